//! The report of `gaugeblock fuzz`: text, JSON and files.

use std::cmp::Reverse;
use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::path::Path;

use gaugeblock_report::escape_text;
use gaugeblock_runner::fuzz::comparability::NotComparable;
use gaugeblock_runner::fuzz::groups::Finding;
use gaugeblock_runner::fuzz::journal::{Header, NotJudged};
use gaugeblock_runner::fuzz::statistics::{Counts, ENOUGH, Statistics};
use gaugeblock_vocabulary::Scenario;
use serde_json::json;

use super::user_files;
use crate::error::CliError;

/// How many divergences are printed with their programs.
const SHOWN: usize = 40;

/// A finished run.
#[derive(Debug)]
pub(crate) struct Report<'a> {
    pub(crate) header: &'a Header,
    pub(crate) statistics: &'a Statistics,
    pub(crate) findings: &'a [Finding],
    /// Divergences of an earlier report.
    pub(crate) known: &'a [Finding],
    /// Outcomes of the suite's rules that few programs or none reached, and how many.
    pub(crate) rare: &'a [(String, u64)],
    /// Outcomes that no program reached, nor any case that both controllers can run, each with the reason.
    pub(crate) not_shown: &'a NotComparable,
    /// The first programs that could not be judged, by their number.
    pub(crate) not_judged: &'a BTreeMap<u64, NotJudged>,
    pub(crate) seconds: f64,
    /// Percentage of blocks that must be compared for a success.
    pub(crate) least_compared: u32,
}

