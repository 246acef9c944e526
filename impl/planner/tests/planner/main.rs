//! The trajectory planner, checked by its samples.

mod bits;
mod check;
mod corners;
mod cycle_times;
mod jerk;
mod known_times;
mod memory;
mod merging;
mod monotonic_times;
mod operators;
mod programs;
mod random;
mod regressions;
mod stalls;
