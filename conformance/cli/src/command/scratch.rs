//! Samples that do not fit into memory, in a scratch file.

use std::io;

use gaugeblock_filesystem::ScratchFile;
use gaugeblock_reference::motion::recording::{PageStore, Recording, RecordingError};
use gaugeblock_vocabulary::Position;
use gaugeblock_vocabulary::motion::Samples;

use crate::error::CliError;

/// Pages in a scratch file, which is made for the first of them.
#[derive(Debug, Default)]
struct ScratchPages(Option<ScratchFile>);

impl ScratchPages {
    fn call<T>(
        &mut self,
        act: impl FnOnce(&mut ScratchFile) -> io::Result<T>,
    ) -> Result<T, String> {
        let file = match &mut self.0 {
            Some(file) => Ok(file),
            none => ScratchFile::new("samples").map(|file| none.insert(file)),
        };
        file.and_then(act).map_err(|error| error.to_string())
    }
}

impl PageStore for ScratchPages {
    fn append(&mut self, bytes: &[u8]) -> Result<u64, String> {
        self.call(|file| file.append(bytes))
    }

    fn replace(&mut self, place: u64, bytes: &[u8]) -> Result<(), String> {
        self.call(|file| file.replace(place, bytes))
    }

    fn read(&mut self, place: u64, bytes: &mut [u8]) -> Result<(), String> {
        self.call(|file| file.read(place, bytes))
    }
}

/// An empty recording that keeps few samples in memory.
pub(crate) fn recording(header: &Samples, start: Position) -> Recording {
    Recording::new(header, start, Some(Box::new(ScratchPages::default())))
}

/// The error of a recording.
pub(crate) fn failed(error: &RecordingError) -> CliError {
    let message = format!("the samples cannot be kept in a temporary file: {error}");
    CliError::failure(message, "free the disk, or set TMPDIR to a folder with more space")
}
