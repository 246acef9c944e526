//! Each kind of file at the path of an output, before it is written and after.

use std::fs::{self, Permissions};
use std::io::{Error, Write};
use std::os::unix::fs::{FileTypeExt as _, MetadataExt as _, PermissionsExt as _, symlink};
use std::path::{Path, PathBuf};
use std::thread;
use std::time::Duration;

use rustix::fs::{CWD, FileType, Mode, mknodat};

use super::*;

/// An empty folder for a test, removed when it is dropped.
struct Scratch(PathBuf);

impl Scratch {
    fn new(name: &str) -> Self {
        let path = std::env::temp_dir()
            .join(format!("gaugeblock-filesystem-{name}-{}", std::process::id()));
        fs::create_dir(&path).unwrap();
        Self(path)
    }

    fn path(&self, name: &str) -> PathBuf {
        self.0.join(name)
    }

    /// Names in it, sorted.
    fn names(&self) -> Vec<String> {
        let names = fs::read_dir(&self.0).unwrap();
        let mut names: Vec<_> =
            names.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
        names.sort();
        names
    }
}

impl Drop for Scratch {
    fn drop(&mut self) {
        fs::remove_dir_all(&self.0).unwrap();
    }
}

fn mode(path: &Path) -> u32 {
    path.metadata().unwrap().permissions().mode() & 0o7777
}

#[test]
fn new_file_has_default_permissions_and_no_leftovers() {
    let scratch = Scratch::new("new");
    fs::write(scratch.path("usual"), "").unwrap();
    write_output(&scratch.path("out"), "text").unwrap();
    assert_eq!(fs::read(scratch.path("out")).unwrap(), b"text");
    assert_eq!(mode(&scratch.path("out")), mode(&scratch.path("usual")));
    assert_eq!(scratch.names(), ["out", "usual"]);
}

#[test]
fn a_regular_file_keeps_its_permissions_and_its_links() {
    let scratch = Scratch::new("regular");
    fs::create_dir(scratch.path("folder")).unwrap();
    symlink("folder/file", scratch.path("link")).unwrap();
    symlink("link", scratch.path("link-to-link")).unwrap();
    for permissions in [0o600, 0o640, 0o644, 0o755] {
        for name in ["folder/file", "link", "link-to-link"] {
            let file = scratch.path("folder/file");
            fs::write(&file, "before, and longer").unwrap();
            fs::set_permissions(&file, Permissions::from_mode(permissions)).unwrap();
            let before = file.metadata().unwrap();
            write_output(&scratch.path(name), "after").unwrap();
            assert_eq!(fs::read(&file).unwrap(), b"after", "{name}");
            let after = file.symlink_metadata().unwrap();
            assert_eq!(mode(&file), permissions, "{name}");
            assert_eq!((after.uid(), after.gid()), (before.uid(), before.gid()));
            assert_ne!(after.ino(), before.ino(), "it is replaced as a whole");
        }
    }
    assert!(scratch.path("link").is_symlink() && scratch.path("link-to-link").is_symlink());
    assert_eq!(scratch.names(), ["folder", "link", "link-to-link"]);
}

#[test]
fn root_keeps_the_owner_of_a_file() {
    let scratch = Scratch::new("owner");
    let file = scratch.path("file");
    fs::write(&file, "before").unwrap();
    if std::os::unix::fs::chown(&file, Some(65534), Some(65533)).is_err() {
        return;
    }
    write_output(&file, "after").unwrap();
    let owner = file.metadata().unwrap();
    assert_eq!((owner.uid(), owner.gid()), (65534, 65533));
}

#[test]
fn a_link_that_dangles_gets_its_target() {
    let scratch = Scratch::new("dangling");
    symlink("next", scratch.path("link")).unwrap();
    symlink("target", scratch.path("next")).unwrap();
    write_output(&scratch.path("link"), "text").unwrap();
    assert_eq!(fs::read(scratch.path("target")).unwrap(), b"text");
    assert!(scratch.path("link").is_symlink() && scratch.path("next").is_symlink());
    symlink("loop", scratch.path("loop")).unwrap();
    assert!(write_output(&scratch.path("loop"), "text").is_err());
}

