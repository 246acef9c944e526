//! Numbers as they are written (11.4.2.4): digits with one decimal point at most, blanks anywhere between them.

use gaugeblock_vocabulary::FaultKind;

use crate::faults::{PlantedFault, planted};
use crate::math;
use crate::syntax::Parsed;
use crate::syntax::cursor::Cursor;

/// Largest mantissa that a double holds exactly.
const EXACT: u64 = 1 << 53;
/// Powers of ten that a double holds exactly.
const POWERS: [f64; 23] = [
    1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15, 1e16,
    1e17, 1e18, 1e19, 1e20, 1e21, 1e22,
];
/// Powers of ten by the number of digits after a point.
const TENS: [u64; 8] = [1, 10, 100, 1_000, 10_000, 100_000, 1_000_000, 10_000_000];
/// Most characters of a number that the standard library reads.
const LONGEST: usize = 320;

/// Whether a number without a sign begins here.
#[inline]
pub(crate) fn begins(cursor: &Cursor<'_>) -> bool {
    matches!(cursor.peek(), b'0'..=b'9' | b'.')
}

/// Most digits of a short number: together they stay below 2^53.
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

/// A number of few adjacent digits.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Short {
    /// All digits as an integer.
    mantissa: u64,
    /// How many of them are after the point.
    decimals: usize,
    /// Bytes up to the text after it.
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

    /// Ten times the number, where that is an integer: a G code.
    #[inline]
    pub(crate) fn tenths(self) -> Option<u64> {
        match self.decimals {
            0 => Some(self.mantissa.wrapping_mul(10)),
            1 => Some(self.mantissa),
            _ => None,
        }
    }

    /// The number, where it is written without a point.
    #[inline]
    pub(crate) fn integer(self) -> Option<u64> {
        (self.decimals == 0).then_some(self.mantissa)
    }
}

/// Fast path of [`run_of_digits`]. Up to seven digits at the beginning of a text, read at once, and how many they
/// are. None where there may be more of them.
#[inline(always)]
fn few_digits(text: &[u8]) -> Option<(u64, usize)> {
    const ZEROS: u64 = 0x3030_3030_3030_3030;
    const SIXES: u64 = 0x7676_7676_7676_7676;
    const HIGHS: u64 = 0x8080_8080_8080_8080;
    const BYTES: u64 = 0x0000_00ff_0000_00ff;
    let digits = u64::from_le_bytes(*text.first_chunk::<8>()?) ^ ZEROS;
    // The high bit of the first byte that is not a digit; those after it do not matter.
    let others = (digits.wrapping_add(SIXES) | digits) & HIGHS;
    let bits = others.trailing_zeros() & 0x78;
    if others == 0 {
        return None;
    }
    // The digits go to the end of the eight bytes, zeros before them; then pairs, fours and all are joined.
    let eight = (digits << 1).wrapping_shl(63_u32.wrapping_sub(bits));
    let pairs = eight.wrapping_mul(10).wrapping_add(eight >> 8);
    let even = (pairs & BYTES).wrapping_mul(100 + (1_000_000 << 32));
    let odd = ((pairs >> 16) & BYTES).wrapping_mul(1 + (10_000 << 32));
    let count = usize::try_from(bits >> 3).unwrap_or(0);
    Some((even.wrapping_add(odd) >> 32, count))
}

/// Fast path of [`longer`]. The number at the beginning of a text, where it is a short one; the caller checks the
/// text after it.
#[inline]
pub(crate) fn plain(text: &[u8]) -> Option<Short> {
    let Some((whole, length)) = few_digits(text) else { return longer(text) };
    let rest = text.get(length..)?;
    let [b'.', behind @ ..] = rest else {
        return (length != 0).then_some(Short { mantissa: whole, decimals: 0, length });
    };
    let Some((behind_point, decimals)) = few_digits(behind) else { return longer(text) };
    let mantissa = whole.wrapping_mul(*TENS.get(decimals)?).wrapping_add(behind_point);
    let digits = length.wrapping_add(decimals);
    (digits != 0).then_some(Short { mantissa, decimals, length: digits.wrapping_add(1) })
}

/// A short number that may have more digits, or that may end the text.
#[inline(never)]
fn longer(text: &[u8]) -> Option<Short> {
    let mut mantissa = 0_u64;
    let whole = run_of_digits(text, 0, &mut mantissa);
    let (length, decimals) = if text.get(whole) == Some(&b'.') {
        let begin = whole.wrapping_add(1);
        let end = run_of_digits(text, begin, &mut mantissa);
        (end, end.wrapping_sub(begin))
    } else {
        (whole, 0)
    };
    let digits = whole.wrapping_add(decimals);
    (digits.wrapping_sub(1) < SHORT).then_some(Short { mantissa, decimals, length })
}

/// Fast path of [`unusual`]. The number at the beginning of a text, where it is a short one that ends there, as
/// nearly every number does.
#[inline]
pub(crate) fn short(text: &[u8]) -> Option<Short> {
    let number = plain(text)?;
    match text.get(number.length..)? {
        // Blanks may separate digits: the number continues if a digit or a point follows the blank.
        [b' ', b'0'..=b'9' | b'.' | b' ' | b'\t', ..] | [b'\t' | b'.', ..] => None,
        [b' ', ..] => Some(Short { length: number.length.wrapping_add(1), ..number }),
        _ => Some(number),
    }
}

/// Reads a number without a sign, rounded correctly.
#[inline]
pub(crate) fn unsigned(cursor: &mut Cursor<'_>) -> Parsed<f64> {
    match short(cursor.rest()) {
        Some(short) => {
            cursor.advance_to_next(short.length);
            Ok(short.value())
        }
        None => unusual(cursor),
    }
}

/// Reads a number that is long or has blanks in it.
#[cold]
fn unusual(cursor: &mut Cursor<'_>) -> Parsed<f64> {
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
    if digits == 0 && !planted(PlantedFault::PointAlone) {
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
fn slow(mut cursor: Cursor<'_>) -> Parsed<f64> {
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
