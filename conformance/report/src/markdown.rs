//! The report as a short page of Markdown, for a pull request: the verdict first, what is new, and the smallest
//! programs.
//!
//! Text of a controller is in code spans, in a run of backticks that it cannot close: it makes no heading, no link, no
//! mention, no HTML. The page has a limit, and says what it leaves out.

use gaugeblock_runner::expectations::ExpectationMismatch;
use gaugeblock_runner::findings::Finding;
use gaugeblock_vocabulary::Language;

use super::abridge::abridged;
use super::grouping::{explain, size, title, without_guard};
use super::terminal::shortened;
use super::{ProfileResult, Report, RuleResult, RuleVerdict, html};

/// Most bytes of the page: less than a comment on GitHub may have.
const MOST: usize = 60_000;

/// Longest text in characters.
const SHOWN: usize = 300;

/// Most items of a list.
const ITEMS: usize = 20;

/// Most lines of a program.
const LINES: usize = 24;

/// Notes that say what passes now.
const FIXED: &str = "fixed: ";

/// The report in Markdown.
pub fn markdown(report: &Report<'_>) -> String {
    let mut page = head(report);
    for section in [changes(report), profiles(report), rules(report), not_judged(report)] {
        page.push_str(&section);
    }
    let last = [unsupported(report), notes(report), foot(report)].concat();
    page.push_str(&divergences(report, MOST.saturating_sub(page.len() + last.len())));
    page.push_str(&last);
    page
}

fn head(report: &Report<'_>) -> String {
    let header = &report.header;
    let counts = report.counts();
    let (_, says) = html::says(report);
    let columns = [
        ("cases", counts.all(), true),
        ("pass", counts.pass, true),
        ("diverge", counts.diverges, true),
        ("with a side difference", counts.side_difference, true),
        ("known", counts.known, false),
        ("waived", counts.waived, false),
        ("unsupported", counts.unsupported, true),
        ("not judged", counts.not_judged(), true),
    ];
    let columns = columns.into_iter().filter(|(_, count, always)| *always || *count > 0);
    let (mut names, mut rule, mut numbers) = (String::new(), String::new(), String::new());
    for (name, count, _) in columns {
        names.push_str(&format!(" {name} |"));
        rule.push_str(" ---: |");
        numbers.push_str(&format!(" {count} |"));
    }
    let in_part = counts.in_part();
    let in_part =
        in_part.map_or_else(String::new, |part| format!("\nOf the cases that pass, {part}.\n"));
    format!(
        "## {says}\n\n{} {} against {}: {}\n\n|{names}\n|{rule}\n|{numbers}\n{in_part}",
        code(&header.controller),
        code(&header.version),
        code(&report.edition_and_scope()),
        plain(&report.run.edition.sentence),
    )
}

/// What is not as it is known to be.
fn changes(report: &Report<'_>) -> String {
    let Some(mismatches) = &report.mismatches else { return String::new() };
    let items = mismatches.iter().map(|mismatch| {
        let (rule, case) = mismatch.place();
        let place = code(&format!("{rule} / {case}"));
        match mismatch {
            ExpectationMismatch::New { found, .. } => format!("**new** {place}: {}", code(found)),
            ExpectationMismatch::Changed { listed, found, .. } => {
                format!("**changed** {place}: was {}, now {}", code(listed), code(found))
            }
            ExpectationMismatch::Stale { why, .. } => format!("**stale** {place}: {}", code(why)),
        }
    });
    let fixed = report.notes.iter().filter_map(|note| note.strip_prefix(FIXED));
    let items: Vec<_> = items.chain(fixed.map(|it| format!("**fixed** {}", code(it)))).collect();
    let count = |of: fn(&ExpectationMismatch) -> bool| {
        mismatches.iter().filter(|mismatch| of(mismatch)).count()
    };
    let new = count(|mismatch| matches!(mismatch, ExpectationMismatch::New { .. }));
    let changed = count(|mismatch| matches!(mismatch, ExpectationMismatch::Changed { .. }));
    let stale = count(|mismatch| matches!(mismatch, ExpectationMismatch::Stale { .. }));
    let fixed = items.len() - mismatches.len();
    let stale = if stale == 0 { String::new() } else { format!(", {stale} stale") };
    let title = "Against what is known";
    section(&format!("{title}: {new} new, {changed} changed{stale}, {fixed} fixed"), &items)
}

