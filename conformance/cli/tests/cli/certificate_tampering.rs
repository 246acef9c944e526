//! Certificates that were changed: without the key, so that the signature does not fit, and with it, so that only the
//! content is wrong.

use gaugeblock_certificate::{
    AcceptanceList, CaseVerdict, CertifiedDivergence, CertifiedProfile, Coverage, ListKind,
    RunResult, Statement, sha256,
};
use gaugeblock_report::RuleVerdict;
use gaugeblock_runner::certify::Scope;

use crate::certificate::{Bench, ONLY};

/// What is done to a statement.
pub(crate) type Tampering = fn(&mut Statement);

/// Each with its name and what a verifier says if the signer did it. Without words only the signature protects from it:
/// nothing else in a statement depends on it.
const TAMPERINGS: [(&str, Tampering, Option<&str>); 33] = [
    ("verdict-flipped", flip_verdict, Some("counts: not what follows")),
    ("verdict-without-reason", verdict_without_reason, Some("does not fit")),
    ("case-dropped", case_dropped, Some("is missing")),
    ("case-twice", case_twice, Some("is there twice")),
    ("case-renamed", case_renamed, Some("does not belong to this run")),
    ("cases-reordered", |it| it.predicate.rules[0].cases.reverse(), Some("another order")),
    ("rule-dropped", |it| drop(it.predicate.rules.pop()), Some("is missing")),
    ("rule-verdict", rule_verdict, Some("verdicts of the rules: not what follows")),
    ("counts", |it| it.predicate.counts.pass += 1, Some("counts: not what follows")),
    ("result", |it| it.predicate.result = RunResult::Fails, Some("result: not what follows")),
    ("profile-added", profile_added, Some("profiles: not what follows")),
    ("another-suite", another_suite, Some("suite: the certificate is of suite")),
    ("suite-of-one-beginning", suite_of_one_beginning, Some("suite: the certificate is of suite")),
    (
        "another-edition",
        |it| it.predicate.run.edition = "no-such".into(),
        Some("no edition no-such"),
    ),
    ("another-known-edition", known_edition, Some("completeness:")),
    (
        "wider-selection",
        |it| it.predicate.run.only = vec!["saved-state".into()],
        Some("is missing"),
    ),
    ("whole-selection", |it| it.predicate.run.only.clear(), Some("coverage: not what")),
    ("named-complete", |it| it.predicate.coverage = Coverage::Complete, Some("coverage: not what")),
    (
        "another-controller",
        |it| it.predicate.run.controller = "mill".into(),
        Some("subject: not the"),
    ),
    ("another-version", |it| it.predicate.run.version = "99".into(), Some("subject: not the")),
    ("another-file", another_file, Some("subject: not the")),
    ("option-added", option_added, Some("options: the suite has no option")),
    ("no-file", no_file, Some("no file of the controller")),
    ("another-shard", |it| it.predicate.run.shard.of = 2, Some("completeness:")),
    (
        "another-tool",
        |it| it.predicate.tool.version = "0.0.9".into(),
        Some("did not run gaugeblock"),
    ),
    ("seed", |it| it.predicate.seeds.run_twice = "7".into(), Some("seeds: not those")),
    ("future", |it| it.predicate.made = "2999-01-01T00:00:00Z".into(), Some("made in the future")),
    ("started-after", started_after, Some("began after the certificate was made")),
    ("no-time", |it| it.predicate.made = "yesterday".into(), Some("is not a point in time")),
    ("list-added", list_added, Some("a list without mismatches")),
    ("predicate-type", |it| it.predicate_type.push('0'), Some("is of type")),
    ("scope", |it| it.predicate.run.scope = Scope::AssertionsOnly, None),
    ("date", another_date, None),
];

/// A pass becomes a difference, and nothing else changes.
fn flip_verdict(it: &mut Statement) {
    let case = &mut it.predicate.rules[0].cases[0];
    case.verdict = CaseVerdict::SideDifference;
    case.found = Some(CertifiedDivergence { what: "invented".to_owned(), breaks_rule: false });
}

/// As [`flip_verdict`], and all that follows from it changes, too: only another run finds that.
fn flip_consistently(it: &mut Statement) {
    flip_verdict(it);
    it.predicate.counts.pass -= 1;
    it.predicate.counts.side_difference += 1;
    it.predicate.result = RunResult::Fails;
}

fn verdict_without_reason(it: &mut Statement) {
    it.predicate.rules[0].cases[0].verdict = CaseVerdict::Unsupported;
}

fn case_dropped(it: &mut Statement) {
    let dropped = it.predicate.rules[0].cases.pop();
    assert!(dropped.is_some());
    it.predicate.counts.cases -= 1;
    it.predicate.counts.pass -= 1;
}

fn case_twice(it: &mut Statement) {
    let case = it.predicate.rules[0].cases[0].clone();
    it.predicate.rules[0].cases.push(case);
    it.predicate.counts.cases += 1;
    it.predicate.counts.pass += 1;
}

fn case_renamed(it: &mut Statement) {
    it.predicate.rules[0].cases[0].case = "invented".to_owned();
}

