//! Error messages and the kinds of fault that they mean.
//!
//! The messages carry no number, so a fragment of the text decides; the first row that the message contains wins. A
//! message without a row is a harness error, not a fault: a wrong kind would be judged, an unknown one is noticed.

use gaugeblock_vocabulary::FaultKind as Kind;

/// Fragments and kinds, special ones before general ones.
const FRAGMENTS: &[(&str, Kind)] = &[
    // Text.
    ("Command too long", Kind::LineTooLong),
    ("Bad character 'a' used", Kind::NoSuchAxis),
    ("Bad character 'b' used", Kind::NoSuchAxis),
    ("Bad character 'c' used", Kind::NoSuchAxis),
    ("Bad character 'u' used", Kind::NoSuchAxis),
    ("Bad character 'v' used", Kind::NoSuchAxis),
    ("Bad character 'w' used", Kind::NoSuchAxis),
    ("Bad character", Kind::BadCharacter),
    ("Unclosed comment", Kind::BadComment),
    ("Nested comment", Kind::BadComment),
    ("bad number format", Kind::BadNumber),
    ("No characters found in reading", Kind::BadNumber),
    ("Bad format unsigned integer", Kind::BadNumber),
    ("File ended with no percent sign", Kind::MissingEnd),
    // Expressions.
    ("Unclosed expression", Kind::BadExpression),
    ("Unknown operation", Kind::BadExpression),
    ("Unknown word where unary operation", Kind::BadExpression),
    ("Unknown word starting with", Kind::BadExpression),
    ("Left bracket missing", Kind::BadExpression),
    ("Slash missing after first atan", Kind::BadExpression),
    ("Expected # reading", Kind::BadExpression),
    ("Expected ] reading", Kind::BadExpression),
    ("divide by zero", Kind::DivideByZero),
    ("Calculation resulted in", Kind::OutOfDomain),
    ("Negative argument to sqrt", Kind::OutOfDomain),
    ("Zero or negative argument to ln", Kind::OutOfDomain),
    ("Argument to acos", Kind::OutOfDomain),
    ("Argument to asin", Kind::OutOfDomain),
    ("raise negative to non integer", Kind::OutOfDomain),
    // Parameters.
    ("Parameter number out of range", Kind::ParameterOutOfRange),
    ("read-only parameter", Kind::ReadOnlyParameter),
    ("Parameter is readonly", Kind::ReadOnlyParameter),
    ("Could not assign #<_hal[", Kind::ReadOnlyParameter),
    ("Equal sign missing", Kind::BadBlock),
    ("Named parameter not terminated", Kind::BadBlock),
    ("not found in INI file", Kind::NoSuchParameter),
    ("Named hal parameter", Kind::NoSuchParameter),
    ("not defined", Kind::NoSuchParameter),
    // Subroutines and control: before words, since some of them name words.
    ("Nested subroutine definition", Kind::NestedSub),
    ("redefining sub", Kind::DuplicateSub),
    ("duplicate O-word label", Kind::DuplicateLabel),
    ("undefined O-word label", Kind::UnknownLabel),
    ("no matching", Kind::UnknownLabel),
    ("ot in a subroutine definition", Kind::OutsideSub),
    ("Not in subroutine definition", Kind::OutsideSub),
    ("seeking o-word", Kind::UnknownSub),
    ("before EOF", Kind::UnknownSub),
    ("File not open", Kind::UnknownSub),
    ("Too many subroutine levels", Kind::TooManyLevels),
    ("Too many subroutine parameters", Kind::TooManyArguments),
    ("must be called with", Kind::MixedStyles),
    ("must end with 'M99'", Kind::MixedStyles),
    ("must follow 'O.... sub'", Kind::MixedStyles),
    ("instead of 'O endsub'", Kind::MixedStyles),
    ("DISABLE_FANUC_STYLE_SUB", Kind::FanucDisabled),
    ("code with no P-word", Kind::MissingWord),
    ("Internal error: Could not assign", Kind::BadBlock),
    ("Unexpected character after O-word", Kind::BadBlock),
    ("Unknown control command in o word", Kind::BadBlock),
    ("Unknown oword", Kind::BadBlock),
    ("found in illegal location", Kind::BadBlock),
    ("Unable to open file", Kind::BadFile),
    ("Cannot restore context", Kind::NothingSaved),
    // Words.
    ("words on one line", Kind::RepeatedWord),
    ("used from same modal group", Kind::ModalConflict),
    ("Too many m codes", Kind::TooManyMCodes),
    ("Unknown g code", Kind::UnknownCode),
    ("Unknown m code", Kind::UnknownCode),
    ("G-code out of range", Kind::UnknownCode),
    ("M-code greater than", Kind::UnknownCode),
    ("Negative g code", Kind::UnknownCode),
    ("Negative m code", Kind::UnknownCode),
    ("to use it", Kind::UnusedWord),
    ("word with no ", Kind::UnusedWord),
    ("Non integer value for integer", Kind::NotAnInteger),
    ("to be a whole number", Kind::NotAnInteger),
    ("not an integer", Kind::NotAnInteger),
    // Compensation.
    ("with cutter radius comp", Kind::CompensationActive),
    ("with cutter compensation", Kind::CompensationActive),
    ("with tool radius comp", Kind::CompensationActive),
    ("cutter radius comp on when on", Kind::CompensationActive),
    ("compensation allowed only in", Kind::ModalConflict),
    ("gouging", Kind::Gouging),
    ("concave corner", Kind::Gouging),
    ("cutter compensation entry", Kind::Gouging),
    ("Radius of cutter compensation", Kind::Gouging),
    ("Tool radius not less", Kind::Gouging),
    ("inside corner", Kind::Gouging),
    // Spindles and tools.
    ("Spindle ($) number out of range", Kind::SpindleOutOfRange),
    ("Invalid spindle ($) number", Kind::SpindleOutOfRange),
    ("zero spindle speed", Kind::ZeroSpeed),
    ("pindle not turning", Kind::ZeroSpeed),
    ("not turning in G76", Kind::ZeroSpeed),
    ("Spindle turning", Kind::ModalConflict),
    ("Requested tool -", Kind::WordOutOfRange),
    ("Negative tool id", Kind::WordOutOfRange),
    ("not found in the tool table", Kind::ToolNotFound),
    ("Need tool prepared", Kind::MissingWord),
    // Motion and settings.
    ("Zero feed", Kind::ZeroFeed),
    ("zero feed rate", Kind::ZeroFeed),
    ("0 feedrate", Kind::ZeroFeed),
    ("without a g code that uses them", Kind::AxisWords),
    ("both use axis values", Kind::AxisWords),
    ("axis values with g80", Kind::AxisWords),
    ("All axes missing", Kind::MissingWord),
    ("F word missing", Kind::MissingWord),
    ("S word missing", Kind::MissingWord),
    ("Dwell time missing", Kind::MissingWord),
    ("word missing", Kind::MissingWord),
    ("words missing", Kind::MissingWord),
    ("words all missing", Kind::MissingWord),
    ("No valid P word", Kind::MissingWord),
    ("with no D word", Kind::MissingWord),
    ("Need to have either a valid P", Kind::MissingWord),
    ("Need non-negative Q-word", Kind::WordOutOfRange),
    ("does not have L0", Kind::WordOutOfRange),
    ("out of range", Kind::WordOutOfRange),
    ("out of bounds", Kind::WordOutOfRange),
    ("must be", Kind::WordOutOfRange),
    ("requires a value", Kind::WordOutOfRange),
    ("should be 1 or greater", Kind::WordOutOfRange),
    ("Invalid analog index", Kind::WordOutOfRange),
    ("Negative f word", Kind::WordOutOfRange),
    ("Negative spindle speed", Kind::WordOutOfRange),
    ("Negative h word", Kind::WordOutOfRange),
    ("Negative l word", Kind::WordOutOfRange),
    ("Negative d word", Kind::WordOutOfRange),
    ("Negative or zero q value", Kind::WordOutOfRange),
    ("Zero timeout", Kind::WordOutOfRange),
    ("zero repeats", Kind::WordOutOfRange),
    ("Can't select analog input", Kind::WordOutOfRange),
    ("both a digital and an analog", Kind::ModalConflict),
    ("G4 not allowed with G2 or G3", Kind::ModalConflict),
    ("g53 incremental", Kind::ModalConflict),
    ("g0 or g1 with g53", Kind::ModalConflict),
    ("Cannot use g53", Kind::ModalConflict),
    ("not allowed with loaded tool", Kind::ModalConflict),
    ("not allowed with G10", Kind::UnusedWord),
    ("not allowed in G10", Kind::UnusedWord),
    ("without offsets has no effect", Kind::MissingWord),
    ("but plane is not G18", Kind::ModalConflict),
    ("Can not have both H and axis words", Kind::AxisWords),
    ("polar coordinate except in G17", Kind::ModalConflict),
    ("polar coordinates with G53", Kind::ModalConflict),
    ("lacking X or Y axes", Kind::NoSuchAxis),
    ("olar coordinate", Kind::AxisWords),
    ("Invalid absolute position", Kind::WordOutOfRange),
    ("Indexing axis", Kind::AxisWords),
    ("Invalid tool orientation", Kind::WordOutOfRange),
    // Arcs, cycles and probing.
    ("Mixed radius ijk", Kind::BadArc),
    ("given for arc", Kind::BadArc),
    ("Radius to end of arc differs", Kind::BadArc),
    ("Zero-radius arc", Kind::BadArc),
    ("Arc radius too small", Kind::BadArc),
    ("same as end point of arc", Kind::BadArc),
    ("Cannot probe", Kind::Probe),
    ("too close to probe point", Kind::Probe),
    ("unspecified in", Kind::MissingWord),
    ("R less than", Kind::WordOutOfRange),
    ("canned cycle", Kind::ModalConflict),
    ("arc in planes", Kind::ModalConflict),
    ("for plane", Kind::ModalConflict),
    ("can only be used in XZ plane", Kind::ModalConflict),
    ("arcs have the same center", Kind::Gouging),
    ("intersect parallel lines", Kind::Gouging),
    ("Corner finish failed", Kind::Gouging),
    ("F word used with", Kind::UnusedWord),
    ("rotary axes with G76", Kind::AxisWords),
    ("In G76, I must not", Kind::WordOutOfRange),
    ("Invalid D-number in G76", Kind::SpindleOutOfRange),
    ("Invalid D-number", Kind::WordOutOfRange),
    ("Invalid E-number", Kind::WordOutOfRange),
    ("Spindle state unknown", Kind::ZeroSpeed),
    ("G7X error", Kind::BadBlock),
    ("G7x error", Kind::BadBlock),
    ("G7x.x", Kind::MissingWord),
    ("Not monotonic", Kind::BadBlock),
    ("Between G5.2 and G5.3", Kind::ModalConflict),
    ("without G5.2 first", Kind::ModalConflict),
    ("Splines may not have motion", Kind::AxisWords),
    ("Must specify both", Kind::MissingWord),
    ("Must specify positive weight", Kind::WordOutOfRange),
    ("Can specify P without X and Y", Kind::MissingWord),
    ("You must specify", Kind::MissingWord),
];

