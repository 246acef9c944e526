//! Files of the host: outputs at paths that the caller names, private folders, scratch files, and inputs from folders
//! of others.
//!
//! **Invariants.** An output never replaces a device, a FIFO or a link. No link is followed to a file that this module
//! creates under a name of its own.

mod input;
mod output;
mod private;
mod scratch;
#[cfg(test)]
mod tests;

pub use input::read_regular;
pub use output::{
    PartialFolder, check_folder, copy_output, move_into, open_output, write_long_output,
    write_output, write_outputs,
};
pub use private::{PrivateFolder, SharedFolder, open_lock, remove_private_folders};
pub use scratch::ScratchFile;
