//! Refused blocks: how far they came, and what is said.
//!
//! The sentences are our own, except those on which programs depend that read the output of `rs274`: short facts of its
//! interface, as observed.

use gaugeblock_vocabulary::{Fault, FaultKind, Plane, Position};

use super::codes::{CYCLES, MOTIONS};
use super::plane::in_plane;
use super::words::{Phase, Words};

/// A refused block, as far as a sentence about it needs it.
#[derive(Debug)]
pub(super) struct RefusedBlock<'a> {
    pub(super) fault: &'a Fault,
    pub(super) words: &'a Words,
    /// Its text.
    pub(super) line: &'a str,
    /// Where the controlled point was before it.
    pub(super) position: Position,
    pub(super) plane: Plane,
    /// Whether the program begins with a percent line.
    pub(super) percent: bool,
}

/// What is looked at before anything of a block is executed, and what after all but its motion, by how the message
/// begins.
const AT_ONCE: [&str; 4] = [
    "axis words that two",
    "a rotary axis word in a canned",
    "polar words together",
    "G53 without G0",
];
const WITH_MOTION: [&str; 8] = [
    "a lathe cycle",
    "a canned cycle under inverse",
    "a spline outside",
    "an arc outside",
    "an incremental polar move",
    "inverse time",
    "offsets of an arc with R",
    "tapping",
];

/// Up to which phase a refused block is executed; `modal` is the motion code in force before it.
pub(super) fn phase_reached(fault: &Fault, words: &Words, modal: u16) -> Phase {
    let explicit = words.g_of(&MOTIONS);
    let motion = explicit.unwrap_or(modal);
    let probes = (382..=385).contains(&motion);
    let arc_or_cycle = motion > 10 && motion != 800 && !probes;
    let says = |begun: &[&str]| begun.iter().any(|begun| fault.message.starts_with(begun));
    match fault.kind {
        Some(_) if says(&AT_ONCE) || missing_at_once(fault, words) => Phase::Comment,
        Some(_) if says(&WITH_MOTION) => Phase::Motion,
        // The spindle is on its way when its time is looked at.
        Some(_) if says(&["Q of M19"]) => Phase::Saved,
        Some(FaultKind::CompensationActive) => under_compensation(&fault.message),
        Some(_) if fault_of_compensation(fault, words) => Phase::Compensation,
        Some(FaultKind::Gouging) => before_gouging(words),
        Some(FaultKind::BadArc | FaultKind::ZeroFeed | FaultKind::Probe | FaultKind::ZeroSpeed) => {
            Phase::Motion
        }
        Some(FaultKind::MissingWord | FaultKind::WordOutOfRange | FaultKind::AxisWords)
            if arc_or_cycle =>
        {
            Phase::Motion
        }
        Some(FaultKind::UnusedWord) if fault.message.starts_with("an offset") && arc_or_cycle => {
            Phase::Motion
        }
        Some(FaultKind::ToolNotFound) => Phase::Tool,
        Some(FaultKind::UnknownCode) if is_user_code(fault) => Phase::Dwell,
        Some(FaultKind::NothingSaved) => Phase::Saved,
        _ => Phase::Comment,
    }
}

/// Whether nothing of the block is executed since a word is missing: each axis of a motion other than an arc, or a word
/// of a thread.
fn missing_at_once(fault: &Fault, words: &Words) -> bool {
    if fault.kind != Some(FaultKind::MissingWord) {
        return false;
    }
    let motion = words.g_of(&MOTIONS);
    let moves = motion.is_some_and(|code| !matches!(code, 20 | 30 | 52 | 53 | 800));
    let axes = b"XYZABCUVW".iter().any(|axis| words.get(*axis).is_some());
    moves && !axes || matches!(motion, Some(330 | 331 | 760))
}

/// Whether the program of a user-defined code is refused: none is found.
fn is_user_code(fault: &Fault) -> bool {
    fault.message == "refused from outside"
}

