//! The report as one self-contained page: worst first, with a search, and a card for each divergence.
//!
//! Text of a controller stays text: the template escapes everything except pictures, which are made of numbers.

use std::cmp::Reverse;
use std::time::Duration;

use gaugeblock_runner::certify::{CaseResult, Scope};
use gaugeblock_runner::measure::Measurement;
use minijinja::Environment;
use minijinja::value::Serde;
use serde::Serialize;

use super::cards::{Kind, class, kinds};
use super::json::{self, JudgedProfile};
use super::{ChapterCounts, Counts, Report, RuleVerdict, escape_text};

const PAGE: &str = include_str!("page.html");
/// The style of each page.
pub(super) const STYLE: &str = include_str!("style.css");
/// Pictures of motions that are as they should be, at most: the page has to stay small.
const PICTURES: usize = 48;
/// The slowest cases, so many of them.
const SLOWEST: usize = 10;

/// The report as HTML.
///
/// # Errors
/// The template does not fit: a fault of this program.
pub fn html(report: &Report<'_>) -> Result<String, String> {
    let render = || {
        let mut environment = Environment::new();
        environment.add_template("page.html", PAGE)?;
        environment.get_template("page.html")?.render(Serde(page(report)))
    };
    let page = render().map_err(|error: minijinja::Error| format!("{error:#}"))?;
    Ok(escape_text(&page).into_owned())
}

/// The content of the page.
#[derive(Debug, Serialize)]
struct Page<'a> {
    style: &'static str,
    controller: &'a str,
    version: &'a str,
    edition: String,
    scope: Option<&'static str>,
    sentence: &'a str,
    says: &'static str,
    status: &'static str,
    notes: &'a [String],
    counts: Vec<Count>,
    in_part: Option<String>,
    accuracy: String,
    /// Whether anything is known of it.
    judged: bool,
    mismatches: Option<Vec<String>>,
    profiles: Vec<Distance>,
    measurements: Vec<Limit<'a>>,
    fingerprint: Option<Fingerprint<'a>>,
    words: Vec<Word>,
    kinds: Vec<Kind<'a>>,
    chapters: Vec<Chapter<'a>>,
    rules: Vec<Row<'a>>,
    motions: Vec<Moved<'a>>,
    not_judged: Vec<Open<'a>>,
    unsupported: Vec<Unsupported<'a>>,
    void: Vec<Void<'a>>,
    cost: Option<Cost<'a>>,
    basis: String,
    masked: String,
    gaugeblock_version: &'a str,
    suite: &'a str,
    only: &'a [String],
    shard: String,
    twice: u8,
}

fn page<'a>(report: &'a Report<'_>) -> Page<'a> {
    let header = &report.header;
    let masked: Vec<_> = report.masked().into_keys().collect();
    let reasons = report.unsupported().into_iter();
    let mut unsupported: Vec<_> = reasons.map(|(why, cases)| Unsupported { why, cases }).collect();
    unsupported.sort_by(|a, b| b.cases.cmp(&a.cases).then_with(|| a.why.cmp(b.why)));
    let mismatches = report.mismatches.as_ref();
    let void = report.run.not_applicable.iter().map(|(rule, why)| Void { rule: &rule.id, why });
    let (status, says) = says(report);
    let kinds = kinds(report);
    Page {
        style: STYLE,
        controller: &header.controller,
        version: &header.version,
        edition: report.edition_and_scope(),
        scope: header.scope.note(),
        sentence: &report.run.edition.sentence,
        says,
        status,
        notes: &report.notes,
        counts: counts(report),
        in_part: report.counts().in_part(),
        accuracy: header.accuracy.to_string(),
        judged: report.counts().judged() > 0,
        mismatches: mismatches.map(|all| all.iter().map(ToString::to_string).collect()),
        profiles: distances(report),
        measurements: limits(report),
        fingerprint: fingerprint(report),
        words: words(report),
        rules: rules(report, &kinds),
        kinds,
        chapters: report.chapters().into_iter().map(chapter).collect(),
        motions: motions(report),
        not_judged: not_judged(report),
        unsupported,
        void: void.collect(),
        cost: cost(report),
        basis: basis(report),
        masked: if masked.is_empty() { "nothing".to_owned() } else { masked.join(", ") },
        gaugeblock_version: &header.gaugeblock_version,
        suite: &header.suite,
        only: &header.only,
        shard: header.shard.to_string(),
        twice: header.twice,
    }
}

/// How far the controller is from a profile.
#[derive(Debug, Serialize)]
struct Distance {
    #[serde(flatten)]
    judged: JudgedProfile,
    named: String,
}

fn distances(report: &Report<'_>) -> Vec<Distance> {
    let all = json::profiles(report).into_iter().zip(&report.profiles);
    let listed = all.filter(|(_, result)| result.is_listed());
    listed.map(|(judged, result)| Distance { judged, named: result.missing_in_words() }).collect()
}

