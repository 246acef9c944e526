//! A case of motion: samples that the laws judge, or a program whose plan they judge.

use std::collections::BTreeMap;
use std::str::FromStr;

use gaugeblock_vocabulary::Axis;
use gaugeblock_vocabulary::motion::{MotionEvent, MotionLimits, MotionScript};
use serde::{Deserialize, Serialize};

/// Limits of a case that names none: X, Y, Z with 250 mm/s and 2000 mm/s², a servo cycle of a millisecond.
const LIMITS: &str = "period = 0.001
[axes]
x = { velocity = 250, acceleration = 2000 }
y = { velocity = 250, acceleration = 2000 }
z = { velocity = 250, acceleration = 2000 }
";

/// A program, limits, a script, and samples or none.
///
/// With samples it is about a law: what the model's laws say of them. Without, it is about a controller: its own
/// samples are judged.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MotionCase {
    /// Its name within the rule.
    pub name: String,
    /// Why it is there, where the name does not say it.
    #[serde(default)]
    pub why: String,
    /// The case above it from which missing members are taken, except its defect.
    #[serde(default)]
    pub like: Option<String>,
    /// The program.
    #[serde(default)]
    pub program: String,
    /// What the axes can do.
    #[serde(default)]
    pub limits: Option<MotionLimits>,
    /// What a person and the inputs do.
    #[serde(default)]
    pub script: Vec<MotionEvent>,
    /// What the axes do, from rest at the machine's origin.
    #[serde(default)]
    pub pieces: Vec<Piece>,
    /// Further columns: the values that each takes, and from which sample on.
    #[serde(default)]
    pub columns: BTreeMap<String, Vec<(usize, f64)>>,
    /// Servo cycles from one sample to the next; 1 where nothing is said.
    #[serde(default)]
    pub every: Option<f64>,
    /// How far a recorded position may be from the commanded one, millimetres and degrees.
    #[serde(default)]
    pub resolution: f64,
    /// What is done to the samples after they are made.
    #[serde(default)]
    pub fault: Option<SampleDefect>,
    /// What the laws decide, written by hand. Cases of choices have it in their options.
    #[serde(default, rename = "assert")]
    pub assertions: Vec<String>,
}

/// A stretch of constant acceleration.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Piece {
    /// How long it lasts, servo cycles; not always a whole number of them.
    pub cycles: f64,
    /// Accelerations by axis, millimetres or degrees per second squared; zero for those that are not listed.
    #[serde(default)]
    pub accelerate: BTreeMap<Axis, f64>,
    /// Speeds by axis at which it begins, where they are not those at which the stretch before it ended; those of axes
    /// that are not listed are zero.
    #[serde(default)]
    pub speed: Option<BTreeMap<Axis, f64>>,
}

/// Something that is wrong with samples that were right.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum SampleDefect {
    /// Some samples are elsewhere.
    Displaced {
        /// The first of them.
        from: usize,
        /// How many.
        #[serde(default = "one")]
        samples: usize,
        /// By how much, millimetres or degrees.
        by: BTreeMap<Axis, f64>,
    },
    /// A column has its values later, or earlier if this is below zero.
    Late {
        /// Its name.
        column: String,
        /// By how many samples.
        samples: isize,
    },
    /// Some samples are missing.
    LeftOut {
        /// The first of them.
        from: usize,
        /// How many.
        #[serde(default = "one")]
        samples: usize,
    },
    /// A sample occurs more than once.
    Repeated {
        /// Which.
        from: usize,
        /// How many times more.
        #[serde(default = "one")]
        samples: usize,
    },
    /// Some samples are in the opposite order.
    Reversed {
        /// The first of them.
        from: usize,
        /// How many.
        samples: usize,
    },
    /// A column has another value for a while.
    Value {
        /// Its name.
        column: String,
        /// From which sample on.
        from: usize,
        /// In how many.
        #[serde(default = "one")]
        samples: usize,
        /// The value.
        value: f64,
    },
}

fn one() -> usize {
    1
}

/// What a case says of the laws.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum MotionAssertion {
    /// No law is broken, and the one whose page it is holds.
    Holds,
    /// A law is broken, first at a sample where one is named.
    Breaks {
        /// Its id.
        law: String,
        /// The first sample at which it is broken.
        at: Option<usize>,
    },
    /// The program contains nothing that the law applies to.
    NotApplicable {
        /// Its id.
        law: String,
    },
    /// A law cannot be judged.
    NotJudged {
        /// Its id.
        law: String,
    },
}

