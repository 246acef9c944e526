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
//! * `rs274.polar-repeated`: `syntax::block`.
//! * `rs274.retract-under-compensation`, `rs274.path-under-compensation`: `modal::mode_select`, except for restores.
//! * `rs274.compensation-entry-equal`, `rs274.compensation-exit-length`, `rs274.compensation-exit-arc`:
//!   `modal::compensation`.

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

/// How far the centre of an arc is from its chord at least, in radii: for half a circle it is not quite on the chord,
/// which decides the sign of a zero.
pub(crate) const ARC_HEIGHT: f64 = f64::EPSILON / 4.0;
