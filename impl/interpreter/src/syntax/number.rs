//! Reads numbers (11.4.2.4): digits with one decimal point at most, blanks anywhere between them.
//!
//! Nearly every number is short: at most 15 adjacent digits. Each reader leaves what it cannot read to the next one:
//!
//! ```text
//! read_unsigned                       any number without a sign
//!   read_short                          a short number, where the text after it does not continue it
//!     read_short_prefix                   a short number at the beginning of a text, whatever follows
//!       read_few_digits                     up to seven digits, eight bytes at once
//!       read_short_prefix_bytewise          eight digits or more, or fewer than eight bytes of text: byte by byte
//!   read_spaced_or_long                 blanks between digits, or a mantissa of up to 2^53
//!     read_long                           all other numbers, by the standard library
//! ```

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
/// Most digits and points of a number that [`read_long`] reads.
const SLOW_CHARACTERS_MAX: usize = 320;

/// Whether a number without a sign begins here.
#[inline]
pub(crate) fn begins(cursor: &Cursor<'_>) -> bool {
    matches!(cursor.peek(), b'0'..=b'9' | b'.')
}

/// Most digits of a short number: its mantissa stays below 2^53.
const SHORT_DIGITS_MAX: usize = 15;

/// Appends the digits of a text from a place on to a mantissa. Returns where they end.
#[inline]
fn add_digits(text: &[u8], from: usize, mantissa: &mut u64) -> usize {
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

/// A number of at most [`SHORT_DIGITS_MAX`] adjacent digits.
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

/// Fast path of [`add_digits`]. Returns the value of up to seven digits at the beginning of a text, and their count.
/// None where there may be more digits, or where the text has fewer than eight bytes.
///
/// It works on eight bytes as one integer; the first byte of the text is the lowest.
#[inline(always)]
fn read_few_digits(text: &[u8]) -> Option<(u64, usize)> {
    const ZEROS: u64 = 0x3030_3030_3030_3030;
    const CARRY_ABOVE_NINE: u64 = 0x7676_7676_7676_7676;
    const HIGHS: u64 = 0x8080_8080_8080_8080;
    const BYTES: u64 = 0x0000_00ff_0000_00ff;
    // A digit becomes its value, 0 to 9; any other byte becomes more than 9.
    let digits = u64::from_le_bytes(*text.first_chunk::<8>()?) ^ ZEROS;
    // 0x76 + 0x0A is 0x80: the addition sets the high bit of a byte above 9. `| digits` keeps a high bit that the byte
    // had. A carry can spoil only later bytes, and only the first byte that is not a digit matters.
    let others = (digits.wrapping_add(CARRY_ABOVE_NINE) | digits) & HIGHS;
    let bits = others.trailing_zeros() & 0x78;
    if others == 0 {
        return None;
    }
    // Right-align the digits, with zeros before them. Then join neighbours: each byte with the next one to a pair, and
    // the pairs, weighted by 10^6, 10^4, 10^2 and 1, to the number in the upper 32 bits.
    let eight = (digits << 1).wrapping_shl(63_u32.wrapping_sub(bits));
    let pairs = eight.wrapping_mul(10).wrapping_add(eight >> 8);
    let even = (pairs & BYTES).wrapping_mul(100 + (1_000_000 << 32));
    let odd = ((pairs >> 16) & BYTES).wrapping_mul(1 + (10_000 << 32));
    let count = usize::try_from(bits >> 3).unwrap_or(0);
    Some((even.wrapping_add(odd) >> 32, count))
}

/// Fast path of [`read_short_prefix_bytewise`]. Reads a short number at the beginning of a text; the caller checks the
/// text after it. None where there is no short number.
#[inline]
pub(crate) fn read_short_prefix(text: &[u8]) -> Option<Short> {
    let Some((whole, length)) = read_few_digits(text) else {
        return read_short_prefix_bytewise(text);
    };
    let rest = text.get(length..)?;
    let [b'.', behind @ ..] = rest else {
        return (length != 0).then_some(Short { mantissa: whole, decimals: 0, length });
    };
    let Some((behind_point, decimals)) = read_few_digits(behind) else {
        return read_short_prefix_bytewise(text);
    };
    let mantissa = whole.wrapping_mul(*TENS.get(decimals)?).wrapping_add(behind_point);
    let digits = length.wrapping_add(decimals);
    (digits != 0).then_some(Short { mantissa, decimals, length: digits.wrapping_add(1) })
}

/// Reads a short number at the beginning of a text, byte by byte. None where there is no short number.
#[inline(never)]
fn read_short_prefix_bytewise(text: &[u8]) -> Option<Short> {
    let mut mantissa = 0_u64;
    let whole = add_digits(text, 0, &mut mantissa);
    let (length, decimals) = if text.get(whole) == Some(&b'.') {
        let begin = whole.wrapping_add(1);
        let end = add_digits(text, begin, &mut mantissa);
        (end, end.wrapping_sub(begin))
    } else {
        (whole, 0)
    };
    let digits = whole.wrapping_add(decimals);
    (digits.wrapping_sub(1) < SHORT_DIGITS_MAX).then_some(Short { mantissa, decimals, length })
}

/// Fast path of [`read_spaced_or_long`]. Reads a short number at the beginning of a text, where the text after it does
/// not continue it. A blank after the number counts to its length.
#[inline]
pub(crate) fn read_short(text: &[u8]) -> Option<Short> {
    let number = read_short_prefix(text)?;
    match text.get(number.length..)? {
        // Blanks may separate digits: the number continues if a digit or a point follows the blank.
        [b' ', b'0'..=b'9' | b'.' | b' ' | b'\t', ..] | [b'\t' | b'.', ..] => None,
        [b' ', ..] => Some(Short { length: number.length.wrapping_add(1), ..number }),
        _ => Some(number),
    }
}

/// Reads a number without a sign, rounded correctly.
#[inline]
pub(crate) fn read_unsigned(cursor: &mut Cursor<'_>) -> Parsed<f64> {
    match read_short(cursor.rest()) {
        Some(short) => {
            cursor.advance_to_next(short.length);
            Ok(short.value())
        }
        None => read_spaced_or_long(cursor),
    }
}

/// Reads a number that has blanks in it or more digits than a short one.
#[cold]
fn read_spaced_or_long(cursor: &mut Cursor<'_>) -> Parsed<f64> {
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
        let tab = cursor.rest().get(1) == Some(&b'\t');
        cursor.step();
        if tab && begins(cursor) && planted(PlantedFault::TabInNumber) {
            return cursor.refuse(FaultKind::BadNumber, "a tab in a number");
        }
    }
    if digits == 0 && !planted(PlantedFault::PointAlone) {
        return start.refuse(FaultKind::BadNumber, "a number has a digit");
    }
    if digits > 17 && planted(PlantedFault::EighteenDigits) {
        return start.refuse(FaultKind::BadNumber, "too many digits");
    }
    if mantissa <= EXACT
        && let Some(power) = POWERS.get(decimals)
    {
        let number = math::from_u64(mantissa);
        return Ok(if decimals == 0 { number } else { number / power });
    }
    read_long(start)
}

/// Reads a number whose mantissa or power of ten a double does not hold exactly, by the standard library.
#[cold]
fn read_long(mut cursor: Cursor<'_>) -> Parsed<f64> {
    let mut text = [0_u8; SLOW_CHARACTERS_MAX];
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
pub(crate) fn read_digits(cursor: &mut Cursor<'_>, into: &mut alloc::string::String) {
    while cursor.peek().is_ascii_digit() {
        into.push(char::from(cursor.peek()));
        cursor.step();
    }
}
