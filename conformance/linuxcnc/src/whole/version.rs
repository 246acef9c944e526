//! Finds the controller and queries its version, and whether it can have namespaces of its own.

use std::env;
use std::path::PathBuf;
use std::process::Command;

use gaugeblock_adapter::{ControllerError, HarnessError};

use super::session::is_root;

/// The versions that this adapter understands.
const WANTED: &str = "2.9";

/// The programs that starting it takes.
const PROGRAMS: &[&str] = &["linuxcnc", "milltask", "linuxcnc_var", "unshare", "mount", "python3"];

/// The version, such as `2.9.0~pre1`.
///
/// # Errors
/// A program is missing, the version is another one, or the system gives no name spaces.
pub(super) fn query() -> Result<String, ControllerError> {
    let needed = PROGRAMS.iter().chain(is_root().then_some(&"setpriv"));
    for name in needed {
        if find(name).is_none() {
            return Err(ControllerError::Missing {
                searched: format!(
                    "no {name} on the search path (Debian packages linuxcnc-uspace, util-linux)"
                ),
            });
        }
    }
    let broken = |why: String| ControllerError::Broken(HarnessError::NotRun(why));
    let output = Command::new("linuxcnc_var")
        .arg("LINUXCNCVERSION")
        .output()
        .map_err(|error| broken(error.to_string()))?;
    let version = String::from_utf8_lossy(&output.stdout).trim().to_owned();
    if !version.starts_with(WANTED) {
        let found = if version.is_empty() { "unknown".to_owned() } else { version };
        return Err(ControllerError::WrongVersion { found, required: "2.9.x" });
    }
    let mut spaces = Command::new("unshare");
    if !is_root() {
        spaces.args(["--user", "--map-current-user", "--keep-caps"]);
    }
    let tried = spaces
        .args([
            "-i",
            "-n",
            "-m",
            "-p",
            "-f",
            "--mount-proc",
            "--kill-child",
            "mount",
            "--bind",
            "/tmp",
            "/tmp",
        ])
        .output()
        .map_err(|error| broken(error.to_string()))?;
    if !tried.status.success() {
        let why = String::from_utf8_lossy(&tried.stderr).trim().to_owned();
        return Err(broken(format!("no name spaces of its own ({why})")));
    }
    Ok(version)
}

/// The program of a name on the search path.
pub(super) fn find(program: &str) -> Option<PathBuf> {
    let paths = env::var_os("PATH").unwrap_or_default();
    env::split_paths(&paths).map(|path| path.join(program)).find(|path| path.is_file())
}
