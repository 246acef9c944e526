//! The program that is run, in a cleaned environment.

use std::ffi::OsString;
use std::os::unix::process::CommandExt as _;
use std::path::Path;
use std::process::Command;

/// What is started.
#[derive(Clone, Copy, Debug)]
pub(super) struct Started<'a> {
    /// The binary.
    pub(super) binary: &'a Path,
    /// Home of the Python within; its own if none.
    pub(super) python: Option<&'a Path>,
}

impl Started<'_> {
    /// The program in `directory`, which is its home as well.
    pub(super) fn command(&self, arguments: &[OsString], directory: &Path) -> Command {
        let mut command = Command::new(self.binary);
        command.args(arguments).current_dir(directory).process_group(0);
        command.env_clear().env("HOME", directory).env("LC_ALL", "C");
        command.envs(self.python.map(|home| ("PYTHONHOME", home)));
        command
    }
}
