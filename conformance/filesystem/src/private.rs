//! Private folders: what a controller and the referee share, and others on the machine must neither read nor change.

use std::collections::BTreeSet;
use std::fs::{DirBuilder, File, OpenOptions, Permissions};
use std::io::{Error, ErrorKind, Result, Write as _};
use std::os::fd::{AsFd, BorrowedFd, OwnedFd};
use std::os::unix::fs::{
    DirBuilderExt as _, MetadataExt as _, OpenOptionsExt as _, PermissionsExt as _,
};
use std::path::{Component, Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use rustix::fs::{AtFlags, CWD, FlockOperation, Mode, OFlags, flock, mkdirat, openat, unlinkat};

/// Permissions of a private folder, whatever the umask: its owner may do everything, others nothing.
const PRIVATE: u32 = 0o700;

/// The prefix of the name of every private folder.
const PREFIX: &str = "gaugeblock-";

/// Another process never removes a younger private folder: it may not be locked yet.
const LEAST_AGE: Duration = Duration::from_secs(600);

/// The private folders of this process.
#[derive(Default)]
struct Folders {
    paths: BTreeSet<PathBuf>,
    /// Parents whose abandoned folders have been removed.
    swept: BTreeSet<PathBuf>,
    /// The process ends, and makes no more folders.
    closed: bool,
}

static FOLDERS: Mutex<Folders> =
    Mutex::new(Folders { paths: BTreeSet::new(), swept: BTreeSet::new(), closed: false });

/// The list stays valid if another thread panics.
fn folders() -> MutexGuard<'static, Folders> {
    FOLDERS.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Removes all private folders of this process, which is about to end by a signal. No folder can be made afterwards.
pub fn remove_private_folders() {
    /// A file may be written into a folder while it is removed.
    const ATTEMPTS: usize = 5;
    let mut folders = folders();
    folders.closed = true;
    for path in std::mem::take(&mut folders.paths) {
        for _attempt in 0..ATTEMPTS {
            if std::fs::remove_dir_all(&path).is_ok() || !path.exists() {
                break;
            }
        }
    }
}

/// A folder that only the user of this process, and root, may enter. It is removed with all that is in it when
/// this is dropped. The folders that a killed process left in the same parent are removed when the first one is made.
#[derive(Debug)]
pub struct PrivateFolder {
    path: PathBuf,
    /// Held open, so that something else under its name changes nothing.
    handle: OwnedFd,
}

impl PrivateFolder {
    /// Makes a new, empty folder among the temporary files; `label` is a part of its name.
    ///
    /// # Errors
    /// It cannot be made, or it is not ours alone.
    pub fn new(label: &str) -> Result<Self> {
        Self::below(&std::env::temp_dir(), label)
    }

    /// Makes a new, empty folder in a folder; `label` is a part of its name.
    ///
    /// # Errors
    /// It cannot be made, or it is not ours alone.
    pub fn below(parent: &Path, label: &str) -> Result<Self> {
        static COUNT: AtomicU64 = AtomicU64::new(0);
        let mut folders = folders();
        if folders.closed {
            return Err(Error::new(ErrorKind::Interrupted, "the process ends"));
        }
        if folders.swept.insert(parent.to_owned()) {
            remove_abandoned(parent);
        }
        loop {
            let number = COUNT.fetch_add(1, Ordering::Relaxed);
            let path = parent.join(format!("{PREFIX}{label}-{}-{number}", std::process::id()));
            match DirBuilder::new().mode(PRIVATE).create(&path) {
                Ok(()) => {
                    let folder = Self::opened(path)?;
                    folders.paths.insert(folder.path.clone());
                    return Ok(folder);
                }
                // Left by a process that had our number, or put there by someone else.
                Err(error) if error.kind() == ErrorKind::AlreadyExists => {}
                Err(error) => return Err(error),
            }
        }
    }

    /// Opens a folder that has just been made, and checks that it is the one.
    fn opened(path: PathBuf) -> Result<Self> {
        let handle = openat(CWD, &path, FOLDER, Mode::empty())?;
        let folder = File::from(handle);
        folder.set_permissions(Permissions::from_mode(PRIVATE))?;
        let found = folder.metadata()?;
        if found.uid() != rustix::process::geteuid().as_raw() || found.mode() & 0o077 != 0 {
            let why = format!("{}: another user owns it or may enter it", path.display());
            return Err(Error::new(ErrorKind::PermissionDenied, why));
        }
        // The lock marks the folder as in use, also for processes in other name spaces.
        let _where_locks_exist = flock(&folder, FlockOperation::NonBlockingLockShared);
        Ok(Self { path, handle: folder.into() })
    }

    /// Where it is.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Writes a file of it, and makes the folders that lead to it. What was there under its name is removed first, and
    /// no link is followed.
    ///
    /// # Errors
    /// A name that leads elsewhere, or a file that cannot be written.
    pub fn write(&self, name: &str, content: impl AsRef<[u8]>) -> Result<File> {
        let not_inside = || Error::new(ErrorKind::InvalidInput, "its name leads out of the folder");
        let mut names = Vec::new();
        for component in Path::new(name).components() {
            let Component::Normal(name) = component else { return Err(not_inside()) };
            names.push(name);
        }
        let file = names.pop().ok_or_else(not_inside)?;
        let mut folder = self.handle.try_clone()?;
        for name in names {
            match mkdirat(&folder, name, Mode::from_raw_mode(0o755)) {
                Ok(()) | Err(rustix::io::Errno::EXIST) => {}
                Err(error) => return Err(error.into()),
            }
            folder = openat(&folder, name, FOLDER, Mode::empty())?;
        }
        let _there_was_none = unlinkat(&folder, file, AtFlags::empty());
        let file = create_new_at(folder.as_fd(), file)?;
        (&file).write_all(content.as_ref())?;
        Ok(file)
    }
}

impl AsFd for PrivateFolder {
    fn as_fd(&self) -> BorrowedFd<'_> {
        self.handle.as_fd()
    }
}

