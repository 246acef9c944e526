//! What a run is held against beside the documents: what is known of the controller, and what somebody answers for.

use std::path::{Path, PathBuf};

use clap::Args;
use gaugeblock_suite::Suite;

use super::{Refused, report};
use crate::certify::{BASELINE, EXPECTATIONS, Run};
use crate::expectations::{Expectations, Trouble};
use crate::report::Header;
use crate::report::merge::Stored;
use crate::waivers::{Day, Waivers};

#[derive(Debug, Args)]
pub(super) struct Against {
    /// What the controller is known to do otherwise; anything else fails
    #[arg(long, value_name = "FILE")]
    expectations: Option<PathBuf>,
    /// An earlier report of this controller and edition, in any version: only what is new or has changed since fails,
    /// such as a case that passed and is not judged now
    #[arg(long, value_name = "REPORT", conflicts_with = "expectations")]
    baseline: Option<PathBuf>,
    /// Divergences that somebody answers for until a day: rule, case, reason, owner, expires (TOML)
    #[arg(long, value_name = "FILE")]
    waivers: Option<PathBuf>,
    /// The day on which waivers are held to be [default: today]
    #[arg(long, value_name = "YYYY-MM-DD")]
    today: Option<Day>,
}

/// The files, read.
#[derive(Debug)]
pub(super) struct Known {
    expectations: Option<Expectations>,
    baseline: Option<Stored>,
    waivers: Option<(Waivers, Day)>,
}

impl Against {
    /// Reads the files, before anything runs.
    pub(super) fn read(&self) -> Result<Known, Refused> {
        let baseline = self.baseline.as_deref().map(report::stored).transpose()?;
        let today = self.today.unwrap_or_else(today);
        let waivers = self.waivers.as_deref().map(read_waivers).transpose()?;
        Ok(Known {
            expectations: self.expectations.as_deref().map(read).transpose()?,
            baseline: baseline.map(|(_, stored)| stored),
            waivers: waivers.map(|waivers| (waivers, today)),
        })
    }
}

impl Known {
    /// Refuses what is of another controller, and a waiver of what the suite does not have. A note where a baseline
    /// is of another version.
    pub(super) fn fits(&self, header: &Header, suite: &Suite) -> Result<Option<String>, Refused> {
        let waivers = self.waivers.as_ref();
        if let Some(unknown) = waivers.and_then(|(waivers, _)| waivers.unknown(suite)) {
            return Err(Refused::wrong(
                unknown,
                "`gaugeblock rules` lists the rules' ids, and with --format json their cases",
            ));
        }
        if let Some(baseline) = &self.baseline {
            let hint = "name the report.json of this controller, held to this edition";
            return baseline.fits(header).map_err(|why| Refused::wrong(why, hint));
        }
        let Some(expectations) = &self.expectations else { return Ok(None) };
        let Header { controller, version, edition, .. } = header;
        if expectations.controller != *controller || expectations.edition != *edition {
            return Err(Refused::wrong(
                format!(
                    "these expectations are of {} held to {}, not of {controller} held to {edition}",
                    expectations.controller, expectations.edition
                ),
                "name the expectations of this controller and edition",
            ));
        }
        if expectations.version != *version {
            return Err(Refused::unfinished(
                format!(
                    "these expectations are of version {}, the controller is of {version}",
                    expectations.version
                ),
                "look at what the new version does, then --write-expectations",
            ));
        }
        Ok(None)
    }

    /// Where a run disagrees with what is known of it, and a note for each divergence that is mended. In the run what
    /// is known or waived is named so. `whole` says that every case was selected.
    pub(super) fn hold(
        &self,
        run: &mut Run<'_>,
        whole: bool,
    ) -> (Option<Vec<Trouble>>, Vec<String>) {
        let (mut troubles, mut notes, mut who) = (None, Vec::new(), None);
        if let Some(expectations) = &self.expectations {
            (troubles, who) = (Some(expectations.hold(run, whole)), Some(EXPECTATIONS));
        }
        if let Some(baseline) = &self.baseline {
            let (new, mended) = baseline.hold(run);
            (troubles, who) = (Some(new), Some(BASELINE));
            notes = mended;
        }
        let mut waived = Vec::new();
        if let Some((waivers, today)) = &self.waivers {
            let (left, held) = waivers.hold(run, troubles, *today);
            (troubles, waived) = (Some(left), held);
        }
        run.excuse(troubles.as_deref().unwrap_or_default(), &waived, who);
        (troubles, notes)
    }
}

fn read_waivers(path: &Path) -> Result<Waivers, Refused> {
    let name = path.display();
    let hint = "[[waiver]] with rule, reason, owner, expires = \"2027-01-31\", and case for one of its cases";
    let text = std::fs::read_to_string(path)
        .map_err(|error| Refused::wrong(format!("{name}: {error}"), hint))?;
    Waivers::read(&text)
        .map_err(|error| Refused::wrong(format!("{name}: {}", error.trim_end()), hint))
}

#[expect(clippy::disallowed_methods, reason = "a waiver ends on a day of the calendar")]
fn today() -> Day {
    let since = std::time::SystemTime::now().duration_since(std::time::UNIX_EPOCH);
    Day::after_epoch(since.map_or(0, |since| since.as_secs() / 86_400))
}

fn read(path: &Path) -> Result<Expectations, Refused> {
    let name = path.display();
    let text = std::fs::read_to_string(path).map_err(|error| {
        Refused::wrong(format!("{name}: {error}"), "--write-expectations makes such a file")
    })?;
    Expectations::read(&text).map_err(|error| {
        Refused::wrong(
            format!("{name}: {}", error.trim_end()),
            "--write-expectations makes such a file",
        )
    })
}
