//! What holds for every shift of coordinates: offsets, rotations, tools and units, in whatever order.

use alloc::format;
use alloc::string::String;

use gaugeblock_vocabulary::{LengthUnit, Machine};
use proptest::prelude::*;

use super::{Run, machine, run};

/// A number with two decimals.
fn number() -> impl Strategy<Value = f64> {
    (-5000_i16..5000).prop_map(|hundredths| f64::from(hundredths) / 100.0)
}

/// Blocks that shift, turn, move and change units.
fn shift() -> impl Strategy<Value = String> {
    prop_oneof![
        (1_u8..10, number(), number()).prop_map(|(p, x, y)| format!("g10 l2 p{p} x{x} y{y}")),
        (1_u8..10, -360_i16..360).prop_map(|(p, r)| format!("g10 l2 p{p} r{r}")),
        (0_u8..10, number()).prop_map(|(p, y)| format!("g10 l20 p{p} y{y}")),
        (number(), number()).prop_map(|(x, z)| format!("g92 x{x} z{z}")),
        (number(), number()).prop_map(|(y, z)| format!("g52 y{y} z{z}")),
        (number(), number()).prop_map(|(x, z)| format!("g43.1 x{x} z{z}")),
        (number(), number(), number()).prop_map(|(x, y, z)| format!("g0 x{x} y{y} z{z}")),
        (1_u8..4, number(), number()).prop_map(|(p, y, z)| format!("g10 l1 p{p} y{y} z{z}")),
        prop::sample::select(
            &["g20", "g21", "g54", "g55", "g59.3", "g92.2", "g92.3", "g43 h1", "g43 h2", "g49"][..]
        )
        .prop_map(String::from),
    ]
}

fn shifts() -> impl Strategy<Value = String> {
    prop::collection::vec(shift(), 1..8).prop_map(|blocks| blocks.join("; "))
}

fn on(inch: bool) -> Machine {
    let length_unit = if inch { LengthUnit::Inch } else { LengthUnit::Millimetre };
    Machine { length_unit, ..machine() }
}

fn accepted(inch: bool, program: &str) -> Run {
    let run = run(&on(inch), &[], program);
    assert!(run.last.1.is_ok(), "{program}: {:?}", run.last);
    run
}

fn near(found: [f64; 9], wanted: [f64; 9]) -> bool {
    found.iter().zip(wanted).all(|(found, wanted)| (found - wanted).abs() < 1e-6)
}

fn machine_position(run: &Run) -> [f64; 9] {
    let modes = run.modal.active.now();
    modes.machine_of(run.modal.position).converted(run.modal.active_to_machine()).0
}

proptest! {
    /// Nothing but a move moves.
    #[test]
    fn offsets_move_nothing(inch: bool, before in shifts(), last in shift()) {
        prop_assume!(!last.starts_with("g0"));
        let place = machine_position(&accepted(inch, &before));
        let after = machine_position(&accepted(inch, &format!("{before}; {last}")));
        prop_assert!(near(after, place), "{:?} {:?}", place, after);
    }

    /// G10 L10 and G43: the coordinates of the words; those without a word are as with the old entry.
    #[test]
    fn tools_measured_on_the_part(inch: bool, before in shifts(), x in number(), z in number()) {
        let [_, old_y, ..] = accepted(inch, &format!("{before}; g43 h2")).modal.position.0;
        let run = accepted(inch, &format!("{before}; g10 l10 p2 x{x} z{z}; g43 h2"));
        let [found_x, found_y, found_z, ..] = run.modal.position.0;
        prop_assert!((found_x - x).abs() + (found_z - z).abs() + (found_y - old_y).abs() < 1e-6);
    }

    /// G10 L11 and G43, in G59.3 without G92.
    #[test]
    fn tools_measured_on_a_fixture(inch: bool, before in shifts(), x in number(), z in number()) {
        let run = accepted(inch, &format!("{before}; g10 l11 p2 x{x} z{z}; g43 h2; g59.3; g92.2"));
        let [found_x, _, found_z, ..] = run.modal.position.0;
        prop_assert!((found_x - x).abs() + (found_z - z).abs() < 1e-6, "{} {}", found_x, found_z);
    }

    /// G10 L20: the coordinates of the words, the others as they were.
    #[test]
    fn origins_measured(inch: bool, before in shifts(), x in number()) {
        let mut wanted = accepted(inch, &before).modal.position.0;
        let run = accepted(inch, &format!("{before}; g10 l20 p0 x{x}"));
        wanted[0] = x;
        prop_assert!(near(run.modal.position.0, wanted), "{:?} {:?}", wanted, run.modal.position.0);
    }

    /// G28.1 and G28: the same place of the machine, whatever the offsets say by then.
    #[test]
    fn predefined_positions(inch: bool, before in shifts(), between in shifts(), code in prop::sample::select(&["28", "30"][..])) {
        let place = machine_position(&accepted(inch, &before));
        let run = accepted(inch, &format!("{before}; g{code}.1; {between}; g{code}"));
        prop_assert!(near(machine_position(&run), place));
        // With axis words only those go there, in coordinates of the machine.
        let middle = accepted(inch, &format!("{before}; g{code}.1; {between}; g0 x3"));
        let run = accepted(inch, &format!("{before}; g{code}.1; {between}; g{code} x3"));
        let mut wanted = machine_position(&middle);
        wanted[0] = place[0];
        prop_assert!(near(machine_position(&run), wanted));
    }

    /// G53: the named axes stand at the machine coordinates of the words.
    #[test]
    fn machine_coordinates(inch: bool, before in shifts(), x in number()) {
        let before = format!("{before}; g21");
        let mut wanted = machine_position(&accepted(inch, &before));
        wanted[0] = if inch { x / 25.4 } else { x };
        let run = accepted(inch, &format!("{before}; g53 g0 x{x}"));
        prop_assert!(near(machine_position(&run), wanted));
    }

    /// G92: the coordinates of the words; the axes without a word have no offset.
    #[test]
    fn axes_offsets(inch: bool, before in shifts(), x in number()) {
        let run = accepted(inch, &format!("{before}; g92 x{x}"));
        prop_assert!((run.modal.position.0[0] - x).abs() < 1e-6);
        let offset = run.modal.active.now().g92_offset.0;
        prop_assert!(offset[1..].iter().all(|offset| offset.abs() <= 0.0));
    }
}
