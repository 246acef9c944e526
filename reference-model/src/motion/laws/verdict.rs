//! What the laws say.

use crate::ids::{Rule, rule};
use std::fmt;

use gaugeblock_vocabulary::Axis;

macro_rules! laws {
    ($($(#[$about:meta])* $name:ident = $rule:path,)*) => {
        /// A law of motion.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
        pub enum Law {
            $($(#[$about])* $name,)*
        }

        impl Law {
            /// All of them, in the order in which they are judged.
            pub const ALL: &'static [Self] = &[$(Self::$name),*];

            /// The law's rule.
            pub fn rule(self) -> Rule {
                match self {
                    $(Self::$name => $rule,)*
                }
            }

            /// The id of the law's rule.
            pub fn id(self) -> &'static str {
                self.rule().id()
            }
        }
    };
}

laws! {
    /// No axis is faster than it can be.
    Velocity = rule::trajectory::VELOCITY,
    /// No axis accelerates more than it can.
    Acceleration = rule::trajectory::ACCELERATION,
    /// No axis changes its acceleration faster than it can.
    Jerk = rule::trajectory::JERK,
    /// The path is passed no faster than it is programmed and overridden.
    Feed = rule::trajectory::FEED,
    /// The commanded point is nowhere farther from the path than allowed.
    Deviation = rule::trajectory::DEVIATION,
    /// The commanded path passes no corner farther away than allowed.
    Vertex = rule::trajectory::VERTEX,
    /// Without a tolerance corners are rounded between the middles of their legs.
    Midpoints = rule::trajectory::MIDPOINTS,
    /// The motion rests at each corner that requires it.
    Stop = rule::trajectory::STOP,
    /// The motion starts and ends at the programmed points, at rest.
    Ends = rule::trajectory::ENDS,
    /// Each element is passed, in the order of the program.
    Order = rule::trajectory::ORDER,
    /// The path is not followed backwards without a command.
    Progress = rule::trajectory::PROGRESS,
    /// Outputs switch where the program says, in its order, and only those.
    Outputs = rule::trajectory::OUTPUTS,
    /// A dwell lasts as long as it says.
    Dwell = rule::trajectory::DWELL,
    /// A hold stops the motion on the path, and it stays at rest until it may go on.
    Hold = rule::trajectory::HOLD,
    /// An abort stops the motion for good.
    Abort = rule::trajectory::ABORT,
    /// At each instant what is queued suffices to stop.
    StoppingDistance = rule::trajectory::RESERVE,
}

impl fmt::Display for Law {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.id())
    }
}

/// A law that was broken.
#[derive(Clone, Debug, PartialEq)]
pub struct Violation {
    /// Which one.
    pub law: Law,
    /// The first sample at which it is broken, from 0.
    pub cycle: usize,
    /// At how many samples in a row it is broken.
    pub cycles: usize,
    /// The axis, where it is one.
    pub axis: Option<Axis>,
    /// What was measured where it is worst, in the unit that the words name.
    pub measured: f64,
    /// What is allowed.
    pub allowed: f64,
    /// What is wrong, for a person.
    pub words: String,
}

impl fmt::Display for Violation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} at cycle {}: {}", self.law, self.cycle, self.words)?;
        if self.cycles > 1 {
            write!(f, " ({} cycles)", self.cycles)?;
        }
        Ok(())
    }
}

/// What a law says of a record.
#[derive(Clone, Debug, PartialEq)]
pub enum Verdict {
    /// It holds; how much of what it allows was used at most, 1 for all of it, where that can be said.
    Satisfied {
        /// The largest share.
        share: Option<f64>,
    },
    /// The program requests nothing that the law applies to.
    NotApplicable,
    /// It does not hold.
    Violated(Vec<Violation>),
    /// It cannot be judged: why.
    NotJudged(String),
}

/// What all laws say of a record, in their order.
#[derive(Clone, Debug, PartialEq)]
pub struct Judgement(pub Vec<(Law, Verdict)>);

impl Judgement {
    /// What one law says.
    pub fn of(&self, law: Law) -> Option<&Verdict> {
        self.0.iter().find(|(known, _)| *known == law).map(|(_, verdict)| verdict)
    }

    /// Everything that is broken.
    pub fn violations(&self) -> impl Iterator<Item = &Violation> {
        self.0.iter().flat_map(|(_, verdict)| match verdict {
            Verdict::Violated(violations) => violations.as_slice(),
            Verdict::Satisfied { .. } | Verdict::NotApplicable | Verdict::NotJudged(_) => &[],
        })
    }
}

/// Digits of a number in a message.
const DIGITS: usize = 7;

/// A number as messages write it: rounded to so many digits.
pub(super) fn figure(number: f64) -> f64 {
    format!("{number:.*e}", DIGITS - 1).parse().unwrap_or(number)
}

/// Findings of one law as they are made, cycle by cycle; those at neighbouring cycles become one.
#[derive(Clone, Debug)]
pub(super) struct Findings {
    law: Law,
    share: Option<f64>,
    broken: Vec<Violation>,
    /// Why the law is not judged, unless it is broken.
    hidden: Option<String>,
}

impl Findings {
    pub(super) fn of(law: Law) -> Self {
        Self { law, share: None, broken: Vec::new(), hidden: None }
    }

    /// A measured value that must not be above another one. `words` says what it is.
    pub(super) fn at_most(
        &mut self,
        cycle: usize,
        axis: Option<Axis>,
        (measured, allowed): (f64, f64),
        (limit, words): (f64, &dyn Fn() -> String),
    ) {
        if limit > 0.0 {
            self.share = Some(self.share.unwrap_or(0.0).max(measured / limit));
        }
        if measured > allowed {
            self.breaks(cycle, axis, (measured, limit), words());
        }
    }

    /// Notes that the resolution of the samples is too coarse for a limit: the law can then be broken, but not
    /// satisfied.
    pub(super) fn hides(&mut self, hidden: f64, limit: f64, of: &dyn Fn() -> String) {
        if limit > 0.0 && hidden > limit && self.hidden.is_none() {
            self.hidden = Some(format!(
                "the resolution of the samples hides {hidden} {of}, more than the limit of {limit}",
                hidden = figure(hidden),
                of = of(),
                limit = figure(limit)
            ));
        }
    }

    /// The law is broken.
    pub(super) fn breaks(
        &mut self,
        cycle: usize,
        axis: Option<Axis>,
        (measured, allowed): (f64, f64),
        words: String,
    ) {
        let new = Violation { law: self.law, cycle, cycles: 1, axis, measured, allowed, words };
        let goes_on = |old: &&mut Violation| old.axis == axis && old.cycle + old.cycles == cycle;
        let Some(old) = self.broken.iter_mut().rev().take(9).find(goes_on) else {
            self.broken.push(new);
            return;
        };
        let (first, cycles) = (old.cycle, old.cycles + 1);
        if measured - allowed > old.measured - old.allowed {
            *old = new;
        }
        (old.cycle, old.cycles) = (first, cycles);
    }

    pub(super) fn verdict(self) -> Verdict {
        match self.hidden {
            _ if !self.broken.is_empty() => Verdict::Violated(self.broken),
            Some(why) => Verdict::NotJudged(why),
            None => Verdict::Satisfied { share: self.share },
        }
    }
}
