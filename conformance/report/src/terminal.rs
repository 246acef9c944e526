//! The report as a person reads it on a terminal. Text of a controller is [escaped](escape_text).

use std::collections::BTreeMap;
use std::fmt::Write as _;

use anstyle::{AnsiColor, Style};
use gaugeblock_runner::certify::{CaseResult, RuleDivergence, Scope, Verdict};
use gaugeblock_runner::findings::{Finding, FindingCause};
use gaugeblock_suite::Profile;
use gaugeblock_vocabulary::Language;

use super::abridge::{abridged, wrapped};
use super::grouping::{explain, size, title, without_guard, without_lines};
use super::{Report, RuleVerdict, escape_line, escape_text};

const BOLD: Style = Style::new().bold();
const RED: Style = AnsiColor::Red.on_default().bold();
const GREEN: Style = AnsiColor::Green.on_default().bold();
const YELLOW: Style = AnsiColor::Yellow.on_default().bold();
const DIM: Style = Style::new().dimmed();

fn styled(style: Style, text: &str) -> String {
    format!("{style}{text}{style:#}")
}

macro_rules! line {
    ($text:expr) => { line!($text, "") };
    ($text:expr, $($words:tt)*) => {{
        let _infallible = writeln!($text, $($words)*);
    }};
}

/// How much of a report is printed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Detail {
    /// The notes, the counts and the verdict alone.
    Verdict,
    /// A table of the chapters, the worst findings, what was not judged.
    Worst,
    /// The same with all findings.
    Findings,
    /// The same with every divergence in full, known ones among them.
    Everything,
}

/// How many findings [`Detail::Worst`] has.
const WORST: usize = 10;

/// The report as text, with styles of a terminal.
pub fn terminal(report: &Report<'_>, detail: Detail) -> String {
    let verbose = detail == Detail::Everything;
    let mut text = String::new();
    if detail == Detail::Verdict {
        notes(&mut text, report);
        verdict(&mut text, report);
        return text;
    }
    head(&mut text, report);
    chapters(&mut text, report);
    if verbose {
        let divergent = report.run.cases.iter();
        for result in divergent.filter(|result| result.verdict.divergence().is_some()) {
            divergence(&mut text, report, result);
        }
    }
    findings(&mut text, report, detail);
    notation(&mut text, report, verbose);
    not_judged(&mut text, report);
    waived(&mut text, report);
    mismatches(&mut text, report);
    profiles(&mut text, report);
    measurements(&mut text, report);
    void(&mut text, report, verbose);
    unseen(&mut text, report, verbose);
    verdict(&mut text, report);
    text
}

fn head(text: &mut String, report: &Report<'_>) {
    let controller = format!("{} {}", report.header.controller, report.header.version);
    let controller = escape_line(&controller);
    let edition = styled(BOLD, &report.edition_and_scope());
    line!(text, "{} against {edition}", styled(BOLD, &controller));
    line!(text, "{}", styled(DIM, &report.run.edition.sentence));
    line!(text, "{}", styled(DIM, &format!("declared accuracy: {}", report.header.accuracy)));
    notes(text, report);
    line!(text);
}

fn notes(text: &mut String, report: &Report<'_>) {
    for note in &report.notes {
        line!(text, "{} {}", styled(YELLOW, "note"), escape_text(note));
    }
}

fn chapters(text: &mut String, report: &Report<'_>) {
    line!(
        text,
        "{:<18}{:>6}{:>7}{:>10}{:>13}{:>12}",
        "chapter",
        "rules",
        "pass",
        "diverges",
        "unsupported",
        "not judged"
    );
    for of in report.chapters() {
        let shown = |count: usize, style: Style, width: usize| match count {
            0 => styled(DIM, &format!("{:>width$}", "·")),
            _ => styled(style, &format!("{count:>width$}")),
        };
        line!(
            text,
            "{:<18}{:>6}{}{}{}{}",
            of.chapter,
            of.rules,
            shown(of.pass, GREEN, 7),
            shown(of.diverges, RED, 10),
            shown(of.unsupported, YELLOW, 13),
            shown(of.not_judged, YELLOW, 12)
        );
    }
    line!(text);
}

/// The rules that do not exist in the edition: how many, or each with the reason.
fn void(text: &mut String, report: &Report<'_>, verbose: bool) {
    let void = &report.run.not_applicable;
    if void.is_empty() {
        return;
    }
    if verbose {
        line!(text, "void in this edition:");
        for (rule, why) in void {
            line!(text, "  {:<36} {}", rule.id, styled(DIM, why));
        }
    } else {
        let is = if void.len() == 1 { "rule is" } else { "rules are" };
        line!(text, "{} {is} void in this edition (-v says why)", void.len());
    }
}