#[test]
fn a_device_a_fifo_and_an_open_file_are_written_in_place() {
    let scratch = Scratch::new("in-place");
    let permissions = Mode::from_raw_mode(0o600);
    let fifo = scratch.path("fifo");
    mknodat(CWD, &fifo, FileType::Fifo, permissions, 0).unwrap();
    symlink("fifo", scratch.path("link-to-fifo")).unwrap();
    for name in ["fifo", "link-to-fifo"] {
        let reader = thread::spawn({
            let fifo = fifo.clone();
            move || fs::read(fifo).unwrap()
        });
        write_output(&scratch.path(name), "text").unwrap();
        assert_eq!(reader.join().unwrap(), b"text");
        assert!(fifo.symlink_metadata().unwrap().file_type().is_fifo());
    }
    // Only root may make a device; it has the number of /dev/null.
    let device = scratch.path("device");
    let null = rustix::fs::makedev(1, 3);
    if mknodat(CWD, &device, FileType::CharacterDevice, permissions, null).is_ok() {
        write_output(&device, "text").unwrap();
        assert!(device.symlink_metadata().unwrap().file_type().is_char_device());
    }
    let open = fs::File::create(scratch.path("open")).unwrap();
    let named = format!("/proc/self/fd/{}", std::os::fd::AsRawFd::as_raw_fd(&open));
    fs::remove_file(scratch.path("open")).unwrap();
    write_output(Path::new(&named), "text").unwrap();
    assert_eq!(open.metadata().unwrap().len(), 4, "a file without a name any more");
}

#[test]
fn failed_write_leaves_the_old_file() {
    let scratch = Scratch::new("refused");
    fs::create_dir(scratch.path("folder")).unwrap();
    assert!(write_output(&scratch.path("folder"), "text").is_err());
    assert!(write_output(&scratch.path("absent/file"), "text").is_err());
    assert_eq!(scratch.names(), ["folder"]);
}

#[test]
fn outputs_that_belong_together_are_all_written_or_none() {
    let scratch = Scratch::new("together");
    let (one, two) = (scratch.path("one"), scratch.path("two"));
    write_outputs(&[(&one, b"1"), (&two, b"2")]).unwrap();
    fs::set_permissions(&one, Permissions::from_mode(0o600)).unwrap();
    write_outputs(&[(&one, b"first"), (&two, b"second")]).unwrap();
    assert_eq!(
        (fs::read(&one).unwrap(), fs::read(&two).unwrap()),
        (b"first".to_vec(), b"second".to_vec())
    );
    assert_eq!(mode(&one), 0o600);
    fs::create_dir(scratch.path("folder")).unwrap();
    for other in ["folder", "absent/file"] {
        assert!(
            write_outputs(&[(&one, b"new"), (&scratch.path(other), b"new")]).is_err(),
            "{other}"
        );
        assert_eq!(fs::read(&one).unwrap(), b"first", "{other}");
    }
    assert_eq!(scratch.names(), ["folder", "one", "two"]);
}

#[test]
fn links_at_the_names_of_partial_files_are_not_followed() {
    let scratch = Scratch::new("partial");
    fs::write(scratch.path("victim"), "kept").unwrap();
    symlink("victim", scratch.path("out.partial")).unwrap();
    symlink("victim", scratch.path(".gaugeblock-partial")).unwrap();
    for number in 0..100 {
        let name = format!(".gaugeblock-{}-{number}.partial", std::process::id());
        symlink("victim", scratch.path(&name)).unwrap();
    }
    write_output(&scratch.path("out"), "text").unwrap();
    check_folder(&scratch.0).unwrap();
    PartialFolder::new(&scratch.path("campaign")).unwrap().finish().unwrap();
    assert_eq!(fs::read(scratch.path("victim")).unwrap(), b"kept");
    assert_eq!(fs::read(scratch.path("out")).unwrap(), b"text");
    assert!(!scratch.path("out").is_symlink());
}

