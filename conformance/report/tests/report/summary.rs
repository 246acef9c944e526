//! The summary for a pull request: what a controller says is text in it, and it can be posted.

use std::num::NonZero;

use gaugeblock_controllers::Reference;
use gaugeblock_report::markdown::markdown;
use gaugeblock_report::{Header, Report};
use gaugeblock_runner::certify::{Plan, RuleDivergence, Run, Scope, Verdict, certify};
use gaugeblock_runner::expectations::ExpectationMismatch;
use gaugeblock_runner::shard::Shard;
use gaugeblock_suite::Suite;

/// Most characters of a comment on GitHub.
const MOST: usize = 60_000;

/// Each tries to be more than text, and names itself where it succeeds.
const HOSTILE: [&str; 8] = [
    "<script>EVIL()</script> <img src=//EVIL> </code></summary></details> EVIL",
    "[EVIL](https://EVIL) ![EVIL](//EVIL) <https://EVIL> www.EVIL.com @EVIL EVIL#1",
    "` EVIL `` EVIL ``` EVIL ```` EVIL",
    "\n# EVIL\n\n- EVIL\r\n```\nEVIL\n~~~\n</details>\n\n| EVIL | EVIL |\n| --- | --- |\n",
    "`",
    "EVIL\\",
    "\u{202e}LIVE\u{200b}EVIL\u{7}\u{1b}[31mEVIL\0EVIL",
    "$`EVIL`$ $$EVIL$$ :EVIL: &EVIL; *EVIL* _EVIL_ ~~EVIL~~ a|EVIL|b",
];

/// A page without what stands in code, as `CommonMark` reads it: fenced blocks first, then runs of backticks of equal
/// length, block by block.
fn outside_of_code(page: &str) -> String {
    let (mut prose, mut fence) = (String::new(), None);
    for line in page.lines() {
        let run = line.len() - line.trim_start_matches('`').len();
        match fence {
            None if run >= 3 && !line[run..].contains('`') => fence = Some(run),
            Some(open) if run >= open && line[run..].trim().is_empty() => fence = None,
            Some(_) => {}
            None => prose.push_str(&format!("{}\n", without_spans(line))),
        }
    }
    assert_eq!(fence, None, "every block is closed");
    prose
}

fn without_spans(line: &str) -> String {
    let (mut prose, mut rest) = (String::new(), line);
    while let Some(at) = rest.find('`') {
        let run = rest[at..].len() - rest[at..].trim_start_matches('`').len();
        let (before, open) = rest.split_at(at);
        let inner = &open[run..];
        let mut ends = inner.match_indices('`').map(|(end, _)| end).filter(|end| {
            let length = inner[*end..].len() - inner[*end..].trim_start_matches('`').len();
            length == run && !inner[..*end].ends_with('`')
        });
        prose.push_str(before);
        match ends.next() {
            Some(end) => rest = &inner[end + run..],
            None => panic!("backticks without an end: {line}"),
        }
    }
    prose + rest
}

/// The page of a run in which every case does what one of the hostile texts says.
fn page(only: &str, change: &dyn Fn(usize, &str) -> Verdict) -> String {
    let suite =
        Suite::read(&gaugeblock_embedded_suite::files().expect("the suite")).expect("the suite");
    let edition = suite.edition("linuxcnc-2.9").expect("the suite");
    let only = [only.to_owned()];
    let plan = Plan {
        suite: &suite,
        edition,
        only: &only,
        jobs: NonZero::<usize>::MIN,
        scope: Scope::Full,
    };
    let reference = Reference::default();
    let mut run: Run<'_> = certify(plan, &reference, &|| ());
    let mut mismatches = Vec::new();
    for (at, result) in run.cases.iter_mut().enumerate() {
        let text = HOSTILE[at % HOSTILE.len()];
        result.verdict = change(at, text);
        let (rule, case) = (result.rule.id.clone(), result.name.to_owned());
        let found = text.to_owned();
        mismatches.push(match at % 2 {
            0 => ExpectationMismatch::New { rule, case, found },
            _ => ExpectationMismatch::Changed { rule, case, listed: found.clone(), found },
        });
    }
    let mut header = Header::of(plan, &reference, Shard::WHOLE);
    header.controller = HOSTILE[0].to_owned();
    header.version = HOSTILE[2].to_owned();
    let mended = HOSTILE.iter().map(|text| format!("fixed: {text}"));
    let notes = mended.chain(HOSTILE.iter().map(|text| (*text).to_owned())).collect();
    markdown(&Report { notes, mismatches: Some(mismatches), ..Report::of(&suite, &run, header) })
}

fn departs(_: usize, text: &str) -> Verdict {
    Verdict::Diverges(RuleDivergence {
        assertion: Some(("feed_rate = 1".to_owned(), text.to_owned())),
        difference: Some(text.to_owned()),
        explanation: vec![text.to_owned()],
        ..RuleDivergence::default()
    })
}

#[test]
fn controller_text_is_escaped() {
    let fails = |at: usize, text: &str| match at % 2 {
        0 => Verdict::Inconclusive(text.to_owned()),
        _ => Verdict::Unsupported(text.to_owned()),
    };
    for page in [page("saved-state.feed", &departs), page("saved-state.feed", &fails)] {
        assert!(page.contains("EVIL"));
        let prose = outside_of_code(&page);
        assert!(!prose.contains("EVIL"), "{prose}");
        assert!(!page.contains(['\u{202e}', '\u{200b}', '\u{1b}', '\0', '\r']));
        let opened = prose.matches("<details>").count();
        assert_eq!(opened, prose.matches("</details>").count(), "{prose}");
    }
}

#[test]
fn a_page_of_any_run_can_be_posted() {
    let long = |_: usize, text: &str| departs(0, &format!("{text} {}", "`long ".repeat(9_000)));
    let page = page("", &long);
    assert!(page.len() <= MOST, "{} bytes", page.len());
    assert!(page.contains("more: see report.html"));
    outside_of_code(&page);
}