fn rule_verdict(it: &mut Statement) {
    it.predicate.rules[0].verdict = RuleVerdict::NotJudged;
}

fn profile_added(it: &mut Statement) {
    it.predicate.profiles.push(CertifiedProfile {
        profile: "rs274-core".to_owned(),
        version: 1,
        claimed: true,
        passes: true,
    });
}

fn another_suite(it: &mut Statement) {
    it.predicate.suite_sha256 = sha256("another suite");
    it.predicate.run.suite = it.predicate.suite_sha256[..16].to_owned();
}

/// A suite whose digest begins like this one's.
fn suite_of_one_beginning(it: &mut Statement) {
    it.predicate.suite_sha256.replace_range(16.., &sha256("another suite")[16..]);
}

fn known_edition(it: &mut Statement) {
    it.predicate.run.edition = "gpp-classic".to_owned();
}

fn another_file(it: &mut Statement) {
    it.subject[0].digest.sha256 = sha256("another file");
}

fn option_added(it: &mut Statement) {
    it.predicate.run.options.0.insert("saved-state.no-such".to_owned(), "on".to_owned());
}

fn no_file(it: &mut Statement) {
    it.subject.clear();
    it.predicate.run.controller_files.clear();
}

fn started_after(it: &mut Statement) {
    it.predicate.started = Some("2998-01-01T00:00:00Z".to_owned());
}

fn another_date(it: &mut Statement) {
    it.predicate.started = Some("2020-01-01T00:00:00Z".to_owned());
    it.predicate.made = "2020-01-01T00:01:00Z".to_owned();
}

fn list_added(it: &mut Statement) {
    it.predicate.lists.push(AcceptanceList {
        kind: ListKind::Waivers,
        file: "waivers.toml".to_owned(),
        sha256: sha256(""),
    });
}

/// A verified certificate of a small selection.
fn certified(name: &str) -> (Bench, Statement) {
    let bench = Bench::new(name);
    let (status, text) = bench.certify("reference", "c.json", &ONLY);
    assert_eq!(status, 0, "{text}");
    let (status, text) = bench.verify(&["c.json"], &["--partial"]);
    assert_eq!(status, 0, "{text}");
    let statement = bench.statement("c.json");
    assert!(statement.predicate.rules[0].cases.len() > 1, "a dropped case leaves another one");
    (bench, statement)
}

/// Tampers in every way, and writes each file.
fn tampered(statement: &Statement, write: impl Fn(&str, &Statement)) -> Vec<String> {
    let all = TAMPERINGS.iter().map(|(name, tamper, _)| {
        let mut tampered = statement.clone();
        tamper(&mut tampered);
        assert_ne!(tampered, *statement, "{name} changes something");
        let file = format!("{name}.json");
        write(&file, &tampered);
        file
    });
    all.collect()
}

/// Verifies files in one call, which reports a problem with these words for each.
pub(crate) fn each_is_refused(bench: &Bench, files: &[(String, &str)]) {
    let names: Vec<&str> = files.iter().map(|(name, _)| name.as_str()).collect();
    let (status, text) = bench.verify(&names, &["--partial"]);
    assert_eq!(status, 1, "{text}");
    assert!(text.ends_with("NOT VERIFIED\n"), "{text}");
    for (name, words) in files {
        let file = bench.path(name);
        let mut said =
            text.lines().filter(|line| line.starts_with("problem") && line.contains(&file));
        assert!(said.any(|line| line.contains(words)), "{name}, {words:?}: {text}");
    }
}

#[test]
fn certificate_that_a_stranger_changed_is_refused_by_its_signature() {
    let (bench, statement) = certified("strangers");
    let signature = bench.read("c.json.minisig");
    let mut files = tampered(&statement, |file, tampered| {
        bench.write(file, &tampered.to_text());
        bench.write(&format!("{file}.minisig"), &signature);
    });
    let text = bench.read("c.json");
    for (name, text) in [
        ("truncated.json", &text[..text.len() / 2]),
        ("last-byte.json", text.trim_end()),
        ("empty.json", ""),
        ("compact.json", &text.replace("\n  ", "\n")),
        ("no-json.json", "g0 x1\nm2\n"),
    ] {
        bench.write(name, text);
        bench.write(&format!("{name}.minisig"), &signature);
        files.push(name.to_owned());
    }
    let names: Vec<&str> = files.iter().map(String::as_str).collect();
    let (status, text) = bench.verify(&names, &["--partial"]);
    assert_eq!(status, 1, "{text}");
    for name in names {
        let problem =
            format!("{}: signature: the signature does not fit the file", bench.path(name));
        assert!(text.contains(&problem), "{name}: {text}");
    }
    assert!(!text.contains("certificate "), "nothing of them is read: {text}");
}

