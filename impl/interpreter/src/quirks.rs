//! What LinuxCNC's `rs274` does differently from its manual, to emulate it: off the main path, and off by default.
//!
//! Differences that a printer can make up for are not here. Each was observed; the page of its id in `suite/quirks`
//! has a program.
//!
//! * `rs274.exists-numbered`: EXISTS takes a numbered parameter (`syntax::expression`). A function may follow a
//!   number sign (`syntax::parameter`), and a name alone may follow an O (`syntax::o_word`): no page, because no
//!   document mentions them.
//! * `rs274.file-with-two-subs`: `control::files`, except for calls of those other subs.
//! * `rs274.unpassed-arguments-zero`: `control::calls`.
//! * `rs274.orient-without-angle` and `rs274.orient-without-timeout`: `modal::spindle`.
//! * `rs274.cycle-retract-from-initial`: `modal::cycles`.
//! * `rs274.tap-dwell-kept`: `modal::cycles`.
//! * `rs274.arc-radius-tolerance`: `modal::arcs`.
//! * `rs274.arc-least-radius`: `modal::arcs`.
//! * `rs274.continue-seeks-end`: `control::loops`.
//! * `rs274.stored-rotation`: `modal`. What its parameter file holds of parameters that are not persistent it takes
//!   over, too (`interpret`).
//! * `rs274.compensation-l-word`, `rs274.dynamic-compensation-r-word`, `rs274.synchronised-e-word` and
//!   `rs274.unused-q-minus-one`, except for a series of cycles that peck: `modal::check`.
//! * `rs274.offset-data-words`, of axis words alone: `modal::tool_table`.
//! * `rs274.polar-repeated` and `rs274.semicolon-plain`: `syntax::block`.
//! * `rs274.rounded-zero-sign`, `rs274.round-32-bits` and `rs274.absolute-negative-zero`: `syntax::arithmetic`. Sines,
//!   cosines and tangents of right angles are off by the rounding of a number with 64 bits, whose sign is printed.
//! * `rs274.message-small-value`: `control::message`.
//! * `rs274.cancel-with-motion`: `modal::check`. `rs274.probe-same-point`: `modal::probe`.
//! * `rs274.position-omitted-axes`: `modal::work_offsets`.
//! * `rs274.blend-q-without-p` and `rs274.tool-offset-unit`: `modal::mode_select`.
//! * `rs274.peck-rounding`: `modal::cycles`.
//! * The probe, and the tool in the spindle: `modal::stand_alone`. They have no page: they replace a machine.
//! * `rs274.retract-under-compensation`, `rs274.path-under-compensation`: `modal::mode_select`, except for restores.
//! * `rs274.compensation-entry-equal`, `rs274.compensation-exit-length`, `rs274.compensation-exit-arc`:
//!   `modal::compensation`.
//! * `rs274.turning-traverse-in-place`, `rs274.turning-start-incremental`, `rs274.turning-start-too-far`,
//!   `rs274.finishing-one-arc`, `rs274.turning-profile-codes` and `rs274.turning-end`: `modal::turning`. A lathe cycle
//!   forgets the stop or end of its block, and moves other axes with X and Z: no page, because no document mentions
//!   them.

use gaugeblock_vocabulary::LengthUnit;

use crate::math;
use crate::modal::letters::{E, L, Q, R};
use crate::words::Words;

/// Letters that a block may have though no code of it uses them: L with G41 and G42, R with G41.1 and G42.1, E with
/// G33 and G33.1, and Q-1.
pub(crate) fn ignored(words: &Words, compensation: Option<u16>, motion: Option<u16>) -> u32 {
    let order = words.get(b'L').and_then(math::near_integer);
    let takes_l = matches!(compensation, Some(410 | 420)) && order.is_some_and(|order| order >= 0);
    let l = if takes_l { L } else { 0 };
    let e = if matches!(motion, Some(330 | 331)) { E } else { 0 };
    let r = if matches!(compensation, Some(411 | 421)) { R } else { 0 };
    let q = if words.get(b'Q').is_some_and(|q| (q + 1.0).abs() <= 0.0) { Q } else { 0 };
    e | l | q | r
}

/// `#1` to `#30` in a sub where the call passes none.
pub(crate) const UNPASSED: [f64; 30] = [0.0; 30];

/// The last parameter that EXISTS finds.
const LAST_PARAMETER: f64 = 5601.0;

/// Whether a number is that of a parameter.
pub(crate) fn is_parameter(number: f64) -> bool {
    (1.0..=LAST_PARAMETER).contains(&number)
}

/// The fine and the coarse tolerance of an arc's radii, length units. A difference up to the fine one is always
/// accepted, up to the coarse one only where it is at most a thousandth of the radius.
pub(crate) fn arc_tolerances(units: LengthUnit) -> (f64, f64) {
    let diagonal = math::sqrt(2.0);
    match units {
        LengthUnit::Inch => (0.002 * diagonal, 0.2 * diagonal),
        LengthUnit::Millimetre => (0.02 * diagonal, 2.0 * diagonal),
    }
}

/// The least radius of an arc, length units.
pub(crate) fn arc_least_radius(units: LengthUnit) -> f64 {
    match units {
        LengthUnit::Inch => 0.000_05,
        LengthUnit::Millimetre => 0.001_27,
    }
}

