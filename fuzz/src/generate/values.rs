//! Numbers, parameters and expressions whose values are neither too large nor no number.

use std::fmt::{Arguments, Write as _};

use super::writer::Writer;

/// Room for most values.
const FEW_CHARACTERS: usize = 16;

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
    /// What is written by itself.
    fn alone(&mut self, write: impl FnOnce(&mut Self, &mut String)) -> String {
        let mut text = String::with_capacity(FEW_CHARACTERS);
        write(self, &mut text);
        text
    }

    /// A number as a program has it.
    pub(crate) fn number(&mut self) -> String {
        self.alone(Self::write_number)
    }

    fn one_of(&mut self, words: &[&'static str]) -> &'static str {
        let word: &&str = self.entropy.pick(words);
        word
    }

    fn write_number(&mut self, text: &mut String) {
        if self.entropy.chance(80) {
            text.push_str(self.one_of(NUMBERS));
            return;
        }
        let sign = if self.entropy.chance(40) { "-" } else { "" };
        let (whole, part) = (self.entropy.below(200), self.entropy.below(10_000));
        put(text, format_args!("{sign}{whole}.{part:04}"));
    }

    /// A whole number from `first` to `last`, sometimes calculated.
    pub(crate) fn whole(&mut self, first: u32, last: u32) -> String {
        let number = self.entropy.range(first, last);
        match self.entropy.below(20) {
            0 => format!("[{number} + 0]"),
            1 => format!("{number}."),
            2 => format!("[{} - 1]", number + 1),
            3 => format!("0{number}"),
            _ => number.to_string(),
        }
    }

    /// A number from `first` to `last`, sometimes calculated.
    pub(crate) fn within(&mut self, first: u32, last: u32) -> String {
        let number = self.entropy.range(first, last);
        match self.entropy.below(12) {
            0 => format!("[{number}]"),
            1 if last > first => {
                let value = self.value(2);
                format!("[{first} + [abs[{value}] mod {}]]", last - first)
            }
            2 if number < last => format!("{number}.{}", self.entropy.below(1000)),
            _ => number.to_string(),
        }
    }

    /// A coordinate.
    pub(crate) fn coordinate(&mut self) -> String {
        self.alone(Self::write_coordinate)
    }

    /// The same, appended to a text.
    pub(crate) fn write_coordinate(&mut self, text: &mut String) {
        match self.entropy.below(10) {
            0 | 1 => self.write_value(text, 2),
            2 => self.write_parameter(text),
            _ => self.write_number(text),
        }
    }

    /// Something that may stand after a letter or an equal sign.
    pub(crate) fn value(&mut self, depth: u32) -> String {
        self.alone(|w, text| w.write_value(text, depth))
    }

    fn write_value(&mut self, text: &mut String, depth: u32) {
        match self.entropy.below(if depth == 0 { 7 } else { 11 }) {
            0..=3 => self.write_number(text),
            4 | 5 => self.write_parameter(text),
            6 => self.write_state_parameter(text),
            7 | 8 => {
                text.push('[');
                self.write_expression(text, depth - 1);
                text.push(']');
            }
            9 => self.write_function(text, depth - 1),
            _ => {
                // Some documents have no sign but that of a number.
                if self.entropy.chance(30) {
                    text.push('-');
                }
                self.write_function(text, depth - 1);
            }
        }
    }

    /// What may stand between brackets.
    pub(crate) fn expression(&mut self, depth: u32) -> String {
        self.alone(|w, text| w.write_expression(text, depth))
    }

    fn write_expression(&mut self, text: &mut String, depth: u32) {
        self.write_value(text, depth);
        for _ in 0..self.entropy.below(3) {
            let operator = self.entropy.below(12);
            match operator {
                0..=2 => text.push_str(" + "),
                3..=5 => text.push_str(" - "),
                6 => text.push_str(" * "),
                7 => text.push_str(" / "),
                8 => text.push_str(" mod "),
                9 => text.push_str(" ** "),
                _ => {
                    text.push(' ');
                    text.push_str(self.one_of(RELATIONS));
                    text.push(' ');
                }
            }
            match operator {
                6 => text.push_str(self.one_of(&["2", "-1", "0.5", "1.5"])),
                7 => text.push_str(self.one_of(&["2", "-4", "3", "0.5"])),
                8 => text.push_str(self.one_of(&["7", "2.5", "-3", "360"])),
                9 => text.push_str(self.one_of(&["2", "1", "0"])),
                _ => self.write_value(text, depth),
            }
        }
    }

    /// A condition of a branch or loop.
    pub(crate) fn condition(&mut self) -> String {
        match self.entropy.below(6) {
            0 => "1".to_owned(),
            1 => "0".to_owned(),
            2 => self.expression(1),
            _ => {
                let relation = *self.entropy.pick(RELATIONS);
                let mut text = self.value(1);
                put(&mut text, format_args!(" {relation} "));
                self.write_value(&mut text, 1);
                text
            }
        }
    }

    fn write_function(&mut self, text: &mut String, depth: u32) {
        let start = text.len();
        self.write_value(text, depth);
        let function = self.entropy.below(17);
        let (before, behind) = match function {
            0 => ("sin[", "]"),
            1 => ("cos[", "]"),
            2 => ("atan[", "]/["),
            3 => ("sqrt[abs[", "]]"),
            4 => ("exp[[", "] mod 5]"),
            5 => ("ln[abs[", "] + 1]"),
            6 => ("asin[[", "] mod 1]"),
            7 => ("acos[[", "] mod 1]"),
            8 => ("tan[[", "] mod 45]"),
            9 => ("exists[#<", ">]"),
            10 | 11 => ("fix[", "]"),
            12 => ("fup[", "]"),
            13 | 14 => ("round[", "]"),
            _ => ("abs[", "]"),
        };
        if function == 9 {
            text.truncate(start);
            text.push_str(self.one_of(NAMES));
        }
        text.insert_str(start, before);
        text.push_str(behind);
        if function == 2 {
            self.write_value(text, depth);
            text.push(']');
        }
    }

    /// A parameter that can be read.
    pub(crate) fn parameter(&mut self) -> String {
        self.alone(Self::write_parameter)
    }

    fn write_parameter(&mut self, text: &mut String) {
        if !self.state.names.is_empty() && self.entropy.chance(35) {
            let name: &String = self.entropy.pick(&self.state.names);
            return put_name(text, name);
        }
        match self.entropy.below(12) {
            0 => put(text, format_args!("#[{} + 1]", self.entropy.pick(&["30", "31", "32"]))),
            1 => put_name(text, self.one_of(PREDEFINED)),
            _ => put_number(text, self.one_of(NUMBERED)),
        }
    }

    /// A parameter that has part of the state.
    pub(crate) fn state_parameter(&mut self) -> String {
        self.alone(Self::write_state_parameter)
    }

    fn write_state_parameter(&mut self, text: &mut String) {
        if self.entropy.chance(60) {
            put_name(text, self.one_of(PREDEFINED));
        } else {
            put_number(text, self.one_of(STATE_NUMBERED));
        }
    }

    /// A parameter that a program may set, as it is written before the equal sign.
    pub(crate) fn settable(&mut self) -> String {
        let mut text = String::with_capacity(FEW_CHARACTERS);
        if self.entropy.chance(30) {
            put_name(&mut text, self.one_of(NAMES));
        } else {
            put_number(&mut text, self.one_of(NUMBERED));
        }
        text
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

/// A named parameter.
fn put_name(text: &mut String, name: &str) {
    text.push_str("#<");
    text.push_str(name);
    text.push('>');
}

/// A numbered parameter.
fn put_number(text: &mut String, number: &str) {
    text.push('#');
    text.push_str(number);
}

fn put(text: &mut String, what: Arguments<'_>) {
    text.write_fmt(what).expect("a string can be written to");
}
