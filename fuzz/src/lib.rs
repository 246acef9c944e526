//! gaugeblock-fuzz
