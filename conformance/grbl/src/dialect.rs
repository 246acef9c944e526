//! Members of the family, and what their numbers of errors and alarms mean.
//!
//! The tables follow the lists of error and alarm codes that Grbl 1.1 and grblHAL publish. A number with no kind is a
//! refusal whose reason the vocabulary has no word for.

use std::collections::BTreeSet;

use gaugeblock_adapter::protocol::{CommentKind, DeclaredLanguage, ParameterKind};
use gaugeblock_vocabulary::{FaultKind, FeedMode};

use crate::message::Welcome;
use crate::words::Words;

/// A member of the family.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Dialect {
    /// Grbl 1.1.
    Grbl,
    /// grblHAL.
    GrblHal,
}

/// What an error or an alarm means.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Meaning {
    /// The block is refused, with the kind if there is a word for it.
    Refused(Option<FaultKind>),
    /// The controller or the machine is in no state to run programs; the text is a hint.
    NotReady(&'static str),
    /// The list has no such number, or it is not about programs.
    Unknown,
}

const LOCKED: &str = "an alarm locks it; home the machine, or permit `$X` with the option `unlock`";
const DOOR: &str = "the safety door is open; close it";
const STOPPED: &str = "the emergency stop or a motor fault is active; clear it";
const CHANGE: &str = "a tool change is pending; complete or cancel it";

impl Dialect {
    /// The dialect of a welcome line.
    pub(crate) fn of(welcome: &Welcome) -> Option<Self> {
        if !welcome.version.starts_with("1.1") {
            return None;
        }
        match welcome.name.to_lowercase().as_str() {
            "grbl" => Some(Self::Grbl),
            "grblhal" => Some(Self::GrblHal),
            _ => None,
        }
    }

    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            Self::Grbl => "Grbl",
            Self::GrblHal => "grblHAL",
        }
    }

    /// What `error:N` means after a block with these words, in the feed mode before it. A block with two errors may be
    /// refused for either: the documents do not say which is reported.
    pub(crate) fn error(self, number: u16, block: &Words, before: Option<FeedMode>) -> Meaning {
        let refused = |kind| Meaning::Refused(Some(kind));
        match number {
            4 | 20 if block.repeats_a_letter() => Meaning::Refused(None),
            // Two codes that use axis words, and of one group.
            24 if block.has_two_of_a_group() => Meaning::Refused(None),
            22 if block.is_in_inverse_time(before) => refused(FaultKind::MissingWord),
            23 if block.has_code_with_decimals() => refused(FaultKind::UnknownCode),
            1 => refused(FaultKind::BadCharacter),
            2 => refused(FaultKind::BadNumber),
            4 | 27 => refused(FaultKind::WordOutOfRange),
            8 => Meaning::NotReady("it is not idle; wait for the end of its motion, or reset it"),
            9 => Meaning::NotReady(LOCKED),
            11 => refused(FaultKind::LineTooLong),
            13 => Meaning::NotReady(DOOR),
            20 | 29 => refused(FaultKind::UnknownCode),
            21 | 30 => refused(FaultKind::ModalConflict),
            22 => refused(FaultKind::ZeroFeed),
            23 => refused(FaultKind::NotAnInteger),
            24 | 31 | 37 => refused(FaultKind::AxisWords),
            25 => refused(FaultKind::RepeatedWord),
            26 | 28 | 32 | 35 => refused(FaultKind::MissingWord),
            33 if block.has('G', &[382, 383, 384, 385]) => refused(FaultKind::Probe),
            33 | 34 => refused(FaultKind::BadArc),
            36 => refused(FaultKind::UnusedWord),
            38 if self == Self::Grbl => refused(FaultKind::WordOutOfRange),
            _ if self == Self::GrblHal => hal_error(number),
            _ => Meaning::Unknown,
        }
    }

    /// What `ALARM:N` means.
    pub(crate) fn alarm(self, number: u16) -> Meaning {
        match (self, number) {
            (_, 2) => Meaning::Refused(Some(FaultKind::BeyondLimit)),
            (_, 4 | 5) | (Self::GrblHal, 13) => Meaning::Refused(Some(FaultKind::Probe)),
            (_, 1) | (Self::GrblHal, 12) => {
                Meaning::NotReady("a limit switch is engaged; release it and home the machine")
            }
            (_, 3 | 6..=9) | (Self::Grbl, 10) | (Self::GrblHal, 11 | 15 | 18) => {
                Meaning::NotReady(LOCKED)
            }
            (Self::GrblHal, 10 | 17) => Meaning::NotReady(STOPPED),
            (Self::GrblHal, 14) => Meaning::Refused(Some(FaultKind::ZeroSpeed)),
            (Self::GrblHal, 16 | 19..=22) => {
                Meaning::NotReady("it reports a failure of its hardware")
            }
            _ => Meaning::Unknown,
        }
    }

    /// The part of RS-274 that its documents list. `features` are what `[NEWOPT:]` and `[AXS:]` name.
    pub(crate) fn language(self, features: &Features) -> DeclaredLanguage {
        let (mut g, mut m) = (codes(GRBL_G), codes(GRBL_M));
        if self == Self::GrblHal {
            g.extend(codes(HAL_G));
            m.extend(codes(HAL_M));
        }
        let words = [("G10 L2", "PXYZABCUVW"), ("G10 L20", "PXYZABCUVW"), ("G43.1", "XYZABCUVW")];
        let parameters =
            features.expressions.then_some([ParameterKind::Numbered, ParameterKind::Named]);
        DeclaredLanguage {
            g: Some(g),
            m: Some(m),
            words: words.map(|(code, words)| (code.to_owned(), words.to_owned())).into(),
            axes: Some(features.axes.clone()),
            letters: Some("FSTN".to_owned()),
            parameters: Some(parameters.into_iter().flatten().collect()),
            greatest_parameter: None,
            expressions: Some(features.expressions),
            comparisons: None,
            o_words: Some(false),
            comments: Some([CommentKind::Parentheses, CommentKind::Semicolon].into()),
        }
    }
}

