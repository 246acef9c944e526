//! gaugeblock