/// A divergence: the rule, its sources, the program, what was expected and found.
fn divergence(text: &mut String, report: &Report<'_>, result: &CaseResult<'_>) {
    let Some(divergence) = result.verdict.divergence() else { return };
    let word = result.verdict.word();
    line!(text, "{} {} / {}", styled(RED, word), styled(BOLD, &result.rule.id), result.name);
    line!(text, "  {}", result.rule.sentence);
    for section in report.sections(result.rule) {
        line!(text, "  {}", styled(DIM, &section));
    }
    program(text, result.program, result.rule.language);
    assertion(text, "  ", divergence);
    if let Some(divergence) = &divergence.difference {
        line!(text, "  first difference  {}", escape_line(divergence));
    }
    if let Some(shrunk) = &divergence.shrunk {
        line!(text, "  the smallest program that does so");
        result
            .rule
            .language
            .lines(shrunk)
            .for_each(|line| line!(text, "         {}", escape_line(line)));
    }
    if let Some(explanation) = explain(&report.header.controller, divergence) {
        let style = if explanation.applies_to_controller { YELLOW } else { DIM };
        line!(text, "  {}", styled(style, &explanation.text));
    }
    if let Some(source) = result.verdict.accepted_by() {
        line!(text, "  accepted  {}", escape_line(source));
    }
    line!(text);
}

/// The failed assertion, and what was found.
fn assertion(text: &mut String, margin: &str, divergence: &RuleDivergence) {
    let Some((said, found)) = &divergence.assertion else { return };
    let (said, found) = abridged(without_guard(said), found);
    let indentation = margin.len() + "expected  ".len();
    line!(text, "{margin}expected  {}", styled(GREEN, &wrapped(&said, indentation)));
    let found = escape_line(&found);
    line!(text, "{margin}found     {}", styled(RED, &wrapped(&found, indentation)));
}

/// Explains the notation of assertions, once, if a printed divergence has one that needs it.
fn notation(text: &mut String, report: &Report<'_>, verbose: bool) {
    let findings = report.findings().iter().filter(|finding| verbose || !finding.is_known);
    let printed =
        findings.flat_map(|finding| finding.divergent().take(if verbose { usize::MAX } else { 1 }));
    let assertions = printed.filter_map(|(_, divergence)| divergence.assertion.as_ref());
    let texts: Vec<_> =
        assertions.map(|(said, found)| (without_guard(said), found.as_str())).collect();
    let notes = [
        ("after 4", "the state after the block of line 4", {
            texts.iter().any(|(said, _)| said.starts_with("after "))
        }),
        ("()", "a position or offset with all axes at zero", {
            texts.iter().any(|(said, found)| said.contains("= ()") || found.contains("= ()"))
        }),
        ("0 of dwell", "a run without the effect `dwell`", {
            texts.iter().any(|(said, _)| said.starts_with("count "))
        }),
    ];
    let notes: Vec<_> = notes
        .into_iter()
        .filter(|(_, _, is_needed)| *is_needed)
        .map(|(written, means, _)| format!("`{written}` is {means}"))
        .collect();
    if !notes.is_empty() {
        line!(text, "in assertions: {}", notes.join("; "));
        line!(text);
    }
}

/// Findings that no list accepts, the worst first: each with its rule and the smallest program.
fn findings(text: &mut String, report: &Report<'_>, detail: Detail) {
    let findings: Vec<_> = report.findings().iter().filter(|finding| !finding.is_known).collect();
    if findings.is_empty() {
        return;
    }
    line!(text, "{}", styled(BOLD, &format!("findings: {}, the worst first", findings.len())));
    let printed = if detail == Detail::Worst { WORST } else { usize::MAX };
    for (place, found) in findings.iter().enumerate().take(printed) {
        finding(text, report, place + 1, found);
    }
    line!(text);
    if let more @ 1.. = findings.len().saturating_sub(printed) {
        line!(text, "{more} more findings: --all prints them, --report writes them as a page");
        line!(text);
    }
}

