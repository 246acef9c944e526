#!/bin/bash -eu
# Builds each target of fuzz/targets, with its corpus, into $OUT: ClusterFuzzLite calls this in the image of the Dockerfile.
cd "$SRC/gaugeblock"
built=$PWD/target/clusterfuzzlite
cargo fuzz build -O --debug-assertions --fuzz-dir fuzz/targets --features libfuzzer --target-dir "$built"
for source in fuzz/targets/fuzz_targets/*.rs; do
  name=$(basename "$source" .rs)
  cp "$built/x86_64-unknown-linux-gnu/release/$name" "$OUT/"
  zip --quiet --junk-paths "$OUT/${name}_seed_corpus.zip" "fuzz/targets/corpus/$name"/*
done
