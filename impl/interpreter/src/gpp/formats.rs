//! Formats: how a number is rounded to decimal digits, and how these are printed.

use alloc::string::String;

use crate::faults::{PlantedFault, planted};
use crate::math;

/// The names of the formats.
pub(super) const NAMES: [&str; 19] = [
    "CHARACTER",
    "COORDINATES",
    "ANGLES",
    "FEED",
    "SPINDLE",
    "DWELL",
    "SEQUENCING",
    "TOOL",
    "USER_1",
    "USER_2",
    "USER_3",
    "USER_4",
    "USER_5",
    "USER_6",
    "USER_7",
    "USER_8",
    "USER_9",
    "USER_10",
    "REAL",
];

/// The format of texts, as a place among the names.
pub(super) const CHARACTER: usize = 0;
/// The format in which expressions are compared.
pub(super) const REAL: usize = 18;
/// Most digits on one side of the point.
pub(super) const MOST_DIGITS: u32 = 14;

/// Ten to the power of 0 to 14.
const TENS: [u64; 15] = [
    1,
    10,
    100,
    1_000,
    10_000,
    100_000,
    1_000_000,
    10_000_000,
    100_000_000,
    1_000_000_000,
    10_000_000_000,
    100_000_000_000,
    1_000_000_000_000,
    10_000_000_000_000,
    100_000_000_000_000,
];

/// Five to the power of 0 to 14.
const FIVES: [u128; 15] = [
    1,
    5,
    25,
    125,
    625,
    3_125,
    15_625,
    78_125,
    390_625,
    1_953_125,
    9_765_625,
    48_828_125,
    244_140_625,
    1_220_703_125,
    6_103_515_625,
];

/// The place of a format's name, in capitals.
pub(super) fn named(name: &str) -> Option<usize> {
    NAMES.iter().position(|known| *known == name)
}

/// The formats where a toolpath does not set them.
pub(super) fn defaults() -> [Format; 19] {
    core::array::from_fn(|place| {
        let (integer, fraction) = match place {
            3 => ((1, 5), (0, 1)),
            4 | 6 | 7 => ((1, 5), (0, 0)),
            5 => ((1, 5), (0, 2)),
            REAL => ((1, MOST_DIGITS), (1, MOST_DIGITS)),
            _ => ((1, 5), (0, 3)),
        };
        Format {
            integer,
            fraction,
            leading: true,
            trailing: true,
            plus: None,
            minus: Some('-'),
            point: '.',
            whole_point: false,
            zero: String::new(),
            modal: place == CHARACTER,
        }
    })
}

/// How numbers are printed.
#[derive(Clone, Debug)]
pub(super) struct Format {
    /// Fewest and most digits before the point.
    pub(super) integer: (u32, u32),
    /// Fewest and most digits after it.
    pub(super) fraction: (u32, u32),
    /// Whether the fewest digits before the point are reached with zeros, and not with blanks.
    pub(super) leading: bool,
    /// Whether those after it are.
    pub(super) trailing: bool,
    pub(super) plus: Option<char>,
    pub(super) minus: Option<char>,
    pub(super) point: char,
    /// Whether a whole number has a point, too.
    pub(super) whole_point: bool,
    /// The text for zero, where it is not empty.
    pub(super) zero: String,
    /// Whether its variables are modal, in the old GPP.
    pub(super) modal: bool,
}

/// A number of decimal digits. Zero has no sign.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Decimal {
    negative: bool,
    whole: u64,
    /// The part after the point, as so many digits.
    fraction: u64,
    places: u32,
}

/// The number has more digits before the point than its format allows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct TooLong;

impl Format {
    /// A number rounded to the most digits after the point, on its exact binary value.
    ///
    /// # Errors
    /// It has too many digits before the point then.
    pub(super) fn rounded(&self, value: f64, tie_even: bool) -> Result<Decimal, TooLong> {
        let places = self.fraction.1;
        let power = power_of_ten(places);
        let scaled = scaled(value.abs(), places, tie_even).ok_or(TooLong)?;
        let (whole, fraction) = if let Ok(scaled) = u64::try_from(scaled) {
            (scaled.checked_div(power), scaled.checked_rem(power))
        } else {
            let power = u128::from(power);
            let narrow = |part: Option<u128>| part.and_then(|part| u64::try_from(part).ok());
            (narrow(scaled.checked_div(power)), narrow(scaled.checked_rem(power)))
        };
        let (Some(whole), Some(fraction)) = (whole, fraction) else { return Err(TooLong) };
        if whole >= power_of_ten(self.integer.1) {
            return Err(TooLong);
        }
        let negative = value < 0.0 && (whole, fraction) != (0, 0);
        Ok(Decimal { negative, whole, fraction, places })
    }

