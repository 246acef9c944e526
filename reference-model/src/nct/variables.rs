//! Variables: local ones by level, common ones, and what holds nothing.

use gaugeblock_vocabulary::FaultKind;

use super::refusal::{StepError, refuse};
use crate::ids::rule;

/// A value, or none: vacant.
pub type VariableValue = Option<f64>;
/// Local variables of a level: #1 first.
pub type Locals = [VariableValue; 33];

/// The first numbers of the two ranges of common variables, and how many each has.
const COMMON: [(u32, u32); 2] = [(100, 100), (500, 100)];
/// How many common variables there are.
pub const COMMON_COUNT: usize = 200;
/// The greatest number of a common variable.
const LAST_COMMON: i64 = 599;

/// All variables.
#[derive(Clone, Debug)]
pub struct Variables {
    /// The local variables of each level in progress, that of the main program first.
    pub levels: Vec<Locals>,
    /// The common variables, in the order of their numbers.
    pub common: [VariableValue; COMMON_COUNT],
}

/// Where a variable is.
enum Place {
    /// #0.
    Vacant,
    /// A local variable of the level in progress, from 0 for #1.
    Local(usize),
    /// A common variable.
    Common(usize),
}

impl Variables {
    /// All of them vacant, at level 0.
    pub fn new() -> Self {
        Self { levels: vec![[None; 33]], common: [None; COMMON_COUNT] }
    }

    /// The macro level.
    pub fn level(&self) -> usize {
        self.levels.len() - 1
    }

    /// The local variables of the level in progress.
    pub(super) fn locals(&mut self) -> &mut Locals {
        self.levels.last_mut().expect("variables: the main program's level stays")
    }

    /// What a variable holds.
    ///
    /// # Errors
    /// There is no variable of this number.
    pub(super) fn get(&mut self, number: i64) -> Result<VariableValue, StepError> {
        Ok(match place(number)? {
            Place::Vacant => None,
            Place::Local(place) => self.locals()[place],
            Place::Common(place) => self.common[place],
        })
    }

    /// Gives a variable a value, or none. Zero has no sign.
    ///
    /// Rule nct.vacant. #0 holds nothing, whatever is done.
    ///
    /// # Errors
    /// There is no variable of this number, or it is #0.
    pub(super) fn set(&mut self, number: i64, value: VariableValue) -> Result<(), StepError> {
        let value = value.map(|value| value + 0.0);
        match place(number)? {
            Place::Vacant => {
                let message = "#0 takes no value";
                return Err(refuse(rule::nct::VACANT, FaultKind::ReadOnlyParameter, message));
            }
            Place::Local(place) => self.locals()[place] = value,
            Place::Common(place) => self.common[place] = value,
        }
        Ok(())
    }

    /// The number of a common variable by its place.
    pub fn common_number(place: usize) -> u32 {
        let place = u32::try_from(place).unwrap_or_default();
        let [(first, count), (second, _)] = COMMON;
        if place < count { first + place } else { second + place - count }
    }
}

impl Default for Variables {
    fn default() -> Self {
        Self::new()
    }
}

/// Rule nct.variable-numbers. There are #1 to #33, #100 to #199 and #500 to #599; #0 holds nothing. System variables
/// have other numbers, which the documents do not list (page 174): a greater number is not supported.
fn place(number: i64) -> Result<Place, StepError> {
    let known = u32::try_from(number).ok().and_then(|number| match number {
        0 => Some(Place::Vacant),
        1..=33 => Some(Place::Local(number as usize - 1)),
        _ => {
            let mut before = 0;
            COMMON.iter().find_map(|(first, count)| {
                let place = number.checked_sub(*first).filter(|place| place < count);
                let place = place.map(|place| Place::Common((before + place) as usize));
                before += count;
                place
            })
        }
    });
    if known.is_none() && number > LAST_COMMON {
        return Err(StepError::Unsupported(format!("the system variable #{number}")));
    }
    let message = format!("there is no variable #{number}");
    let rule = rule::nct::VARIABLE_NUMBERS;
    known.ok_or_else(|| refuse(rule, FaultKind::ParameterOutOfRange, message))
}
