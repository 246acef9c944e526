//! G28, G28.1, G30, G30.1 (11.5.20, 11.5.21).

use gaugeblock_vocabulary::FaultKind::{AxisWords, CompensationActive, ModalConflict, UnusedWord};
use gaugeblock_vocabulary::{Axis, Indexed, Machine};

use super::Expect::{After, Effects, Refused};
use super::{check, check_on, inch_machine, machine};

#[test]
fn moving() {
    // If no position is stored all axes go to the machine origin.
    check(
        "g0 x1 y2 z3 a4; g28",
        Effects("1 straight_traverse end=(x1 y2 z3 a4); 2 straight_traverse end=()"),
    );
    check("g0 x1 y2; g28.1; g0 x5 y6; g28", After("position = (x1 y2)"));
    check("g0 x1 y2; g30.1; g0 x5 y6; g30", After("position = (x1 y2), #5181 = 1, #5182 = 2"));
    check("g0 x1 y2; g30.1; g28", After("position = ()"));
    // The named axes go to an intermediate point, then to the stored position; the others stay.
    check(
        "g0 x1 y2 z3; g28 z2.5",
        Effects(
            "1 straight_traverse end=(x1 y2 z3); 2 straight_traverse end=(x1 y2 z2.5); 2 straight_traverse end=(x1 y2)",
        ),
    );
    check(
        "g91 g0 x1 y2; g30 x1",
        Effects(
            "1 straight_traverse end=(x1 y2); 2 straight_traverse end=(x2 y2); 2 straight_traverse end=(y2)",
        ),
    );
    check("g7 g28 x4", Effects("1 straight_traverse end=(x2); 1 straight_traverse end=()"));
    check("g1 f1; g28 x1; x2", After("motion = feed, position = (x2)"));
    check("g1 f1 g28", Refused(AxisWords));
}

#[test]
fn machine_coordinates_and_units() {
    check("g10 l2 p1 x10 z1; g92 x5; g43.1 z2; g28", After("position = (x5 z-3)"));
    check("g92 x5; g28 x7", Effects("2 straight_traverse end=(x7); 2 straight_traverse end=(x5)"));
    check("g20 g0 x1 a5; g28.1; g21", After("#5161 = 25.4, #5164 = 5, #5167 = 0"));
    check_on(&inch_machine(), &[], "g0 x25.4; g28.1", After("#5161 = 1"));
    let stored = Indexed([(5161, 1.0), (5169, 3.0), (5162, -2.0)].into());
    let machine = Machine { parameters: stored, ..inch_machine() };
    check_on(&machine, &[], "g20; g28", After("position = (x1 y-2)"));
    check_on(&machine, &[], "g21; g28", After("position = (x25.4 y-50.8)"));
    let all = Machine { axes: Axis::ALL.into(), ..machine };
    check_on(&all, &[], "g20; g28", After("position = (x1 y-2 w3)"));
    check_on(&all, &[], "g20 g0 w1; g30.1", After("#5189 = 1"));
}

#[test]
fn turned_systems() {
    // X of the program is Y of the machine: only the machine's X axis goes to its place.
    check("g10 l2 p1 r90; g0 x3 y4; g28 x3", After("#5221 = 0"));
    let run = super::run(&machine(), &[], "g10 l2 p1 r90; g0 x3 y4; g28 x5");
    let [x, y, ..] = run.modal.active.now().machine_of(run.modal.position).0;
    assert!(x.abs() < 1e-9 && (y - 5.0).abs() < 1e-9, "{x} {y}");
}

#[test]
fn order_and_refusals() {
    // G28.1 takes no axis words; storing comes before the motion.
    check("g0 x1; g28.1 g0 x5", After("position = (x5), #5161 = 1"));
    check("g28 g0 x1", Refused(AxisWords));
    check("g28 g92 x1", Refused(ModalConflict));
    check("g28 g43.1 z1", After("tool_offset = (z1)"));
    check("g28 x1 i1", Refused(UnusedWord));
    check("g28.1 x1", Refused(AxisWords));
    for code in ["g28", "g28.1", "g30 x1", "g30.1"] {
        check(&alloc::format!("g41 d3; {code}"), Refused(CompensationActive));
    }
}
