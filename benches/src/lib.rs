//! gaugeblock-benches
