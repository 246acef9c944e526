//! What a controller exposes, and with which resolution: no more of its runs is compared.

use std::collections::{BTreeMap, BTreeSet};
use std::ops::RangeInclusive;

use gaugeblock_vocabulary::{
    Effect, Entry, GppState, LengthUnit, NctState, Pin, Rs274State, Settings,
};

use crate::accuracy::{Accuracy, Resolution, unit_in, unit_of};

/// What is observable on a controller; declared before the run.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Capabilities {
    /// Name of the controller.
    pub name: String,
    /// The version that it reports.
    pub version: String,
    /// Largest absolute error of the numbers that it prints, in program units.
    pub resolution: f64,
    /// Largest error of the numbers that it prints, in proportion to the number: that of 32-bit numbers.
    pub relative_resolution: f64,
    /// Settings that it prints once, as lengths of the unit that is in force then, and the largest absolute error of
    /// their numbers where that is the millimetre later on.
    pub unconverted_lengths: BTreeMap<String, f64>,
    /// Names of the settings and state fields that it reports, without index.
    pub fields: BTreeSet<String>,
    /// Those of them whose value is also known at each effect, not only after the block, and after the program's end.
    pub fields_at_effects: BTreeSet<String>,
    /// Whether it tells every field that it shows whenever that has a value: one that is missing then differs. Where
    /// not, it is not judged.
    pub reports_all_fields: bool,
    /// Names of the effects that it reports.
    pub effects: BTreeSet<String>,
    /// Whether it reports a straight move whose end is where the controlled point is.
    pub moves_in_place: bool,
    /// Whether it shows which blocks were executed, and the state after each. Where not, its effects stand in one
    /// step, with the state at the end, which is compared unless a block was refused: what that one has done before
    /// is open.
    pub blocks: bool,
    /// Whether it ever refuses a block. If not, what the documents refuse is not judged.
    pub refuses: bool,
    /// Whether its faults may name their block.
    pub faults_have_blocks: bool,
    /// Whether its faults name their kind.
    pub faults_have_kinds: bool,
    /// Whether it reports all numbered parameters at the end.
    pub final_parameters: bool,
    /// Numbers of parameters that it does not show at the end.
    pub hidden_parameters: Vec<RangeInclusive<u32>>,
    /// Names of the pins whose changes it reports, without index.
    pub pins: BTreeSet<String>,
    /// How long a pin must keep a value for it to be seen for sure, seconds.
    pub pin_period: f64,
}

impl Capabilities {
    /// Everything, exactly, as for an interpreter in this process.
    pub fn everything(name: &str, version: &str) -> Self {
        let fields = || {
            let of_state = [Rs274State::FIELDS, GppState::FIELDS, NctState::FIELDS].concat();
            let all = [Settings::FIELDS, &of_state].concat();
            all.into_iter().map(str::to_owned).collect()
        };
        Self {
            name: name.to_owned(),
            version: version.to_owned(),
            resolution: 0.0,
            relative_resolution: 0.0,
            unconverted_lengths: BTreeMap::new(),
            fields: fields(),
            fields_at_effects: fields(),
            reports_all_fields: true,
            effects: Effect::NAMES.iter().map(|name| (*name).to_owned()).collect(),
            moves_in_place: true,
            blocks: true,
            refuses: true,
            faults_have_blocks: true,
            faults_have_kinds: true,
            final_parameters: true,
            hidden_parameters: Vec::new(),
            pins: Pin::names().map(str::to_owned).collect(),
            pin_period: 0.0,
        }
    }

    /// The accuracy of what it reports.
    pub fn accuracy(&self) -> Accuracy {
        Accuracy {
            absolute: self.resolution,
            relative: self.relative_resolution,
            pin_period: self.pin_period,
        }
    }

    /// The error of numbers without a length unit: parameters and pins.
    pub fn resolution(&self) -> Resolution {
        Resolution::new(self.resolution, self.relative_resolution, LengthUnit::Millimetre)
    }

    /// The error of a field, with the unit that these entries have.
    pub fn resolution_of(&self, field: &str, among: &[Entry]) -> Resolution {
        let unit = unit_of(among);
        let carried = self.unconverted_lengths.get(field);
        let carried = carried.filter(|_| among.iter().any(|entry| entry.field == "units"));
        let absolute = match (carried, unit) {
            (Some(error), LengthUnit::Millimetre) => *error,
            (Some(_), LengthUnit::Inch) | (None, _) => self.resolution,
        };
        Resolution::new(absolute, self.relative_resolution, unit)
    }

    /// The error of an effect under these settings.
    pub fn resolution_at(&self, settings: &Settings) -> Resolution {
        Resolution::new(self.resolution, self.relative_resolution, unit_in(settings))
    }

    /// What this controller and another one both show.
    pub fn and(&self, other: &Self) -> Self {
        let both =
            |a: &BTreeSet<String>, b: &BTreeSet<String>| a.intersection(b).cloned().collect();
        let mut carried = self.unconverted_lengths.clone();
        for (field, error) in &other.unconverted_lengths {
            let own = carried.entry(field.clone()).or_insert(*error);
            *own = own.max(*error);
        }
        Self {
            name: self.name.clone(),
            version: self.version.clone(),
            resolution: self.resolution.max(other.resolution),
            relative_resolution: self.relative_resolution.max(other.relative_resolution),
            unconverted_lengths: carried,
            fields: both(&self.fields, &other.fields),
            fields_at_effects: both(&self.fields_at_effects, &other.fields_at_effects),
            reports_all_fields: self.reports_all_fields && other.reports_all_fields,
            effects: both(&self.effects, &other.effects),
            moves_in_place: self.moves_in_place && other.moves_in_place,
            blocks: self.blocks && other.blocks,
            refuses: self.refuses && other.refuses,
            faults_have_blocks: self.faults_have_blocks && other.faults_have_blocks,
            faults_have_kinds: self.faults_have_kinds && other.faults_have_kinds,
            final_parameters: self.final_parameters && other.final_parameters,
            hidden_parameters: [self.hidden_parameters.clone(), other.hidden_parameters.clone()]
                .concat(),
            pins: both(&self.pins, &other.pins),
            pin_period: self.pin_period.max(other.pin_period),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::accuracy::Quantity;

    #[test]
    fn a_length_that_is_carried_is_coarser_in_millimetres() {
        let carried = BTreeMap::from([("feed_rate".to_owned(), 0.05)]);
        let observables = Capabilities {
            resolution: 0.002,
            unconverted_lengths: carried,
            ..Capabilities::everything("a", "1")
        };
        let both = observables.and(&Capabilities::everything("b", "1"));
        for (field, units, expected) in [
            ("feed_rate", LengthUnit::Millimetre, 0.05),
            ("feed_rate", LengthUnit::Inch, 0.002),
            ("position", LengthUnit::Millimetre, 0.002),
        ] {
            let among = Settings { units: Some(units), ..Settings::default() }.entries();
            for observables in [&observables, &both] {
                let found = observables.resolution_of(field, &among);
                let (found, _) = found.error_of(Quantity::Length);
                assert!((found - expected).abs() < 1e-12, "{field} in {units:?}: {found}");
            }
        }
    }
}
