//! Outputs: files and folders at paths that the caller names.

use std::fs::{DirBuilder, File, Metadata, OpenOptions, Permissions};
use std::io::{BufWriter, Error, ErrorKind, Result, Write};
use std::os::fd::{AsFd as _, OwnedFd};
use std::os::unix::fs::{
    DirBuilderExt as _, MetadataExt as _, OpenOptionsExt as _, PermissionsExt as _,
};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering};

use rustix::fs::{Gid, OFlags, Uid};

/// Links that are followed from a path before it counts as a loop, as in the kernel.
const MOST_LINKS: usize = 40;

/// Permission bits of a file, without those that run it with the rights of its owner.
const FILE_PERMISSIONS: u32 = 0o777;

/// Permission bits of a folder.
const FOLDER_PERMISSIONS: u32 = 0o7777;

/// Writes an output.
///
/// A regular file, or one that is not there yet, is written whole or not at all: a new file in its folder replaces it,
/// with its permissions and, where the system allows it, its owner. Links that lead to it stay. Anything else, such as
/// a device, a FIFO or standard output, is written in place.
///
/// # Errors
/// It cannot be written. A regular file is unchanged then.
pub fn write_output(path: &Path, content: impl AsRef<[u8]>) -> Result<()> {
    write(path, &mut |file| file.write_all(content.as_ref()), None)
}

/// The same for an output that is too long to be kept in memory: a function writes it, part by part.
///
/// # Errors
/// It cannot be written, or the function fails. A regular file is unchanged then.
pub fn write_long_output(
    path: &Path,
    mut content: impl FnMut(&mut dyn Write) -> Result<()>,
) -> Result<()> {
    let buffered = &mut |file: &mut File| {
        let mut buffer = BufWriter::new(file);
        content(&mut buffer)?;
        buffer.flush()
    };
    write(path, buffered, None)
}

/// Writes outputs that belong together, each a regular file or one that is not there yet. Each new file is written
/// whole before the first takes its place.
///
/// # Errors
/// One of them cannot be written, or is something else than a regular file. Until all are written, nothing is changed.
pub fn write_outputs(outputs: &[(&Path, &[u8])]) -> Result<()> {
    let written = outputs.iter().map(|(path, content)| partial(path, content));
    let written = written.collect::<Result<Vec<_>>>()?;
    written.into_iter().try_for_each(PartialFile::finish)
}

/// Writes a new file for a path at which there is a regular file, or a link to one, or nothing.
fn partial(path: &Path, content: &[u8]) -> Result<PartialFile> {
    let content = &mut |file: &mut File| file.write_all(content);
    match path.metadata() {
        Ok(found) if found.is_file() => {
            let target = path.canonicalize()?;
            // A file that must not be written is not replaced either.
            drop(OpenOptions::new().write(true).open(&target)?);
            PartialFile::new(&target, content, Some(&found))
        }
        Ok(_) => Err(Error::new(ErrorKind::InvalidInput, "it is not a regular file")),
        Err(error) if error.kind() == ErrorKind::NotFound => {
            PartialFile::new(&target(path)?, content, None)
        }
        Err(error) => Err(error),
    }
}

/// Opens an output that is too long to be kept, and is therefore written in place. What was there is gone.
///
/// # Errors
/// It cannot be opened.
pub fn open_output(path: &Path) -> Result<File> {
    let stream = path.metadata().ok().map(|found| own_stream(&found)).transpose()?.flatten();
    match stream {
        Some(stream) => Ok(File::from(stream)),
        None => File::create(path),
    }
}

/// Copies a regular file to an output, which has its permissions unless it is there already. Anything else is not
/// copied.
///
/// # Errors
/// It cannot be read, or the output cannot be written.
pub fn copy_output(from: &Path, to: &Path) -> Result<()> {
    let found = match from.metadata() {
        Err(error) if error.kind() == ErrorKind::NotFound => return Ok(()),
        found => found?,
    };
    if !found.is_file() {
        return Ok(());
    }
    let content = std::fs::read(from)?;
    write(to, &mut |file| file.write_all(&content), Some(&found))
}

