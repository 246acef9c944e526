//! What a controller is and reports, found out when it is opened.

use std::collections::{BTreeMap, BTreeSet};

use gaugeblock_adapter::{ControllerError, HarnessError};
use gaugeblock_compare::Capabilities;
use gaugeblock_vocabulary::{Axis, LengthUnit, Program, Scenario, Settings};

use crate::dialect::{Dialect, Features};
use crate::message::{Welcome, number};
use crate::modes::{Decimals, MM_PER_INCH, Modes};
use crate::session::Session;
use crate::setup::{Motion, Setup};
use crate::stored::Stored;
use crate::words::Words;

/// Settings that hold offsets.
const OFFSETS: [&str; 3] = ["g5x_offset", "g92_offset", "tool_offset"];

/// Half of the last decimal of a position in millimetres and in inches.
const HALF_DECIMAL_MM: f64 = 0.0005;
const HALF_DECIMAL_INCH: f64 = 0.00005;

/// Error of a number that is rounded to 24 bits four times, relative to it.
const SINGLE_PRECISION: f64 = 2.4e-7;

/// Largest error that a comparison takes into account, millimetres.
const ERROR_MAX_MM: f64 = 0.1;

/// Where whole numbers and their halves are exact in 24 bits.
const EXACT_BELOW: f64 = 4_194_304.0;

/// Words beyond this make offsets that 24 bits hold less exactly than they are printed, millimetres.
const FAR_MM: f64 = 1000.0;

/// What the family is called in messages.
const FAMILY: &str = "Grbl 1.1 or grblHAL";

/// What is known of a controller.
#[derive(Clone, Debug)]
pub(crate) struct Identity {
    pub(crate) dialect: Dialect,
    /// The version that `$I` reports, without the user's text.
    pub(crate) version: String,
    pub(crate) features: Features,
    /// Unit of lengths in reports (`$13`).
    pub(crate) unit: LengthUnit,
    /// The modes after a reset.
    modes: Modes,
    /// The offsets after a reset.
    pub(crate) stored: Stored,
    /// Whether offsets are reported while a program runs.
    pub(crate) reports_offsets: bool,
    /// The coarsest step of an axis, millimetres.
    step: f64,
}

impl Identity {
    /// Queries a controller that was reset.
    pub(crate) fn query(
        session: &mut Session,
        welcome: &Welcome,
        setup: &Setup,
    ) -> Result<Self, ControllerError> {
        let broken = ControllerError::Broken;
        let found = format!("{} {}", welcome.name, welcome.version);
        let wrong = ControllerError::WrongVersion { found, required: FAMILY };
        let dialect = Dialect::of(welcome).ok_or(wrong)?;
        session.make_ready(setup.unlock).map_err(broken)?;
        let mut identity = Self {
            dialect,
            version: welcome.version.clone(),
            features: Features::default(),
            unit: LengthUnit::Millimetre,
            modes: Modes::default(),
            stored: Stored::default(),
            reports_offsets: setup.motion == Motion::Real,
            step: 0.0,
        };
        identity.query_build(session).map_err(broken)?;
        identity.query_settings(session).map_err(broken)?;
        session.unit = identity.unit;
        identity.modes = session.modes().map_err(broken)?.of(dialect);
        let stored = session.stored().map_err(broken)?;
        let none = || HarnessError::NotRun("`$#` is refused by an idle controller".to_owned());
        identity.stored = stored.ok_or_else(|| broken(none()))?;
        if setup.motion == Motion::Checked {
            session.enter_check_mode().map_err(broken)?;
            identity.reports_offsets = session.stored().map_err(broken)?.is_some();
            session.reset().map_err(broken)?;
        }
        Ok(identity)
    }

    fn query_build(&mut self, session: &mut Session) -> Result<(), HarnessError> {
        let build = session.accepted("$I")?;
        if let Some(version) = build.value("VER").and_then(|version| version.split(':').next()) {
            self.version = version.trim_start_matches('v').to_owned();
        }
        if let Some(axes) = build.value("AXS").and_then(|axes| axes.split(':').nth(1)) {
            self.features.axes = axes.to_owned();
        }
        let options = build.value("NEWOPT").unwrap_or_default();
        self.features.expressions = options.split(',').any(|option| option == "EXPR");
        Ok(())
    }

    fn query_settings(&mut self, session: &mut Session) -> Result<(), HarnessError> {
        let settings = session.accepted("$$")?;
        let value = |name: &str| settings.value(name).and_then(number);
        if value("$13").is_some_and(|value| value > 0.0) {
            self.unit = LengthUnit::Inch;
        }
        let steps = ["$100", "$101", "$102"].into_iter().filter_map(value);
        let steps = steps.filter(|steps| *steps > 0.0);
        self.step = steps.map(|steps| 1.0 / steps).fold(0.0, f64::max);
        Ok(())
    }

    /// The axes in the order of reports.
    pub(crate) fn axes(&self) -> Vec<Axis> {
        let of = |letter: char| {
            let letter = letter.to_ascii_lowercase().to_string();
            Axis::ALL.iter().copied().find(|axis| axis.word() == letter)
        };
        self.features.axes.chars().filter_map(of).collect()
    }

