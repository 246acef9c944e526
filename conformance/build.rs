//! Builds the suite into the program, anew whenever a page changes.

fn main() {
    println!("cargo::rerun-if-changed=suite");
}
