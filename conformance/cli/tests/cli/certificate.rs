//! Certificates: made, verified, run again; what they name, and what a call must say.

use std::path::{Path, PathBuf};
use std::process::Command;

use gaugeblock_certificate::{Coverage, RunResult, SigningKey, Statement, schema, sha256};
use gaugeblock_runner::certify::Scope;
use minisign::KeyPair;
use serde_json::Value;

use crate::command::gaugeblock;

/// A small selection that runs in no time.
pub(crate) const ONLY: [&str; 2] = ["--only", "saved-state.feed"];

/// A folder with a pair of keys, for the certificates of a test.
pub(crate) struct Bench {
    folder: PathBuf,
    pub(crate) key: SigningKey,
}

impl Bench {
    pub(crate) fn new(name: &str) -> Self {
        let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("certificates").join(name);
        let _absent = std::fs::remove_dir_all(&folder);
        std::fs::create_dir_all(&folder).expect("a folder for the test");
        let pair = KeyPair::generate_unencrypted_keypair().expect("a pair of keys");
        let secret = pair.sk.to_box(None).expect("a key file").to_string();
        let key = SigningKey::read(&secret, None).expect("a key");
        let public = pair.pk.to_box().expect("a key file").to_string();
        std::fs::write(folder.join("minisign.key"), secret).expect("a file");
        std::fs::write(folder.join("minisign.pub"), public).expect("a file");
        Self { folder, key }
    }

    pub(crate) fn path(&self, name: &str) -> String {
        self.folder.join(name).to_str().expect("UTF-8").to_owned()
    }

    pub(crate) fn read(&self, name: &str) -> String {
        std::fs::read_to_string(self.path(name)).expect("a file")
    }

    pub(crate) fn write(&self, name: &str, text: &str) {
        std::fs::write(self.path(name), text).expect("a file");
    }

    pub(crate) fn statement(&self, name: &str) -> Statement {
        Statement::read(&self.read(name)).expect("a certificate")
    }

    /// Writes a statement under a name, with a signature of the key.
    pub(crate) fn sign(&self, name: &str, statement: &Statement) {
        let text = statement.to_text();
        self.write(name, &text);
        self.write(&format!("{name}.minisig"), &self.key.sign(&text, "a test").expect("signed"));
    }

    /// Certifies a controller into a file: the exit status and what was printed.
    pub(crate) fn certify(&self, controller: &str, name: &str, more: &[&str]) -> (i32, String) {
        let (file, key) = (self.path(name), self.path("minisign.key"));
        let call = ["certify", "--controller", controller, "--certificate", &file, "--key", &key];
        printed(&[&call[..], more].concat())
    }

    /// Verifies files: the exit status and what was printed.
    pub(crate) fn verify(&self, names: &[&str], more: &[&str]) -> (i32, String) {
        let files: Vec<String> = names.iter().map(|name| self.path(name)).collect();
        let files: Vec<&str> = files.iter().map(String::as_str).collect();
        let key = self.path("minisign.pub");
        let call = [&["verify-certificate", "--public-key", &key], files.as_slice(), more].concat();
        printed(&call)
    }
}

/// The exit status of a call, and what it printed on both streams.
pub(crate) fn printed(call: &[&str]) -> (i32, String) {
    let output = gaugeblock(call);
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    let both = text(&output.stdout) + &text(&output.stderr);
    (output.status.code().expect("an exit status"), both)
}

fn has(text: &str, words: &[&str]) {
    for words in words {
        assert!(text.contains(words), "{words:?} is not in: {text}");
    }
}

