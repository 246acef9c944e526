//! Where offsets, positions and the tool are stored among the numbered parameters (11.1).

use gaugeblock_vocabulary::Tool;

use crate::math;
use crate::parameters::Numbered;

use super::coordinates::Coordinates;

/// 5210: whether the offset of G52 and G92 applies.
pub(crate) const G92_APPLIED: u32 = 5210;
/// 5211 to 5219: the offset of G52 and G92.
const G92_OFFSET: u32 = 5211;
/// 5220: number of the work coordinate system.
pub(crate) const WORK_OFFSET: u32 = 5220;
/// 5161 to 5169: the position of G28.
pub(crate) const G28_POSITION: u32 = 5161;
/// 5181 to 5189: the position of G30.
pub(crate) const G30_POSITION: u32 = 5181;
/// 5061 to 5069: where the last probe changed.
const PROBE_RESULT: u32 = 5061;
/// 5070: whether it did.
const PROBE_SUCCESS: u32 = 5070;
/// 5420 to 5428: the controlled point.
const POSITION: u32 = 5420;

/// Nine parameters in a row, X to W.
pub(super) fn row(numbered: &Numbered, first: u32) -> Coordinates {
    let mut row = Coordinates::default();
    for (number, coordinate) in (first..).zip(row.0.iter_mut()) {
        // A zero has no sign.
        *coordinate = numbered.get(number) + 0.0;
    }
    row
}

/// Sets nine parameters in a row.
pub(super) fn set_row(numbered: &mut Numbered, first: u32, row: Coordinates) {
    for (number, coordinate) in (first..).zip(row.0) {
        numbered.set(number, coordinate);
    }
}

/// Parameters of a work coordinate system, 1 to 9: the first of ten in a row.
fn first_of(system: u32) -> u32 {
    system.saturating_sub(1).saturating_mul(20).saturating_add(5221)
}

/// The stored origin of a work coordinate system, machine unit.
pub(crate) fn origin(numbered: &Numbered, system: u32) -> Coordinates {
    row(numbered, first_of(system))
}

/// The stored rotation of a work coordinate system, degrees.
pub(crate) fn rotation(numbered: &Numbered, system: u32) -> f64 {
    numbered.get(first_of(system).saturating_add(9))
}

/// Stores origin (machine unit) and rotation (degrees) of a work coordinate system.
pub(crate) fn store(numbered: &mut Numbered, system: u32, origin: Coordinates, rotation: f64) {
    set_row(numbered, first_of(system), origin);
    numbered.set(first_of(system).saturating_add(9), rotation);
}

/// The stored offset of G52 and G92, machine unit.
pub(crate) fn g92_offset(numbered: &Numbered) -> Coordinates {
    row(numbered, G92_OFFSET)
}

/// Stores the offset of G52 and G92, machine unit.
pub(crate) fn store_g92(numbered: &mut Numbered, offset: Coordinates) {
    set_row(numbered, G92_OFFSET, offset);
}

/// Stores what a straight probe found (11.5.24): where the probe changed, or else the programmed point, and which of
/// both it is.
pub(crate) fn store_probe(numbered: &mut Numbered, position: Coordinates, changed: bool) {
    set_row(numbered, PROBE_RESULT, position);
    numbered.set(PROBE_SUCCESS, f64::from(u8::from(changed)));
}

/// Whether the last straight probe succeeded.
pub(crate) fn probe_succeeded(numbered: &Numbered) -> bool {
    numbered.get(PROBE_SUCCESS) > 0.0
}

/// What the last straight probe stored.
pub(crate) fn probed(numbered: &Numbered) -> Coordinates {
    row(numbered, PROBE_RESULT)
}

/// Writes the controlled point into its parameters, program units.
pub(crate) fn publish(numbered: &mut Numbered, position: Coordinates) {
    set_row(numbered, POSITION, position);
}

/// The coordinate that a parameter of the controlled point reports, 5420 to 5428.
pub(crate) fn published(position: Coordinates, number: u32) -> Option<f64> {
    let place = number.checked_sub(POSITION)?;
    position.0.get(usize::try_from(place).ok()?).copied()
}

/// The work coordinate system of a parameter's value; the first for anything but 1 to 9 (11.1.3.1).
pub(crate) fn system_of(value: f64) -> u32 {
    math::near_integer(value)
        .and_then(|system| u32::try_from(system).ok())
        .filter(|system| (1..=9).contains(system))
        .unwrap_or(1)
}

/// The parameters of the tool in the spindle, 5400 to 5413.
pub(crate) fn store_tool(numbered: &mut Numbered, number: i32, tool: &Tool) {
    numbered.set(5400, f64::from(number));
    set_row(numbered, 5401, tool.offset.into());
    numbered.set(5410, tool.diameter);
    numbered.set(5411, tool.front_angle);
    numbered.set(5412, tool.back_angle);
    numbered.set(5413, f64::from(tool.orientation));
}