#[test]
fn certificate_in_which_the_signer_lies_is_refused_where_it_contradicts_itself() {
    let (bench, statement) = certified("signers");
    let files = tampered(&statement, |file, tampered| bench.sign(file, tampered));
    let names: Vec<&str> = files.iter().map(String::as_str).collect();
    let (status, text) = bench.verify(&names, &["--partial"]);
    assert_eq!(status, 1, "{text}");
    for ((name, _, words), file) in TAMPERINGS.iter().zip(&files) {
        let file = bench.path(file);
        let mut said =
            text.lines().filter(|line| line.starts_with("problem") && line.contains(&file));
        match words {
            Some(words) => assert!(said.any(|line| line.contains(words)), "{name}: {text}"),
            None => assert_eq!(said.find(|line| !line.contains(" shards: ")), None, "{name}"),
        }
    }
}

#[test]
fn one_lie_alone_ends_with_status_1() {
    let (bench, statement) = certified("one");
    let (name, tamper, words) = TAMPERINGS[0];
    let mut tampered = statement;
    tamper(&mut tampered);
    bench.sign("lie.json", &tampered);
    let (status, text) = bench.verify(&["lie.json"], &["--partial"]);
    assert_eq!(status, 1, "{text}");
    assert!(text.contains(words.unwrap_or_default()), "{name}: {text}");
    assert!(text.ends_with("NOT VERIFIED\n"), "{text}");
}

#[test]
fn consistent_lie_is_found_by_another_run_only() {
    let (bench, mut statement) = certified("consistent");
    flip_consistently(&mut statement);
    bench.sign("lie.json", &statement);
    let (status, text) = bench.verify(&["lie.json"], &["--partial"]);
    assert_eq!(status, 1, "{text}");
    assert!(text.ends_with("\nverified; the run FAILS\n"), "{text}");
    let again = ["--partial", "--rerun", "100%", "--controller", "reference"];
    let (status, text) = bench.verify(&["lie.json"], &again);
    assert_eq!(status, 1, "{text}");
    let words = "certified differs: invented; now pass";
    assert!(text.contains(words) && text.ends_with("\nNOT VERIFIED\n"), "{text}");
}

#[test]
fn signature_of_another_key_statement_or_form_is_refused() {
    let (bench, statement) = certified("signatures");
    let other = Bench::new("signatures-of-others");
    let mut later = statement.clone();
    later.predicate.notes.push("another statement".to_owned());
    let (text, good) = (bench.read("c.json"), bench.read("c.json.minisig"));
    let foreign = other.key.sign(&text, "a test").expect("signed");
    let swapped = bench.key.sign(&later.to_text(), "a test").expect("signed");
    let commented = good.replace(" made ", " never ");
    let lines: Vec<&str> = good.lines().collect();
    let mixed =
        [lines[0], swapped.lines().nth(1).unwrap_or_default(), lines[2], lines[3], ""].join("\n");
    let files = [
        ("other-key", foreign.as_str(), "signed with key"),
        ("other-statement", &swapped, "does not fit"),
        ("comment", &commented, "omment signature"),
        ("mixed", &mixed, "does not fit"),
        ("truncated", &good[..good.len() - 3], "was cut off"),
        ("two-lines", &lines[..2].join("\n"), "was cut off"),
        ("empty", "", "was cut off"),
        ("no-signature", "g0 x1\nm2\n", "was cut off"),
    ];
    let refused = files.map(|(name, signature, words)| {
        let file = format!("{name}.json");
        bench.write(&file, &text);
        bench.write(&format!("{file}.minisig"), signature);
        (file, words)
    });
    each_is_refused(&bench, &refused);
    // Without a signature, or with a key that is none, nothing can be verified.
    bench.write("unsigned.json", &text);
    let (status, text) = bench.verify(&["unsigned.json"], &[]);
    assert_eq!(status, 2, "{text}");
    assert!(
        text.contains("unsigned.json.minisig: No such file") && text.contains("hint:"),
        "{text}"
    );
    let file = bench.path("c.json");
    let (status, text) =
        crate::certificate::printed(&["verify-certificate", &file, "--public-key", &file]);
    assert_eq!(status, 2, "{text}");
    assert!(text.contains("is not a public key of minisign") && text.contains("hint:"), "{text}");
}

#[test]
fn second_field_of_one_name_and_unknown_fields_are_refused_though_signed() {
    let (bench, statement) = certified("forms");
    let text = statement.to_text();
    let result = "    \"result\": \"passes\",\n";
    let edition = "      \"edition\":";
    assert!(text.contains(result) && text.contains(edition), "{text}");
    let files = [
        ("twice", text.replace(result, &result.repeat(2)), "duplicate field"),
        (
            "unknown",
            text.replace(result, &format!("{result}    \"audited\": true,\n")),
            "another form",
        ),
        (
            "in-run",
            text.replace(edition, &format!("      \"edition\": \"x\",\n{edition}")),
            "duplicate",
        ),
        ("spaces", text.replace(result, &result.replace(": ", ":  ")), "another form"),
        ("two-documents", format!("{text}{text}"), "trailing"),
    ];
    let refused = files.map(|(name, text, words)| {
        let file = format!("{name}.json");
        bench.write(&file, &text);
        let signature = bench.key.sign(&text, "a test").expect("signed");
        bench.write(&format!("{file}.minisig"), &signature);
        (file, words)
    });
    each_is_refused(&bench, &refused);
}
