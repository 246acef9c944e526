//! Laws of the repository: what the design promises about its crates and files, a test each.

mod crates;
mod files;
mod graph;
mod independence;
mod licences;
mod mutants;
mod prose;
mod toolchain;

/// Fails with the list of exceptions to a law, when there are any.
#[track_caller]
fn holds(law: &str, exceptions: &[String]) {
    assert!(exceptions.is_empty(), "{law}, but:\n  {}", exceptions.join("\n  "));
}
