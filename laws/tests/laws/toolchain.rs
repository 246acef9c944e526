//! Which Rust builds the project.

use std::fs;

use gaugeblock_laws::{files, workspace};
use syn::visit::{self, Visit};

use crate::holds;

fn text(path: &str) -> String {
    fs::read_to_string(files::root().join(path)).unwrap_or_else(|error| panic!("{path}: {error}"))
}

fn table(path: &str) -> toml::Table {
    text(path).parse().unwrap_or_else(|error| panic!("{path}: {error}"))
}

/// The first two numbers of a version.
fn version(text: &str) -> (u32, u32) {
    let mut parts = text.split('.').map(|part| part.parse().expect("a version has numbers"));
    (parts.next().unwrap_or_default(), parts.next().unwrap_or_default())
}

/// The oldest Rust that builds the project.
fn oldest() -> (u32, u32) {
    let manifest = table("Cargo.toml");
    version(
        manifest["workspace"]["package"]["rust-version"]
            .as_str()
            .expect("Cargo.toml has a rust-version"),
    )
}

/// The Rust that developers and the gate use.
fn pinned() -> String {
    let toolchain = table("rust-toolchain.toml");
    toolchain["toolchain"]["channel"]
        .as_str()
        .expect("rust-toolchain.toml has a channel")
        .to_owned()
}

#[test]
fn no_dependency_requires_a_later_rust_than_the_project() {
    let later = |package: &workspace::Package| {
        package.rust_version.as_deref().is_some_and(|needed| version(needed) > oldest())
    };
    let later: Vec<_> =
        workspace::packages().into_iter().filter(later).map(|package| package.name).collect();
    holds("dependencies build with the oldest Rust that builds the project", &later);
    assert!(
        version(&pinned()) >= oldest(),
        "rust-toolchain.toml is older than rust-version in Cargo.toml"
    );
}

/// Clippy refuses library items that are younger than `rust-version`, which it reads from Cargo.toml.
#[test]
fn lints_know_the_oldest_rust() {
    let clippy = table("clippy.toml");
    assert!(
        !clippy.contains_key("msrv"),
        "clippy.toml has a version of its own; Cargo.toml has it for all"
    );
    let lints = &table("Cargo.toml")["workspace"]["lints"]["clippy"];
    assert_eq!(lints["incompatible_msrv"].as_str(), Some("warn"));
}

/// Images and workflows name the pinned Rust, and one job the oldest.
#[test]
fn every_build_uses_the_pinned_rust() {
    let (major, minor) = version(&pinned());
    let names = [
        ("deploy/Dockerfile", format!("rust:{major}.{minor}-")),
        ("action.yml", format!("cargo +{major}.{minor} ")),
        (".github/workflows/ci.yml", format!("rust:{major}.{minor}-")),
        (".github/workflows/nightly.yml", format!("rust:{major}.{minor}-")),
    ];
    let oldest = oldest();
    let names = names.into_iter().chain([
        (".github/workflows/ci.yml", format!("container: rust:{}.{}-", oldest.0, oldest.1)),
        (".github/workflows/ci.yml", format!("RUSTUP_TOOLCHAIN: {}.{}.0", oldest.0, oldest.1)),
    ]);
    let others = names.filter(|(path, name)| !text(path).contains(name));
    let others: Vec<_> = others.map(|(path, name)| format!("{path} lacks {name}")).collect();
    holds("rust-toolchain.toml, images and workflows name the pinned and the oldest Rust", &others);
}

/// Finds `if let` in the guard of a match arm, which Rust has from 1.95 on; no lint knows that.
#[derive(Default)]
struct Guards(Vec<usize>);

impl<'ast> Visit<'ast> for Guards {
    fn visit_pat_guard(&mut self, pattern: &'ast syn::PatGuard) {
        let mut found = Lets(false);
        found.visit_expr(&pattern.guard);
        if found.0 {
            self.0.push(pattern.if_token.span.start().line);
        }
        visit::visit_pat_guard(self, pattern);
    }
}

struct Lets(bool);

impl<'ast> Visit<'ast> for Lets {
    fn visit_expr_let(&mut self, _: &'ast syn::ExprLet) {
        self.0 = true;
    }

    fn visit_block(&mut self, _: &'ast syn::Block) {}

    fn visit_expr_closure(&mut self, _: &'ast syn::ExprClosure) {}
}

#[test]
fn no_guard_of_a_match_arm_has_a_let() {
    if oldest() >= (1, 95) {
        return;
    }
    let mut places = Vec::new();
    for (path, text) in files::sources("") {
        let mut guards = Guards::default();
        guards.visit_file(&syn::parse_file(&text).expect("a source is Rust"));
        places.extend(guards.0.iter().map(|line| format!("{path}:{line}")));
    }
    holds("the oldest Rust has no `if let` in guards", &places);
}