/// A measured limit of the controller.
#[derive(Debug, Serialize)]
struct Limit<'a> {
    id: &'a str,
    title: &'a str,
    result: String,
    program: &'a str,
}

fn limits<'a>(report: &'a Report<'_>) -> Vec<Limit<'a>> {
    let limit = |it: &'a Measurement| Limit {
        id: &it.id,
        title: &it.title,
        result: it.result(),
        program: &it.program,
    };
    report.measurements.iter().map(limit).collect()
}

#[derive(Debug, Serialize)]
struct Count {
    name: &'static str,
    count: usize,
    class: String,
}

/// A verdict that can be filtered by.
#[derive(Debug, Serialize)]
struct Word {
    word: &'static str,
    class: String,
}

#[derive(Debug, Serialize)]
struct Unsupported<'a> {
    why: &'a str,
    cases: usize,
}

#[derive(Debug, Serialize)]
struct Void<'a> {
    rule: &'a str,
    why: &'a str,
}

#[derive(Debug, Serialize)]
struct Row<'a> {
    rule: &'a str,
    verdict: &'static str,
    class: String,
    sentence: &'a str,
    sources: String,
    cases: String,
    /// The number of the first finding with a case of the rule.
    finding: Option<usize>,
}

/// The rules of a chapter, by verdict.
#[derive(Debug, Serialize)]
struct Chapter<'a> {
    chapter: &'a str,
    rules: usize,
    counts: [Count; 4],
}

fn chapter(of: ChapterCounts<'_>) -> Chapter<'_> {
    let count = |name, count, word| Count { name, count, class: class(word) };
    let counts = [
        count("pass", of.pass, "pass"),
        count("diverge", of.diverges, "diverges"),
        count("unsupported", of.unsupported, "unsupported"),
        count("not judged", of.not_judged, "not judged"),
    ];
    Chapter { chapter: of.chapter, rules: of.rules, counts }
}

#[derive(Debug, Serialize)]
struct Open<'a> {
    rule: &'a str,
    case: &'a str,
    word: &'static str,
    class: String,
    why: &'a str,
    accepted: Option<&'a str>,
}

#[derive(Debug, Serialize)]
struct Moved<'a> {
    rule: &'a str,
    case: &'a str,
    picture: String,
}

/// Each choice and quirk: the expected and the observed option.
#[derive(Debug, Serialize)]
struct Fingerprint<'a> {
    agrees: usize,
    all: usize,
    declared: usize,
    departs: Vec<Shown<'a>>,
    rest: Vec<Shown<'a>>,
}

#[derive(Debug, Serialize)]
struct Shown<'a> {
    choice: &'a str,
    sentence: Option<&'a str>,
    held_to: &'a str,
    declared: bool,
    shown: String,
}

#[derive(Debug, Serialize)]
struct Cost<'a> {
    all: String,
    each: String,
    slowest: Vec<Slow<'a>>,
}

#[derive(Debug, Serialize)]
struct Slow<'a> {
    rule: &'a str,
    case: &'a str,
    time: String,
}

/// The result in a sentence, and the verdict whose style it has.
pub(super) fn says(report: &Report<'_>) -> (&'static str, &'static str) {
    match report.exit_status() {
        0 if report.mismatches.is_some() => ("pass", "All differences are known."),
        0 if report.header.scope == Scope::AssertionsOnly => {
            ("pass", "Every judged assertion holds. Nothing else was compared.")
        }
        0 => ("pass", "It does what the documents say in every judged case."),
        1 => ("diverges", "It diverges from its documents."),
        _ if report.counts().judged() == 0 => {
            ("inconclusive", "Nothing was judged: nothing is certified.")
        }
        _ => ("inconclusive", "Some cases could not be judged. This is not a certificate."),
    }
}

fn counts(report: &Report<'_>) -> Vec<Count> {
    let counts = report.counts();
    let count = |name, count, word| Count { name, count, class: class(word) };
    let mut all = vec![
        count("cases", counts.all(), "all"),
        count("pass", counts.pass, "pass"),
        count("diverge", counts.diverges, "diverges"),
    ];
    let more = [
        ("with a side difference", counts.side_difference, "side difference"),
        ("known", counts.known, "known"),
        ("waived", counts.waived, "waived"),
        ("unsupported", counts.unsupported, "unsupported"),
    ];
    let open = counts.not_judged_by_verdict().map(|(word, count)| (word, count, word));
    let more = more.into_iter().chain(open).filter(|(_, count, _)| *count > 0);
    all.extend(more.map(|(name, number, word)| count(name, number, word)));
    all
}

/// The verdicts of rules, and those of cards.
fn words(report: &Report<'_>) -> Vec<Word> {
    let counts = report.counts();
    let mut words = vec!["diverges"];
    words.extend(
        [(counts.known, "known"), (counts.waived, "waived")]
            .iter()
            .filter_map(|(count, word)| (*count > 0).then_some(*word)),
    );
    words.extend(["not judged", "unsupported", "pass"]);
    words.into_iter().map(|word| Word { word, class: class(word) }).collect()
}

