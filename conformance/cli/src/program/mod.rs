//! Programs of users: what belongs to one, the machine that it runs on, and how its run is printed.

pub(crate) mod called_files;
pub(crate) mod causes;
pub(crate) mod machine_files;
pub(crate) mod own_name;
pub(crate) mod remarks;
pub(crate) mod run_setup;
pub(crate) mod run_text;