/// How far the controller is from each profile: the claimed ones with the rules that fail them, the others folded.
fn profiles(report: &Report<'_>) -> String {
    let listed = report.profiles.iter().filter(|it| it.is_listed());
    let (claimed, others): (Vec<_>, Vec<_>) = listed.partition(|it| it.claimed);
    let mut text = String::new();
    if !claimed.is_empty() {
        let items = claimed.iter().map(|result| {
            let says = if result.passes() { "passes" } else { "**fails**" };
            let (id, version) = (code(&result.profile.id), result.profile.version);
            let missing = if result.passes() { String::new() } else { missing(result) };
            format!("{says} {id} {version}, {}{missing}", share(result))
        });
        text = section("Claimed profiles", &items.collect::<Vec<_>>());
    }
    if !others.is_empty() {
        let passed = others.iter().filter(|it| it.passes()).count();
        let row = |result: &&ProfileResult<'_>| {
            let id = plain(&result.profile.id);
            format!("| {id} | {} | {} |\n", share(result), plain(&result.missing_in_words()))
        };
        let rows: String = others.iter().map(row).collect();
        let title = format!("Profiles: passes {passed} of {}", others.len());
        text.push_str(&format!(
            "\n<details><summary>{title}</summary>\n\n\
             | profile | rules | not passed |\n| --- | ---: | --- |\n{rows}\n</details>\n"
        ));
    }
    text
}

/// How many rules of a profile pass, such as `57 of 60`.
fn share(result: &ProfileResult<'_>) -> String {
    format!("{} of {}", result.count(RuleVerdict::Pass), result.rules.len())
}

fn missing(result: &ProfileResult<'_>) -> String {
    format!("; {}", plain(&result.missing_in_words()))
}

/// The rules of which most cases diverge.
fn rules(report: &Report<'_>) -> String {
    let mut rules: Vec<RuleResult<'_>> = report.rules();
    rules.retain(|result| result.counts.diverges > 0);
    rules.sort_by_key(|result| std::cmp::Reverse(result.counts.diverges));
    if rules.is_empty() {
        return String::new();
    }
    let count = rules.len();
    let row = |result: &RuleResult<'_>| {
        let RuleResult { rule, counts, .. } = result;
        let (id, sentence) = (plain(&rule.id), plain(&rule.sentence));
        format!("| {} of {} | {id} | {sentence} |\n", counts.diverges, counts.all())
    };
    let rows: String = rules.iter().take(ITEMS).map(row).collect();
    let more = more(count);
    format!(
        "\n### Broken rules: {count}\n\n| cases | rule | requirement |\n| ---: | --- | --- |\n{rows}{more}"
    )
}

/// Findings that no list accepts, each with its smallest program, in at most so many bytes: the worst first.
fn divergences(report: &Report<'_>, room: usize) -> String {
    let all: Vec<_> = report.findings().iter().filter(|finding| !finding.is_known).collect();
    if all.is_empty() {
        return String::new();
    }
    let title = match &report.mismatches {
        None => "Findings, and the smallest program of each",
        Some(_) => "Findings that are new or have changed, and the smallest program of each",
    };
    let mut text = format!("\n### {title}\n\nThe worst first; each has one cause.\n");
    for (shown, finding) in all.iter().enumerate() {
        let card = card(report, finding);
        // Room for the sentence that tells of the rest.
        if text.len() + card.len() + 100 > room {
            text.push_str(&format!("\n… and {} more: see report.html\n", all.len() - shown));
            break;
        }
        text.push_str(&card);
    }
    text
}

/// A finding, folded: the rule, what differs, the smallest program.
fn card(report: &Report<'_>, finding: &Finding<'_, '_>) -> String {
    let Some((result, divergence)) = finding.divergent().next() else { return String::new() };
    let severity = finding.severity.heading();
    let rule = finding.rule.map_or("no rule is known to be broken", |rule| rule.id.as_str());
    let (rule, size) = (escaped(rule), size(finding));
    let mut text =
        format!("\n<details><summary>{severity}: <code>{rule}</code> ({size})</summary>\n\n");
    if let Some(rule) = finding.rule {
        let sources = report.sections(rule);
        let sources: Vec<_> = sources.iter().map(|section| plain(section)).collect();
        text.push_str(&format!("{} ({})\n\n", plain(&rule.sentence), sources.join("; ")));
    }
    let place = format!("{} / {}", result.rule.id, result.name);
    let title = title(&report.header.controller, finding);
    text.push_str(&format!("{}. The smallest, {}:\n\n", code(&title), code(&place)));
    text.push_str(&program(divergence.program(result), result.rule.language));
    text.push('\n');
    if let Some((said, found)) = &divergence.assertion {
        let (said, found) = abridged(without_guard(said), found);
        text.push_str(&format!("- expected {}\n- found {}\n", code(&said), code(&found)));
    }
    if let Some(divergence) = &divergence.difference {
        text.push_str(&format!("- first difference {}\n", code(divergence)));
    }
    if let Some(explanation) = explain(&report.header.controller, divergence)
        && explanation.text != title
    {
        text.push_str(&format!("- {}\n", code(&explanation.text)));
    }
    let touched: Vec<_> = finding.touched_rules().into_iter().take(ITEMS).map(code).collect();
    if !touched.is_empty() {
        text.push_str(&format!("- other rules with failing cases: {}\n", touched.join(", ")));
    }
    text.push_str("\n</details>\n");
    text
}

