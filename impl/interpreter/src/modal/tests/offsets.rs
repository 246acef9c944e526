//! Coordinate systems, G10, G52, G92, tool length offsets.

use gaugeblock_vocabulary::FaultKind::{MissingWord, NotAnInteger, ToolNotFound, WordOutOfRange};
use gaugeblock_vocabulary::{Indexed, Machine};

use super::Expect::{After, Refused};
use super::{check, check_on, inch_machine, machine};

#[test]
fn work_coordinate_systems() {
    check(
        "g10 l2 p2 x10; g0 x1; g55",
        After("work_offset = 2, g5x_offset = (x10), position = (x-9), #5220 = 2"),
    );
    check("g10 l2 p0 x10", After("g5x_offset = (x10), position = (x-10), #5221 = 10"));
    check(
        "g10 l2 p9 y1 r30; g59.3",
        After("rotation = 30, work_offset = 9, #5382 = 1, #5390 = 30"),
    );
    check("g0 x5; g10 l20 p1 x1", After("position = (x1), g5x_offset = (x4)"));
    check("g0 x5; g10 l20 p3 x1", After("position = (x5), #5261 = 4"));
    check("g91 g10 l2 p1 x3; g10 l2 p1 x3", After("g5x_offset = (x3)"));
    check("g20 g10 l2 p1 x1", After("g5x_offset = (x1), #5221 = 25.4"));
    check("g7 g10 l2 p1 x4", After("g5x_offset = (x4)"));
    check_on(
        &machine(),
        &[("units-planes.diameter-offsets", "every-word")],
        "g7 g10 l2 p1 x4",
        After("g5x_offset = (x2)"),
    );
    for program in ["g10 l2 p-1 x1", "g10 l2 p10 x1", "g10 l3 p1", "g10 l21 p1 x1"] {
        check(program, Refused(WordOutOfRange));
    }
    check("g10 l2 p1.5 x1", Refused(NotAnInteger));
    check("g10 l2.5 p1 x1", Refused(NotAnInteger));
}

#[test]
fn offsets_of_g52_and_g92() {
    check(
        "g52 x1 y2; g52 x3",
        After("g92_offset = (x3 y2), position = (x-3 y-2), #5210 = 1, #5212 = 2"),
    );
    check("g0 x4; g92 x7", After("position = (x7), g92_offset = (x-3), #5211 = -3"));
    check("g0 x4 y4; g92 x7; g92 y0", After("g92_offset = (y4), position = (x4)"));
    check("g0 x4; g92 x7; g92.2", After("position = (x4), g92_offset = (), #5210 = 0, #5211 = -3"));
    check("g0 x4; g92 x7; g92.1", After("position = (x4), #5210 = 0, #5211 = 0"));
    check("g0 x4; g92 x7; g92.2; g92.3", After("position = (x7), #5210 = 1"));
    check("g91 g92 x7", After("position = (x7)"));
    check("g92.1 g92.2", Refused(gaugeblock_vocabulary::FaultKind::ModalConflict));
    check("g92", Refused(MissingWord));
    check("g52", Refused(MissingWord));
}

#[test]
fn stored_parameters_are_taken_over() {
    let stored = [(5220, 2.0), (5241, 1.0), (5210, 1.0), (5213, 0.5)];
    let machine = Machine { parameters: Indexed(stored.into()), ..inch_machine() };
    check_on(
        &machine,
        &[],
        "m5",
        After(
            "work_offset = 2, g5x_offset = (x25.4), g92_offset = (z12.7), position = (x-25.4 z-12.7)",
        ),
    );
    let wild = Machine { parameters: Indexed([(5220, 99.0)].into()), ..inch_machine() };
    check_on(&wild, &[], "m5", After("work_offset = 1, #5220 = 1"));
}

#[test]
fn volatile_parameters_are_not_stored() {
    let numbers = [
        1, 5, 30, 31, 5000, 5001, 5061, 5070, 5160, 5161, 5390, 5391, 5399, 5400, 5420, 5429, 5598,
        5599, 5602,
    ];
    let stored = numbers.into_iter().map(|number| (number, 7.0));
    let machine = Machine { parameters: Indexed(stored.collect()), ..inch_machine() };
    let kept = "#31 = 7, #5000 = 7, #5161 = 7, #5390 = 7";
    check_on(&machine, &[], "m5", After(kept));
    let volatile = "#1 = 0, #5 = 0, #30 = 0, #5001 = 0, #5061 = 0, #5070 = 0, #5160 = 0, #5391 = 0, \
        #5399 = 0, #5400 = 0, #5420 = 0, #5429 = 0, #5598 = 0, #5599 = 0, #5602 = 0";
    check_on(&machine, &[], "m5", After(volatile));
}

#[test]
fn tool_length_offsets() {
    check("g43 h1", After("tool_length = on, tool_offset = (z10), position = (z-10)"));
    check("t2 m6; g43", After("tool_offset = (z20)"));
    check("t2 m6 g43 h0", After("tool_offset = (z20)"));
    check("g43 h0", After("tool_length = on, tool_offset = ()"));
    check("g43 h3", After("tool_length = on, tool_offset = ()"));
    check("g43 h1; g43.1 x1", After("tool_offset = (x1 z10)"));
    check("g43 h1; g43.2 h2", After("tool_offset = (z30)"));
    check("g43 h1; g43.2 z1", After("tool_offset = (z11)"));
    check("g43 h1; g49", After("tool_length = off, tool_offset = (), position = ()"));
    check_on(&inch_machine(), &[], "g43 h1", After("tool_offset = (z254)"));
    check("g43", After("tool_length = on, tool_offset = ()"));
    check("g43 h9", Refused(ToolNotFound));
    check("g43.2 h9", Refused(ToolNotFound));
    check("g43 h-1", Refused(WordOutOfRange));
    check("g43 h1.5", Refused(NotAnInteger));
    check_on(
        &Machine { random_tool_changer: true, ..machine() },
        &[],
        "g43 h0",
        Refused(ToolNotFound),
    );
}
