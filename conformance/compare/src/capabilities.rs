//! What a controller exposes, and with which resolution: no more of its runs is compared.

use std::collections::{BTreeMap, BTreeSet};
use std::ops::RangeInclusive;

use gaugeblock_vocabulary::{Effect, Entry, GppState, NctState, Pin, Rs274State, Settings, Value};

/// What is observable on a controller; declared before the run.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Capabilities {
    /// Name of the controller.
    pub name: String,
    /// The version that it reports.
    pub version: String,
    /// Largest absolute error of the numbers that it prints, in program units.
    pub resolution: f64,
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
            unconverted_lengths: BTreeMap::new(),
            fields: fields(),
            fields_at_effects: fields(),
            reports_all_fields: true,
            effects: Effect::NAMES.iter().map(|name| (*name).to_owned()).collect(),
            moves_in_place: true,
            blocks: true,
            faults_have_blocks: true,
            faults_have_kinds: true,
            final_parameters: true,
            hidden_parameters: Vec::new(),
            pins: Pin::names().map(str::to_owned).collect(),
            pin_period: 0.0,
        }
    }

    /// Largest absolute error of a field, with the unit that these entries have.
    pub fn resolution_of(&self, field: &str, among: &[Entry]) -> f64 {
        let Some(error) = self.unconverted_lengths.get(field) else { return self.resolution };
        let unit = among.iter().find(|entry| entry.field == "units").map(|entry| &entry.value);
        if unit == Some(&Value::Word("mm".to_owned())) { *error } else { self.resolution }
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
            unconverted_lengths: carried,
            fields: both(&self.fields, &other.fields),
            fields_at_effects: both(&self.fields_at_effects, &other.fields_at_effects),
            reports_all_fields: self.reports_all_fields && other.reports_all_fields,
            effects: both(&self.effects, &other.effects),
            moves_in_place: self.moves_in_place && other.moves_in_place,
            blocks: self.blocks && other.blocks,
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
    use gaugeblock_vocabulary::LengthUnit;

    use super::*;

    #[test]
    fn a_length_that_is_carried_is_coarser_in_millimetres() {
        let carried = BTreeMap::from([("feed_rate".to_owned(), 0.5)]);
        let observables = Capabilities {
            resolution: 0.25,
            unconverted_lengths: carried,
            ..Capabilities::everything("a", "1")
        };
        let both = observables.and(&Capabilities::everything("b", "1"));
        for (field, units, expected) in [
            ("feed_rate", LengthUnit::Millimetre, 0.5),
            ("feed_rate", LengthUnit::Inch, 0.25),
            ("position", LengthUnit::Millimetre, 0.25),
        ] {
            let among = Settings { units: Some(units), ..Settings::default() }.entries();
            for observables in [&observables, &both] {
                let found = observables.resolution_of(field, &among);
                assert!((found - expected).abs() < 1e-12, "{field} in {units:?}: {found}");
            }
        }
    }
}