/// The centre of an arc with a radius. It is to the left of the chord, or to its right. The last bits of angles decide
/// the sign of a zero.
pub(crate) fn arc_centre(start: [f64; 2], end: [f64; 2], radius: f64, left: bool) -> [f64; 2] {
    let ([start_x, start_y], [end_x, end_y]) = (start, end);
    let middle = [(end_x + start_x) / 2.0, (end_y + start_y) / 2.0];
    let [x, y] = middle;
    let half = math::hypotenuse_of_any_size(x - end_x, y - end_y);
    let radius = radius.max(half);
    let along = math::angle(end_y - start_y, end_x - start_x);
    let across = if left { quarter_more(along) } else { -quarter_more(-along) };
    let height = radius * math::cosine_of_radians(math::arcsine_in_radians(half / radius));
    [x + height * math::cosine_of_radians(across), y + height * math::sine_of_radians(across)]
}

/// A direction of length 1 from its angle.
pub(crate) fn direction([x, y]: [f64; 2]) -> [f64; 2] {
    // `+ 0.0` makes a negative zero positive.
    let angle = math::angle(y + 0.0, x + 0.0);
    [math::cosine_of_radians(angle), math::sine_of_radians(angle)]
}

/// The direction a quarter turn to the left of another one, or to its right, of length 1.
pub(crate) fn normal([x, y]: [f64; 2], left: bool) -> [f64; 2] {
    let quarter = core::f64::consts::FRAC_PI_2;
    let across = math::angle(y, x) + if left { quarter } else { -quarter };
    [math::cosine_of_radians(across), math::sine_of_radians(across)]
}

/// An angle plus a quarter turn. The sum uses more bits of the quarter turn than an f64 holds.
fn quarter_more(angle: f64) -> f64 {
    /// The bits of a quarter turn after those of the number nearest to it.
    const REST: f64 = 6.123_5e-17;
    let quarter = core::f64::consts::FRAC_PI_2;
    let sum = angle + quarter;
    let of_quarter = sum - angle;
    let lost = (angle - (sum - of_quarter)) + (quarter - of_quarter);
    sum + (lost + REST)
}

/// X and Y at a distance and an angle in degrees, or turned by that angle from a point: `rs274` computes in radians.
pub(crate) fn at_distance(
    [x, y]: [f64; 2],
    distance: f64,
    angle: Option<f64>,
    turned: bool,
) -> [f64; 2] {
    let from = math::angle(y, x);
    let first = if turned { from } else { 0.0 };
    let angle = angle.map_or(from, |more| first + more.to_radians());
    [distance * math::cosine_of_radians(angle), distance * math::sine_of_radians(angle)]
}

/// The smallest value that a message does not print as zero.
pub(crate) const PRINTED_MIN: f64 = 0.0001;

/// By what lengths of the tool table are multiplied: `rs274` takes a millimetre for 0.03937007874016 inches.
pub(crate) const TABLE_SCALE: f64 = 1.0 / (25.4 * 0.039_370_078_740_16);

/// What ROUND gives: an integer of 32 bits, without the sign of a zero.
pub(crate) fn rounded(value: f64) -> f64 {
    let bounds = f64::from(i32::MIN)..=f64::from(i32::MAX);
    if bounds.contains(&value) { value + 0.0 } else { f64::from(i32::MIN) }
}

/// The most quarter turns that [`beyond_right_angle`] computes.
const QUARTERS_MAX: i64 = 4096;

/// The quarter turns of an angle that is a multiple of 90 degrees, and by how many radians a number of 64 bits that is
/// computed from it exceeds them.
fn beyond_right_angle(degrees: f64) -> Option<(i64, f64)> {
    let quarters = math::whole(degrees / 90.0).filter(|quarters| quarters.abs() <= QUARTERS_MAX)?;
    let exact = quarters.checked_mul(90).and_then(math::whole_as_number)?;
    if quarters == 0 || (exact - degrees).abs() > 0.0 {
        return None;
    }
    let turns = u128::from(quarters.unsigned_abs());
    let excess = math::rounding_of_quarter_turns(turns);
    Some((quarters, if quarters < 0 { -excess } else { excess }))
}

/// SIN, COS and TAN of a right angle: nearly zero, or nearly infinite; none for other angles and values.
pub(crate) fn sine(degrees: f64) -> Option<f64> {
    let (quarters, excess) = beyond_right_angle(degrees)?;
    match quarters.rem_euclid(4) {
        0 => Some(excess),
        2 => Some(-excess),
        _ => None,
    }
}

/// The cosine, as [`sine`] is the sine.
pub(crate) fn cosine(degrees: f64) -> Option<f64> {
    let (quarters, excess) = beyond_right_angle(degrees)?;
    match quarters.rem_euclid(4) {
        1 => Some(-excess),
        3 => Some(excess),
        _ => None,
    }
}

/// The tangent, as [`sine`] is the sine.
pub(crate) fn tangent(degrees: f64) -> Option<f64> {
    let (quarters, excess) = beyond_right_angle(degrees)?;
    Some(if quarters.rem_euclid(2) == 0 { excess } else { -1.0 / excess })
}
