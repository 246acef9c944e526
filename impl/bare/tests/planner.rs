//! Samples have the bits that they have elsewhere, and nothing is allocated: tests of `gaugeblock-impl`, on whatever
//! processor this is built for.

extern crate gaugeblock_bare as gaugeblock_impl;

#[path = "../../tests/motion/bits.rs"]
mod bits;
#[expect(dead_code, reason = "other tests use the others")]
#[path = "../../tests/motion/check.rs"]
mod check;
#[path = "../../tests/motion/memory.rs"]
mod memory;
#[path = "../../tests/motion/programs.rs"]
mod programs;
