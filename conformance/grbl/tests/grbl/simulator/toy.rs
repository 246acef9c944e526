//! A toy interpreter of modal codes and straight moves: enough to be observed.

use std::collections::BTreeMap;

/// Modes and offsets, in millimetres.
#[derive(Clone, Debug)]
pub(super) struct Toy {
    /// The code in force, in tenths, by modal group.
    groups: BTreeMap<u8, u32>,
    mist: bool,
    flood: bool,
    feed: f64,
    speed: f64,
    tool: u32,
    pub(super) machine: [f64; 3],
    pub(super) systems: [[f64; 3]; 6],
    pub(super) g92: [f64; 3],
    pub(super) tool_length: f64,
}

impl Default for Toy {
    fn default() -> Self {
        let mut toy = Self {
            groups: BTreeMap::new(),
            mist: false,
            flood: false,
            feed: 0.0,
            speed: 0.0,
            tool: 0,
            machine: [0.0; 3],
            systems: [[0.0; 3]; 6],
            g92: [0.0; 3],
            tool_length: 0.0,
        };
        toy.reset();
        toy
    }
}

/// Modal groups by code in tenths; M codes count from 10 000.
const GROUPS: &[(u8, &[u32])] = &[
    (1, &[0, 10, 20, 30, 800]),
    (2, &[170, 180, 190]),
    (3, &[900, 910]),
    (5, &[930, 940]),
    (6, &[200, 210]),
    (8, &[431, 490]),
    (12, &[540, 550, 560, 570, 580, 590]),
    (20, &[10_000, 10_020, 10_300]),
    (21, &[10_030, 10_040, 10_050]),
    (22, &[10_070, 10_080, 10_090]),
    (30, &[40, 100, 530, 920, 921]),
];

impl Toy {
    pub(super) fn reset(&mut self) {
        let codes = [0, 170, 900, 940, 210, 490, 540, 10_050];
        self.groups = codes.iter().filter_map(|code| Some((group(*code)?, *code))).collect();
        (self.mist, self.flood) = (false, false);
        (self.feed, self.speed, self.tool) = (0.0, 0.0, 0);
        (self.g92, self.tool_length) = ([0.0; 3], 0.0);
    }

    /// Machine position minus work position.
    pub(super) fn offset(&self) -> [f64; 3] {
        let system = self.systems[self.system()];
        let mut offset = [0, 1, 2].map(|axis| system[axis] + self.g92[axis]);
        offset[2] += self.tool_length;
        offset
    }

    fn system(&self) -> usize {
        place((self.groups[&12] - 540) / 10)
    }

    /// The value of `[GC:]`.
    pub(super) fn modes(&self, with_extensions: bool) -> String {
        let mut words = Vec::new();
        for group in [1, 12, 2, 6, 3, 5] {
            words.push(name(self.groups[&group]));
        }
        if with_extensions {
            words.push(name(self.groups[&8]));
            words.push("G98".to_owned());
            words.push("G50".to_owned());
        }
        words.push(name(self.groups[&21]));
        words.extend(self.mist.then(|| "M7".to_owned()));
        words.extend(self.flood.then(|| "M8".to_owned()));
        words.extend((!self.mist && !self.flood).then(|| "M9".to_owned()));
        words.push(format!("T{} F{:.0} S{:.0}", self.tool, self.feed, self.speed));
        words.join(" ")
    }

    /// Executes a block. True if it ends the program.
    pub(super) fn execute(&mut self, line: &str, is_checked: bool) -> Result<bool, u16> {
        let (codes, words) = read(line)?;
        let mut next = self.clone();
        let unit = |toy: &Self| if toy.groups[&6] == 200 { 25.4 } else { 1.0 };
        for code in &codes {
            if let Some(group) = group(*code).filter(|group| *group < 20 || *group == 21) {
                next.groups.insert(group, *code);
            }
        }
        let mm = unit(&next);
        if let Some(feed) = words.get(&'F') {
            next.feed = feed * mm;
        }
        next.speed = words.get(&'S').copied().unwrap_or(next.speed);
        next.tool = words.get(&'T').map_or(next.tool, |tool| whole(*tool));
        for code in &codes {
            match code {
                10_070 => next.mist = true,
                10_080 => next.flood = true,
                10_090 => (next.mist, next.flood) = (false, false),
                431 => next.tool_length = words.get(&'Z').ok_or(28_u16)? * mm,
                490 => next.tool_length = 0.0,
                _ => {}
            }
        }
        let axes = ['X', 'Y', 'Z'].map(|axis| words.get(&axis).map(|value| value * mm));
        next.axis_words(&codes, &words, axes, is_checked)?;
        let is_end = codes.contains(&10_020) || codes.contains(&10_300);
        if is_end {
            for code in [10, 170, 900, 940, 540, 10_050] {
                next.groups.extend(group(code).map(|group| (group, code)));
            }
            (next.mist, next.flood) = (false, false);
        }
        *self = next;
        Ok(is_end)
    }

