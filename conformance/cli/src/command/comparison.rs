//! What a run is compared with besides the documents: expectations, a baseline, waivers.

use std::path::{Path, PathBuf};

use clap::Args;
use gaugeblock_certificate::{AcceptanceList, ListKind, sha256};
use gaugeblock_report::Header;
use gaugeblock_report::merge::Stored;
use gaugeblock_runner::certify::{BASELINE, ListName, Run, Scope};
use gaugeblock_runner::expectations::{ExpectationMismatch, Expectations};
use gaugeblock_runner::waivers::{Day, Waivers};
use gaugeblock_suite::Suite;

use super::{stored_report, user_files};
use crate::error::CliError;

#[derive(Debug, Args)]
pub(crate) struct ComparisonArguments {
    /// File of known divergences; any other divergence fails
    #[arg(long, value_name = "FILE")]
    expectations: Option<PathBuf>,
    /// Earlier report of this controller and edition; only new or changed results fail, such as a case that passed then
    /// and is not judged now
    #[arg(long, value_name = "REPORT", conflicts_with = "expectations")]
    baseline: Option<PathBuf>,
    /// Time-limited waivers, a TOML file: rule, case, reason, owner, expires
    #[arg(long, value_name = "FILE")]
    waivers: Option<PathBuf>,
    /// Date on which waivers are checked for expiry [default: today]
    #[arg(long, value_name = "YYYY-MM-DD")]
    today: Option<Day>,
}

/// The files, read.
#[derive(Debug)]
pub(crate) struct ComparisonFiles {
    expectations: Option<Expectations>,
    baseline: Option<Stored>,
    waivers: Option<(Waivers, Day)>,
}

impl ComparisonArguments {
    /// The first of these options that is given.
    pub(crate) fn first_given(&self) -> Option<&'static str> {
        [
            ("--expectations", self.expectations.is_some()),
            ("--baseline", self.baseline.is_some()),
            ("--waivers", self.waivers.is_some()),
        ]
        .into_iter()
        .find_map(|(option, is_given)| is_given.then_some(option))
    }

    /// The files of these options, each with its kind.
    fn named(&self) -> Vec<(ListKind, &Path)> {
        let named = [
            (ListKind::Expectations, &self.expectations),
            (ListKind::Baseline, &self.baseline),
            (ListKind::Waivers, &self.waivers),
        ];
        named.into_iter().filter_map(|(kind, path)| Some((kind, path.as_deref()?))).collect()
    }

    /// The files of these options.
    pub(crate) fn files(&self) -> Vec<PathBuf> {
        self.named().into_iter().map(|(_, path)| stored_report::file(path)).collect()
    }

    /// The lists, as a certificate names them.
    pub(crate) fn lists(&self) -> Result<Vec<AcceptanceList>, CliError> {
        let list = |(kind, path): (ListKind, &Path)| {
            let path = stored_report::file(path);
            let bytes = user_files::read_bytes(&path, kind.word())?;
            let file = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
            Ok(AcceptanceList { kind, file, sha256: sha256(bytes) })
        };
        self.named().into_iter().map(list).collect()
    }

    /// Reads the files, before anything runs.
    pub(crate) fn read(&self) -> Result<ComparisonFiles, CliError> {
        let baseline = self.baseline.as_deref().map(stored_report::stored).transpose()?;
        let today = self.today.unwrap_or_else(today);
        let waivers = self.waivers.as_deref().map(read_waivers).transpose()?;
        let expectations = self.expectations.as_deref().map(|path| {
            let hint = "`gaugeblock certify --write-expectations FILE` writes such a file";
            read_expectations(path, "--expectations", hint)
        });
        Ok(ComparisonFiles {
            expectations: expectations.transpose()?,
            baseline: baseline.map(|(_, stored)| stored),
            waivers: waivers.map(|waivers| (waivers, today)),
        })
    }
}

