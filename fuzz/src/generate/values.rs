//! Numbers, parameters and expressions whose values are neither too large nor no number.

use super::writer::Writer;

/// Numbers as people write them.
const NUMBERS: &[&str] = &[
    "1", "0", "2", "3", "-1", "10", "0.5", "2.5", "-2.5", "100", "25.4", "1.0", "+3.", ".5",
    "-.25", "0.001", "7", "-10", "1000", "12.3456", "-0", "00.10", "1.5", "90", "360", "0.0001",
];

/// Numbered parameters that programs use.
const NUMBERED: &[&str] =
    &["1", "2", "3", "4", "30", "31", "32", "33", "34", "35", "100", "500", "1000", "5000"];

/// Numbered parameters that tell the state.
const STATE_NUMBERED: &[&str] = &[
    "5220", "5221", "5222", "5223", "5230", "5241", "5261", "5390", "5400", "5401", "5403", "5410",
    "5413", "5420", "5421", "5422", "5423", "5424", "5428", "5211", "5210", "5161", "5181", "5599",
    "5399",
];

/// Predefined named parameters.
const PREDEFINED: &[&str] = &[
    "_vmajor",
    "_line",
    "_motion_mode",
    "_plane",
    "_ccomp",
    "_metric",
    "_imperial",
    "_absolute",
    "_incremental",
    "_inverse_time",
    "_units_per_minute",
    "_units_per_rev",
    "_coord_system",
    "_tool_offset",
    "_retract_r_plane",
    "_retract_old_z",
    "_spindle_rpm_mode",
    "_spindle_css_mode",
    "_ijk_absolute_mode",
    "_lathe_diameter_mode",
    "_lathe_radius_mode",
    "_spindle_on",
    "_spindle_cw",
    "_mist",
    "_flood",
    "_feed_override",
    "_speed_override",
    "_adaptive_feed",
    "_feed_hold",
    "_feed",
    "_rpm",
    "_current_tool",
    "_selected_tool",
    "_value",
    "_value_returned",
    "_call_level",
    "_remap_level",
    "_x",
    "_y",
    "_z",
    "_a",
    "_abs_x",
    "_abs_y",
    "_abs_z",
];

/// Names that programs give.
const NAMES: &[&str] = &["cut", "depth", "_far", "_total", "i", "a b", "_Speed"];

const RELATIONS: &[&str] = &["eq", "ne", "gt", "ge", "lt", "le", "and", "or", "xor"];

impl Writer<'_, '_> {
    /// A number as it stands in a program.
    pub(crate) fn number(&mut self) -> String {
        if self.dice.chance(80) {
            return (*self.dice.pick(NUMBERS)).to_owned();
        }
        let sign = if self.dice.chance(40) { "-" } else { "" };
        let (whole, part) = (self.dice.below(200), self.dice.below(10_000));
        format!("{sign}{whole}.{part:04}")
    }

    /// A whole number from `first` to `last`, sometimes calculated.
    pub(crate) fn whole(&mut self, first: u32, last: u32) -> String {
        let number = self.dice.range(first, last);
        match self.dice.below(20) {
            0 => format!("[{number} + 0]"),
            1 => format!("{number}."),
            2 => format!("[{} - 1]", number + 1),
            3 => format!("0{number}"),
            _ => number.to_string(),
        }
    }

    /// A number from `first` to `last`, sometimes calculated.
    pub(crate) fn within(&mut self, first: u32, last: u32) -> String {
        let number = self.dice.range(first, last);
        match self.dice.below(12) {
            0 => format!("[{number}]"),
            1 if last > first => {
                let value = self.value(2);
                format!("[{first} + [abs[{value}] mod {}]]", last - first)
            }
            2 if number < last => format!("{number}.{}", self.dice.below(1000)),
            _ => number.to_string(),
        }
    }

    /// A coordinate.
    pub(crate) fn coordinate(&mut self) -> String {
        match self.dice.below(10) {
            0 | 1 => self.value(2),
            2 => self.parameter(),
            _ => self.number(),
        }
    }

