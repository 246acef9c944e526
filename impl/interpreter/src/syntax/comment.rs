//! Active comments (11.4.14 to 11.4.20): messages, logs, and an abort by the program.

use crate::faults::{PlantedFault, planted};
use crate::syntax::bytecode::{Act, CodeSegment, Comment, NONE, ParameterRef, Piece};
use crate::syntax::compiler::LineCompiler;
use crate::syntax::cursor::Cursor;
use crate::syntax::parameter::parameter_number;

/// The actions of comments, by their first word and a comma.
const ACTS: [(&[u8], Act); 7] = [
    (b"msg,", Act::Message),
    (b"debug,", Act::Debug),
    (b"print,", Act::Print),
    (b"log,", Act::Log),
    (b"logopen,", Act::LogOpen),
    (b"logappend,", Act::LogAppend),
    (b"abort,", Act::Abort),
];

/// Compiles the last comment of a block; none where it is a plain one.
pub(crate) fn pack(
    compiler: &mut LineCompiler,
    text: &[u8],
    into: &mut CodeSegment,
) -> Option<u32> {
    let (act, rest) = act(text, compiler.choices.message_free)?;
    let first_piece = into.pieces.len();
    let first = u32::try_from(first_piece).ok()?;
    match act {
        Act::Debug | Act::Print | Act::Log | Act::Abort => expand(compiler, rest, into),
        Act::Message => plain_text(rest, first_piece, into),
        Act::LogOpen | Act::LogAppend if compiler.choices.log_name_whole => {
            plain_text(rest, first_piece, into);
        }
        Act::LogOpen | Act::LogAppend | Act::ProbeOpen => {
            plain_text(without_blanks(rest), first_piece, into);
        }
        Act::LogClose | Act::ProbeClose => {}
    }
    let end = u32::try_from(into.pieces.len()).ok()?;
    let place = u32::try_from(into.comments.len()).ok()?;
    into.comments.push(Comment { act, first, end });
    Some(place)
}

/// The action of a comment, and its text.
fn act(text: &[u8], message_free: bool) -> Option<(Act, &[u8])> {
    for (word, act) in ACTS {
        if let Some(rest) = after(text, word) {
            return Some((act, rest));
        }
    }
    if message_free && let Some(rest) = after(text, b"msg") {
        return Some((Act::Message, rest));
    }
    if let Some(rest) = after(text, b"probeopen") {
        return Some((Act::ProbeOpen, rest));
    }
    for (word, act) in [(&b"logclose"[..], Act::LogClose), (b"probeclose", Act::ProbeClose)] {
        if after(text, word).is_some_and(|rest| without_blanks(rest).is_empty()) {
            return Some((act, &[]));
        }
    }
    None
}

/// The raw text after a word, whose letters may be separated by blanks; none where another word comes first.
fn after<'a>(text: &'a [u8], word: &[u8]) -> Option<&'a [u8]> {
    let mut rest = text;
    for byte in word {
        rest = behind_blanks(rest);
        let (first, others) = rest.split_first()?;
        if first.to_ascii_lowercase() != *byte {
            return None;
        }
        rest = others;
    }
    Some(rest)
}

/// The text after the blanks at the beginning: spaces and tabs are blanks (11.4.2), other control characters are not.
fn behind_blanks(mut text: &[u8]) -> &[u8] {
    while let [b' ' | b'\t', rest @ ..] = text {
        text = rest;
    }
    text
}

/// A text without the blanks at its ends.
fn without_blanks(text: &[u8]) -> &[u8] {
    let mut text = behind_blanks(text);
    while let [rest @ .., b' ' | b'\t'] = text {
        text = rest;
    }
    text
}

/// Characters as they are, joined to the piece before them.
fn literal(text: &[u8], into: &mut CodeSegment) {
    if text.is_empty() {
        return;
    }
    let first = u32::try_from(into.texts.len()).unwrap_or(NONE);
    into.texts.extend_from_slice(text);
    let end = u32::try_from(into.texts.len()).unwrap_or(NONE);
    match into.pieces.last_mut() {
        Some(Piece::Text(_, last)) if *last == first => *last = end,
        Some(_) | None => into.pieces.push(Piece::Text(first, end)),
    }
}