impl ComparisonFiles {
    /// Refuses files of another controller, edition or scope, and waivers for unknown rules. Returns notes where the
    /// baseline belongs to another version or accuracy.
    pub(crate) fn check_header(
        &self,
        header: &Header,
        suite: &Suite,
    ) -> Result<Vec<String>, CliError> {
        let waivers = self.waivers.as_ref();
        if let Some(unknown) = waivers.and_then(|(waivers, _)| waivers.first_unknown(suite)) {
            return Err(CliError::usage(
                unknown,
                "`gaugeblock rules` lists the rules, and with --format json their cases",
            ));
        }
        if let Some(baseline) = &self.baseline {
            let hint = "choose the report.json of an earlier run of this controller and edition";
            return baseline.check_header(header).map_err(|why| CliError::usage(why, hint));
        }
        let Some(expectations) = &self.expectations else { return Ok(Vec::new()) };
        if header.scope != Scope::Full {
            return Err(CliError::usage(
                "--expectations do not apply to a run of --assertions-only: they list differences, too",
                "compare it with --baseline, a report of an earlier run with --assertions-only",
            ));
        }
        let Header { controller, version, edition, .. } = header;
        if expectations.controller != *controller || expectations.edition != *edition {
            return Err(CliError::usage(
                format!(
                    "the expectations are for {}/{}, this run is {controller}/{edition}",
                    expectations.controller, expectations.edition
                ),
                "choose the expectations of this controller and edition",
            ));
        }
        if expectations.version != *version {
            return Err(CliError::failure(
                format!(
                    "the expectations are for version {}, the controller has version {version}",
                    expectations.version
                ),
                "review the results of the new version, then write them with --write-expectations",
            ));
        }
        Ok(Vec::new())
    }

    /// What accepts that a case could not be judged, by the word of its verdict.
    fn accepts_unjudged(&self, rule: &str, case: &str, word: &str) -> Option<String> {
        let waivers = self.waivers.as_ref();
        let waived = waivers.and_then(|(all, today)| all.accepts_unjudged(rule, case, *today));
        let expectations = self.expectations.as_ref();
        let baseline = self.baseline.as_ref();
        waived
            .or_else(|| expectations?.accepts_unjudged(rule, case, word))
            .or_else(|| baseline?.accepts_unjudged(rule, case, word))
    }

    /// Mismatches with the expectations or the baseline, and a note for each divergence that is fixed. Marks known and
    /// waived divergences in the run. `whole` says that every case was selected.
    pub(crate) fn compare(
        &self,
        run: &mut Run<'_>,
        whole: bool,
    ) -> (Option<Vec<ExpectationMismatch>>, Vec<String>) {
        let (mut mismatches, mut notes) = (None, Vec::new());
        if let Some(expectations) = &self.expectations {
            mismatches = Some(expectations.compare(run, whole));
        }
        if let Some(baseline) = &self.baseline {
            let (new, fixed) = baseline.compare(run);
            (mismatches, notes) = (Some(new), fixed);
        }
        let mut waived = Vec::new();
        if let Some((waivers, today)) = &self.waivers {
            let (left, held) = waivers.apply(run, mismatches, *today);
            (mismatches, waived) = (Some(left), held);
        }
        let listed = |rule: &str, case: &str| match &self.expectations {
            Some(expectations) => expectations.source(rule, case),
            None => BASELINE.to_owned(),
        };
        let has_list = self.expectations.is_some() || self.baseline.is_some();
        let source: Option<ListName<'_>> = if has_list { Some(&listed) } else { None };
        run.mark_accepted(mismatches.as_deref().unwrap_or_default(), &waived, source);
        run.mark_unjudged(&|rule, case, word| self.accepts_unjudged(rule, case, word));
        (mismatches, notes)
    }
}

fn read_waivers(path: &Path) -> Result<Waivers, CliError> {
    let name = path.display();
    let hint = "[[waiver]] with rule, reason, owner, expires = \"2027-01-31\", and case for one of its cases";
    let text = user_files::read_text(path, "file of waivers (--waivers)")?;
    Waivers::read(&text)
        .map_err(|error| CliError::usage(format!("{name}: {}", error.trim_end()), hint))
}

#[expect(clippy::disallowed_methods, reason = "a waiver ends on a day of the calendar")]
pub(crate) fn today() -> Day {
    let since = std::time::SystemTime::now().duration_since(std::time::UNIX_EPOCH);
    Day::after_epoch(since.map_or(0, |since| since.as_secs() / 86_400))
}

/// The expectations in a file before it is overwritten; none if the file does not exist or is empty.
pub(crate) fn earlier_expectations(path: Option<&Path>) -> Result<Option<Expectations>, CliError> {
    let has_text =
        |path: &&Path| path.metadata().is_ok_and(|file| file.is_file() && file.len() > 0);
    let read = path.filter(has_text).map(|path| {
        let hint = "remove the file, or name another one with --write-expectations";
        read_expectations(path, "--write-expectations", hint)
    });
    read.transpose()
}

fn read_expectations(path: &Path, option: &str, hint: &str) -> Result<Expectations, CliError> {
    let text = user_files::read_text(path, &format!("file of expectations ({option})"))?;
    Expectations::read(&text)
        .map_err(|error| CliError::usage(format!("{}: {}", path.display(), error.trim_end()), hint))
}