    /// Something that may stand after a letter or an equal sign.
    pub(crate) fn value(&mut self, depth: u32) -> String {
        match self.dice.below(if depth == 0 { 7 } else { 11 }) {
            0..=3 => self.number(),
            4 | 5 => self.parameter(),
            6 => self.state_parameter(),
            7 | 8 => ["[", self.expression(depth - 1).as_str(), "]"].concat(),
            9 => self.function(depth - 1),
            _ => {
                // Some documents have no sign but that of a number.
                let sign = if self.dice.chance(30) { "-" } else { "" };
                format!("{sign}{}", self.function(depth - 1))
            }
        }
    }

    /// What may stand between brackets.
    pub(crate) fn expression(&mut self, depth: u32) -> String {
        let mut text = self.value(depth);
        for _ in 0..self.dice.below(3) {
            match self.dice.below(12) {
                0..=2 => text.push_str(&format!(" + {}", self.value(depth))),
                3..=5 => text.push_str(&format!(" - {}", self.value(depth))),
                6 => text.push_str(&format!(" * {}", self.dice.pick(&["2", "-1", "0.5", "1.5"]))),
                7 => text.push_str(&format!(" / {}", self.dice.pick(&["2", "-4", "3", "0.5"]))),
                8 => text.push_str(&format!(" mod {}", self.dice.pick(&["7", "2.5", "-3", "360"]))),
                9 => text.push_str(&format!(" ** {}", self.dice.pick(&["2", "1", "0"]))),
                _ => {
                    let relation = *self.dice.pick(RELATIONS);
                    text.push_str(&format!(" {relation} {}", self.value(depth)));
                }
            }
        }
        text
    }

    /// A condition of a branch or loop.
    pub(crate) fn condition(&mut self) -> String {
        match self.dice.below(6) {
            0 => "1".to_owned(),
            1 => "0".to_owned(),
            2 => self.expression(1),
            _ => {
                let relation = *self.dice.pick(RELATIONS);
                format!("{} {relation} {}", self.value(1), self.value(1))
            }
        }
    }

    fn function(&mut self, depth: u32) -> String {
        let value = self.value(depth);
        match self.dice.below(17) {
            0 => format!("sin[{value}]"),
            1 => format!("cos[{value}]"),
            2 => format!("atan[{value}]/[{}]", self.value(depth)),
            3 => format!("sqrt[abs[{value}]]"),
            4 => format!("exp[[{value}] mod 5]"),
            5 => format!("ln[abs[{value}] + 1]"),
            6 => format!("asin[[{value}] mod 1]"),
            7 => format!("acos[[{value}] mod 1]"),
            8 => format!("tan[[{value}] mod 45]"),
            9 => format!("exists[#<{}>]", self.dice.pick(NAMES)),
            10 | 11 => format!("fix[{value}]"),
            12 => format!("fup[{value}]"),
            13 | 14 => format!("round[{value}]"),
            _ => format!("abs[{value}]"),
        }
    }

    /// A parameter that can be read.
    pub(crate) fn parameter(&mut self) -> String {
        if !self.state.names.is_empty() && self.dice.chance(35) {
            return ["#<", self.dice.pick(&self.state.names).as_str(), ">"].concat();
        }
        match self.dice.below(12) {
            0 => format!("#[{} + 1]", self.dice.pick(&["30", "31", "32"])),
            1 => ["#<", *self.dice.pick(PREDEFINED), ">"].concat(),
            _ => ["#", *self.dice.pick(NUMBERED)].concat(),
        }
    }

    /// A parameter that tells the state.
    pub(crate) fn state_parameter(&mut self) -> String {
        if self.dice.chance(60) {
            ["#<", *self.dice.pick(PREDEFINED), ">"].concat()
        } else {
            ["#", *self.dice.pick(STATE_NUMBERED)].concat()
        }
    }

    /// A parameter that a program may set, as it stands before the equal sign.
    pub(crate) fn settable(&mut self) -> String {
        if self.dice.chance(30) {
            let name = *self.dice.pick(NAMES);
            return ["#<", name, ">"].concat();
        }
        ["#", *self.dice.pick(NUMBERED)].concat()
    }

    /// Remembers that a parameter was set.
    pub(crate) fn was_set(&mut self, parameter: &str) {
        let name = parameter.strip_prefix("#<").and_then(|rest| rest.strip_suffix('>'));
        if let Some(name) = name.filter(|name| !self.state.names.iter().any(|known| known == name))
        {
            self.state.names.push(name.to_owned());
        }
    }
}
