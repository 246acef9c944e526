//! The suite on the model and on production, and generated programs.

mod expectations;
mod fingerprint;
mod fuzz;
mod language;
mod machine_units;
mod never_refuses;
mod production;
mod refused_motion;
mod suite;
mod twins;
