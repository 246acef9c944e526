//! Programs of users: what belongs to one, the machine that it runs on, and how its run is printed.

pub(crate) mod called_files;
pub(crate) mod run_setup;