/// A finding: the broken rule, its smallest program, and what else the cause touches.
fn finding(text: &mut String, report: &Report<'_>, number: usize, finding: &Finding<'_, '_>) {
    let controller = &report.header.controller;
    let title = escape_line(&title(controller, finding));
    line!(text);
    let heading = format!("{number}. {}", finding.severity.heading());
    match finding.rule {
        Some(rule) => {
            line!(text, "{}: {}", styled(RED, &heading), styled(BOLD, &rule.id));
            line!(text, "   {}", rule.sentence);
            report
                .sections(rule)
                .iter()
                .for_each(|section| line!(text, "   {}", styled(DIM, section)));
        }
        None => line!(text, "{}: no rule is known to be broken", styled(RED, &heading)),
    }
    line!(text, "   {} {}", title, styled(DIM, &format!("({})", size(finding))));
    if let Some((result, divergence)) = finding.divergent().next() {
        line!(text, "   smallest: {} / {}", result.rule.id, result.name);
        program(text, divergence.program(result), result.rule.language);
        assertion(text, "   ", divergence);
        if let Some(difference) = &divergence.difference {
            line!(text, "   first difference  {}", escape_line(difference));
        }
        // Of a finding by a rule the title says what differs; a quirk of another controller is worth a line.
        if matches!(finding.cause, FindingCause::Rule)
            && let Some(explanation) = explain(controller, divergence)
        {
            line!(text, "   {}", styled(DIM, &explanation.text));
        }
    }
    let touched: Vec<_> = finding.touched_rules().into_iter().collect();
    if !touched.is_empty() {
        let touched = format!("   other rules with failing cases: {}", listed(&touched));
        line!(text, "{}", wrapped(&touched, 6));
    }
}

/// The first of many names.
fn listed(names: &[&str]) -> String {
    const SHOWN: usize = 8;
    let first = names.iter().take(SHOWN).copied().collect::<Vec<_>>().join(", ");
    match names.len().checked_sub(SHOWN) {
        Some(more @ 1..) => format!("{first} and {more} more"),
        _ => first,
    }
}

/// The lines of a program, numbered as blocks are.
fn program(text: &mut String, program: &str, language: Language) {
    let lines: Vec<&str> = language.lines(program).collect();
    const SHOWN: usize = 24;
    for (place, line) in lines.iter().take(SHOWN).enumerate() {
        let line = shortened(&escape_line(line));
        line!(text, "  {} {line}", styled(DIM, &format!("{:>4} |", place + 1)));
    }
    if lines.len() > SHOWN {
        line!(text, "  {}", styled(DIM, &format!("     | … {} more lines", lines.len() - SHOWN)));
    }
}

/// As much of a line as a person reads, and a sign where that is not all.
pub(super) fn shortened(line: &str) -> String {
    const SHOWN: usize = 100;
    let mut shown: String = line.chars().take(SHOWN).collect();
    if line.chars().count() > SHOWN {
        shown.push('…');
    }
    shown
}

fn not_judged(text: &mut String, report: &Report<'_>) {
    for result in &report.run.cases {
        let Some(why) = result.verdict.undetermined_reason() else { continue };
        let word = styled(YELLOW, result.verdict.word());
        let accepted = result.accepted.as_ref().map(|source| format!(" ({source})"));
        let accepted = accepted.unwrap_or_default();
        let (rule, accepted) = (&result.rule.id, escape_line(&accepted));
        line!(text, "{word} {rule} / {}: {}{accepted}", result.name, escape_line(why));
    }
    for (result, how) in report.leaks() {
        let (rule, how) = (&result.rule.id, escape_line(how));
        let word = styled(YELLOW, "leaked state");
        line!(text, "{word} {rule} / {}: judged alone; after other programs {how}", result.name);
    }
}

fn waived(text: &mut String, report: &Report<'_>) {
    for result in &report.run.cases {
        let Verdict::Waived(divergence, why) = &result.verdict else { continue };
        let line = escape_line(&divergence.summary());
        let word = styled(YELLOW, result.verdict.word());
        line!(text, "{word} {} / {}: {why}: {line}", result.rule.id, result.name);
    }
}

fn mismatches(text: &mut String, report: &Report<'_>) {
    for mismatch in report.mismatches.iter().flatten() {
        let mismatch = mismatch.to_string();
        line!(text, "{} {}", styled(RED, "expectation"), escape_line(&mismatch));
    }
}

/// How far the controller is from each profile: the rules that pass, and the others by name.
fn profiles(text: &mut String, report: &Report<'_>) {
    const INDENTATION: usize = 33;
    let listed: Vec<_> = report.profiles.iter().filter(|it| it.is_listed()).collect();
    if listed.is_empty() {
        return;
    }
    line!(text, "{:<18}{:>6}{:>7}  not passed", "profile", "rules", "pass");
    for result in &listed {
        let (id, rules) = (&result.profile.id, result.rules.len());
        let pass = format!("{:>7}", result.count(RuleVerdict::Pass));
        let pass = if result.passes() { styled(GREEN, &pass) } else { pass };
        let missing = wrapped(&result.missing_in_words(), INDENTATION);
        let missing =
            if missing.is_empty() { missing } else { format!("  {}", styled(DIM, &missing)) };
        line!(text, "{id:<18}{rules:>6}{pass}{missing}");
    }
    line!(text);
    for result in listed.iter().filter(|it| it.claimed) {
        let (style, says) = match result.passes() {
            true => (GREEN, "passes the claimed profile"),
            false => (RED, "fails the claimed profile"),
        };
        let Profile { id, version, .. } = result.profile;
        line!(text, "{} {id} (version {version})", styled(style, says));
    }
}