#[test]
fn a_folder_is_there_whole_with_the_permissions_of_the_empty_one() {
    let scratch = Scratch::new("folder");
    fs::create_dir(scratch.path("empty")).unwrap();
    fs::set_permissions(scratch.path("empty"), Permissions::from_mode(0o2750)).unwrap();
    symlink("empty", scratch.path("link")).unwrap();
    let folder = PartialFolder::new(&scratch.path("link")).unwrap();
    folder.write("a/b", "text").unwrap();
    assert_eq!(fs::read_dir(scratch.path("empty")).unwrap().count(), 0);
    folder.finish().unwrap();
    assert_eq!(fs::read(scratch.path("empty/a/b")).unwrap(), b"text");
    assert_eq!(mode(&scratch.path("empty")), 0o2750);
    drop(PartialFolder::new(&scratch.path("other")).unwrap());
    assert_eq!(scratch.names(), ["empty", "link"]);
}

#[test]
fn a_copy_has_the_permissions_of_the_original() {
    let scratch = Scratch::new("copy");
    let (original, copy) = (scratch.path("original"), scratch.path("copy"));
    copy_output(&original, &copy).unwrap();
    assert!(!copy.exists(), "there is nothing to copy");
    fs::write(&original, "text").unwrap();
    fs::set_permissions(&original, Permissions::from_mode(0o600)).unwrap();
    copy_output(&original, &copy).unwrap();
    assert_eq!((fs::read(&copy).unwrap(), mode(&copy)), (b"text".to_vec(), 0o600));
}

#[test]
fn a_private_folder_is_ours_alone_and_goes_away() {
    let scratch = Scratch::new("private");
    fs::set_permissions(&scratch.0, Permissions::from_mode(0o2777)).unwrap();
    let (one, two) = (PrivateFolder::new("test").unwrap(), PrivateFolder::new("test").unwrap());
    let third = PrivateFolder::below(&scratch.0, "test").unwrap();
    for folder in [&one, &two, &third] {
        assert_eq!(mode(folder.path()) & 0o777, 0o700);
        let owner = folder.path().metadata().unwrap().uid();
        assert_eq!(owner, rustix::process::geteuid().as_raw());
    }
    assert_ne!(one.path(), two.path());
    let path = one.path().to_owned();
    one.write("a/b.txt", "text").unwrap();
    assert_eq!(fs::read(path.join("a/b.txt")).unwrap(), b"text");
    drop(one);
    assert!(!path.exists() && two.path().exists());
    assert!(PrivateFolder::below(&scratch.path("absent"), "test").is_err());
}

#[test]
fn a_private_folder_is_ours_alone_whatever_the_umask() {
    let test = "tests::a_private_folder_is_ours_alone_and_goes_away";
    for umask in ["000", "002", "022", "027", "077"] {
        let mut shell = std::process::Command::new("sh");
        shell.args(["-c", "umask $0; exec \"$@\"", umask]);
        let tests = std::env::current_exe().unwrap();
        let output = shell.arg(tests).args(["--exact", test]).output().unwrap();
        let said = String::from_utf8_lossy(&output.stdout);
        assert!(output.status.success() && said.contains("1 passed"), "{umask}: {said}");
    }
}

#[test]
fn a_private_folder_writes_nothing_outside() {
    let (scratch, folder) = (Scratch::new("outside"), PrivateFolder::new("test").unwrap());
    fs::write(scratch.path("victim"), "kept").unwrap();
    symlink(scratch.path("victim"), folder.path().join("file")).unwrap();
    symlink(&scratch.0, folder.path().join("folder")).unwrap();
    folder.write("file", "text").unwrap();
    assert!(folder.write("folder/file", "text").is_err());
    for name in ["", "..", "../x", "/tmp/x", "a/../../x"] {
        assert!(folder.write(name, "text").is_err(), "{name}");
    }
    assert_eq!(fs::read(scratch.path("victim")).unwrap(), b"kept");
    assert_eq!(scratch.names(), ["victim"]);
}

