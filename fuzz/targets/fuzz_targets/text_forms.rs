//! `gaugeblock_fuzz_targets::text_forms` as a target of libFuzzer.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| gaugeblock_fuzz_targets::text_forms(bytes));