/// The phase of what cutter compensation forbids.
fn under_compensation(message: &str) -> Phase {
    let phases = [
        ("M66", Phase::Outputs),
        ("outputs", Phase::Outputs),
        ("M6", Phase::Change),
        ("overrides", Phase::Overrides),
        ("another plane", Phase::Plane),
        ("cutter compensation", Phase::Compensation),
        ("a tool length offset", Phase::Modes),
        ("selecting a coordinate system", Phase::Modes),
        ("changing an offset", Phase::Offsets),
        ("a predefined position", Phase::Offsets),
        ("a return mode", Phase::Modes),
        ("a path control mode", Phase::Modes),
        ("G53", Phase::Motion),
        ("a canned cycle", Phase::Motion),
        ("probing", Phase::Motion),
    ];
    let found = phases.iter().find(|(forbidden, _)| message.starts_with(forbidden));
    found.map_or(Phase::Comment, |(_, phase)| *phase)
}

/// The phase at which a last move is found not to fit: where what waits is put out, or at the next move.
fn before_gouging(words: &Words) -> Phase {
    let moves = b"XYZABCIJKR".iter().any(|letter| words.get(*letter).is_some());
    if words.g_of(&[400]).is_some() {
        Phase::Compensation
    } else if moves {
        Phase::Motion
    } else {
        Phase::Stop
    }
}

/// How far a canned cycle comes that is refused.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum CycleProgress {
    /// To the R plane, where the point was below it, and to another path mode.
    Above,
    /// To the R plane over its hole.
    OverHole,
}

/// How far the canned cycle has come that is refused; none where it is refused before it moves.
pub(super) fn cycle_progress(fault: &Fault, words: &Words) -> Option<CycleProgress> {
    words.g_of(&CYCLES)?;
    match fault.message.as_str() {
        "a cycle that dwells without P" | "a cycle that pecks without Q" | "P is negative" => {
            Some(CycleProgress::Above)
        }
        // A Q of -1 is taken for none.
        "Q is negative or zero"
            if words.get(b'Q').is_some_and(|q| q.to_bits() == (-1.0_f64).to_bits()) =>
        {
            Some(CycleProgress::Above)
        }
        "Q is negative or zero"
        | "G86 while the spindle is stopped"
        | "tapping while the spindle is stopped"
        | "tapping while the spindle turns the other way" => Some(CycleProgress::OverHole),
        _ => None,
    }
}

/// Codes that turn compensation on.
const COMPENSATIONS: [u16; 4] = [410, 420, 411, 421];

/// Whether compensation cannot be turned on: for the plane, or for a word of its code.
fn fault_of_compensation(fault: &Fault, words: &Words) -> bool {
    let of_plane =
        fault.kind == Some(FaultKind::ModalConflict) && fault.message.contains("outside of");
    let of_diameter =
        fault.kind == Some(FaultKind::MissingWord) && fault.message.starts_with("the D word");
    words.g_of(&COMPENSATIONS).is_some() && (of_plane || of_diameter)
}

/// Whether a label was looked for up to the end of the file.
pub(super) fn file_not_found(fault: &Fault) -> bool {
    match fault.kind {
        Some(FaultKind::UnknownSub | FaultKind::UnknownLabel) => true,
        Some(FaultKind::MissingEnd) => fault.message == "the sub does not end",
        _ => false,
    }
}