/// Writes the content of a file.
type Content<'a> = &'a mut dyn FnMut(&mut File) -> Result<()>;

/// Writes an output; `like` has the permissions of a new file.
fn write(path: &Path, content: Content<'_>, like: Option<&Metadata>) -> Result<()> {
    let found = match path.metadata() {
        Ok(found) => found,
        Err(error) if error.kind() == ErrorKind::NotFound => {
            return replace(&target(path)?, content, like);
        }
        Err(error) => return Err(error),
    };
    if let Some(stream) = own_stream(&found)? {
        return content(&mut File::from(stream));
    }
    if found.is_file() {
        // The path of an open file below /proc may lead to a name that is another file's by now.
        let target = path.canonicalize().ok();
        let is_it = |other: &PathBuf| other.metadata().is_ok_and(|other| is_same(&other, &found));
        if let Some(target) = target.filter(is_it) {
            // A file that must not be written is not replaced either.
            drop(OpenOptions::new().write(true).open(&target)?);
            return replace(&target, content, Some(&found));
        }
    }
    content(&mut OpenOptions::new().write(true).truncate(found.is_file()).open(path)?)
}

/// The path at the end of a chain of links that lead to nothing yet.
fn target(path: &Path) -> Result<PathBuf> {
    let mut path = path.to_owned();
    for _ in 0..MOST_LINKS {
        match std::fs::read_link(&path) {
            Ok(next) => path = path.parent().unwrap_or(Path::new("")).join(next),
            // It is no link, or nothing at all.
            Err(error)
                if [ErrorKind::InvalidInput, ErrorKind::NotFound].contains(&error.kind()) =>
            {
                return Ok(path);
            }
            Err(error) => return Err(error),
        }
    }
    Err(Error::other("too many links lead from it"))
}

/// Standard output or standard error, if the file is one of them: two openings of one file would overwrite each other.
fn own_stream(found: &Metadata) -> Result<Option<OwnedFd>> {
    let (output, errors) = (std::io::stdout(), std::io::stderr());
    for stream in [output.as_fd(), errors.as_fd()] {
        if let Ok(stream) = stream.try_clone_to_owned() {
            let stream = File::from(stream);
            if is_same(&stream.metadata()?, found) {
                std::io::stdout().flush()?;
                return Ok(Some(stream.into()));
            }
        }
    }
    Ok(None)
}

/// The folder in which a path is.
fn parent(path: &Path) -> &Path {
    path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."))
}

fn is_same(one: &Metadata, other: &Metadata) -> bool {
    (one.dev(), one.ino()) == (other.dev(), other.ino())
}

/// Puts a new file at a path at which there is a regular file or nothing.
fn replace(path: &Path, content: Content<'_>, like: Option<&Metadata>) -> Result<()> {
    PartialFile::new(path, content, like)?.finish()
}

/// A file that is written whole under another name, before it takes its place.
#[derive(Debug)]
struct PartialFile {
    target: PathBuf,
    partial: PathBuf,
}

impl PartialFile {
    /// Writes what is to be at a path at which there is a regular file or nothing.
    fn new(target: &Path, content: Content<'_>, like: Option<&Metadata>) -> Result<Self> {
        let create = |name: &Path| {
            // Where the permissions are those of another file, the content is private until they are set.
            let mode = if like.is_some() { 0o600 } else { 0o666 };
            new_file(name, mode)
        };
        let (partial, mut file) = under_new_name(parent(target), create)?;
        let made = Self { target: target.to_owned(), partial };
        content(&mut file)?;
        if let Some(like) = like {
            take_after(&file, like)?;
        }
        Ok(made)
    }

    /// Puts it at its place.
    fn finish(self) -> Result<()> {
        std::fs::rename(&self.partial, &self.target)
    }
}

impl Drop for PartialFile {
    fn drop(&mut self) {
        // Once it is at its place there is nothing left here.
        let _gone = std::fs::remove_file(&self.partial);
    }
}