/// The worst first: unknown divergences in most cases.
fn rules<'a>(report: &'a Report<'_>, kinds: &[Kind<'_>]) -> Vec<Row<'a>> {
    let mut rules = report.rules();
    rules.sort_by_key(|result| {
        let Counts { diverges, known, waived, .. } = result.counts;
        let kind = match result.verdict {
            RuleVerdict::Diverges => 0,
            RuleVerdict::NotJudged => 1,
            RuleVerdict::Unsupported => 2,
            RuleVerdict::Pass => 3,
        };
        (kind, Reverse(diverges), Reverse(known + waived), Reverse(result.counts.not_judged()))
    });
    let cases = |counts: Counts| {
        let departing = counts.diverges + counts.known + counts.waived;
        let bad = if departing > 0 { departing } else { counts.not_judged() };
        if bad > 0 { format!("{bad} of {}", counts.all()) } else { counts.all().to_string() }
    };
    let row = |result: super::RuleResult<'a>| Row {
        rule: &result.rule.id,
        verdict: result.verdict.word(),
        class: class(result.verdict.word()),
        sentence: &result.rule.sentence,
        sources: report.sections(result.rule).join("; "),
        cases: cases(result.counts),
        finding: kinds.iter().position(|kind| kind.has(&result.rule.id)).map(|place| place + 1),
    };
    rules.into_iter().map(row).collect()
}

/// Pictures of cases without a card.
fn motions<'a>(report: &'a Report<'_>) -> Vec<Moved<'a>> {
    let others = report.run.cases.iter().filter(|result| result.verdict.divergence().is_none());
    let drawn = others.filter_map(|result| {
        let picture = result.sketch.as_ref()?.svg();
        Some(Moved { rule: &result.rule.id, case: result.name, picture })
    });
    drawn.take(PICTURES).collect()
}

fn not_judged<'a>(report: &'a Report<'_>) -> Vec<Open<'a>> {
    let why = |result: &'a CaseResult<'_>| {
        let why = result.verdict.undetermined_reason()?;
        let word = result.verdict.word();
        let accepted = result.accepted.as_deref();
        Some(Open {
            rule: &result.rule.id,
            case: result.name,
            word,
            class: class(word),
            why,
            accepted,
        })
    };
    let leaked = report.leaks().into_iter().map(|(result, why)| Open {
        rule: &result.rule.id,
        case: result.name,
        word: "leaked state",
        class: class("nondeterministic"),
        why,
        accepted: None,
    });
    report.run.cases.iter().filter_map(why).chain(leaked).collect()
}

fn fingerprint<'a>(report: &'a Report<'_>) -> Option<Fingerprint<'a>> {
    let traits = report.run.fingerprint.as_ref()?;
    let shown = |of: &'a gaugeblock_runner::fingerprint::FingerprintEntry| Shown {
        choice: &of.choice,
        sentence: report
            .suite
            .choices
            .iter()
            .find(|choice| choice.id == of.choice)
            .map(|choice| choice.sentence.as_str()),
        held_to: &of.expected,
        declared: of.declared,
        shown: of.observed.to_string(),
    };
    let (departs, rest): (Vec<_>, Vec<_>) = traits.iter().partition(|of| of.differs());
    Some(Fingerprint {
        agrees: traits.iter().filter(|of| of.agrees()).count(),
        all: traits.len(),
        declared: traits.iter().filter(|of| of.declared).count(),
        departs: departs.into_iter().map(shown).collect(),
        rest: rest.into_iter().map(shown).collect(),
    })
}

/// What it cost, where that is known.
fn cost<'a>(report: &'a Report<'_>) -> Option<Cost<'a>> {
    let cases = &report.run.cases;
    let all: Duration = cases.iter().map(|result| result.cost).sum();
    if all.is_zero() {
        return None;
    }
    let mut slowest: Vec<_> = cases.iter().collect();
    slowest.sort_by_key(|result| Reverse(result.cost));
    let slow = |result: &&'a CaseResult<'_>| Slow {
        rule: &result.rule.id,
        case: result.name,
        time: in_words(result.cost),
    };
    let each = all / u32::try_from(cases.len()).unwrap_or(u32::MAX).max(1);
    let slowest = slowest.iter().take(SLOWEST).map(slow).collect();
    Some(Cost { all: in_words(all), each: in_words(each), slowest })
}

fn in_words(time: Duration) -> String {
    let seconds = time.as_secs_f64();
    if seconds >= 1.0 { format!("{seconds:.1} s") } else { format!("{:.2} ms", seconds * 1e3) }
}

/// How many values of each kind were compared.
fn basis(report: &Report<'_>) -> String {
    let mut all = gaugeblock_compare::Tally::default();
    report.run.cases.iter().for_each(|result| all.extend(&result.compared));
    let what = match report.header.scope {
        Scope::Full => "assertions, and everything else that the controller reports",
        Scope::AssertionsOnly => "assertions only; the outcomes were not compared with the model",
    };
    format!("{} values were compared: {what}.", all.total())
}