impl RefusedBlock<'_> {
    /// What is said of it.
    pub(super) fn sentence(&self) -> String {
        self.observed().unwrap_or_else(|| self.fault.message.clone())
    }

    fn observed(&self) -> Option<String> {
        let motion = self.words.g_of(&MOTIONS);
        let text = match self.fault.kind {
            Some(FaultKind::ZeroFeed) => match motion {
                Some(20 | 30) => "Cannot make arc with zero feed rate",
                Some(code) if CYCLES.contains(&code) => "Cannot feed with zero feed rate",
                _ => "Cannot do g1 with zero feed rate",
            },
            Some(FaultKind::Gouging) => return self.gouging(),
            Some(FaultKind::NothingSaved) => {
                "Cannot restore context from invalid stack frame - missing M70/M73?"
            }
            Some(FaultKind::DivideByZero) => "Attempt to divide by zero",
            Some(FaultKind::NestedSub) => "Nested subroutine definition",
            Some(FaultKind::MissingEnd) if self.percent => "File ended with no percent sign",
            Some(FaultKind::MissingEnd) => "File ended with no percent sign or program end",
            Some(FaultKind::BadArc) if matches!(motion, Some(20 | 30)) => return self.arc(),
            Some(FaultKind::MissingWord) => return self.missing_word(motion),
            Some(FaultKind::ParameterOutOfRange) => "Parameter number out of range",
            Some(FaultKind::AxisWords) if self.fault.message.contains("canned cycle") => {
                let turned = ["a", "b", "c"].into_iter().find(|axis| self.has(axis))?;
                return Some(format!("Cannot put an {turned} in canned cycle"));
            }
            Some(FaultKind::NoSuchParameter) => return self.absent(),
            Some(FaultKind::ReadOnlyParameter) => {
                let name = self.line.split_once("#<")?.1.split('>').next()?;
                return Some(format!(
                    "Cannot assign to read-only parameter #<{}>",
                    name.to_lowercase()
                ));
            }
            Some(FaultKind::FanucDisabled) => {
                let found = if self.has("m98") { "m98" } else { "m99" };
                return Some(format!("DISABLE_FANUC_STYLE_SUB set in INI file, but found {found}"));
            }
            Some(FaultKind::MixedStyles) => return self.mixed(),
            Some(FaultKind::UnknownCode) if is_user_code(self.fault) => {
                let code = self.words.m.iter().find(|code| **code >= 100)?;
                return Some(format!("Unknown m code used: M{code}"));
            }
            Some(FaultKind::ToolNotFound) => {
                let tool = self.words.get(b'T')?;
                return Some(format!("Requested tool {tool:.0} not found in the tool table"));
            }
            Some(FaultKind::BadExpression | FaultKind::BadNumber | FaultKind::BadBlock)
                if self.has("exists[") =>
            {
                return self.exists();
            }
            _ => return None,
        };
        Some(text.to_owned())
    }

    /// Whether the text holds something, blanks and cases apart.
    fn has(&self, what: &str) -> bool {
        let text: String = self.line.chars().filter(|letter| !letter.is_whitespace()).collect();
        text.to_lowercase().contains(what)
    }

    /// What cutter compensation cannot do.
    fn gouging(&self) -> Option<String> {
        let text = match self.fault.message.as_str() {
            "an arc as the first move after G40" => {
                "The move just after exiting cutter compensation mode must be straight, not an arc"
            }
            "an entry that is too short for the cutter's radius" => {
                "Length of cutter compensation entry move is not greater than the tool radius"
            }
            "an arc whose radius is not greater than the cutter's" => {
                "Tool radius not less than arc radius with comp"
            }
            "the cutter does not fit between two inner corners" => {
                "Straight feed in concave corner cannot be reached by the tool without gouging"
            }
            _ => return None,
        };
        Some(text.to_owned())
    }

    fn missing_word(&self, motion: Option<u16>) -> Option<String> {
        let text = match motion {
            Some(20 | 30) => "R i j k words all missing for arc",
            Some(382..=385) => "All axes missing with motion code",
            _ if self.has("m98") => "Found 'm98' code with no P-word",
            _ => return None,
        };
        Some(text.to_owned())
    }

    /// Subroutines of one style, called or ended in the other; the line is that of the head or the end of the sub.
    fn mixed(&self) -> Option<String> {
        let text = if self.has("m99") {
            "'O.... endsub' or 'O.... return' must follow 'O.... sub' subroutine definition"
        } else if self.has("endsub") {
            "Fanuc 'O....' subroutine definition must end with 'M99'"
        } else if self.has("m98") {
            "'O.... sub' subroutine must be called with 'O.... call'"
        } else {
            "Fanuc 'O....' subroutine must be called with 'M98'"
        };
        Some(text.to_owned())
    }

    /// The text that is printed with the sentence. For a call of the wrong style it is that of the definition.
    pub(super) fn message(&self) -> String {
        if self.fault.kind == Some(FaultKind::MixedStyles) {
            let line = self.line.trim();
            if let Some(at) = line.to_lowercase().find("call") {
                return line.get(..at).unwrap_or(line).trim_end().to_owned();
            }
            let label: String =
                line.chars().skip_while(|letter| !matches!(letter, 'P' | 'p')).skip(1).collect();
            if self.has("m98") {
                return format!("O{} sub", label.trim());
            }
        }
        self.line.to_owned()
    }

    fn exists(&self) -> Option<String> {
        let name = self.line.to_lowercase().split_once("exists[")?.1.trim_start().to_owned();
        let text = match name.as_bytes() {
            [b'#', b'<', ..] if !name.contains('>') => "Named parameter not terminated",
            [b'#', b']', ..] => "bad number format (conversion failed) parsing ''",
            [b'#', letter, ..] if letter.is_ascii_alphabetic() => {
                return Some(format!("Unknown word starting with {}", char::from(*letter)));
            }
            [b'#', ..] => "Expected ] reading bracketed parameter",
            _ => "Expected # reading parameter",
        };
        Some(text.to_owned())
    }

    /// A named parameter that does not exist: the first one of the line after an equals sign.
    fn absent(&self) -> Option<String> {
        let value = self.line.split_once('=').map_or(self.line, |(_, value)| value);
        let name = value.split_once("#<")?.1.split('>').next()?;
        // The name of an INI entry is shown with its first part in lower case.
        let name = match name.split_once('[') {
            Some((first, rest)) => format!("{}[{rest}", first.to_lowercase()),
            None => name.to_lowercase(),
        };
        Some(format!("Named parameter #<{name}> not defined"))
    }

    /// An arc whose radii differ.
    fn arc(&self) -> Option<String> {
        if self.words.get(b'R').is_some() {
            return Some("Arc radius too small to reach end point".to_owned());
        }
        let (axes, offsets) = match self.plane {
            Plane::Zx => ([b'Z', b'X'], [b'K', b'I']),
            Plane::Yz => ([b'Y', b'Z'], [b'J', b'K']),
            Plane::Xy | Plane::Uv | Plane::Wu | Plane::Vw => ([b'X', b'Y'], [b'I', b'J']),
        };
        let (start, _) = in_plane(self.plane, &self.position);
        let point = |letters: [u8; 2], value: [f64; 2]| {
            let [first, second] = letters.map(char::from);
            format!("({first}{:.4},{second}{:.4})", value[0], value[1])
        };
        let mut centre = start;
        let mut end = start;
        for place in 0..2 {
            centre[place] += self.words.get(offsets[place]).unwrap_or(0.0);
            end[place] = self.words.get(axes[place]).unwrap_or(end[place]);
        }
        let radius = |at: [f64; 2]| libm::hypot(at[0] - centre[0], at[1] - centre[1]);
        let (first, second) = (radius(start), radius(end));
        let (from, about, to) = (point(axes, start), point(axes, centre), point(axes, end));
        let ends = format!("start={from} center={about} end={to} r1={first:.4} r2={second:.4}");
        if self.fault.message == "an arc without a radius" {
            return Some(format!("Zero-radius arc: {ends}"));
        }
        let error = (first - second).abs();
        let relative = 100.0 * error / first.max(second);
        Some(format!(
            "Radius to end of arc differs from radius to start: {ends} abs_err={} rel_err={relative:.4}%",
            four_digits(error),
        ))
    }
}

/// A number with four significant digits and no trailing zeros.
fn four_digits(value: f64) -> String {
    let mut decimals = 3_usize;
    let mut scale = value;
    while scale > 0.0 && scale < 1.0 && decimals < 12 {
        scale *= 10.0;
        decimals += 1;
    }
    let mut large = value;
    while large >= 10.0 && decimals > 0 {
        large /= 10.0;
        decimals -= 1;
    }
    let text = format!("{value:.decimals$}");
    if text.contains('.') {
        text.trim_end_matches('0').trim_end_matches('.').to_owned()
    } else {
        text
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn errors_have_four_digits() {
        for (value, text) in
            [(0.285_71, "0.2857"), (3.0, "3"), (0.002_857, "0.002857"), (2.857, "2.857")]
        {
            assert_eq!(four_digits(value), text);
        }
    }
}
