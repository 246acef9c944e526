//! What the laws and the bound say of a motion, for a person.

use std::fmt;

use gaugeblock_reference::Choices;
use gaugeblock_reference::motion::bound::{Kind, least_time};
use gaugeblock_reference::motion::laws::{Judgement, Verdict, judge_recording};
use gaugeblock_reference::motion::recording::{Recording, RecordingError};
use gaugeblock_vocabulary::motion::{
    MotionAction, MotionLimits, MotionScript, PathElement, ProgrammedPath, Shape,
};

/// The share of the least time, less some periods, that lawful samples take at least.
const UNCERTAIN_SHARE: f64 = 0.99;
const UNCERTAIN_PERIODS: f64 = 4.0;

/// Most violations that are shown.
const SHOWN: usize = 12;

/// A motion, held to the laws and to the least time.
#[derive(Clone, Debug)]
pub struct Summary {
    /// Seconds from the first to the last moving sample, and those of dwells before and after.
    pub time: f64,
    /// No motion that keeps its limits at every instant takes less; or why that is not known.
    pub least: Result<f64, String>,
    /// Seconds by which lawful samples may be below the least time: they have one position per period.
    pub uncertainty: f64,
    /// Which bounds it rests on, in words.
    pub kinds: Vec<&'static str>,
    /// Whether the script aborts the run.
    pub aborted: bool,
    /// What each law says.
    pub judgement: Judgement,
}

impl Summary {
    /// Checks samples against a path under limits.
    ///
    /// # Errors
    /// The store of the recording cannot be read or written.
    pub fn of(
        recording: &Recording,
        path: &ProgrammedPath,
        limits: &MotionLimits,
        script: &MotionScript,
    ) -> Result<Self, RecordingError> {
        let judgement = judge_recording(Choices::default(), recording, path, limits, script)?;
        let bound = least_time(path, limits, fastest(script));
        let mut kinds = Vec::new();
        for stretch in bound.iter().flat_map(|bound| &bound.stretches) {
            let kind = in_words(stretch.kind);
            if !kinds.contains(&kind) {
                kinds.push(kind);
            }
        }
        Ok(Self {
            time: moving_time(recording) + dwells_at_ends(path),
            uncertainty: UNCERTAIN_PERIODS * recording.period(),
            least: bound.map(|bound| bound.least),
            kinds,
            aborted: script.events.iter().any(|event| event.action == MotionAction::Abort),
            judgement,
        })
    }

    /// Whether anything moves: laws of samples hold where nothing does, and that is worth nothing.
    pub fn moves(&self) -> bool {
        self.time > 0.0
    }

    /// Whether every law holds that can be judged.
    pub fn holds(&self) -> bool {
        self.judgement.violations().next().is_none()
    }

    /// Whether the time is below that of every motion along the path, even of one that keeps its limits in samples
    /// alone. Then the samples are of another motion. An aborted motion does not reach the end of the path.
    pub fn is_impossible(&self) -> bool {
        let Ok(least) = &self.least else { return false };
        !self.aborted && self.time < least * UNCERTAIN_SHARE - self.uncertainty
    }

    /// The time, and how it compares, in a line.
    pub fn headline(&self) -> String {
        match &self.least {
            _ if !self.moves() => "0.000 s: nothing moves".to_owned(),
            // Laws of samples leave room for what no motion could do that kept its limits at every instant.
            Ok(least) if self.time < least * (1.0 - 1e-6) => format!(
                "{:.3} s; {least:.3} s at best ({}) if limits are kept at every instant, and not in the samples alone",
                self.time,
                self.kinds.join(", ")
            ),
            Ok(least) if *least > 0.0 => format!(
                "{:.3} s; at best {least:.3} s ({}), {:.4} times of that",
                self.time,
                self.kinds.join(", "),
                self.time / least
            ),
            Ok(_) => format!("{:.3} s", self.time),
            Err(why) => format!("{:.3} s; how fast it could be is not known: {why}", self.time),
        }
    }
}

impl fmt::Display for Summary {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "{}", self.headline())?;
        for (law, verdict) in &self.judgement.0 {
            match verdict {
                Verdict::Satisfied { .. } if !self.moves() => writeln!(f, "  n/a         {law}")?,
                Verdict::Satisfied { share: Some(share) } => {
                    writeln!(f, "  holds       {law} (at most {:.2} % of it)", share * 100.0)?;
                }
                Verdict::Satisfied { share: None } => writeln!(f, "  holds       {law}")?,
                Verdict::NotApplicable => writeln!(f, "  n/a         {law}")?,
                Verdict::NotJudged(why) => writeln!(f, "  not judged  {law}: {why}")?,
                Verdict::Violated(violations) => {
                    let times = if violations.len() == 1 { "time" } else { "times" };
                    writeln!(f, "  broken      {law}, {} {times}", violations.len())?;
                }
            }
        }
        if self.is_impossible() {
            writeln!(f, "  not judged  the whole: no motion along this path is so fast")?;
        }
        let mut violations = self.judgement.violations();
        for violation in violations.by_ref().take(SHOWN) {
            writeln!(f, "{violation}")?;
        }
        match violations.count() {
            0 => Ok(()),
            more => writeln!(f, "… {more} more"),
        }
    }
}

/// How many times the programmed feed an operator and a controller outside may ask for at most.
fn fastest(script: &MotionScript) -> f64 {
    let highest = |of: fn(&MotionAction) -> Option<f64>| {
        script.events.iter().filter_map(|event| of(&event.action)).fold(1.0, f64::max)
    };
    let by_hand =
        highest(
            |action| {
                if let MotionAction::FeedOverride(factor) = action { Some(*factor) } else { None }
            },
        );
    let adaptive = highest(|action| {
        if let MotionAction::AdaptiveFeed(factor) = action { Some(factor.abs()) } else { None }
    });
    by_hand * adaptive
}

fn in_words(kind: Kind) -> &'static str {
    match kind {
        Kind::ExactStop => "closed form of straight ways",
        Kind::Reachability => "reachability along the curve",
        Kind::Axis => "one axis alone",
        Kind::Length => "the shortest way at the highest feed",
    }
}

/// Seconds of the dwells before the first and after the last motion. The samples of a recording need not have them.
fn dwells_at_ends(path: &ProgrammedPath) -> f64 {
    let mut at = path.start;
    let moves = |element: &PathElement| {
        let is_curved = matches!(element.shape, Shape::Arc { .. } | Shape::Curve { .. });
        let before = at;
        at = element.end().unwrap_or(at);
        is_curved || at != before
    };
    let moving: Vec<bool> = path.elements.iter().map(moves).collect();
    let first = moving.iter().position(|moves| *moves);
    let last = moving.iter().rposition(|moves| *moves);
    let elements = path.elements.iter().enumerate();
    let at_ends = elements.filter(|(at, _)| {
        first.is_none_or(|first| *at < first) || last.is_some_and(|last| *at > last)
    });
    let dwell = |element: &PathElement| {
        if let Shape::Dwell { seconds } = element.shape { seconds } else { 0.0 }
    };
    at_ends.map(|(_, element)| dwell(element)).sum()
}

/// Seconds from where the position first changes to where it last does.
fn moving_time(recording: &Recording) -> f64 {
    let cycles = recording.moving().map_or(0, |(first, last)| last + 1 - first);
    let cycles = u32::try_from(cycles).unwrap_or(u32::MAX);
    f64::from(cycles) * recording.period()
}