impl Report<'_> {
    /// 0 nothing, 1 divergences, 3 not everything was judged, or too little was compared.
    pub(crate) fn exit_status(&self) -> u8 {
        if !self.findings.is_empty() {
            1
        } else if !self.statistics.not_judged.is_empty() || self.compares_too_little() {
            3
        } else {
            0
        }
    }

    /// Whether so few blocks were compared that the run says little about the controller.
    fn compares_too_little(&self) -> bool {
        let Statistics { compared, blocks, blocks_compared, .. } = *self.statistics;
        let least = u64::from(self.least_compared);
        compared == 0 || blocks_compared.saturating_mul(100) < blocks.saturating_mul(least)
    }

    pub(crate) fn json(&self) -> serde_json::Value {
        let findings: Vec<_> = self.findings.iter().map(|finding| {
            json!({
                "signature": finding.signature, "shape": finding.shape, "rules": finding.rules, "options": finding.options, "count": finding.count, "number": finding.number,
                "divergence": finding.divergence, "shrunk": finding.shrunk, "causes": finding.causes,
                "scenario": finding.scenario,
            })
        }).collect();
        json!({
            "gaugeblock": "fuzz", "version": 0, "run": self.header, "statistics": self.statistics,
            "divergences": findings, "known": self.known.len(), "rarely_reached": self.rare,
            "not_shown": self.not_shown,
            "not_judged": self.not_judged.values().collect::<Vec<_>>(),
        })
    }

    pub(crate) fn text(&self, verbose: bool) -> String {
        let mut text = String::new();
        let Header { iut: controller, against, options, seed, shard, .. } = self.header;
        let _infallible = writeln!(
            text,
            "{controller} against {against}, {options}, seed {seed}, shard {shard}\n"
        );
        for (place, finding) in self.findings.iter().take(SHOWN).enumerate() {
            let _infallible = writeln!(text, "{}", describe(place + 1, finding));
        }
        if self.findings.len() > SHOWN {
            let _infallible = writeln!(text, "… and {} more kinds\n", self.findings.len() - SHOWN);
        }
        let s = self.statistics;
        let rate = if self.seconds > 0.0 { as_float(s.programs) / self.seconds } else { 0.0 };
        let _infallible = writeln!(
            text,
            "{} programs in {:.1} s ({rate:.0} a second); {} compared, {} of them accepted; {} of blocks compared",
            s.programs,
            self.seconds,
            percent(s.compared, s.programs),
            percent(s.accepted, s.compared),
            percent(s.blocks_compared, s.blocks),
        );
        let _infallible = writeln!(
            text,
            "{} blocks a program; {} rule outcomes, {} codes, {} kinds of faults reached; {} fragile ({})",
            s.blocks_compared.checked_div(s.compared).unwrap_or_default(),
            s.rules.len(),
            s.codes.len(),
            s.faults.len(),
            s.fragile,
            percent(s.fragile, s.compared),
        );
        for (what, counts) in [
            ("unsupported", &s.unsupported),
            ("left open by the documents", &s.unspecified),
            ("not judged", &s.not_judged),
        ] {
            list(&mut text, what, counts, if verbose { usize::MAX } else { 6 });
        }
        self.first_not_judged(&mut text);
        self.rarely_reached(&mut text, if verbose { usize::MAX } else { 10 });
        self.not_shown(&mut text, verbose);
        if verbose {
            for (what, counts) in
                [("ends", &s.ends), ("faults", &s.faults), ("codes", &s.codes), ("rules", &s.rules)]
            {
                list(&mut text, what, counts, usize::MAX);
            }
        }
        let _infallible = writeln!(text, "{}", self.verdict());
        text
    }

    /// The numbers of the first programs that could not be judged.
    fn first_not_judged(&self, text: &mut String) {
        if !self.not_judged.is_empty() {
            let numbers: Vec<_> = self.not_judged.keys().map(u64::to_string).collect();
            let (numbers, hint) = (numbers.join(", "), "`--report DIR` writes each into a folder");
            let _infallible = writeln!(text, "            not judged: programs {numbers}; {hint}");
        }
    }

    /// Outcomes that few programs reached, so that the run says little about them.
    fn rarely_reached(&self, text: &mut String, most: usize) {
        if self.rare.is_empty() {
            return;
        }
        let _infallible = writeln!(
            text,
            "{} outcomes of the suite's rules were reached by fewer than {ENOUGH} programs:",
            self.rare.len()
        );
        for (name, programs) in self.rare.iter().take(most) {
            let _infallible = writeln!(text, "  {programs:>8}  {name}");
        }
        if self.rare.len() > most {
            let _infallible = writeln!(text, "            … {} more", self.rare.len() - most);
        }
    }

    /// Outcomes that cannot be compared between these two controllers, by the reason.
    fn not_shown(&self, text: &mut String, verbose: bool) {
        if self.not_shown.is_empty() {
            return;
        }
        let _infallible = writeln!(
            text,
            "{} outcomes were reached by no program, nor by a case that both controllers can run:",
            self.not_shown.len()
        );
        let mut by_reason: BTreeMap<&str, Vec<&str>> = BTreeMap::new();
        for (name, why) in self.not_shown {
            by_reason.entry(why).or_default().push(name);
        }
        let mut by_reason: Vec<_> = by_reason.into_iter().collect();
        by_reason.sort_by_key(|(_, names)| Reverse(names.len()));
        for (why, names) in by_reason {
            let _infallible = writeln!(text, "  {:>8}  {why}", names.len());
            for name in names.iter().filter(|_| verbose) {
                let _infallible = writeln!(text, "            {name}");
            }
        }
    }

    /// In words.
    fn verdict(&self) -> String {
        let known = match self.known.len() {
            0 => String::new(),
            count => format!(" ({count} kinds are known)"),
        };
        self.new_findings() + &known
    }

    fn new_findings(&self) -> String {
        let Statistics { diverging, compared, not_judged, blocks, blocks_compared, .. } =
            self.statistics;
        match (self.findings.len(), compared) {
            (0, 0) => "nothing was compared".to_owned(),
            (0, _) if self.compares_too_little() => format!(
                "no divergence, but too little was compared: {} of blocks; expected at least {} % (`--min-compared`)",
                percent(*blocks_compared, *blocks),
                self.least_compared
            ),
            (0, _) if !not_judged.is_empty() => {
                "no divergence, but not everything was judged".to_owned()
            }
            (0, _) => "no divergence".to_owned(),
            (kinds, _) => format!("{diverging} programs diverge, in {kinds} kinds"),
        }
    }

    /// Writes report.json, report.txt, a folder for each divergence, and a folder `not-judged-N` for each of the first
    /// programs that could not be judged.
    pub(crate) fn write(&self, folder: &Path) -> Result<(), CliError> {
        user_files::write_whole(&folder.join("report.json"), format!("{:#}\n", self.json()))?;
        user_files::write_whole(
            &folder.join("report.txt"),
            escape_text(&self.text(true)).as_bytes(),
        )?;
        for (at, finding) in self.findings.iter().enumerate() {
            let name: String = finding
                .signature
                .to_string()
                .chars()
                .map(|c| if c.is_ascii_alphanumeric() { c } else { '-' })
                .take(60)
                .collect();
            let folder = folder.join(format!("{:03}-{name}", at + 1));
            write_program(&folder, &finding.scenario)?;
            let description = describe(at + 1, finding);
            user_files::write_whole(
                &folder.join("divergence.txt"),
                escape_text(&description).as_bytes(),
            )?;
        }
        for NotJudged { number, why, scenario } in self.not_judged.values() {
            let folder = folder.join(format!("not-judged-{number}"));
            write_program(&folder, scenario)?;
            let description = escape_text(why) + "\n";
            user_files::write_whole(&folder.join("why.txt"), description.as_bytes())?;
        }
        Ok(())
    }
}