#[test]
fn certificate_is_verified_and_names_what_was_run() {
    let bench = Bench::new("made");
    let (status, text) = bench.certify("reference", "c.json", &ONLY);
    assert_eq!(status, 0, "{text}");
    has(&text, &["signed with key", &bench.key.id(), &bench.key.public_key()]);
    let statement = bench.statement("c.json");
    let predicate = &statement.predicate;
    assert_eq!((predicate.result, predicate.coverage), (RunResult::Passes, Coverage::Partial));
    assert_eq!(predicate.run.only, ["saved-state.feed"]);
    assert_eq!(predicate.run.scope, Scope::Full);
    assert_eq!(statement.case_count(), predicate.counts.cases);
    assert_eq!(statement.subject[0].annotations.controller, "reference");

    let (status, text) = bench.verify(&["c.json"], &["--partial"]);
    assert_eq!(status, 0, "{text}");
    has(&text, &["PARTIAL", "--only saved-state.feed", "\nverified; the run passes\n"]);
    let (status, text) = bench.verify(&["c.json"], &[]);
    assert_eq!(status, 1, "{text}");
    has(&text, &["coverage: partial", "--partial", "NOT VERIFIED"]);

    // The line of the key does as well as its file, and a JSON document says the same.
    let (file, key) = (bench.path("c.json"), bench.key.public_key());
    let call = ["verify-certificate", &file, "--public-key", &key, "--partial", "--format", "json"];
    let (status, text) = printed(&call);
    let document: Value = serde_json::from_str(&text).expect("JSON");
    assert_eq!(
        (status, &document["verified"], &document["result"]),
        (0, &true.into(), &"passes".into())
    );
    assert_eq!(document["certificates"][0]["key"], bench.key.id());
}

#[test]
fn certificate_of_a_whole_edition_is_complete() {
    let bench = Bench::new("whole");
    let (status, text) = bench.certify("reference", "c.json", &["--edition", "gpp-classic"]);
    assert_eq!(status, 0, "{text}");
    assert_eq!(bench.statement("c.json").predicate.coverage, Coverage::Complete);
    let (status, text) = bench.verify(&["c.json"], &[]);
    assert_eq!(status, 0, "{text}");
    has(&text, &["complete, shard 1/1", "verified; the run passes"]);
}

#[test]
fn published_schema_is_what_the_types_generate_and_certificates_fit_it() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../certificate/schema/certificate.json");
    let schema = schema();
    let now = serde_json::to_string_pretty(&schema).expect("a schema is JSON") + "\n";
    if std::env::var_os("GAUGEBLOCK_BLESS").is_some() {
        std::fs::write(&path, &now).expect("schema/ can be written");
    }
    let published = std::fs::read_to_string(&path).unwrap_or_default();
    assert!(published == now, "{}: run with GAUGEBLOCK_BLESS=1", path.display());
    let printed = gaugeblock(&["schema", "certificate"]).stdout;
    let printed: Value = serde_json::from_slice(&printed).expect("JSON");
    assert_eq!(Some(&printed), Some(schema.as_value()));
    let bench = Bench::new("schema");
    bench.certify("production", "c.json", &ONLY);
    let mut document: Value = serde_json::from_str(&bench.read("c.json")).expect("JSON");
    let validator = jsonschema::validator_for(schema.as_value()).expect("a schema");
    let wrong: Vec<_> = validator.iter_errors(&document).map(|error| error.to_string()).collect();
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    document["predicate"]["result"] = "excellent".into();
    assert!(!validator.is_valid(&document), "the schema lets everything through");
}

#[test]
fn cases_run_again_have_the_certified_verdicts() {
    let bench = Bench::new("again");
    bench.certify("reference", "c.json", &ONLY);
    let again = ["--partial", "--rerun", "50%", "--seed", "7", "--controller", "reference"];
    let (status, text) = bench.verify(&["c.json"], &again);
    assert_eq!(status, 0, "{text}");
    has(&text, &["50 % of the cases", "chosen by seed 7", "every verdict is the same"]);
    let random = ["--partial", "--rerun", "1", "--controller", "reference"];
    let (status, text) = bench.verify(&["c.json"], &random);
    assert_eq!(status, 0, "{text}");
    has(&text, &["1 % of the cases, 1, chosen by seed "]);
    let other = ["--partial", "--rerun", "5%", "--controller", "production"];
    let (status, text) = bench.verify(&["c.json"], &other);
    assert_eq!(status, 1, "{text}");
    has(&text, &["another controller: name production; certified is reference"]);
    let wrong = ["--partial", "--rerun", "0", "--controller", "reference"];
    let (status, text) = bench.verify(&["c.json"], &wrong);
    assert_eq!(status, 2, "{text}");
    has(&text, &["from 1% to 100%"]);
}

