//! Crates of the workspace and their dependencies, as `cargo metadata` reports them.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;
use std::process::Command;

use serde_json::Value;

use crate::files;

/// A crate of this workspace.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Crate {
    /// Name of the package.
    pub name: String,
    /// Its folder, from the root of the repository.
    pub folder: String,
    /// What it builds.
    pub targets: Vec<Target>,
    /// Names of the packages that its library and programs depend on.
    pub dependencies: BTreeSet<String>,
    /// Names of the packages that its tests and its build script depend on besides.
    pub dev_dependencies: BTreeSet<String>,
}

/// What a crate builds: a library, a program, a test.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Target {
    /// `lib`, `bin`, `test`, `bench`, `example` or `custom-build`.
    pub kind: String,
    /// Name by which Rust code calls it.
    pub name: String,
    /// Its first source file, from the root of the repository.
    pub source: String,
}

/// A package that this workspace builds with, its own or another's.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Package {
    /// Name of the package.
    pub name: String,
    /// Licence that it declares, an SPDX expression.
    pub license: String,
    /// Lowest version of Rust that it declares.
    pub rust_version: Option<String>,
    /// Whether it is a crate of this workspace.
    pub is_ours: bool,
}

/// Crates of this workspace, by name of the package.
///
/// # Panics
///
/// When cargo cannot be run or writes something else than documented.
#[must_use]
pub fn crates() -> BTreeMap<String, Crate> {
    let metadata = metadata(&["--no-deps"]);
    list(&metadata, "packages")
        .iter()
        .map(crate_from)
        .map(|found| (found.name.clone(), found))
        .collect()
}

/// All packages that this machine builds with.
///
/// # Panics
///
/// When cargo or rustc cannot be run or write something else than documented.
#[must_use]
pub fn packages() -> Vec<Package> {
    let host = Command::new("rustc").arg("-vV").output().expect("rustc runs");
    let host = String::from_utf8_lossy(&host.stdout).into_owned();
    let host = host.lines().find_map(|line| line.strip_prefix("host: ")).expect("rustc has a host");
    let metadata = metadata(&["--filter-platform", host]);
    let package = |package: &Value| Package {
        name: text(package, "name"),
        license: text(package, "license"),
        rust_version: package["rust_version"].as_str().map(str::to_owned),
        is_ours: package["source"].is_null(),
    };
    list(&metadata, "packages").iter().map(package).collect()
}

fn metadata(arguments: &[&str]) -> Value {
    let cargo = std::env::var("CARGO").unwrap_or_else(|_| "cargo".to_owned());
    let output = Command::new(cargo)
        .args(["metadata", "--format-version", "1", "--offline", "--locked"])
        .args(arguments)
        .current_dir(files::root())
        .output()
        .expect("cargo runs");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    serde_json::from_slice(&output.stdout).expect("cargo writes JSON")
}

fn crate_from(package: &Value) -> Crate {
    let manifest = text(package, "manifest_path");
    let folder = Path::new(&manifest).parent().expect("a manifest is in a folder");
    let mut found = Crate {
        name: text(package, "name"),
        folder: files::from_root(folder),
        targets: list(package, "targets").iter().map(target_from).collect(),
        dependencies: BTreeSet::new(),
        dev_dependencies: BTreeSet::new(),
    };
    for dependency in list(package, "dependencies") {
        let of = match dependency["kind"].as_str() {
            None => &mut found.dependencies,
            Some(_) => &mut found.dev_dependencies,
        };
        of.insert(text(dependency, "name"));
    }
    found
}

fn target_from(target: &Value) -> Target {
    let kind = list(target, "kind").first().and_then(Value::as_str).unwrap_or_default();
    Target {
        kind: kind.to_owned(),
        name: text(target, "name").replace('-', "_"),
        source: files::from_root(Path::new(&text(target, "src_path"))),
    }
}

fn text(value: &Value, key: &str) -> String {
    value[key].as_str().unwrap_or_default().to_owned()
}

fn list<'a>(value: &'a Value, key: &str) -> &'a [Value] {
    value[key].as_array().map_or(&[], Vec::as_slice)
}

impl Crate {
    /// Names of all packages that any part of the crate depends on.
    #[must_use]
    pub fn all_dependencies(&self) -> BTreeSet<&str> {
        self.dependencies.iter().chain(&self.dev_dependencies).map(String::as_str).collect()
    }

    /// Its folder of sources, from the root of the repository.
    #[must_use]
    pub fn sources(&self) -> String {
        format!("{}/src", self.folder)
    }
}
