//! Offsets that `$#` reports: coordinate systems, reference points, G92, tool length.

use std::collections::BTreeMap;

use gaugeblock_vocabulary::{Axis, LengthUnit, Position, Settings};

use crate::message::numbers;
use crate::modes::converted;

/// The coordinate systems that every member of the family has, in the order of their numbers.
const SYSTEMS: [&str; 9] = ["G54", "G55", "G56", "G57", "G58", "G59", "G59.1", "G59.2", "G59.3"];

/// Differences below this are in the last printed digit or beyond.
const PRINTED_DIFFERENCE_MIN: f64 = 1e-6;

/// What a program may have written.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Written {
    /// Coordinate systems.
    pub(crate) systems: bool,
    /// The G92 offset.
    pub(crate) local: bool,
    /// The tool length offset.
    pub(crate) tool: bool,
}

/// What `$#` reports, in the length unit of reports.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Stored(BTreeMap<String, Vec<f64>>);

impl Stored {
    /// Takes a report over. False if it is none of `$#`, or has no numbers.
    pub(crate) fn take(&mut self, name: &str, value: &str) -> bool {
        let is_known = SYSTEMS.contains(&name) || ["G28", "G30", "G92", "TLO"].contains(&name);
        match numbers(value).filter(|_| is_known) {
            Some(values) => self.0.insert(name.to_owned(), values).is_none(),
            None => ["PRB", "TLR"].contains(&name),
        }
    }

    /// Whether all coordinate systems that were reported are zero.
    pub(crate) fn has_zero_systems(&self) -> bool {
        let systems = SYSTEMS.iter().filter_map(|name| self.0.get(*name));
        systems.flatten().all(|value| value.abs() < PRINTED_DIFFERENCE_MIN)
    }

    /// Whether the G92 offset is zero, or not reported.
    pub(crate) fn has_zero_local_offset(&self) -> bool {
        self.is_zero("G92")
    }

    /// Whether the tool length offset is zero, or not reported.
    pub(crate) fn has_zero_tool_offset(&self) -> bool {
        self.is_zero("TLO")
    }

    fn is_zero(&self, name: &str) -> bool {
        let offset = self.0.get(name).into_iter().flatten();
        offset.copied().all(|value: f64| value.abs() < PRINTED_DIFFERENCE_MIN)
    }

    /// Offsets as settings, in the active length unit.
    pub(crate) fn settings(
        &self,
        modes: &Settings,
        axes: &[Axis],
        unit: LengthUnit,
    ) -> Option<Settings> {
        let to = modes.units?;
        let place = usize::try_from(modes.work_offset?).ok()?.checked_sub(1)?;
        let system = self.0.get(*SYSTEMS.get(place)?)?;
        let tool = self.0.get("TLO")?;
        let tool_offset = match tool.as_slice() {
            // One number is that of the tool axis.
            [length] => position(&[0.0, 0.0, *length], axes, unit, to),
            all => position(all, axes, unit, to),
        };
        Some(Settings {
            g5x_offset: Some(position(system, axes, unit, to)),
            g92_offset: Some(position(self.0.get("G92")?, axes, unit, to)),
            tool_offset: Some(tool_offset),
            ..Settings::default()
        })
    }

    /// Blocks that give each coordinate system that differs in `now` the value that it has here, and cancel a G92
    /// offset and a tool length offset that are zero here. What is zero here and among `written` is set to zero in any
    /// case: a change can be too small to be printed.
    pub(crate) fn blocks_from(
        &self,
        now: &Self,
        axes: &[Axis],
        unit: LengthUnit,
        written: Written,
    ) -> Vec<String> {
        let unit = if unit == LengthUnit::Inch { "G20" } else { "G21" };
        let mut blocks = Vec::new();
        for (number, name) in (1..).zip(SYSTEMS) {
            let (Some(before), Some(now)) = (self.0.get(name), now.0.get(name)) else { continue };
            let differs = |(a, b): (&f64, &f64)| (a - b).abs() > PRINTED_DIFFERENCE_MIN;
            if written.systems && self.is_zero(name) || before.iter().zip(now).any(differs) {
                let word =
                    |(axis, value): (&Axis, &f64)| format!("{}{value}", axis.word().to_uppercase());
                let words: String = axes.iter().zip(before).map(word).collect();
                blocks.push(format!("{unit}G10L2P{number}{words}"));
            }
        }
        if self.has_zero_local_offset() && (written.local || !now.has_zero_local_offset()) {
            blocks.push("G92.1".to_owned());
        }
        if self.has_zero_tool_offset() && (written.tool || !now.has_zero_tool_offset()) {
            blocks.push("G49".to_owned());
        }
        blocks
    }
}

