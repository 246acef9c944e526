//! The suite on the model and on production, and generated programs.

mod compensated_contours;
mod expectations;
mod findings;
mod fingerprint;
mod fuzz;
mod language;
mod machine_units;
mod never_refuses;
mod production;
mod profiles;
mod refused_motion;
mod suite;
mod twins;
