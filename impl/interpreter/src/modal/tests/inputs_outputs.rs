//! M62 to M68, user-defined codes.

use gaugeblock_vocabulary::FaultKind::{
    CompensationActive, MissingWord, ModalConflict, NoSuchInputOrOutput, NotAnInteger, UnknownCode,
    UnusedWord, WordOutOfRange,
};

use super::Expect::{After, Effects, Refused};
use super::{check, check_on, machine};

#[test]
fn outputs() {
    check(
        "m62 p0; m63 p3; m64 p1; m65 p2",
        Effects(
            "1 set_digital_output output=0 on=yes timing=with_motion; 2 set_digital_output output=3 on=no timing=with_motion; \
         3 set_digital_output output=1 on=yes timing=at_once; 4 set_digital_output output=2 on=no timing=at_once",
        ),
    );
    check(
        "m67 e1 q0.5; m68 e3 q-1",
        Effects(
            "1 set_analog_output output=1 to=0.5 timing=with_motion; 2 set_analog_output output=3 to=-1 timing=at_once",
        ),
    );
    for program in ["m62 p-1", "m62 p4", "m65 p4", "m67 e4 q1", "m68 e-1 q1", "m66 p4", "m66 e4"] {
        check(program, Refused(NoSuchInputOrOutput));
    }
    for program in ["m62 p1.5", "m67 e0.5 q1", "m66 p0.5", "m66 p0 l0.5"] {
        check(program, Refused(NotAnInteger));
    }
    check("m62 e1", Refused(UnusedWord));
    let strict = &[("outputs.under-compensation", "refused")];
    check_on(&machine(), strict, "g41; m64 p0", Refused(CompensationActive));
    check_on(&machine(), strict, "g41; m67 e0 q1", Refused(CompensationActive));
    check("g41; m64 p0", Effects("2 set_digital_output output=0 on=yes timing=at_once"));
}

#[test]
fn inputs() {
    check("m66 p0", Effects("1 wait_input digital=0 mode=immediate read=0"));
    check("m66 e1 l0 q0", Effects("1 wait_input analog=1 mode=immediate read=0"));
    check("m66 p1 l3 q5", Effects("1 wait_input digital=1 mode=high timeout=5 read=0"));
    check("m66 p1 l1 q5", Effects("1 wait_input digital=1 mode=rise timeout=5 read=0"));
    check("m66 p1 l2 q5; m66 p1 l4 q5", After("#5399 = 0.5"));
    check("m66 p0 e0", Refused(ModalConflict));
    check("m66 l0", Refused(MissingWord));
    check("m66 p0 l3", Refused(MissingWord));
    for program in
        ["m66 p0 l5 q1", "m66 p0 l-1 q1", "m66 e0 l1 q1", "m66 p0 l3 q0", "m66 p0 l3 q-1"]
    {
        check(program, Refused(WordOutOfRange));
    }
    check_on(
        &machine(),
        &[("inputs.without-timeout", "accepted")],
        "m66 p0 l3",
        Effects("1 wait_input digital=0 mode=high read=0"),
    );
    check_on(
        &machine(),
        &[("inputs.under-compensation", "refused")],
        "g41; m66 p0",
        Refused(CompensationActive),
    );
    check("g41; m66 p0", After("#5399 = 0.5"));
}

#[test]
fn user_codes() {
    check("m101 p123.456 q-2", Effects("1 user_code code=101 p=\"123.456\" q=\"-2\""));
    check("m100 q1", Effects("1 user_code code=100 p=\"-1\" q=\"1\""));
    check_on(
        &machine(),
        &[("user-codes.missing-argument", "empty")],
        "m100",
        Effects("1 user_code code=100 p=\"\" q=\"\""),
    );
    check("m199", Refused(UnknownCode));
    check("m200", Refused(UnknownCode));
    check("m100 r1", Refused(UnusedWord));
}
