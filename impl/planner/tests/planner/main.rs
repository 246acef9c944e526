//! The trajectory planner, checked by its samples.

mod bits;
mod changes;
mod check;
mod found;
mod joined;
mod memory;
mod operators;
mod programs;
mod random;
mod table;