impl FromStr for MotionAssertion {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        if text == "holds" {
            return Ok(Self::Holds);
        }
        let (law, rest) = text.split_once(' ').unwrap_or((text, ""));
        let law = law.to_owned();
        match rest {
            "breaks" => Ok(Self::Breaks { law, at: None }),
            "is not applicable" => Ok(Self::NotApplicable { law }),
            "is not judged" => Ok(Self::NotJudged { law }),
            _ => match rest.strip_prefix("breaks at ").and_then(|at| at.parse().ok()) {
                Some(at) => Ok(Self::Breaks { law, at: Some(at) }),
                None => Err(format!(
                    "invalid `{text}`: expected holds, LAW breaks, LAW breaks at N, LAW is not applicable, or LAW is not judged"
                )),
            },
        }
    }
}

impl MotionCase {
    /// Whether it has samples, so that it is about a law and not about a controller.
    pub fn is_recorded(&self) -> bool {
        !self.pieces.is_empty()
    }

    /// What it says, which was checked when the page was read.
    pub fn parsed(&self) -> Vec<MotionAssertion> {
        self.assertions.iter().filter_map(|text| text.parse().ok()).collect()
    }

    /// What its axes can do.
    ///
    /// # Errors
    /// Never for the limits that are built in.
    pub fn limits(&self) -> Result<MotionLimits, String> {
        match &self.limits {
            Some(limits) => Ok(limits.clone()),
            None => MotionLimits::from_text(LIMITS).map_err(|error| error.message),
        }
    }

    /// What a person and the inputs do.
    pub fn script(&self) -> MotionScript {
        MotionScript { events: self.script.clone() }
    }

    /// Takes over from another case what this one does not say.
    fn inherit(&mut self, other: &Self) {
        fn take<T: Clone>(mine: &mut T, theirs: &T, is_missing: bool) {
            if is_missing {
                mine.clone_from(theirs);
            }
        }
        let (program, script) = (self.program.is_empty(), self.script.is_empty());
        let (pieces, columns) = (self.pieces.is_empty(), self.columns.is_empty());
        let (limits, every) = (self.limits.is_none(), self.every.is_none());
        take(&mut self.program, &other.program, program);
        take(&mut self.script, &other.script, script);
        take(&mut self.pieces, &other.pieces, pieces);
        take(&mut self.columns, &other.columns, columns);
        take(&mut self.limits, &other.limits, limits);
        take(&mut self.every, &other.every, every);
    }

    fn check(&self) -> Result<(), String> {
        check_assertions(&self.assertions)?;
        self.check_form()
    }

    /// Checks the form, except the assertions.
    pub(super) fn check_form(&self) -> Result<(), String> {
        if self.program.is_empty() {
            return Err("it has no program".to_owned());
        }
        if !self.is_recorded() && (self.fault.is_some() || !self.columns.is_empty()) {
            return Err("it has no samples that could have a fault or columns".to_owned());
        }
        let ordered = self.script.windows(2).all(|pair| pair[0].cycle <= pair[1].cycle);
        if !ordered {
            return Err("its script is not in the order of cycles".to_owned());
        }
        Ok(())
    }
}

/// Whether each of the sayings is one, and there is any.
pub(super) fn check_assertions(says: &[String]) -> Result<(), String> {
    if says.is_empty() {
        return Err("it says nothing".to_owned());
    }
    says.iter().try_for_each(|text| text.parse::<MotionAssertion>().map(|_| ()))
}

/// Completes the cases of a page by those that they are like, and checks them.
///
/// # Errors
/// The first case that is not in the form, by its name.
pub(super) fn complete(cases: &mut [MotionCase]) -> Result<(), String> {
    for place in 0..cases.len() {
        let (above, rest) = cases.split_at_mut(place);
        let Some(case) = rest.first_mut() else { break };
        if let Some(name) = &case.like {
            let Some(model) = above.iter().find(|other| other.name == *name) else {
                return Err(format!("case `{}`: there is no `{name}` above it", case.name));
            };
            case.inherit(model);
        }
        case.check().map_err(|error| format!("case `{}`: {error}", case.name))?;
    }
    Ok(())
}
