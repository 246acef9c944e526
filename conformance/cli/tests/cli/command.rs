//! What several tests of the command need.

use std::io::Write as _;
use std::path::Path;
use std::process::{Command, Output};

/// Runs the command to its end, without colours.
pub(crate) fn gaugeblock(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_gaugeblock"))
        .args(arguments)
        .env("NO_COLOR", "1")
        .output()
        .expect("the command runs")
}

/// A browser without a window; if none is installed, a notice says which test is left out.
pub(crate) fn browser() -> Option<&'static str> {
    let names = ["chromium", "chromium-browser", "google-chrome"];
    let found = names.into_iter().find(|name| Command::new(name).arg("--version").output().is_ok());
    if found.is_none() {
        // Written past the test runner, which keeps what passing tests print to itself.
        let notice = b"left out: the page in a browser (chromium was not found)\n";
        std::io::stderr().write_all(notice).expect("standard error can be written");
    }
    found
}

/// The page at an address, a file and its filters, after its script has run without an error. `folder` is for the
/// browser's own files.
pub(crate) fn rendered(browser: &str, folder: &Path, address: &str) -> String {
    let output = Command::new(browser)
        .args(["--headless", "--no-sandbox", "--disable-gpu", "--dump-dom"])
        .arg(format!("--user-data-dir={}", folder.join("profile").display()))
        .arg(format!("file://{address}"))
        .output()
        .expect("the browser runs");
    let page = String::from_utf8_lossy(&output.stdout).into_owned();
    assert!(page.contains("data-script=\"ran\""), "its script ran to its end: {page:.400}");
    assert!(!page.contains("data-error"), "and without an error");
    page
}
