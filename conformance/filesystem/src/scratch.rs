//! Scratch files: what a process keeps on the disk while it runs.

use std::fs::{File, OpenOptions};
use std::io::Result;
use std::os::unix::fs::{FileExt as _, OpenOptionsExt as _};

use crate::private::PrivateFolder;

/// A file without a name, which only this process can read. It is gone when this is dropped, and when the process is
/// killed.
#[derive(Debug)]
pub struct ScratchFile {
    file: File,
    length: u64,
}

impl ScratchFile {
    /// Makes an empty one among the temporary files; `label` is a part of the name that it has for a moment.
    ///
    /// # Errors
    /// It cannot be made.
    pub fn new(label: &str) -> Result<Self> {
        let folder = PrivateFolder::new(label)?;
        let mut options = OpenOptions::new();
        let options = options.read(true).write(true).create_new(true).mode(0o600);
        // The folder is removed with the name of the file, and the file stays for as long as it is open.
        Ok(Self { file: options.open(folder.path().join("scratch"))?, length: 0 })
    }

    /// Appends bytes, and returns where they begin.
    ///
    /// # Errors
    /// They cannot be written.
    pub fn append(&mut self, bytes: &[u8]) -> Result<u64> {
        let place = self.length;
        self.file.write_all_at(bytes, place)?;
        self.length += bytes.len() as u64;
        Ok(place)
    }

    /// Writes bytes over those at a place.
    ///
    /// # Errors
    /// They cannot be written.
    pub fn replace(&mut self, place: u64, bytes: &[u8]) -> Result<()> {
        self.file.write_all_at(bytes, place)
    }

    /// Reads the bytes at a place.
    ///
    /// # Errors
    /// They cannot be read, or there are not so many.
    pub fn read(&self, place: u64, bytes: &mut [u8]) -> Result<()> {
        self.file.read_exact_at(bytes, place)
    }
}