/// What a message means, if a row explains it.
pub(crate) fn kind(message: &str) -> Option<Kind> {
    FRAGMENTS.iter().find(|(fragment, _)| message.contains(fragment)).map(|(_, kind)| *kind)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn special_rows_come_before_general_ones() {
        for (message, expected) in [
            ("Parameter number out of range", Kind::ParameterOutOfRange),
            ("Spindle ($) number out of range in M3 Command", Kind::SpindleOutOfRange),
            ("G-code out of range", Kind::UnknownCode),
            ("P value out of range (0-9) with G10 L2", Kind::WordOutOfRange),
            ("Negative tool id (tool not found)", Kind::WordOutOfRange),
            ("Requested tool -1 not found in the tool table", Kind::WordOutOfRange),
            ("Requested tool 1 not found in the tool table", Kind::ToolNotFound),
            ("Named parameter #<a> not defined", Kind::NoSuchParameter),
            ("3: not in a subroutine definition: 'o1 endsub'", Kind::OutsideSub),
            ("Cannot use g53 with cutter radius comp", Kind::CompensationActive),
            (
                "M7x: restore_settings failed executing: ' G96': S word missing with G96",
                Kind::MissingWord,
            ),
            ("Cannot feed with zero spindle speed in feed per rev mode", Kind::ZeroSpeed),
        ] {
            assert_eq!(kind(message), Some(expected), "{message}");
        }
        assert_eq!(kind("something new"), None);
    }

    #[test]
    fn the_adapter_in_python_has_the_same_rows() {
        let python = include_str!("../../python/instrumentation/faults.py");
        let (_, table) = python.split_once("KINDS = [\n").unwrap();
        let (table, _) = table.split_once("\n]\n").unwrap();
        let lines = table.lines().filter(|line| !line.trim_start().starts_with('#'));
        let table = lines.collect::<Vec<_>>().join("\n");
        let parts: Vec<_> = table.split('"').collect();
        let mut kind = "";
        let mut rows = Vec::new();
        for part in parts.chunks_exact(2) {
            if part[0].ends_with('(') {
                kind = part[1];
            } else {
                rows.push((part[1], kind));
            }
        }
        let own: Vec<_> = FRAGMENTS.iter().map(|(row, kind)| (*row, kind.word())).collect();
        assert_eq!(rows, own);
    }

    #[test]
    fn every_row_can_be_reached() {
        for (fragment, expected) in FRAGMENTS {
            let first = FRAGMENTS.iter().find(|(earlier, _)| fragment.contains(earlier));
            assert_eq!(first.map(|row| row.1), Some(*expected), "{fragment} is shadowed");
        }
    }
}
