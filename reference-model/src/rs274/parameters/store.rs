//! Global parameters as they are stored.

use std::collections::{BTreeMap, BTreeSet};
use std::ops::RangeInclusive;

use gaugeblock_vocabulary::{Indexed, Machine, Shared};

use super::name::Name;
use crate::Choices;
use crate::rs274::modes::start_system;

/// While this parameter is 0 the DEBUG comments say nothing.
pub const DEBUG_SWITCH: u32 = 5599;

/// The number of the active coordinate system, 1 to 9.
const ACTIVE_SYSTEM: u32 = 5220;

/// The parameters that are kept while the machine is off.
pub(super) const PERSISTENT: RangeInclusive<u32> = 5161..=5390;

/// Global parameters. The local ones are in the frames.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Parameters {
    /// Numbers 31 and up that were stored or set; coordinate systems in the machine's length unit.
    pub(super) numbered: Shared<BTreeMap<u32, f64>>,
    /// Global named parameters that the program has set.
    pub(super) named: Shared<BTreeMap<String, f64>>,
    /// Names that were local parameters somewhere: they separate a deleted parameter from one that never existed.
    pub(super) local_names: Shared<BTreeSet<String>>,
    /// Settings of the block that is being executed, which take effect at its end.
    pub(super) announced: Vec<(Name, f64)>,
    /// Parameters that were given a value since the last query, the same one or another.
    pub(super) written: BTreeSet<Name>,
    /// `#<_value>`: what the last return gave; zero when nothing.
    pub returned: f64,
    /// `#<_value_returned>`: whether the last return gave a value.
    pub has_returned: bool,
}

impl Parameters {
    /// The parameters when a program starts: the stored ones, and 0 for all others except #5220 and #5599.
    pub fn new(machine: &Machine, _readings: &Choices) -> Self {
        Self { numbered: at_start(machine).into(), ..Self::default() }
    }

    /// A numbered parameter as it is stored (coordinate systems: machine unit); zero when never set.
    pub fn stored(&self, number: u32) -> f64 {
        self.numbered.get(&number).copied().unwrap_or(0.0)
    }

    /// Stores a numbered parameter without any check.
    pub fn store(&mut self, number: u32, value: f64) {
        self.written.insert(Name::Numbered(number));
        self.numbered.insert(number, value);
    }

    /// The parameters that were given a value since the last query.
    pub fn take_written(&mut self) -> Vec<Name> {
        if self.written.is_empty() {
            // Most blocks set none.
            return Vec::new();
        }
        std::mem::take(&mut self.written).into_iter().collect()
    }

    /// All stored numbered parameters that are not zero. The local ones are not among them: they are in the
    /// frames.
    pub fn nonzero(&self) -> Indexed<u32, f64> {
        self.numbered
            .iter()
            .filter(|(_, value)| value.abs() > 0.0)
            .map(|(number, value)| (*number, *value))
            .collect()
    }

    /// The settings of the block that is to be executed.
    pub fn announce(&mut self, settings: &[(Name, f64)]) {
        self.announced = settings.to_vec();
    }

    /// What the block that is being executed sets a parameter to, if it does.
    pub fn announced(&self, name: &Name) -> Option<f64> {
        self.announced
            .iter()
            .rev()
            .find(|(announced, _)| announced == name)
            .map(|(_, value)| *value)
    }
}

/// The parameters when a program starts.
///
/// Rule parameters.stored. Stored parameters have their values when a program starts: those of the user, 31 to 5000,
/// and those that are persistent, 5161 to 5390. All others are volatile and begin with zero.
/// Rule parameters.debug-switch. 5599 is 1 at the start.
pub(super) fn at_start(machine: &Machine) -> BTreeMap<u32, f64> {
    let stored = |number: &u32| (31..=5000).contains(number) || PERSISTENT.contains(number);
    let mut numbered: BTreeMap<u32, f64> = machine
        .parameters
        .0
        .iter()
        .filter(|(number, value)| stored(number) && value.is_finite())
        .map(|(number, value)| (*number, *value))
        .collect();
    let system = f64::from(start_system(machine));
    numbered.insert(ACTIVE_SYSTEM, system);
    numbered.insert(DEBUG_SWITCH, 1.0);
    numbered
}