    /// Prints digits.
    pub(super) fn print(&self, number: Decimal, text: &mut String) {
        if (number.whole, number.fraction) == (0, 0) && !self.zero.is_empty() {
            text.push_str(&self.zero);
            return;
        }
        text.extend(if number.negative { self.minus } else { self.plus });
        let mut digits = 0;
        while digits < MOST_DIGITS && number.whole >= power_of_ten(digits) {
            digits = digits.saturating_add(1);
        }
        for _ in digits..self.integer.0 {
            text.push(if self.leading { '0' } else { ' ' });
        }
        push_digits(number.whole, digits, text);
        let (mut fraction, mut digits) = (number.fraction, number.places);
        while digits > 0 && fraction.is_multiple_of(10) {
            fraction = fraction.checked_div(10).unwrap_or_default();
            digits = digits.saturating_sub(1);
        }
        if digits > 0 || self.fraction.0 > 0 || self.whole_point {
            text.push(self.point);
        }
        push_digits(fraction, digits, text);
        for _ in digits..self.fraction.0 {
            text.push(if self.trailing { '0' } else { ' ' });
        }
    }
}

impl Decimal {
    /// The float nearest to it.
    pub(super) fn nearest(self) -> f64 {
        let power = power_of_ten(self.places);
        let scaled = self.whole.checked_mul(power).and_then(|s| s.checked_add(self.fraction));
        let magnitude = match scaled {
            // Both are exact, and so the quotient is the nearest.
            Some(scaled) if scaled < 1 << 53 => math::from_u64(scaled) / math::from_u64(power),
            _ => {
                let mut text = String::new();
                push_digits(self.whole, MOST_DIGITS.saturating_add(1), &mut text);
                text.push('.');
                push_digits(self.fraction, self.places, &mut text);
                text.parse().unwrap_or_default()
            }
        };
        if self.negative { -magnitude } else { magnitude }
    }
}

fn power_of_ten(places: u32) -> u64 {
    usize::try_from(places).ok().and_then(|place| TENS.get(place)).copied().unwrap_or(u64::MAX)
}

/// So many digits of a number, the lowest ones.
fn push_digits(mut number: u64, digits: u32, text: &mut String) {
    let mut ascii = [b'0'; 20];
    let count = usize::try_from(digits).unwrap_or_default().min(ascii.len());
    for digit in ascii.iter_mut().take(count).rev() {
        let low = number.checked_rem(10).and_then(|low| u8::try_from(low).ok());
        *digit = b'0'.saturating_add(low.unwrap_or_default());
        number = number.checked_div(10).unwrap_or_default();
    }
    text.push_str(core::str::from_utf8(ascii.get(..count).unwrap_or_default()).unwrap_or_default());
}

/// A magnitude times a power of ten, rounded to an integer exactly; none where it is beyond any format.
fn scaled(magnitude: f64, places: u32, tie_even: bool) -> Option<u128> {
    if magnitude.is_nan() || magnitude >= 1e15 {
        return None;
    }
    let bits = magnitude.to_bits();
    let biased = i32::try_from(bits >> 52).ok()?;
    let fraction = bits & ((1 << 52) - 1);
    let (mantissa, exponent) = if biased == 0 {
        (fraction, -1074)
    } else {
        (fraction | 1 << 52, biased.checked_sub(1075)?)
    };
    let product = u128::from(mantissa).checked_mul(*FIVES.get(usize::try_from(places).ok()?)?)?;
    let shift = exponent.checked_add(i32::try_from(places).ok()?)?;
    let Ok(right) = u32::try_from(shift.checked_neg()?) else {
        return product.checked_shl(shift.unsigned_abs());
    };
    if right == 0 {
        return Some(product);
    }
    // A product has fewer than 90 bits.
    let Some(whole) = product.checked_shr(right) else { return Some(0) };
    let half = 1_u128.checked_shl(right.checked_sub(1)?)?;
    let rest = product & half.checked_mul(2).map_or(u128::MAX, |unit| unit.saturating_sub(1));
    let tie_up = (!tie_even || whole & 1 == 1) && !planted(PlantedFault::TieTowardZero);
    let up = rest > half || rest == half && tie_up;
    Some(whole.saturating_add(u128::from(up)))
}
