//! A release build contains the suite, so that it is built again when a page changes. Other builds read the folder.

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    if std::env::var("PROFILE").is_ok_and(|profile| profile == "release") {
        let suite = std::fs::canonicalize("suite")
            .expect("the link `suite` leads to the folder of the suite");
        println!("cargo::rerun-if-changed={}", suite.display());
    }
}