/// The controller's limits, where they were measured.
fn measurements(text: &mut String, report: &Report<'_>) {
    if report.measurements.is_empty() {
        return;
    }
    line!(text, "measured limits");
    for measurement in &report.measurements {
        let result = measurement.result();
        line!(text, "  {:<21}{}", escape_line(&measurement.id), escape_line(&result));
    }
    line!(text);
}

/// Why a field is masked.
const NOT_JUDGED: &str =
    "not judged, since not reported in every case, or without a code in the edition";

fn unseen(text: &mut String, report: &Report<'_>, verbose: bool) {
    let unsupported = report.unsupported();
    if !unsupported.is_empty() {
        line!(text, "unsupported, by reason:");
        let mut folded: BTreeMap<String, usize> = BTreeMap::new();
        for (reason, cases) in unsupported {
            *folded.entry(without_lines(reason)).or_default() += cases;
        }
        for (reason, cases) in folded {
            line!(text, "  {cases:>5}  {}", escape_text(&reason));
        }
    }
    let masked = report.masked();
    if !masked.is_empty() {
        if verbose {
            line!(text, "{NOT_JUDGED}, by number of cases:");
            for (field, cases) in masked {
                line!(text, "  {cases:>5}  {field}");
            }
        } else {
            let names: Vec<_> = masked.keys().copied().collect();
            let names = names.join(", ");
            let names = format!("{NOT_JUDGED}: {names} (-v counts them)");
            line!(text, "{}", wrapped(&names, 2));
        }
    }
    let repeated = report.run.cases.iter().filter(|result| result.rerun);
    let repeated: Vec<_> =
        repeated.map(|result| format!("{} / {}", result.rule.id, result.name)).collect();
    if !repeated.is_empty() {
        line!(
            text,
            "judged on a new controller, because a used one diverged (state that an earlier program left, or chance): {}",
            repeated.join(", ")
        );
    }
    line!(text);
}

fn verdict(text: &mut String, report: &Report<'_>) {
    let counts = report.counts();
    let compared: usize = report.run.cases.iter().map(|result| result.compared.total()).sum();
    let mut departing = vec![
        format!("{} pass", counts.pass),
        format!("{} with a side difference", counts.side_difference),
        format!("{} diverge", counts.diverges),
    ];
    let excused = [(counts.known, "known"), (counts.waived, "waived")];
    let excused = excused.into_iter().filter(|(count, _)| *count > 0);
    departing.extend(excused.map(|(count, word)| format!("{count} {word}")));
    line!(
        text,
        "{} cases: {}, {} unsupported, {} not judged; {compared} values compared",
        counts.all(),
        departing.join(", "),
        counts.unsupported,
        counts.not_judged()
    );
    if let Some(in_part) = counts.in_part() {
        line!(text, "of the {} that pass, {}", counts.pass, styled(YELLOW, &in_part));
    }
    let open = counts.not_judged_by_verdict().into_iter().filter(|(_, count)| *count > 0);
    let open: Vec<_> = open.map(|(word, count)| format!("{count} {word}")).collect();
    if !open.is_empty() {
        let accepted = match counts.not_judged_accepted {
            0 => String::new(),
            accepted => format!("; {accepted} of them known, waived or without an assertion"),
        };
        line!(text, "not judged: {}{accepted}", styled(YELLOW, &open.join(", ")));
    }
    let (style, words) = match (report.exit_status(), &report.mismatches) {
        (0, Some(_)) => (GREEN, "as the documents say, apart from what is known"),
        (0, None) if report.header.scope == Scope::AssertionsOnly => {
            (GREEN, "every judged assertion holds; nothing else was compared")
        }
        (0, None) => (GREEN, "as the documents say"),
        (1, Some(mismatches)) if !mismatches.is_empty() => (RED, "diverges, and not only as known"),
        (1, None) if counts.diverges + counts.side_difference > 0 => {
            (RED, "diverges from its documents")
        }
        (1, _) => (RED, "does not pass what it claims"),
        _ if counts.judged() == 0 => (YELLOW, "nothing was judged: nothing is certified"),
        _ if counts.open() == 0 => {
            (YELLOW, "not clean: programs leave state that changes the verdict of others")
        }
        _ => (YELLOW, "not finished: some cases were not judged"),
    };
    line!(text, "{}", styled(style, words));
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_are_numbered_as_blocks_are() {
        let shown = |language| {
            let mut text = String::new();
            program(&mut text, "g0 x1\rx2\r\nm2\n", language);
            text.lines().count()
        };
        assert_eq!(shown(Language::Rs274), 3, "a carriage return alone ends a line there");
        assert_eq!(shown(Language::Nct), 2);
    }
}
