//! A private folder of a session, for answers in files. No path outside of it can be named.

use std::fs::File;
use std::io::Read;
use std::os::unix::fs::MetadataExt;
use std::path::Path;

use gaugeblock_filesystem::PrivateFolder;
use rustix::fs::{AtFlags, Mode, OFlags, openat, unlinkat};

/// The folder. It is removed with its files when it is dropped.
#[derive(Debug)]
pub(super) struct ExchangeFolder(PrivateFolder);

impl ExchangeFolder {
    /// Creates a folder that no other user may enter.
    pub(super) fn make() -> std::io::Result<Self> {
        PrivateFolder::new("answers").map(Self)
    }

    /// Its path.
    pub(super) fn path(&self) -> &Path {
        self.0.path()
    }

    /// Reads a file of it and removes it.
    ///
    /// # Errors
    /// The name is not that of a file in the folder, or the file has more than `most` bytes.
    pub(super) fn take(&self, name: &str, most: usize) -> Result<Vec<u8>, String> {
        if name.is_empty() || name.starts_with('.') || name.contains(['/', '\\', '\0']) {
            return Err("its name is not that of a file in the folder".to_owned());
        }
        // Anything that is not a regular file must be neither followed nor waited for.
        let flags = OFlags::RDONLY | OFlags::NOFOLLOW | OFlags::NONBLOCK | OFlags::CLOEXEC;
        let file = openat(&self.0, name, flags, Mode::empty())
            .map_err(|error| std::io::Error::from(error).to_string())?;
        let mut file = File::from(file);
        let about = file.metadata().map_err(|error| error.to_string())?;
        if !about.is_file() || about.nlink() != 1 {
            return Err("it is not a regular file with one link".to_owned());
        }
        let limit = u64::try_from(most).unwrap_or(u64::MAX);
        let mut bytes = Vec::new();
        let read = (&mut file).take(limit.saturating_add(1)).read_to_end(&mut bytes);
        // If this fails, the file goes with the folder.
        let _removed = unlinkat(&self.0, name, AtFlags::empty());
        read.map_err(|error| error.to_string())?;
        if bytes.len() > most {
            return Err(format!("it has more than {most} bytes"));
        }
        Ok(bytes)
    }
}

#[cfg(test)]
mod tests {
    use std::fs::write;

    use super::*;

    #[test]
    fn only_files_of_the_folder_are_read_and_nothing_is_left() {
        let folder = ExchangeFolder::make().unwrap();
        let path = folder.path().to_owned();
        write(path.join("answer"), "1234").unwrap();
        assert_eq!(folder.take("answer", 4), Ok(b"1234".to_vec()));
        assert!(folder.take("answer", 4).is_err(), "it is read once");
        write(path.join("long"), "12345").unwrap();
        assert!(folder.take("long", 4).unwrap_err().contains("more than 4 bytes"));
        let outside = path.with_extension("outside");
        write(&outside, "secret").unwrap();
        std::os::unix::fs::symlink(&outside, path.join("link")).unwrap();
        std::fs::hard_link(&outside, path.join("hard")).unwrap();
        std::fs::create_dir(path.join("folder")).unwrap();
        for name in ["link", "hard", "folder", "", ".", "..", "folder/x", "/etc/passwd", ".hidden"]
        {
            assert!(folder.take(name, 100).is_err(), "{name}");
        }
        // Another folder under the same name is not read.
        let moved = path.with_extension("moved");
        std::fs::rename(&path, &moved).unwrap();
        std::fs::create_dir(&path).unwrap();
        write(path.join("answer"), "other").unwrap();
        assert!(folder.take("answer", 100).is_err());
        drop(folder);
        assert!(!path.exists());
        std::fs::remove_dir_all(&moved).unwrap();
        std::fs::remove_file(&outside).unwrap();
    }
}