/// A position of numbers in the order of the axes.
pub(crate) fn position(
    numbers: &[f64],
    axes: &[Axis],
    from: LengthUnit,
    to: LengthUnit,
) -> Position {
    let mut position = Position::default();
    for (axis, number) in axes.iter().zip(numbers) {
        let is_rotary = [Axis::A, Axis::B, Axis::C].contains(axis);
        *position.get_mut(*axis) = if is_rotary { *number } else { converted(*number, from, to) };
    }
    position
}

#[cfg(test)]
mod tests {
    use super::*;

    const AXES: [Axis; 3] = [Axis::X, Axis::Y, Axis::Z];
    const MM: LengthUnit = LengthUnit::Millimetre;
    const NOTHING: Written = Written { systems: false, local: false, tool: false };
    const SYSTEMS_ONLY: Written = Written { systems: true, ..NOTHING };
    const TOOL_ONLY: Written = Written { tool: true, ..NOTHING };

    fn stored(g55: &str) -> Stored {
        let mut stored = Stored::default();
        let zero = "0.000,0.000,0.000";
        for (name, value) in [
            ("G54", zero),
            ("G55", g55),
            ("G28", zero),
            ("G92", "1.000,0.000,0.000"),
            ("TLO", "2.540"),
            ("PRB", "0.000,0.000,0.000:0"),
        ] {
            assert!(stored.take(name, value), "{name}");
        }
        stored
    }

    #[test]
    fn offsets_are_in_the_active_unit() {
        let modes =
            Settings { units: Some(LengthUnit::Inch), work_offset: Some(2), ..Settings::default() };
        let found = stored("25.400,0.000,-50.800").settings(&modes, &AXES, MM).expect("settings");
        let at = |x, z| Some(Position { x, z, ..Position::default() });
        assert_eq!(found.g5x_offset, at(1.0, -2.0));
        assert_eq!(found.g92_offset, at(1.0 / 25.4, 0.0));
        assert_eq!(found.tool_offset, at(0.0, 0.1));
    }

    #[test]
    fn only_systems_that_differ_are_written_back() {
        let (before, now) = (stored("1.000,-2.500,0.000"), stored("9.000,0.000,0.000"));
        assert_eq!(before.blocks_from(&now, &AXES, MM, NOTHING), ["G21G10L2P2X1Y-2.5Z0"]);
        assert_eq!(now.blocks_from(&now, &AXES, MM, NOTHING), [""; 0]);
        assert_eq!(now.blocks_from(&now, &AXES, MM, SYSTEMS_ONLY), ["G21G10L2P1X0Y0Z0"]);
        assert!(!before.has_zero_systems());
        assert!(stored("0.000,0.000,0.000").has_zero_systems());
    }

    #[test]
    fn local_offset_is_cancelled_if_it_was_zero() {
        let now = stored("0.000,0.000,0.000");
        let mut before = now.clone();
        assert_eq!(before.blocks_from(&now, &AXES, MM, NOTHING), [""; 0]);
        before.0.insert("G92".to_owned(), vec![0.0; 3]);
        assert!(before.has_zero_local_offset() && !now.has_zero_local_offset());
        assert_eq!(before.blocks_from(&now, &AXES, MM, NOTHING), ["G92.1"]);
    }

    #[test]
    fn tool_offset_is_cancelled_if_it_was_zero() {
        let now = stored("0.000,0.000,0.000");
        let mut before = now.clone();
        before.0.insert("TLO".to_owned(), vec![0.0]);
        assert!(before.has_zero_tool_offset() && !now.has_zero_tool_offset());
        assert_eq!(before.blocks_from(&now, &AXES, MM, NOTHING), ["G49"]);
        assert_eq!(before.blocks_from(&before, &AXES, MM, TOOL_ONLY), ["G49"]);
        assert_eq!(now.blocks_from(&before, &AXES, MM, NOTHING), [""; 0]);
    }

    #[test]
    fn report_of_another_form_is_not_taken() {
        let mut stored = Stored::default();
        assert!(!stored.take("G54", "1.000,x"));
        assert!(!stored.take("VER", "1"));
    }
}
