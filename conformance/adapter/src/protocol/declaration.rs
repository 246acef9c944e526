//! What a controller declares before it runs anything: the claim is bounded by it, and a word that is not of the
//! vocabulary is an error.

use std::collections::{BTreeMap, BTreeSet};
use std::ops::RangeInclusive;

use gaugeblock_compare::Capabilities;
use gaugeblock_compare::accuracy::LENGTH_ERROR_MAX_MM;
use gaugeblock_vocabulary::{
    Effect, GppState, Language, LengthUnit, NctState, Options, Pin, Rs274State, Settings,
};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::suggestion::suggest;
use super::{DeclaredLanguage, EXTENSIONS, Extension, FEATURES};

/// The version that is frozen: what stands in it stays, and what comes is optional.
pub const VERSION: u32 = 1;

/// What a controller is and shows. Everything has to be said but what is marked as optional.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Declaration {
    /// Version of the protocol: 1.
    pub protocol: u32,
    /// Name of the controller, as it stands in a report.
    pub name: String,
    /// Its version.
    pub version: String,
    /// Languages that it speaks; a case in another one is not run.
    pub languages: Vec<Language>,
    /// Length units that its machine can have; a case on a machine of another one is not run.
    pub units: Vec<LengthUnit>,
    /// What it has, of the names that [`FEATURES`] lists; a case that needs another one is not run.
    pub features: BTreeSet<String>,
    /// What it shows; nothing else is judged.
    pub observables: Observables,
    /// Largest absolute error of the numbers that it reports, in program units; 0 where they are exact, 0.1 at most.
    pub resolution: f64,
    /// Optional: largest error in proportion to the number, such as 1.2e-7 for numbers of 32 bits; 1e-6 at most.
    #[serde(default, skip_serializing_if = "is_exact")]
    pub relative_resolution: f64,
    /// What its times are.
    pub clock: Clock,
    /// Optional: the edition that it is held to where the caller names none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub edition: Option<String>,
    /// Optional: the edition of the suite that says what this controller really does, where there is one: what
    /// differs is explained by its quirks.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub observed: Option<String>,
    /// Optional: options of choices as this controller reads the documents. They configure the specification, and the
    /// report names them.
    #[serde(default)]
    pub options: Options,
    /// Optional: the part of RS-274 that it has; a program that needs more is not run. All of it where nothing is said.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub language: Option<DeclaredLanguage>,
    /// Optional: how many sessions may run at once; as many as there are processors where nothing is said, 1 for a
    /// single machine.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub sessions: Option<u16>,
    /// Optional: what it can do beyond the operations that each adapter has to know.
    #[serde(default, skip_serializing_if = "BTreeSet::is_empty")]
    pub offers: BTreeSet<Extension>,
}

/// What a controller shows, by the names of the vocabulary (`gaugeblock adapter vocabulary` lists them).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Observables {
    /// Settings and fields of the state that it tells after each block.
    pub fields: BTreeSet<String>,
    /// Those of them whose value is also known at each effect.
    pub fields_at_effects: BTreeSet<String>,
    /// Effects that it tells whenever they happen.
    pub effects: BTreeSet<String>,
    /// Whether it tells a straight move whose end is where the controlled point is.
    pub moves_in_place: bool,
    /// Whether its faults name their kind.
    pub fault_kinds: bool,
    /// Whether it tells all numbered parameters at the end.
    pub final_parameters: bool,
    /// Optional: numbers of parameters that it does not tell at the end, first and last of each range.
    #[serde(default)]
    pub hidden_parameters: Vec<(u32, u32)>,
    /// Pins whose changes it tells.
    pub pins: BTreeSet<String>,
    /// Optional: whether it tells each executed block as a step; true where nothing is said. Where not, all effects
    /// stand in one step, with the state at the end.
    #[serde(default = "yes", skip_serializing_if = "is_yes")]
    pub blocks: bool,
    /// Optional: fields whose number is told when it is set and not again when the length unit changes, with the
    /// largest error, in millimetres, of one that was set in inches.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub carried: BTreeMap<String, f64>,
    /// Optional: whether its faults may name their block; true where nothing is said.
    #[serde(default = "yes", skip_serializing_if = "is_yes")]
    pub fault_blocks: bool,
    /// Optional: whether it ever refuses a block; true where nothing is said. Where not, what the documents refuse
    /// counts as unsupported.
    #[serde(default = "yes", skip_serializing_if = "is_yes")]
    pub refusals: bool,
}

fn yes() -> bool {
    true
}

#[expect(clippy::trivially_copy_pass_by_ref, reason = "serde hands on a reference")]
fn is_yes(said: &bool) -> bool {
    *said
}

#[expect(clippy::trivially_copy_pass_by_ref, reason = "serde hands on a reference")]
fn is_exact(error: &f64) -> bool {
    *error == 0.0
}

/// What a controller's times are.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Clock {
    /// Only dwells and waits take time, and exactly as long as they say.
    Virtual,
    /// Times of the wall, with this resolution in seconds, 1 at most: what lasts less may not be seen.
    Wall(f64),
}

impl Declaration {
    /// What a controller of this project declares.
    pub fn of(observables: &Capabilities, languages: Vec<Language>) -> Self {
        Self {
            protocol: VERSION,
            name: observables.name.clone(),
            version: observables.version.clone(),
            languages,
            units: vec![LengthUnit::Millimetre, LengthUnit::Inch],
            features: FEATURES.iter().map(|(name, _)| (*name).to_owned()).collect(),
            observables: Observables::of(observables),
            resolution: observables.resolution,
            relative_resolution: observables.relative_resolution,
            clock: if observables.pin_period > 0.0 {
                Clock::Wall(observables.pin_period)
            } else {
                Clock::Virtual
            },
            edition: None,
            observed: None,
            options: Options::default(),
            language: None,
            sessions: None,
            offers: BTreeSet::new(),
        }
    }

