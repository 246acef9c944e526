//! gaugeblock-reference