    fn axis_words(
        &mut self,
        codes: &[u32],
        words: &BTreeMap<char, f64>,
        axes: [Option<f64>; 3],
        is_checked: bool,
    ) -> Result<(), u16> {
        let has_axes = axes.iter().any(Option::is_some);
        if codes.contains(&100) {
            let system = words.get(&'P').ok_or(28_u16)?;
            let number = whole(*system).checked_sub(1);
            let system = number.map_or_else(|| self.system(), place);
            for (axis, value) in axes.into_iter().enumerate() {
                let system = self.systems.get_mut(system).ok_or(29_u16)?;
                system[axis] = value.unwrap_or(system[axis]);
            }
        } else if codes.contains(&920) {
            let system = self.systems[self.system()];
            for (axis, value) in axes.into_iter().enumerate() {
                let at = self.machine[axis] - system[axis];
                self.g92[axis] = value.map_or(self.g92[axis], |value| at - value);
            }
        } else if codes.contains(&921) {
            self.g92 = [0.0; 3];
        } else if has_axes && !codes.contains(&431) {
            let motion = self.groups[&1];
            match motion {
                800 => return Err(31),
                10 if self.feed <= 0.0 => return Err(22),
                20 | 30 => return Err(35),
                _ => {}
            }
            let offset = if codes.contains(&530) { [0.0; 3] } else { self.offset() };
            let is_incremental = self.groups[&3] == 910;
            for (axis, value) in axes.into_iter().enumerate() {
                let at = if is_incremental { self.machine[axis] } else { offset[axis] };
                if let (Some(value), false) = (value, is_checked) {
                    self.machine[axis] = at + value;
                }
            }
        }
        Ok(())
    }
}

/// The nearest whole number; negative numbers are out of range.
fn whole(value: f64) -> u32 {
    format!("{value:.0}").parse().unwrap_or(20_000)
}

fn place(number: u32) -> usize {
    usize::try_from(number).unwrap_or(usize::MAX)
}

fn group(code: u32) -> Option<u8> {
    GROUPS.iter().find(|(_, codes)| codes.contains(&code)).map(|(group, _)| *group)
}

fn name(code: u32) -> String {
    let (letter, code) = if code >= 10_000 { ('M', code - 10_000) } else { ('G', code) };
    let tenths = if code % 10 == 0 { String::new() } else { format!(".{}", code % 10) };
    format!("{letter}{}{tenths}", code / 10)
}

/// Codes in tenths, and words.
fn read(line: &str) -> Result<(Vec<u32>, BTreeMap<char, f64>), u16> {
    let mut text = String::new();
    let mut in_comment = false;
    for c in line.chars() {
        match c {
            '(' => in_comment = true,
            ')' => in_comment = false,
            ';' => break,
            c if !in_comment && !c.is_whitespace() => text.push(c.to_ascii_uppercase()),
            _ => {}
        }
    }
    let (mut codes, mut words) = (Vec::new(), BTreeMap::new());
    let mut rest = text.as_str();
    while let Some(letter) = rest.chars().next() {
        if !letter.is_ascii_uppercase() {
            return Err(1);
        }
        rest = &rest[1..];
        let digits = |c: char| !(c.is_ascii_digit() || "+-.".contains(c));
        let end = rest.find(digits).unwrap_or(rest.len());
        let value: f64 = rest[..end].parse().map_err(|_| 2_u16)?;
        rest = &rest[end..];
        if letter == 'G' || letter == 'M' {
            let first = if letter == 'M' { 10_000 } else { 0 };
            let code = first + whole(value * 10.0);
            let group = group(code).ok_or(20_u16)?;
            if codes.iter().any(|other| self::group(*other) == Some(group)) {
                return Err(21);
            }
            codes.push(code);
        } else if words.insert(letter, value).is_some() {
            return Err(25);
        }
    }
    Ok((codes, words))
}