    /// What can be judged of it.
    ///
    /// # Errors
    /// A word that is not of the vocabulary, or a number that cannot be.
    pub fn capabilities(&self) -> Result<Capabilities, String> {
        if self.protocol != VERSION {
            return Err(format!(
                "it speaks version {} of the protocol, not {VERSION}",
                self.protocol
            ));
        }
        if self.name.trim().is_empty() || self.name.chars().any(char::is_control) {
            return Err(
                "invalid `name`: expected text that is not empty and has no control characters"
                    .to_owned(),
            );
        }
        if self.languages.is_empty() || self.units.is_empty() {
            return Err("it declares no language, or no length unit".to_owned());
        }
        let features = FEATURES.iter().map(|(name, _)| (*name).to_owned()).collect();
        words("features", &self.features, &features)?;
        self.language.as_ref().map_or(Ok(()), DeclaredLanguage::check)?;
        let pin_period = match self.clock {
            Clock::Virtual => 0.0,
            Clock::Wall(resolution) => resolution,
        };
        let bare = Capabilities {
            name: self.name.clone(),
            version: self.version.clone(),
            resolution: self.resolution,
            relative_resolution: self.relative_resolution,
            pin_period,
            ..Capabilities::default()
        };
        bare.accuracy().check()?;
        self.observables.capabilities(bare)
    }
}

impl Observables {
    /// What a controller of this project shows.
    pub fn of(observables: &Capabilities) -> Self {
        let range = |range: &RangeInclusive<u32>| (*range.start(), *range.end());
        Self {
            fields: observables.fields.clone(),
            fields_at_effects: observables.fields_at_effects.clone(),
            effects: observables.effects.clone(),
            moves_in_place: observables.moves_in_place,
            fault_kinds: observables.faults_have_kinds,
            final_parameters: observables.final_parameters,
            hidden_parameters: observables.hidden_parameters.iter().map(range).collect(),
            pins: observables.pins.clone(),
            blocks: observables.blocks,
            carried: observables.unconverted_lengths.clone(),
            fault_blocks: observables.faults_have_blocks,
            refusals: observables.refuses,
        }
    }

    /// What can be judged of a controller that shows this; its names and numbers are those of `of`.
    ///
    /// # Errors
    /// A word that is not of the vocabulary, or a number that cannot be.
    pub fn capabilities(&self, of: Capabilities) -> Result<Capabilities, String> {
        let known = Capabilities::everything("", "");
        words("observables.fields", &self.fields, &known.fields)?;
        words("observables.fields_at_effects", &self.fields_at_effects, &self.fields)
            .map_err(|error| format!("{error} (expected names that are also in `fields`)"))?;
        words("observables.effects", &self.effects, &known.effects)?;
        words("observables.pins", &self.pins, &known.pins)?;
        let carried = self.carried.keys().cloned().collect();
        words("observables.carried", &carried, &known.fields)?;
        let is_bounded = |error: &f64| (0.0..=LENGTH_ERROR_MAX_MM).contains(error);
        if let Some((field, error)) = self.carried.iter().find(|(_, error)| !is_bounded(error)) {
            return Err(format!(
                "invalid error of `{field}` in `observables.carried`: {error:?}; expected 0 to {LENGTH_ERROR_MAX_MM:?} millimetres"
            ));
        }
        Ok(Capabilities {
            unconverted_lengths: self.carried.clone(),
            fields: self.fields.clone(),
            fields_at_effects: self.fields_at_effects.clone(),
            reports_all_fields: false,
            effects: self.effects.clone(),
            moves_in_place: self.moves_in_place,
            blocks: self.blocks,
            refuses: self.refusals,
            faults_have_blocks: self.fault_blocks,
            faults_have_kinds: self.fault_kinds,
            final_parameters: self.final_parameters,
            hidden_parameters: self
                .hidden_parameters
                .iter()
                .map(|(first, last)| *first..=*last)
                .collect(),
            pins: self.pins.clone(),
            ..of
        })
    }
}

/// The words that a declaration can have, by the place where they stand, in the order of the vocabulary.
pub fn vocabulary() -> Vec<(&'static str, Vec<&'static str>)> {
    vec![
        ("features", FEATURES.iter().map(|(name, _)| *name).collect()),
        ("settings (fields)", Settings::FIELDS.to_vec()),
        ("state of rs274 (fields)", Rs274State::FIELDS.to_vec()),
        ("state of gpp (fields)", GppState::FIELDS.to_vec()),
        ("state of nct (fields)", NctState::FIELDS.to_vec()),
        ("effects", Effect::NAMES.to_vec()),
        ("pins", Pin::names().collect()),
        ("offers", EXTENSIONS.iter().map(|(_, name, _)| *name).collect()),
    ]
}

fn words(place: &str, said: &BTreeSet<String>, known: &BTreeSet<String>) -> Result<(), String> {
    match said.iter().find(|word| !known.contains(*word)) {
        Some(word) => {
            let meant = suggest(word, known.iter().map(String::as_str));
            let meant = meant.map(|meant| format!(": did you mean {meant:?}?")).unwrap_or_default();
            Err(format!(
                "invalid name {word:?} in `{place}`: the vocabulary does not have it{meant}"
            ))
        }
        None => Ok(()),
    }
}
