//! Numbers as they are written (11.4.2.4): digits with one decimal point at most, blanks anywhere between them.

use gaugeblock_trace::FaultKind;

use crate::math;
use crate::syntax::Packed;
use crate::syntax::cursor::Cursor;

/// Largest mantissa that a double holds exactly.
const EXACT: u64 = 1 << 53;
/// Powers of ten that a double holds exactly.
const POWERS: [f64; 23] = [
    1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15, 1e16,
    1e17, 1e18, 1e19, 1e20, 1e21, 1e22,
];
/// Most characters of a number that is read the slow way.
const LONGEST: usize = 320;

/// Whether a number without a sign begins here.
#[inline]
pub(crate) fn begins(cursor: &Cursor<'_>) -> bool {
    matches!(cursor.peek(), b'0'..=b'9' | b'.')
}

/// Most digits of a number that is read the short way: together they stay below 2^53.
const SHORT: usize = 15;

/// Adds the digits from a place on to a mantissa; where they end.
#[inline]
fn run_of_digits(text: &[u8], from: usize, mantissa: &mut u64) -> usize {
    let mut place = from;
    while let Some(byte) = text.get(place) {
        let digit = byte.wrapping_sub(b'0');
        if digit > 9 {
            break;
        }
        *mantissa = mantissa.wrapping_mul(10).wrapping_add(u64::from(digit));
        place = place.wrapping_add(1);
    }
    place
}

/// A number of few digits that stand together.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Short {
    /// All digits as an integer.
    mantissa: u64,
    /// How many of them stand behind the point.
    decimals: usize,
    /// Bytes up to the next character that is no blank.
    pub(crate) length: usize,
}

impl Short {
    /// The number, rounded correctly: both parts of the division are exact.
    #[inline]
    pub(crate) fn value(self) -> f64 {
        let number = math::from_u64(self.mantissa);
        match POWERS.get(self.decimals) {
            Some(power) if self.decimals != 0 => number / power,
            Some(_) | None => number,
        }
    }

    /// The number, where it is written without a point.
    #[inline]
    pub(crate) fn integer(self) -> Option<u64> {
        (self.decimals == 0).then_some(self.mantissa)
    }
}

/// The number at the beginning of a text, where it is a short one. This is what nearly every number is.
#[inline]
pub(crate) fn short(text: &[u8]) -> Option<Short> {
    let mut mantissa = 0_u64;
    let whole = run_of_digits(text, 0, &mut mantissa);
    let (end, decimals) = if text.get(whole) == Some(&b'.') {
        let begin = whole.wrapping_add(1);
        let end = run_of_digits(text, begin, &mut mantissa);
        (end, end.wrapping_sub(begin))
    } else {
        (whole, 0)
    };
    let digits = whole.wrapping_add(decimals);
    if digits.wrapping_sub(1) >= SHORT {
        return None;
    }
    match text.get(end) {
        // Digits may stand apart: the number goes on behind the blank if a digit or a point does.
        Some(b' ') => match text.get(end.wrapping_add(1)) {
            Some(b'0'..=b'9' | b'.' | b' ' | b'\t') => None,
            Some(_) | None => Some(Short { mantissa, decimals, length: end.wrapping_add(1) }),
        },
        Some(b'\t' | b'.') => None,
        Some(_) | None => Some(Short { mantissa, decimals, length: end }),
    }
}

/// Reads a number without a sign, rounded correctly.
#[inline]
pub(crate) fn unsigned(cursor: &mut Cursor<'_>) -> Packed<f64> {
    match short(cursor.rest()) {
        Some(short) => {
            cursor.advance_to_next(short.length);
            Ok(short.value())
        }
        None => unusual(cursor),
    }
}

/// Reads a number that is long or stands apart.
#[cold]
fn unusual(cursor: &mut Cursor<'_>) -> Packed<f64> {
    let start = *cursor;
    let mut mantissa = 0_u64;
    let mut digits = 0_usize;
    let mut decimals = 0_usize;
    let mut point = false;
    loop {
        let byte = cursor.peek();
        match byte {
            b'0'..=b'9' => {
                if mantissa < EXACT {
                    mantissa = mantissa.wrapping_mul(10).wrapping_add(u64::from(byte & 15));
                } else {
                    mantissa = u64::MAX;
                }
                digits = digits.wrapping_add(1);
                decimals = decimals.wrapping_add(usize::from(point));
            }
            b'.' if point => {
                return cursor.refuse(FaultKind::BadNumber, "a number has one decimal point");
            }
            b'.' => point = true,
            _ => break,
        }
        cursor.step();
    }
    if digits == 0 {
        return start.refuse(FaultKind::BadNumber, "a number has a digit");
    }
    if mantissa <= EXACT
        && let Some(power) = POWERS.get(decimals)
    {
        let number = math::from_u64(mantissa);
        return Ok(if decimals == 0 { number } else { number / power });
    }
    slow(start)
}

/// Reads a long number through the standard library.
#[cold]
fn slow(mut cursor: Cursor<'_>) -> Packed<f64> {
    let mut text = [0_u8; LONGEST];
    let mut length = 0_usize;
    while begins(&cursor) {
        let Some(slot) = text.get_mut(length) else {
            return cursor.refuse(FaultKind::BadNumber, "too many digits");
        };
        *slot = cursor.peek();
        length = length.wrapping_add(1);
        cursor.step();
    }
    let number = text
        .get(..length)
        .and_then(|text| core::str::from_utf8(text).ok())
        .and_then(|text| text.parse::<f64>().ok());
    match number {
        Some(number) => Ok(number),
        None => cursor.refuse(FaultKind::BadNumber, "not a number"),
    }
}

/// Reads an unsigned integer, such as the number of an o-word, as digits into a text.
pub(crate) fn digits(cursor: &mut Cursor<'_>, into: &mut alloc::string::String) {
    while cursor.peek().is_ascii_digit() {
        into.push(char::from(cursor.peek()));
        cursor.step();
    }
}
