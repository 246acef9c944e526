//! The trajectory planner, held to what it promises by its samples.

#[path = "motion/bits.rs"]
mod bits;
#[path = "motion/changes.rs"]
mod changes;
#[path = "motion/check.rs"]
mod check;
#[path = "motion/found.rs"]
mod found;
#[path = "motion/joined.rs"]
mod joined;
#[path = "motion/memory.rs"]
mod memory;
#[path = "motion/operators.rs"]
mod operators;
#[path = "motion/programs.rs"]
mod programs;
#[path = "motion/random.rs"]
mod random;
#[path = "motion/table.rs"]
mod table;