#[test]
fn subject_is_the_certified_file_or_none() {
    let bench = Bench::new("subject");
    bench.write("firmware.bin", "version 1");
    bench.write("other.bin", "version 2");
    let (firmware, other) = (bench.path("firmware.bin"), bench.path("other.bin"));
    let named = [&ONLY[..], &["--subject", &firmware]].concat();
    let (status, text) = bench.certify("reference", "c.json", &named);
    assert_eq!(status, 0, "{text}");
    assert_eq!(bench.statement("c.json").subject[0].name, "firmware.bin");
    let (status, _) = bench.verify(&["c.json"], &["--partial", "--subject", &firmware]);
    assert_eq!(status, 0);
    let (status, text) = bench.verify(&["c.json"], &["--partial", "--subject", &other]);
    assert_eq!(status, 1, "{text}");
    has(&text, &["other.bin has the digest", "not certified"]);
    let again =
        ["--partial", "--rerun", "100%", "--controller", "reference", "--subject", &firmware];
    assert_eq!(bench.verify(&["c.json"], &again).0, 0);
    let (status, text) = bench.verify(&["c.json"], &again[..5]);
    assert_eq!(status, 1, "{text}");
    has(&text, &["digest of its files"]);
}

#[test]
fn lists_of_known_divergences_and_assertions_only_are_named() {
    let bench = Bench::new("lists");
    let adapter = Path::new(env!("CARGO_MANIFEST_DIR")).join("../adapter/templates/template.py");
    let text = std::fs::read_to_string(adapter).expect("the template");
    let alarm =
        "{\"end\": \"fault\", \"block\": block, \"message\": f\"no such code: G{number:g}\"}";
    assert!(text.contains(alarm));
    bench.write("toy.py", &text.replace(alarm, "{\"end\": \"program_end\"}"));
    let toy = format!("exec:python3 {}", bench.path("toy.py"));
    let only = ["--edition", "linuxcnc-2.9", "--only", "modal-groups.g-code-out"];
    let before = bench.path("before");
    let (status, text) =
        bench.certify(&toy, "fails.json", &[&only[..], &["--report", &before]].concat());
    assert_eq!(status, 1, "{text}");
    assert_eq!(bench.statement("fails.json").subject[0].name, "toy.py");
    let report = std::fs::read(bench.path("before/report.json")).expect("a report");
    assert_eq!(bench.statement("fails.json").predicate.report_sha256, sha256(report));
    let (status, text) = bench.verify(&["fails.json"], &["--partial"]);
    assert_eq!(status, 1, "{text}");
    has(&text, &["\nverified; the run FAILS\n"]);

    let listed = [&only[..], &["--baseline", &before]].concat();
    let (status, text) = bench.certify(&toy, "known.json", &listed);
    assert_eq!(status, 0, "{text}");
    assert_eq!(bench.statement("known.json").predicate.lists[0].file, "report.json");
    let again = ["--partial", "--rerun", "100%", "--controller", &toy];
    let (status, text) = bench.verify(&["known.json"], &again);
    assert_eq!(status, 0, "{text}");
    has(
        &text,
        &["list        baseline report.json sha256:", " known", "every verdict is the same"],
    );

    // An unlisted divergence is not hidden by the list.
    let mut hidden = bench.statement("fails.json");
    hidden.predicate.mismatches = Some(Vec::new());
    hidden.predicate.lists = bench.statement("known.json").predicate.lists;
    hidden.predicate.result = RunResult::Passes;
    bench.sign("hidden.json", &hidden);
    let (status, text) = bench.verify(&["hidden.json"], &["--partial"]);
    assert_eq!(status, 1, "{text}");
    has(&text, &["differs, and no mismatch names it"]);

    let narrow = [&ONLY[..], &["--assertions-only"]].concat();
    bench.certify("reference", "narrow.json", &narrow);
    let (status, text) = bench.verify(&["narrow.json"], &["--partial"]);
    assert_eq!(status, 0, "{text}");
    has(&text, &["ASSERTIONS ONLY"]);
}

#[test]
fn profile_that_is_not_claimed_and_passed_is_missed() {
    let bench = Bench::new("profile");
    bench.certify("reference", "c.json", &ONLY);
    let (status, text) = bench.verify(&["c.json"], &["--partial", "--profile", "rs274-core"]);
    assert_eq!(status, 1, "{text}");
    has(&text, &["profiles: rs274-core is not claimed and passed"]);
    let (status, text) = bench.verify(&["c.json"], &["--partial", "--profile", "no-such"]);
    assert_eq!(status, 2, "{text}");
    has(&text, &["unknown profile `no-such`", "hint:"]);
}

