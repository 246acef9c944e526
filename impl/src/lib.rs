//! gaugeblock-impl