/// Writes a program, its files and the scenario into a folder of their own.
///
/// A file whose name has a separator could lie outside of the folder: it is written under a name with `_` instead. The
/// scenario has it under its own name.
fn write_program(folder: &Path, scenario: &Scenario) -> Result<(), CliError> {
    user_files::create_folder(folder)?;
    user_files::write_whole(&folder.join("program.ngc"), &scenario.program.main)?;
    for (name, text) in &scenario.program.files {
        user_files::write_whole(&folder.join(name.replace(['/', '\\'], "_")), text)?;
    }
    let text = scenario.to_text().map_err(|error| {
        CliError::failure(error.message, "this is a bug in gaugeblock; please report it")
    })?;
    user_files::write_whole(&folder.join("scenario.toml"), &text)
}

/// The divergences of an earlier report.
pub(crate) fn read(path: &Path) -> Result<Vec<Finding>, CliError> {
    let text = user_files::read_text(path, "earlier report (--known)")?;
    let refused = |why: String| {
        CliError::usage(
            format!("{} is not a report of `gaugeblock fuzz` (JSON): {why}", path.display()),
            "name the report.json of an earlier run, which `gaugeblock fuzz --report DIR` writes",
        )
    };
    let wrong = |error: serde_json::Error| refused(error.to_string());
    let mut document: serde_json::Value = serde_json::from_str(&text).map_err(wrong)?;
    match document.get_mut("divergences").map(serde_json::Value::take) {
        Some(divergences) => serde_json::from_value(divergences).map_err(wrong),
        None => Err(refused("it lists no divergences".to_owned())),
    }
}

/// A divergence with its smallest program, and in how many programs it was found.
pub(crate) fn describe(place: usize, finding: &Finding) -> String {
    let programs = if finding.count == 1 { "program" } else { "programs" };
    let Finding { signature, count, number, .. } = finding;
    format!(
        "{place}. {signature} ({count} {programs}, the smallest from {number})\n{}",
        body(finding)
    )
}

/// The rules of a divergence, its smallest program and what differs there.
pub(crate) fn body(finding: &Finding) -> String {
    let mut text = String::new();
    if !finding.rules.is_empty() && finding.rules.len() <= 8 {
        let _infallible = writeln!(text, "  rules: {}", finding.rules.join(", "));
    }
    match finding.causes.as_slice() {
        [] => {}
        [cause] => text.push_str(&format!("  looks like {cause}\n")),
        causes => text.push_str(&format!("  looks like one of: {}\n", causes.join(", "))),
    }
    let program = &finding.scenario.program;
    for (at, line) in program.language.lines(&program.main).enumerate() {
        let _infallible = writeln!(text, "  {:>4} | {line}", at + 1);
    }
    for (name, file) in &program.files {
        let _infallible = writeln!(text, "  {name}");
        for (at, line) in program.language.lines(file).enumerate() {
            let _infallible = writeln!(text, "  {:>4} | {line}", at + 1);
        }
    }
    for difference in unusual(finding).iter().chain(&finding.options) {
        let _infallible = writeln!(text, "  with {difference}");
    }
    let _infallible = writeln!(text, "  {}", finding.divergence);
    text
}

/// What of machine and environment is not the default.
fn unusual(finding: &Finding) -> Vec<String> {
    let plain = Scenario::default();
    let of = |scenario: &Scenario| {
        let mut shown = scenario.clone();
        shown.program = plain.program.clone();
        shown.options = plain.options.clone();
        shown.budget = plain.budget;
        let text = shown.to_text().unwrap_or_default();
        text.lines().map(str::to_owned).collect::<Vec<_>>()
    };
    let (usual, lines) = (of(&plain), of(&finding.scenario));
    let mut all: Vec<String> = lines
        .into_iter()
        .filter(|line| !usual.contains(line) && !line.is_empty() && !line.starts_with(']'))
        .collect();
    if finding.scenario.program.block_delete {
        all.push("block delete".to_owned());
    }
    all
}

fn list(text: &mut String, what: &str, counts: &Counts, most: usize) {
    let mut all: Vec<_> = counts.iter().collect();
    all.sort_by(|a, b| b.1.cmp(a.1).then_with(|| a.0.cmp(b.0)));
    if !all.is_empty() {
        let _infallible = writeln!(text, "{what}:");
    }
    for (name, count) in all.iter().take(most) {
        let _infallible = writeln!(text, "  {count:>8}  {name}");
    }
    if all.len() > most {
        let _infallible = writeln!(text, "            … {} more", all.len() - most);
    }
}

/// A count as a floating-point number.
fn as_float(count: u64) -> f64 {
    let thousands = f64::from(u32::try_from(count / 1000).unwrap_or(u32::MAX));
    thousands * 1000.0 + f64::from(u32::try_from(count % 1000).unwrap_or_default())
}

fn percent(part: u64, whole: u64) -> String {
    let tenths = part.saturating_mul(1000).checked_div(whole).unwrap_or_default();
    format!("{}.{} %", tenths / 10, tenths % 10)
}