#[test]
fn nothing_is_written_if_the_certificate_cannot_be_made() {
    let bench = Bench::new("refused");
    let (file, key) = (bench.path("c.json"), bench.path("minisign.key"));
    bench.write("wrong.key", "untrusted comment: no key\nRWQAAEIy\n");
    let (wrong, absent) = (bench.path("wrong.key"), bench.path("absent/c.json"));
    let call = ["certify", "--controller", "reference", ONLY[0], ONLY[1], "--certificate"];
    for (more, status, words) in [
        (vec![&*file, "--key", &wrong], 2, "is not a secret key of minisign"),
        (vec![&*file, "--key", &absent], 2, "check the path of the secret key"),
        (vec![&*key, "--key", &key], 2, "would write over a file that is read"),
        (vec![&*absent, "--key", &key], 2, "No such file"),
        (vec!["/dev/null", "--key", &key], 2, "not a regular file"),
        (vec![&*file, "--restrict-to", "rs274"], 2, "cannot be used with"),
        (vec![&*file, "--max-fail", "1"], 2, "cannot be used with"),
        (vec![&*file, "--controller", "production"], 2, "belongs to one controller"),
        (vec![&*file, "--subject", &absent], 2, "--subject"),
    ] {
        let (found, text) = printed(&[&call[..], &more].concat());
        assert_eq!(found, status, "{more:?}: {text}");
        has(&text, &[words]);
    }
    let left = std::fs::read_dir(bench.path("")).expect("a folder");
    let mut names: Vec<_> = left.map(|entry| entry.expect("an entry").file_name()).collect();
    names.sort();
    assert_eq!(names, ["minisign.key", "minisign.pub", "wrong.key"]);
}

#[test]
fn key_with_a_password_takes_it_from_a_file() {
    let bench = Bench::new("password");
    let pair = KeyPair::generate_encrypted_keypair(Some("secret".to_owned())).expect("a pair");
    bench.write("minisign.key", &pair.sk.to_box(None).expect("a key file").to_string());
    bench.write("minisign.pub", &pair.pk.to_box().expect("a key file").to_string());
    bench.write("password", "secret\n");
    bench.write("wrong", "guess\n");
    let (password, wrong) = (bench.path("password"), bench.path("wrong"));
    let with = |file| [&ONLY[..], &["--key-password", file]].concat();
    let (status, text) = bench.certify("reference", "c.json", &with(&wrong));
    assert_eq!(status, 2, "{text}");
    has(&text, &["password", "hint:"]);
    let (status, text) = bench.certify("reference", "c.json", &with(&password));
    assert_eq!(status, 0, "{text}");
    assert_eq!(bench.verify(&["c.json"], &["--partial"]).0, 0);
}

/// If minisign is installed, it agrees; and a statement that it signs is a certificate.
#[test]
fn minisign_verifies_a_certificate_and_signs_one() {
    if Command::new("minisign").arg("-v").output().is_err() {
        use std::io::Write as _;
        let notice = b"left out: signatures by minisign (it was not found)\n";
        std::io::stderr().write_all(notice).expect("standard error can be written");
        return;
    }
    let bench = Bench::new("minisign");
    bench.certify("reference", "c.json", &ONLY);
    let minisign = |arguments: &[&str]| {
        let output = Command::new("minisign").args(arguments).output().expect("it runs");
        (output.status.success(), String::from_utf8_lossy(&output.stdout).into_owned())
    };
    let (file, public, key) =
        (bench.path("c.json"), bench.path("minisign.pub"), bench.path("minisign.key"));
    let (verified, text) = minisign(&["-Vm", &file, "-p", &public]);
    assert!(verified && text.contains("urn:gaugeblock:certificate:1"), "{text}");

    let unsigned = bench.path("unsigned.json");
    let call = ["certify", "--controller", "reference", "--certificate", &unsigned];
    let (_, text) = printed(&[&call[..], &ONLY].concat());
    has(&text, &["not signed", "minisign -Sm"]);
    assert_eq!(bench.verify(&["unsigned.json"], &["--partial"]).0, 2, "no signature");
    let (signed, text) = minisign(&["-Sm", &unsigned, "-s", &key]);
    assert!(signed, "{text}");
    let (status, text) = bench.verify(&["unsigned.json"], &["--partial"]);
    assert_eq!(status, 0, "{text}");
    has(&text, &["file:unsigned.json"]);
}