/// A program, fenced by more backticks than it has.
fn program(program: &str, language: Language) -> String {
    let short = |line: &str| shortened(&visible(line));
    let lines: Vec<String> = language.lines(program).take(LINES).map(short).collect();
    let left = language.lines(program).count().saturating_sub(lines.len());
    let mut text = lines.join("\n");
    if left > 0 {
        text.push_str(&format!("\n… {left} more lines"));
    }
    let fence = "`".repeat(longest_run(&text).max(2) + 1);
    format!("{fence}text\n{text}\n{fence}\n")
}

fn not_judged(report: &Report<'_>) -> String {
    let items = report.run.cases.iter().filter_map(|result| {
        let why = result.verdict.undetermined_reason()?;
        let place = code(&format!("{} / {}", result.rule.id, result.name));
        let accepted = result.accepted.as_ref().map(|source| format!(" ({})", plain(source)));
        let accepted = accepted.unwrap_or_default();
        Some(format!("{place}: {}, {}{accepted}", result.verdict.word(), code(why)))
    });
    let items: Vec<_> = items.collect();
    if items.is_empty() {
        return String::new();
    }
    section(&format!("Not judged, and not a pass: {}", items.len()), &items)
}

/// Why cases were not run, folded: the most frequent reason first.
fn unsupported(report: &Report<'_>) -> String {
    let mut reasons: Vec<_> = report.unsupported().into_iter().collect();
    if reasons.is_empty() {
        return String::new();
    }
    reasons.sort_by_key(|(_, cases)| std::cmp::Reverse(*cases));
    let items: Vec<_> =
        reasons.iter().map(|(why, cases)| format!("{cases} × {}", code(why))).collect();
    let list = list(&items);
    format!("\n<details><summary>What was not run, and why</summary>\n\n{list}\n</details>\n")
}

fn notes(report: &Report<'_>) -> String {
    let notes = report.notes.iter().filter(|note| !note.starts_with(FIXED));
    let items: Vec<_> = notes.map(|note| code(note)).collect();
    if items.is_empty() { String::new() } else { section("Notes", &items) }
}

fn foot(report: &Report<'_>) -> String {
    let header = &report.header;
    let suite: String = header.suite.chars().take(16).collect();
    let version = plain(&header.gaugeblock_version);
    format!(
        "\ndeclared accuracy: {}; gaugeblock {version}, suite {}\n",
        header.accuracy,
        plain(&suite)
    )
}

fn section(title: &str, items: &[String]) -> String {
    let list = list(items);
    let gap = if list.is_empty() { "" } else { "\n" };
    format!("\n### {title}\n{gap}{list}")
}

fn list(items: &[String]) -> String {
    let items: String = items.iter().take(ITEMS).map(|item| format!("- {item}\n")).collect();
    format!("{items}{}", more(items.len()))
}

fn more(count: usize) -> String {
    match count.saturating_sub(ITEMS) {
        0 => String::new(),
        more => format!("\n… and {more} more: see report.html\n"),
    }
}

/// A text in code: in one line, cut, and between more backticks than it has.
fn code(text: &str) -> String {
    let mut line: String = visible(text).chars().take(SHOWN).collect();
    if text.chars().count() > SHOWN {
        line.push('…');
    }
    if line.trim().is_empty() {
        return "(nothing)".to_owned();
    }
    let fence = "`".repeat(longest_run(&line) + 1);
    // One space on each side is taken away again; without it the text could join the fence.
    format!("{fence} {line} {fence}")
}

/// Words of the suite outside of code.
fn plain(text: &str) -> String {
    let mut plain = String::new();
    for c in visible(text).chars() {
        if "\\`*_[]<>#|~&$@".contains(c) {
            plain.push('\\');
        }
        plain.push(c);
    }
    plain
}

/// Words of the suite within HTML.
fn escaped(text: &str) -> String {
    let text = visible(text);
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

/// A text without what ends a line, moves a cursor or turns the direction of reading.
fn visible(text: &str) -> String {
    let is_seen = |c: char| {
        !c.is_control()
            && !matches!(c, '\u{200b}'..='\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2060}'..='\u{206f}' | '\u{feff}')
    };
    text.chars().map(|c| if is_seen(c) { c } else { ' ' }).collect()
}

/// Longest run of backticks.
fn longest_run(text: &str) -> usize {
    text.split(|c| c != '`').map(str::len).max().unwrap_or_default()
}
