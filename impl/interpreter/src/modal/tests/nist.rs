//! Choices that the report on NIST's interpreter decides differently from LinuxCNC, as far as they concern modes.

use gaugeblock_vocabulary::FaultKind::{BadArc, MissingWord, WordOutOfRange};

use super::Expect::{After, Effects, Refused};
use super::{Chosen, check, check_on, machine};

/// Checks programs under an option.
fn check_under(chosen: Chosen, table: &[(&str, super::Expect)]) {
    for (program, expect) in table {
        check_on(&machine(), chosen, program, *expect);
    }
}

#[test]
fn move_needs_an_axis_word_by_choice() {
    check_under(
        &[("motion.without-axis-words", "refused")],
        &[
            ("g80; g0", Refused(MissingWord)),
            ("f9; g1", Refused(MissingWord)),
            ("g0 @2 ^0", After("position = (x2)")),
            ("g0 x1; m8", After("position = (x1), flood = on")),
        ],
    );
}

#[test]
fn one_bound_for_arcs_of_every_radius_by_choice() {
    check_under(
        &[("arcs.small-tolerance", "two-micrometres")],
        &[
            ("g21 f9; g2 x2.0015 i1", After("position = (x2.0015)")),
            ("g21 f9; g2 x2.0025 i1", Refused(BadArc)),
            ("g21 f9; g2 x2000.0025 i1000", Refused(BadArc)),
            ("g20 f9; g2 x2.00015 i1", After("position = (x2.00015)")),
            ("g20 f9; g2 x2.00025 i1", Refused(BadArc)),
        ],
    );
}

#[test]
fn no_coordinate_system_is_number_0_by_choice() {
    check("g55; g10 l2 p0 x7", After("g5x_offset = (x7)"));
    check_under(
        &[("offsets.set-active-number", "refused")],
        &[
            ("g55; g10 l2 p0 x7", Refused(WordOutOfRange)),
            ("g55; g10 l2 p2 x7", After("g5x_offset = (x7)")),
        ],
    );
}

#[test]
fn cycles_end_at_the_clear_level_by_choice() {
    check_under(
        &[("cycles.bore-return", "feed")],
        &[(
            "f9 g98 g0 z3; g85 x4 z1 r2",
            Effects(
                "1 straight_traverse end=(z3); 2 straight_traverse end=(x4 z3); 2 straight_traverse end=(x4 z2); \
                 2 straight_feed end=(x4 z1); 2 straight_feed end=(x4 z3)",
            ),
        )],
    );
    check_under(
        &[("cycles.peck-return", "clear")],
        &[(
            "g21 f9 g98 g0 z3; g83 x4 z1 r2 q0.5",
            Effects(
                "1 straight_traverse end=(z3); 2 straight_traverse end=(x4 z3); 2 straight_traverse end=(x4 z2); \
                 2 straight_feed end=(x4 z1.5); 2 straight_traverse end=(x4 z3); 2 straight_traverse end=(x4 z1.754); \
                 2 straight_feed end=(x4 z1); 2 straight_traverse end=(x4 z3)",
            ),
        )],
    );
}

#[test]
fn every_axis_goes_home_by_choice() {
    check_under(
        &[("positions.home-axes", "all")],
        &[(
            "g0 x5 y6; g28 x2",
            Effects(
                "1 straight_traverse end=(x5 y6); 2 straight_traverse end=(x2 y6); 2 straight_traverse end=()",
            ),
        )],
    );
}

#[test]
fn program_end_suspends_the_offset_by_choice() {
    check("g92 x7; m2", After("g92_offset = (x-7), #5211 = -7"));
    check_under(
        &[("program-end.local-offset", "suspended")],
        &[("g92 x7; m2", After("g92_offset = (), position = (), #5210 = 0, #5211 = -7"))],
    );
}

#[test]
fn length_offset_needs_a_number_by_choice() {
    check("g43", After("tool_offset = ()"));
    check_under(
        &[("tool.length-number-zero", "zero")],
        &[("g43", Refused(MissingWord)), ("g43 h0", After("tool_offset = ()"))],
    );
}
