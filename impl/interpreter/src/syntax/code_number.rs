//! Which code the number after G or M is (11.4.2.4, 11.4.5): how far it may be from one is a choice.

use crate::faults::{PlantedFault, narrowed, planted};
use crate::math;

/// Largest G number.
const G_MAX: u16 = 99;

/// A G code in tenths, where a number is one. With `hundredths` its decimals are rounded to hundredths.
#[inline]
pub(crate) fn g_number(value: f64, hundredths: bool) -> Option<u16> {
    let value = narrowed(PlantedFault::GcodeWraps, value, 65_536.0);
    if hundredths {
        return g_number_of_hundredths(value);
    }
    near_code(value * 10.0, 999)
}

/// An M code, where a number is one. With `hundredths` its decimals are rounded to hundredths.
#[inline]
pub(crate) fn m_number(value: f64, hundredths: bool) -> Option<u16> {
    if planted(PlantedFault::MCodeExactly) && math::whole(value).is_none() {
        return None;
    }
    let value = narrowed(PlantedFault::McodeWraps, value, 65_536.0);
    if hundredths {
        return whole_and_hundredths(value).filter(|(_, rest)| *rest == 0).map(|(whole, _)| whole);
    }
    near_code(value, u16::MAX)
}

/// The integer that a code is close to, where it is in the range.
#[inline]
fn near_code(value: f64, most: u16) -> Option<u16> {
    let cut = planted(PlantedFault::GcodeCut);
    let value = if cut { math::floor(value + math::CLOSE) } else { value };
    math::near_integer(value)
        .and_then(|number| u16::try_from(number).ok())
        .filter(|number| *number <= most)
}

/// A G code in tenths: a whole number, or one that has these hundredths in Grbl.
#[cold]
fn g_number_of_hundredths(value: f64) -> Option<u16> {
    let (whole, hundredths) = whole_and_hundredths(value).filter(|(whole, _)| *whole <= G_MAX)?;
    let tenth = match (whole, hundredths) {
        (_, 0) => 0,
        (28 | 30 | 43 | 91 | 92, 10) => 1,
        (38, 20) => 2,
        (38, 30) => 3,
        (38, 40) => 4,
        (38, 50) => 5,
        _ => return None,
    };
    whole.checked_mul(10)?.checked_add(tenth)
}

/// A number without its decimals, and the hundredths to which they are rounded, from halfway away from zero.
fn whole_and_hundredths(value: f64) -> Option<(u16, i64)> {
    let whole = math::truncate(value);
    let hundredths = math::round_away((value - whole) * 100.0);
    let number = math::near_integer(whole).and_then(|whole| u16::try_from(whole).ok())?;
    Some((number, math::near_integer(hundredths)?))
}