/// What a build of the controller has.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Features {
    /// Letters of the axes.
    pub(crate) axes: String,
    /// Whether it evaluates expressions and parameters.
    pub(crate) expressions: bool,
}

impl Default for Features {
    fn default() -> Self {
        Self { axes: "XYZ".to_owned(), expressions: false }
    }
}

const GRBL_G: &[&str] = &[
    "0", "1", "2", "3", "4", "10", "17", "18", "19", "20", "21", "28", "28.1", "30", "30.1",
    "38.2", "38.3", "38.4", "38.5", "40", "43.1", "49", "53", "54", "55", "56", "57", "58", "59",
    "61", "80", "90", "91", "91.1", "92", "92.1", "93", "94",
];
const GRBL_M: &[&str] = &["0", "1", "2", "3", "4", "5", "7", "8", "9", "30"];
const HAL_G: &[&str] =
    &["5", "5.1", "59.1", "59.2", "59.3", "73", "81", "82", "83", "85", "86", "89", "98", "99"];
const HAL_M: &[&str] = &["48", "49", "50", "51", "53", "60", "61"];

fn codes(names: &[&str]) -> BTreeSet<String> {
    names.iter().map(|name| (*name).to_owned()).collect()
}

/// Errors that grblHAL has in addition to those of Grbl 1.1.
fn hal_error(number: u16) -> Meaning {
    let refused = |kind| Meaning::Refused(Some(kind));
    match number {
        19 | 39 | 43 | 44 | 54 => refused(FaultKind::WordOutOfRange),
        38 => refused(FaultKind::ToolNotFound),
        40 => Meaning::NotReady(CHANGE),
        41 => refused(FaultKind::ZeroSpeed),
        42 | 48 => refused(FaultKind::ModalConflict),
        45 | 46 => Meaning::NotReady(LOCKED),
        50 | 51 | 79 => Meaning::NotReady(STOPPED),
        58 => refused(FaultKind::NoSuchInputOrOutput),
        71 | 75 => refused(FaultKind::BadExpression),
        72 => refused(FaultKind::DivideByZero),
        73 | 74 | 76 => refused(FaultKind::OutOfDomain),
        81 => refused(FaultKind::BadBlock),
        82 | 83 => refused(FaultKind::TooManyLevels),
        84 => refused(FaultKind::BadFile),
        90 | 91 => refused(FaultKind::CompensationActive),
        92 => refused(FaultKind::Gouging),
        253 => refused(FaultKind::AbortedByProgram),
        15 | 47 | 56 | 80 | 87 | 88 => Meaning::Refused(None),
        77 | 78 => Meaning::NotReady("it requires a password"),
        _ => Meaning::Unknown,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn welcome(name: &str, version: &str) -> Welcome {
        Welcome { name: name.to_owned(), version: version.to_owned() }
    }

    #[test]
    fn dialect_follows_from_the_welcome_line() {
        assert_eq!(Dialect::of(&welcome("Grbl", "1.1h")), Some(Dialect::Grbl));
        assert_eq!(Dialect::of(&welcome("GrblHAL", "1.1f")), Some(Dialect::GrblHal));
        assert_eq!(Dialect::of(&welcome("Grbl", "0.9j")), None);
        assert_eq!(Dialect::of(&welcome("Grbl", "3.7")), None);
    }

    #[test]
    fn lock_is_no_fault_of_the_program() {
        let none = Words::default();
        for dialect in [Dialect::Grbl, Dialect::GrblHal] {
            assert_eq!(dialect.error(9, &none, None), Meaning::NotReady(LOCKED));
            assert_eq!(dialect.alarm(2), Meaning::Refused(Some(FaultKind::BeyondLimit)));
        }
    }

    #[test]
    fn number_means_what_the_dialect_lists() {
        let after =
            |dialect: Dialect, number, block| dialect.error(number, &Words::of(block), None);
        let kind = |kind| Meaning::Refused(Some(kind));
        let (grbl, hal) = (Dialect::Grbl, Dialect::GrblHal);
        assert_eq!(after(grbl, 38, ""), kind(FaultKind::WordOutOfRange));
        assert_eq!(after(hal, 38, ""), kind(FaultKind::ToolNotFound));
        assert_eq!(after(grbl, 72, ""), Meaning::Unknown);
        assert_eq!(after(hal, 72, ""), kind(FaultKind::DivideByZero));
        assert_eq!(after(grbl, 33, "g2x0i1"), kind(FaultKind::BadArc));
        assert_eq!(after(grbl, 33, "g38.2x0"), kind(FaultKind::Probe));
        assert_eq!(after(grbl, 23, "t1.5"), kind(FaultKind::NotAnInteger));
        assert_eq!(after(grbl, 23, "g17.5"), kind(FaultKind::UnknownCode));
        let of_inverse_time =
            |block| grbl.error(22, &Words::of(block), Some(FeedMode::InverseTime));
        assert_eq!(after(grbl, 22, "g1x1"), kind(FaultKind::ZeroFeed));
        assert_eq!(after(grbl, 22, "g93g1x1"), kind(FaultKind::MissingWord));
        assert_eq!(of_inverse_time("g1x1"), kind(FaultKind::MissingWord));
        assert_eq!(of_inverse_time("g94g1x1"), kind(FaultKind::ZeroFeed));
    }

    #[test]
    fn number_of_a_block_with_two_errors_has_no_kind() {
        let after = |number, block| Dialect::Grbl.error(number, &Words::of(block), None);
        for (number, block) in [(20, "d1d2"), (4, "g4p-1p1"), (24, "g28g92x1"), (24, "g49g43.1z1")]
        {
            assert_eq!(after(number, block), Meaning::Refused(None), "{block}");
        }
        assert_eq!(after(24, "g10l2p1g1x1"), Meaning::Refused(Some(FaultKind::AxisWords)));
    }
}