    /// Names of the settings and fields that it reports.
    fn fields(&self, motion: Motion) -> BTreeSet<String> {
        let settings = self.modes.settings.entries();
        let state = self.modes.state.entries();
        let mut fields: BTreeSet<String> =
            settings.iter().chain(&state).map(|entry| entry.field.to_owned()).collect();
        if self.reports_offsets {
            fields.extend(OFFSETS.map(str::to_owned));
            if !self.stored.has_zero_systems() {
                fields.remove("g5x_offset");
            }
            if !self.stored.has_zero_tool_offset() {
                fields.remove("tool_offset");
            }
        }
        if motion == Motion::Real {
            fields.insert("position".to_owned());
        }
        fields
    }

    /// What is observable.
    pub(crate) fn capabilities(&self, motion: Motion) -> Capabilities {
        let printed = match self.unit {
            LengthUnit::Millimetre => HALF_DECIMAL_MM,
            LengthUnit::Inch => HALF_DECIMAL_INCH * MM_PER_INCH,
        };
        let moved = if motion == Motion::Real { self.step / 2.0 } else { 0.0 };
        let fields = self.fields(motion);
        let settings = fields.iter().filter(|field| Settings::FIELDS.contains(&field.as_str()));
        Capabilities {
            name: self.dialect.name().to_owned(),
            version: self.version.clone(),
            resolution: (printed + moved).min(ERROR_MAX_MM),
            relative_resolution: SINGLE_PRECISION,
            unconverted_lengths: BTreeMap::new(),
            fields_at_effects: settings.cloned().collect(),
            fields,
            reports_all_fields: false,
            effects: BTreeSet::new(),
            moves_in_place: true,
            blocks: true,
            refuses: true,
            faults_have_blocks: true,
            faults_have_kinds: true,
            final_parameters: false,
            hidden_parameters: Vec::new(),
            pins: BTreeSet::new(),
            pin_period: 0.0,
        }
    }

    /// What is observable when it runs this program: F and S only if it prints each of them exactly, offsets only if no
    /// word is far from zero, and positions in a coordinate system only if all are zero.
    pub(crate) fn observables(&self, plain: &Capabilities, program: &Program) -> Capabilities {
        let mut observables = plain.clone();
        let mut hide = |field: &str| {
            observables.fields.remove(field);
            observables.fields_at_effects.remove(field);
        };
        let blocks: Vec<Words> = program.language.lines(&program.main).map(Words::of).collect();
        let has = |codes: &[i32]| blocks.iter().any(|block| block.has('G', codes));
        let is_computed = blocks.iter().any(|block| block.has_more);
        let Decimals { feed, speed } = self.modes.decimals;
        let numbers = |letter| blocks.iter().flat_map(move |block| block.numbers(letter));
        let (other_unit, far) = match self.unit {
            LengthUnit::Millimetre => (has(&[200]).then_some(MM_PER_INCH), FAR_MM),
            LengthUnit::Inch => (Some(1.0 / MM_PER_INCH), FAR_MM / MM_PER_INCH),
        };
        let factors = [Some(1.0), other_unit];
        let factors: Vec<f64> = factors.into_iter().flatten().collect();
        let is_feed_exact =
            numbers('F').all(|f| factors.iter().all(|factor| is_printed(f * factor, feed)));
        if is_computed || !is_feed_exact || has(&[930]) {
            hide("feed_rate");
        }
        if is_computed || !numbers('S').all(|s| is_printed(s, speed)) {
            hide("spindle_speed");
        }
        let is_far =
            |letter| numbers(letter).any(|to| factors.iter().any(|by| (to * by).abs() > far));
        if ['X', 'Y', 'Z'].into_iter().any(is_far) {
            OFFSETS.iter().for_each(|field| hide(field));
        }
        let selects = is_computed || has(&[550, 560, 570, 580, 590, 591, 592, 593]);
        if selects && !self.stored.has_zero_systems() {
            hide("position");
        }
        observables
    }
}

/// Whether a number is printed exactly with so many decimals. The controller computes with 24 bits, and adds half of
/// the last decimal before it prints.
fn is_printed(value: f64, decimals: usize) -> bool {
    if value.abs() >= EXACT_BELOW {
        return false;
    }
    let scaled = (0..decimals).fold(value, |scaled, _| scaled * 10.0);
    (scaled - scaled.round()).abs() < 1e-6
}

/// Checks that a program needs no more of the language than is declared, and names what it needs more.
pub type LanguageCheck =
    fn(&gaugeblock_adapter::protocol::DeclaredLanguage, &Scenario) -> Result<(), String>;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn number_with_too_many_decimals_is_not_printed_exactly() {
        assert!(is_printed(100.0, 0) && is_printed(12.5, 1) && is_printed(0.001, 3));
        assert!(!is_printed(12.3456, 0) && !is_printed(12.34, 1) && !is_printed(9_162_499.0, 0));
    }
}