impl Drop for PrivateFolder {
    fn drop(&mut self) {
        // A folder that stays is a nuisance, not a wrong result.
        let _left = std::fs::remove_dir_all(&self.path);
        folders().paths.remove(&self.path);
    }
}

/// Removes the private folders in a folder whose process was killed: they are ours, old enough, and not locked.
fn remove_abandoned(parent: &Path) {
    let Ok(entries) = std::fs::read_dir(parent) else { return };
    for entry in entries.flatten() {
        if entry.file_name().to_string_lossy().starts_with(PREFIX) && is_abandoned(&entry.path()) {
            let _left = std::fs::remove_dir_all(entry.path());
        }
    }
}

fn is_abandoned(path: &Path) -> bool {
    let Ok(handle) = openat(CWD, path, FOLDER, Mode::empty()) else { return false };
    let folder = File::from(handle);
    let Ok(found) = folder.metadata() else { return false };
    let is_old =
        found.modified().is_ok_and(|modified| modified.elapsed().is_ok_and(|age| age > LEAST_AGE));
    found.uid() == rustix::process::geteuid().as_raw()
        && found.mode() & 0o7777 == PRIVATE
        && is_old
        && flock(&folder, FlockOperation::NonBlockingLockExclusive).is_ok()
}

const FOLDER: OFlags =
    OFlags::RDONLY.union(OFlags::DIRECTORY).union(OFlags::NOFOLLOW).union(OFlags::CLOEXEC);

/// A folder that another process shares with this one, in which files are created.
#[derive(Debug)]
pub struct SharedFolder(OwnedFd);

impl SharedFolder {
    /// Opens the folder. Its name may be that of a link, since the caller gives it.
    ///
    /// # Errors
    /// It is not a folder.
    pub fn open(path: &Path) -> Result<Self> {
        let flags = OFlags::RDONLY | OFlags::DIRECTORY | OFlags::CLOEXEC;
        let handle = openat(CWD, path, flags, Mode::empty())?;
        Ok(Self(handle))
    }

    /// Writes a file that was not there before.
    ///
    /// # Errors
    /// Something has its name already, or it cannot be written.
    pub fn write_new(&self, name: &str, content: &[u8]) -> Result<()> {
        create_new_at(self.0.as_fd(), name)?.write_all(content)
    }
}

/// A file in a folder that was not there before. No link is followed to it.
fn create_new_at(folder: BorrowedFd<'_>, name: impl rustix::path::Arg) -> Result<File> {
    let flags = OFlags::WRONLY | OFlags::CREATE | OFlags::EXCL | OFlags::NOFOLLOW | OFlags::CLOEXEC;
    Ok(File::from(openat(folder, name, flags, Mode::from_raw_mode(0o644))?))
}

/// Opens a file that processes of several users lock; it is made where there is none, and never written.
///
/// # Errors
/// It cannot be opened, or a link or something else than a file is in its place.
pub fn open_lock(path: &Path) -> Result<File> {
    let flags = (OFlags::NOFOLLOW | OFlags::NONBLOCK).bits().cast_signed();
    let made = OpenOptions::new().append(true).create(true).custom_flags(flags).open(path);
    let file = match made {
        // Another user's file cannot be written, but it can be locked.
        Err(error) if error.kind() == ErrorKind::PermissionDenied => {
            OpenOptions::new().read(true).custom_flags(flags).open(path)?
        }
        made => made?,
    };
    if !file.metadata()?.is_file() {
        return Err(Error::new(ErrorKind::InvalidInput, "it is not a file"));
    }
    Ok(file)
}