/// Gives a file the owner, if the system allows it, and the permissions of another one.
fn take_after(file: &File, like: &Metadata) -> Result<()> {
    let own = file.metadata()?;
    let (user, group) = (Uid::from_raw(like.uid()), Gid::from_raw(like.gid()));
    if own.uid() != like.uid() {
        let _if_allowed = rustix::fs::fchown(file, Some(user), None);
    }
    if own.gid() != like.gid() {
        let _if_allowed = rustix::fs::fchown(file, None, Some(group));
    }
    let mask = if like.is_dir() { FOLDER_PERMISSIONS } else { FILE_PERMISSIONS };
    file.set_permissions(Permissions::from_mode(like.mode() & mask))
}

/// A file that was not there before; no link is followed to it.
fn new_file(path: &Path, mode: u32) -> Result<File> {
    let flags = OFlags::NOFOLLOW.bits().cast_signed();
    OpenOptions::new().write(true).create_new(true).mode(mode).custom_flags(flags).open(path)
}

/// Creates something in a folder under a name that is still free.
fn under_new_name<T>(folder: &Path, create: impl Fn(&Path) -> Result<T>) -> Result<(PathBuf, T)> {
    static COUNT: AtomicU64 = AtomicU64::new(0);
    loop {
        let number = COUNT.fetch_add(1, Ordering::Relaxed);
        let name = format!(".gaugeblock-{}-{number}.partial", std::process::id());
        let path = folder.join(name);
        match create(&path) {
            Ok(made) => return Ok((path, made)),
            // Left by a process that had our number.
            Err(error) if error.kind() == ErrorKind::AlreadyExists => {}
            Err(error) => return Err(error),
        }
    }
}

/// Makes a folder for results where there is none, and checks that files can be created in it.
///
/// # Errors
/// It cannot be made, or nothing can be created in it.
pub fn check_folder(path: &Path) -> Result<()> {
    std::fs::create_dir_all(path)?;
    let (probe, _file) = under_new_name(path, |name| new_file(name, 0o600))?;
    std::fs::remove_file(probe)
}

/// A folder that is written under another name first, so that it is there whole or not at all.
#[derive(Debug)]
pub struct PartialFolder {
    target: PathBuf,
    partial: PathBuf,
}

impl PartialFolder {
    /// Begins a folder at a path at which there is an empty folder or nothing.
    ///
    /// # Errors
    /// It cannot be made there.
    pub fn new(path: &Path) -> Result<Self> {
        let found = path.metadata().ok();
        let target = if found.is_some() { path.canonicalize()? } else { target(path)? };
        std::fs::create_dir_all(parent(&target))?;
        let mode = if found.is_some() { 0o700 } else { 0o777 };
        let create = |name: &Path| DirBuilder::new().mode(mode).create(name);
        let (partial, ()) = under_new_name(parent(&target), create)?;
        let made = Self { target, partial };
        if let Some(found) = found {
            take_after(&File::open(&made.partial)?, &found)?;
        }
        Ok(made)
    }

    /// Writes a file of it, and the folders that lead to it.
    ///
    /// # Errors
    /// It cannot be written.
    pub fn write(&self, name: impl AsRef<Path>, content: impl AsRef<[u8]>) -> Result<()> {
        let path = self.partial.join(name);
        std::fs::create_dir_all(parent(&path))?;
        std::fs::write(path, content)
    }

    /// Puts it at its place.
    ///
    /// # Errors
    /// Something is there by now.
    pub fn finish(self) -> Result<()> {
        std::fs::rename(&self.partial, &self.target)
    }
}

impl Drop for PartialFolder {
    fn drop(&mut self) {
        // Once it is at its place there is nothing left here.
        let _gone = std::fs::remove_dir_all(&self.partial);
    }
}

/// Moves a file into a folder, and makes the folder if it is absent. A file of the same name in it is replaced.
///
/// # Errors
/// It has no name, the folder cannot be made, or it is on another file system.
pub fn move_into(file: &Path, folder: &Path) -> Result<()> {
    let name = file.file_name().ok_or(ErrorKind::InvalidInput)?;
    std::fs::create_dir_all(folder)?;
    std::fs::rename(file, folder.join(name))
}