/// Text with parameters and formats (11.4.20).
fn expand(compiler: &mut LineCompiler, text: &[u8], into: &mut CodeSegment) {
    let first_piece = into.pieces.len();
    let mut rest = text;
    while let Some(place) = rest.iter().position(|byte| matches!(byte, b'#' | b'%')) {
        let (plain, special) = rest.split_at(place.min(rest.len()));
        plain_text(plain, first_piece, into);
        let taken = match special.first() {
            Some(b'%') => format(compiler, special),
            _ => parameter(compiler, special, into),
        };
        let length = match taken {
            Some((piece, length)) => {
                into.pieces.push(piece);
                length
            }
            None => {
                plain_text(special.get(..1).unwrap_or(&[]), first_piece, into);
                1
            }
        };
        rest = special.get(length..).unwrap_or(&[]);
    }
    plain_text(rest, first_piece, into);
}

/// Characters as they are, joined to those before them in the same comment.
fn plain_text(text: &[u8], first_piece: usize, into: &mut CodeSegment) {
    if into.pieces.len() > first_piece {
        literal(text, into);
    } else if !text.is_empty() {
        let first = u32::try_from(into.texts.len()).unwrap_or(NONE);
        into.texts.extend_from_slice(text);
        into.pieces.push(Piece::Text(first, u32::try_from(into.texts.len()).unwrap_or(NONE)));
    }
}

/// `%d`, `%f`, `%.3f` or `%lf`, and its length.
fn format(compiler: &LineCompiler, text: &[u8]) -> Option<(Piece, usize)> {
    let at = |place: usize| text.get(place).copied();
    match (at(1)?, at(2), at(3)) {
        (b'd', ..) => Some((Piece::Decimals(0), 2)),
        (b'f', ..) => Some((Piece::Decimals(if compiler.choices.format_six { 6 } else { 4 }), 2)),
        (b'l', Some(b'f'), _) => {
            Some((Piece::Decimals(if compiler.choices.default_four { 4 } else { 6 }), 3))
        }
        (b'.', Some(b'0'), Some(b'f')) if planted(PlantedFault::ZeroDecimals) => None,
        (b'.', Some(digit @ b'0'..=b'9'), Some(b'f')) => Some((Piece::Decimals(digit & 15), 4)),
        _ => None,
    }
}

/// `#123` or `#<name>`, and its length.
fn parameter(
    compiler: &mut LineCompiler,
    text: &[u8],
    into: &mut CodeSegment,
) -> Option<(Piece, usize)> {
    let after_sign = text.get(1..)?;
    if after_sign.first() == Some(&b'<') {
        let close = after_sign.iter().position(|byte| *byte == b'>')?;
        let name = after_sign.get(..=close)?;
        let mut cursor = Cursor::new(name);
        // An invalid name is one of a parameter that does not exist.
        let place = compiler.named(&mut cursor).unwrap_or(ParameterRef::Absent);
        let spaced = name.iter().any(|byte| matches!(byte, b' ' | b'\t'));
        let absent = spaced && planted(PlantedFault::SpacedNameAbsent);
        let place = if absent { ParameterRef::Absent } else { place };
        let piece = match place {
            ParameterRef::Local(id) => Piece::Local(id),
            ParameterRef::Global(id) => Piece::Global(id),
            ParameterRef::Mode(name) => Piece::Mode(name),
            ParameterRef::Internal(name) => Piece::Internal(name),
            ParameterRef::Entry(value) => {
                let place = u32::try_from(into.constants.len()).ok()?;
                into.constants.push(value);
                Piece::Constant(place)
            }
            ParameterRef::Absent | ParameterRef::Numbered(_) | ParameterRef::Indirect => {
                Piece::Absent
            }
        };
        return Some((piece, close.checked_add(2)?));
    }
    let digits = after_sign.iter().take_while(|byte| byte.is_ascii_digit()).count();
    if digits == 0 {
        return None;
    }
    let number = core::str::from_utf8(after_sign.get(..digits)?).ok()?.parse::<u32>();
    let number =
        number.ok().and_then(|number| parameter_number(f64::from(number), &compiler.choices).ok());
    let piece = number.map_or(Piece::Absent, |number| Piece::Numbered(u32::from(number)));
    Some((piece, digits.checked_add(1)?))
}
