//! T, M6, M61.

use gaugeblock_vocabulary::FaultKind::{
    CompensationActive, ControllerMode, MissingWord, NotAnInteger, ToolNotFound, WordOutOfRange,
};
use gaugeblock_vocabulary::scenario::ToolChange;
use gaugeblock_vocabulary::{Indexed, Machine};

use super::Expect::{After, Effects, Refused};
use super::{check, check_on, machine};

#[test]
fn preparing_and_changing() {
    check("m3; t1 m6", Effects("2 prepare_tool tool=1; 2 change_tool tool=1"));
    check(
        "m3 m8; t1 m6",
        After(
            "tool = 1, prepared_tool = -1, spindle[0] = stopped, flood = on, #5400 = 1, #5403 = 10, #5410 = 6",
        ),
    );
    check("t1; t2", After("tool = 0, prepared_tool = 2"));
    check("t1; t0", After("prepared_tool = -1"));
    check("t1; t2; m6", After("tool = 2"));
    check("t1 m6; t0 m6", After("tool = 0, #5400 = 0, #5403 = 0"));
    check("t9 m6", After("tool = 0"));
    check("t1 m6; t1 m6", After("tool = 1"));
    check_on(&machine(), &[("tool.selected-by", "slot")], "t1 m6", After("tool = 2"));
    check_on(&machine(), &[("tool.empty-slot", "refused")], "t9", Refused(ToolNotFound));
    check_on(&machine(), &[("tool.empty-slot", "refused")], "t0 m6", After("tool = 0"));
    check_on(
        &machine(),
        &[("tool.change-without-selection", "accepted")],
        "t1 m6; m6",
        After("tool = 1"),
    );
    check("m6", Refused(MissingWord));
    check("t1 m6; m6", Refused(MissingWord));
    check("t-1", Refused(WordOutOfRange));
    check("t1.5", Refused(NotAnInteger));
    check_on(
        &machine(),
        &[("tool.change-under-compensation", "refused")],
        "t1 g41 d2; m6",
        Refused(CompensationActive),
    );
    check("t1 g41 d2; m6", After("tool = 1"));
    check("m3; t1 m6", After("spindle[0] = stopped, spindle[1] = stopped"));
    check_on(
        &machine(),
        &[("tool.change-spindles", "first")],
        "m3; t1 m6",
        After("spindle[0] = stopped, spindle[1] = clockwise"),
    );
}

#[test]
fn what_a_change_does_besides() {
    let change = ToolChange { at_g30: true, quill_up: true, with_spindle_on: true };
    let parameters = Indexed([(5181, 7.0), (5183, -1.0)].into());
    let machine = Machine { tool_change: change, parameters, ..machine() };
    let program = "m3 g0 x1 z5; t1 m6";
    check_on(&machine, &[], program, After("spindle[0] = clockwise, position = (x7 z-1)"));
    check_on(
        &machine,
        &[],
        program,
        Effects(
            "1 straight_traverse end=(x1 z5); 2 prepare_tool tool=1; 2 straight_traverse end=(x1); \
         2 straight_traverse end=(x7 z-1); 2 change_tool tool=1",
        ),
    );
}

#[test]
fn tools_that_change_places() {
    let random = Machine { random_tool_changer: true, ..machine() };
    let program = "t1 m6; t2 m6; t2 m6";
    check_on(&random, &[("tool.selected-by", "slot")], program, After("tool = 1"));
    let exchange = &[("tool.selected-by", "slot"), ("tool.old-tool-place", "slot-of-the-new")];
    check_on(&random, exchange, program, After("tool = 2"));
    check_on(&random, &[("tool.empty-slot", "refused")], "t0", Refused(ToolNotFound));
    check_on(&random, &[], "m61 q0", After("tool = 0"));
}

#[test]
fn saying_which_tool() {
    check("m61 q2", Effects("1 set_tool_number tool=2"));
    check("m61 q2", After("tool = 2, #5400 = 2, #5403 = 20"));
    check("m61 q2; m61 q0", After("tool = 0"));
    check("m61 q9", Refused(ToolNotFound));
    check("m61 q-1", Refused(WordOutOfRange));
    check("m61 q1.4", Refused(NotAnInteger));
    check_on(
        &machine(),
        &[("tool.set-number-in-program", "refused")],
        "m61 q1",
        Refused(ControllerMode),
    );
    check_on(&machine(), &[("tool.set-number-unknown", "accepted")], "m61 q9", After("tool = 9"));
}
