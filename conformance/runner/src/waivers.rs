//! Waivers: divergences that an owner accepts until a day.

use std::fmt;
use std::str::FromStr;

use gaugeblock_suite::Suite;
use serde::{Deserialize, Serialize};

use crate::certify::Run;
use crate::expectations::ExpectationMismatch;

/// A calendar day.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub struct Day {
    year: u32,
    month: u32,
    day: u32,
}

impl Day {
    /// The day that many days after 1970-01-01.
    pub fn after_epoch(days: u64) -> Self {
        // Years begin in March here, in cycles of 400 years, which all have the same length.
        let days = days + 719_468;
        let (round, of_round) = (days / 146_097, days % 146_097);
        let year = (of_round - of_round / 1460 + of_round / 36_524 - of_round / 146_096) / 365;
        let of_year = of_round - (365 * year + year / 4 - year / 100);
        let from_march = (5 * of_year + 2) / 153;
        let day = of_year - (153 * from_march + 2) / 5 + 1;
        let month = if from_march < 10 { from_march + 3 } else { from_march - 9 };
        let year = year + 400 * round + u64::from(month <= 2);
        let small = |number: u64| u32::try_from(number).unwrap_or(u32::MAX);
        Self { year: small(year), month: small(month), day: small(day) }
    }
}

/// How many days a month has, from 1.
fn days_of(year: u32, month: u32) -> u32 {
    let is_leap = year.is_multiple_of(4) && !year.is_multiple_of(100) || year.is_multiple_of(400);
    match month {
        2 => 28 + u32::from(is_leap),
        4 | 6 | 9 | 11 => 30,
        _ => 31,
    }
}

impl fmt::Display for Day {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:04}-{:02}-{:02}", self.year, self.month, self.day)
    }
}

impl FromStr for Day {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let wrong = || format!("`{text}` is not a day; expected one such as 2027-01-31");
        let parts: Vec<u32> = text.split('-').filter_map(|part| part.parse().ok()).collect();
        let [year, month, day] = parts[..] else { return Err(wrong()) };
        let read = Self { year, month, day };
        let exists = (1..=12).contains(&month) && (1..=days_of(year, month)).contains(&day);
        if exists && read.to_string() == text { Ok(read) } else { Err(wrong()) }
    }
}

impl TryFrom<String> for Day {
    type Error = String;

    fn try_from(text: String) -> Result<Self, String> {
        text.parse()
    }
}

impl From<Day> for String {
    fn from(day: Day) -> Self {
        day.to_string()
    }
}

/// A divergence that an owner accepts.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Waiver {
    /// The rule.
    pub rule: String,
    /// Its case; without one, every case of the rule.
    pub case: Option<String>,
    /// Why it is accepted.
    pub reason: String,
    /// Its owner.
    pub owner: String,
    /// The last day on which it is valid.
    pub expires: Day,
}

impl Waiver {
    fn covers(&self, rule: &str, case: &str) -> bool {
        self.rule == rule && self.case.as_deref().is_none_or(|own| own == case)
    }
}

/// A case whose divergence is waived.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Waived {
    /// The rule.
    pub rule: String,
    /// Its case.
    pub case: String,
    /// Owner, last day and reason.
    pub why: String,
}

impl Waived {
    /// Its rule and case.
    pub fn place(&self) -> (&str, &str) {
        (&self.rule, &self.case)
    }
}

/// A file of waivers.
#[derive(Clone, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Waivers {
    /// Each of them.
    #[serde(default)]
    pub waiver: Vec<Waiver>,
}

impl Waivers {
    /// Reads a file of waivers.
    ///
    /// # Errors
    /// It is not in the form, with line and column; or a waiver has no reason or no owner.
    pub fn read(text: &str) -> Result<Self, String> {
        let read: Self = toml::from_str(text).map_err(|error| error.to_string())?;
        let is_said = |text: &str| !text.trim().is_empty();
        match read.waiver.iter().find(|waiver| !is_said(&waiver.reason) || !is_said(&waiver.owner))
        {
            Some(waiver) => {
                Err(format!("the waiver of {} says no reason, or no owner", waiver.rule))
            }
            None => Ok(read),
        }
    }

    /// A message about the first waiver of a rule or case that the suite does not have.
    pub fn first_unknown(&self, suite: &Suite) -> Option<String> {
        self.waiver.iter().find_map(|waiver| {
            let Waiver { rule, case, owner, .. } = waiver;
            let Some(known) = suite.rule(rule) else {
                return Some(format!("a waiver of {owner} names {rule}: there is no such rule"));
            };
            let case = case.as_deref()?;
            let has = known.case_names().any(|name| name == case);
            let names =
                || format!("a waiver of {owner} names {rule} / {case}: the rule has no such case");
            (!has).then(names)
        })
    }