#[test]
fn a_lock_is_a_file_and_no_link() {
    let scratch = Scratch::new("lock");
    open_lock(&scratch.path("lock")).unwrap().lock().unwrap();
    symlink("target", scratch.path("link")).unwrap();
    mknodat(CWD, scratch.path("fifo"), FileType::Fifo, Mode::from_raw_mode(0o600), 0).unwrap();
    assert!(open_lock(&scratch.path("link")).is_err());
    assert!(open_lock(&scratch.path("fifo")).is_err());
    assert_eq!(scratch.names(), ["fifo", "link", "lock"]);
}

#[test]
fn folders_of_killed_processes_are_removed() {
    let scratch = Scratch::new("abandoned");
    let made = |name: &str, mode: u32, hours: u64| {
        let path = scratch.path(name);
        fs::create_dir(&path).unwrap();
        fs::write(path.join("left"), "").unwrap();
        let folder = fs::File::open(&path).unwrap();
        folder.set_permissions(Permissions::from_mode(mode)).unwrap();
        let now = folder.metadata().unwrap().modified().unwrap();
        folder.set_modified(now - Duration::from_secs(3600 * hours)).unwrap();
        folder
    };
    made("gaugeblock-rs274-1-0", 0o700, 1);
    made("gaugeblock-young-1-0", 0o700, 0);
    made("gaugeblock-open-to-all-1-0", 0o755, 1);
    made("of-another-program", 0o700, 1);
    let lives = made("gaugeblock-lives-1-0", 0o700, 1);
    rustix::fs::flock(&lives, rustix::fs::FlockOperation::LockShared).unwrap();
    drop(PrivateFolder::below(&scratch.0, "new").unwrap());
    let kept = [
        "gaugeblock-lives-1-0",
        "gaugeblock-open-to-all-1-0",
        "gaugeblock-young-1-0",
        "of-another-program",
    ];
    assert_eq!(scratch.names(), kept);
}

#[test]
fn a_private_folder_says_that_its_process_lives() {
    let scratch = Scratch::new("lock");
    let folder = PrivateFolder::below(&scratch.0, "new").unwrap();
    let other = fs::File::open(folder.path()).unwrap();
    let exclusive = rustix::fs::FlockOperation::NonBlockingLockExclusive;
    assert!(rustix::fs::flock(&other, exclusive).is_err());
}

#[test]
fn long_output_is_whole_or_unchanged() {
    let scratch = Scratch::new("long");
    let path = scratch.path("out");
    write_long_output(&path, |file| (0..9).try_for_each(|number| write!(file, "{number}")))
        .unwrap();
    assert_eq!(fs::read(&path).unwrap(), b"012345678");
    let fails = |file: &mut dyn Write| {
        file.write_all(b"half")?;
        Err(Error::other("no more"))
    };
    assert_eq!(write_long_output(&path, fails).unwrap_err().to_string(), "no more");
    assert_eq!(fs::read(&path).unwrap(), b"012345678");
    assert_eq!(scratch.names(), ["out"]);
}

#[test]
fn scratch_file_reads_what_it_wrote() {
    let mut file = ScratchFile::new("scratch-test").unwrap();
    assert_eq!(file.append(b"one").unwrap(), 0);
    assert_eq!(file.append(b"two").unwrap(), 3);
    file.replace(0, b"ONE").unwrap();
    let mut bytes = [0; 6];
    file.read(0, &mut bytes).unwrap();
    assert_eq!(&bytes, b"ONEtwo");
    assert!(file.read(1, &mut bytes).is_err());
}
