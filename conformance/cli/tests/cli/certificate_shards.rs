//! Certificates of shards, and of merged reports: each part of one run exactly once.

use gaugeblock_runner::shard::Shard;

use crate::certificate::{Bench, ONLY, printed};
use crate::certificate_tampering::{Tampering, each_is_refused};

/// How many shards a run has.
const SHARDS: usize = 3;

/// The certificates of all shards of a run, and their reports.
fn shards(name: &str) -> (Bench, Vec<String>) {
    let bench = Bench::new(name);
    let part = |index: usize| {
        let (file, shard) = (format!("{index}.json"), format!("{index}/{SHARDS}"));
        let report = bench.path(&format!("report-{index}"));
        let more = [&ONLY[..], &["--shard", &shard, "--report", &report]].concat();
        let (status, text) = bench.certify("reference", &file, &more);
        assert_eq!(status, 0, "{text}");
        file
    };
    let files = (1..=SHARDS).map(part).collect();
    (bench, files)
}

#[test]
fn certificates_of_all_shards_are_verified_together_and_no_others() {
    let (bench, files) = shards("shards");
    let [one, two, three] = [&files[0], &files[1], &files[2]].map(String::as_str);
    let (status, text) = bench.verify(&[three, one, two], &["--partial"]);
    assert_eq!(status, 0, "{text}");
    let again = ["--partial", "--rerun", "100%", "--controller", "reference"];
    let (status, text) = bench.verify(&[one, two, three], &again);
    assert_eq!(status, 0, "{text}");

    let other = [&ONLY[..], &["--shard", "3/3"]].concat();
    bench.certify("production", "production.json", &other);
    let edition = [&other[..], &["--edition", "linuxcnc-2.9"]].concat();
    bench.certify("reference", "edition.json", &edition);
    bench.write("firmware.bin", "version 2");
    let firmware = bench.path("firmware.bin");
    bench.certify("reference", "file.json", &[&other[..], &["--subject", &firmware]].concat());
    bench.certify("reference", "half.json", &[&ONLY[..], &["--shard", "2/2"]].concat());
    for (names, words) in [
        (vec![one, three], "1 of 3 missing, first 2/3"),
        (vec![two], "2 of 3 missing, first 1/3"),
        (vec![one, two, three, two], "are both shard 2/3"),
        (vec![one, two, "production.json"], "controller \"reference\" and \"production\""),
        (vec![one, two, "edition.json"], "edition \"linuxcnc-2.8\" and \"linuxcnc-2.9\""),
        (vec![one, two, "file.json"], "controller files"),
        (vec![one, "half.json"], "is 2/2, not one of 3"),
    ] {
        let (status, text) = bench.verify(&names, &["--partial"]);
        assert_eq!(status, 1, "{names:?}: {text}");
        assert!(text.contains(words), "{words:?} is not in: {text}");
    }
}

#[test]
fn merged_reports_have_a_certificate_that_names_each_shard_once() {
    let (bench, _) = shards("merged");
    let reports = ["report-2", "report-1", "report-3"].map(|name| bench.path(name));
    let (file, key) = (bench.path("c.json"), bench.path("minisign.key"));
    let call = [
        &["report", "merge"],
        reports.each_ref().map(String::as_str).as_slice(),
        &["--certificate", &file, "--key", &key],
    ]
    .concat();
    let (status, text) = printed(&call);
    assert_eq!(status, 0, "{text}");
    let (status, text) = bench.verify(&["c.json"], &["--partial"]);
    assert_eq!(status, 0, "{text}");
    assert!(text.contains("merged of 3 shards"), "{text}");
    let merged = bench.statement("c.json");
    assert_eq!(merged.predicate.started, None);

    let tamperings: [(&str, Tampering, &str); 5] = [
        ("twice", |it| it.predicate.shards[1] = it.predicate.shards[0].clone(), "both shard 1/3"),
        ("missing", |it| drop(it.predicate.shards.pop()), "1 of 3 missing, first 3/3"),
        ("added", |it| it.predicate.shards[2].shard = Shard { index: 4, of: 4 }, "not one of 3"),
        (
            "same-report",
            |it| {
                let first = it.predicate.shards[0].report_sha256.clone();
                it.predicate.shards[1].report_sha256 = first;
            },
            "are the same report",
        ),
        (
            "no-digest",
            |it| it.predicate.shards[1].report_sha256.clear(),
            "the digest of 2/3 is not a SHA-256",
        ),
    ];
    let files = tamperings.map(|(name, tamper, words)| {
        let mut tampered = merged.clone();
        tamper(&mut tampered);
        let file = format!("{name}.json");
        bench.sign(&file, &tampered);
        (file, words)
    });
    each_is_refused(&bench, &files);
}

#[test]
fn reports_of_different_files_of_a_controller_are_not_merged() {
    let bench = Bench::new("files");
    let mut reports = Vec::new();
    for index in ["1", "2"] {
        let (firmware, report) = (format!("firmware-{index}.bin"), format!("report-{index}"));
        bench.write(&firmware, index);
        let (firmware, report) = (bench.path(&firmware), bench.path(&report));
        let shard = format!("{index}/2");
        let call = ["certify", "--controller", "reference", "--shard", &shard, "--report", &report];
        let (status, text) = printed(&[&call[..], &ONLY, &["--subject", &firmware]].concat());
        assert_eq!(status, 0, "{text}");
        reports.push(report);
    }
    let (status, text) = printed(&["report", "merge", &reports[0], &reports[1]]);
    assert_eq!(status, 2, "{text}");
    assert!(text.contains("are not of one run: controller files"), "{text}");
}