    /// What accepts that a case could not be judged: a waiver that is valid.
    pub fn accepts_unjudged(&self, rule: &str, case: &str, today: Day) -> Option<String> {
        let valid = |waiver: &&Waiver| waiver.covers(rule, case) && waiver.expires >= today;
        let Waiver { owner, expires, reason, .. } = self.waiver.iter().find(valid)?;
        Some(format!("waived by {owner} until {expires}: {reason}"))
    }

    /// Splits mismatches into those that no valid waiver covers and those that are waived. `mismatches` defaults to all
    /// divergences of the run. A waiver of a case that could not be judged counts as used. Waivers of rules and cases
    /// that were not selected are ignored.
    pub fn apply(
        &self,
        run: &Run<'_>,
        mismatches: Option<Vec<ExpectationMismatch>>,
        today: Day,
    ) -> (Vec<ExpectationMismatch>, Vec<Waived>) {
        let mismatches = mismatches.unwrap_or_else(|| divergences(run));
        let diverges = |rule: &str, case: &str| {
            let mut of_place = run.cases.iter().filter(|it| it.rule.id == rule && it.name == case);
            of_place.any(|result| result.verdict.divergence().is_some())
        };
        let (mut left, mut held) = (Vec::new(), Vec::new());
        let unjudged = |waiver: &Waiver| {
            let mut open = run.cases.iter().filter(|it| it.verdict.undetermined_reason().is_some());
            open.any(|result| waiver.covers(&result.rule.id, result.name))
        };
        let mut used: Vec<bool> = self.waiver.iter().map(unjudged).collect();
        for mismatch in mismatches {
            let (rule, case) = mismatch.place();
            let mut all = self.waiver.iter().zip(&mut used);
            let waived = all.find(|(waiver, _)| waiver.covers(rule, case));
            match waived {
                Some((waiver, used)) if diverges(rule, case) => {
                    *used = true;
                    let Waiver { owner, reason, expires, .. } = waiver;
                    let (rule, case) = (rule.to_owned(), case.to_owned());
                    if *expires < today {
                        let why =
                            format!("waived by {owner} until {expires}, which is over: {reason}");
                        left.push(ExpectationMismatch::Stale { rule, case, why });
                    } else {
                        let why = format!("by {owner} until {expires}: {reason}");
                        held.push(Waived { rule, case, why });
                    }
                }
                _ => left.push(mismatch),
            }
        }
        let was_asked = |waiver: &Waiver| {
            run.cases.iter().any(|result| waiver.covers(&result.rule.id, result.name))
                || run.not_applicable.iter().any(|(rule, _)| rule.id == waiver.rule)
        };
        let unused = self.waiver.iter().zip(used).filter(|(_, used)| !used);
        for (waiver, _) in unused.filter(|(waiver, _)| was_asked(waiver)) {
            let case = waiver.case.clone().unwrap_or_else(|| "every case".to_owned());
            let why = format!("waived by {}, and there is nothing to waive", waiver.owner);
            left.push(ExpectationMismatch::Stale { rule: waiver.rule.clone(), case, why });
        }
        (left, held)
    }
}

/// Every divergence of a run as an unlisted one.
fn divergences(run: &Run<'_>) -> Vec<ExpectationMismatch> {
    let divergences = run.cases.iter().filter_map(|result| {
        Some(ExpectationMismatch::New {
            rule: result.rule.id.clone(),
            case: result.name.to_owned(),
            found: result.verdict.divergence()?.summary(),
        })
    });
    divergences.collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn days_are_those_of_the_calendar() {
        for (days, expected) in [
            (0, "1970-01-01"),
            (58, "1970-02-28"),
            (59, "1970-03-01"),
            (11_016, "2000-02-29"),
            (11_017, "2000-03-01"),
            (20_780, "2026-11-23"),
            (47_540, "2100-02-28"),
            (47_541, "2100-03-01"),
        ] {
            assert_eq!(Day::after_epoch(days).to_string(), expected);
        }
        assert_eq!("2026-11-23".parse::<Day>().unwrap(), Day::after_epoch(20_780));
        for day in ["2024-02-29", "2000-02-29", "2026-12-31", "2026-04-30"] {
            assert_eq!(day.parse::<Day>().unwrap().to_string(), day);
        }
        let odd = ["2026-13-01", "2026-1-1", "tomorrow", "2026-11", "2026-11-32", "-2026-11-01"];
        let absent =
            ["2026-02-30", "2027-02-31", "2026-02-29", "2100-02-29", "2026-04-31", "2026-11-00"];
        for wrong in odd.into_iter().chain(absent) {
            assert!(wrong.parse::<Day>().is_err(), "{wrong}");
        }
    }
}
