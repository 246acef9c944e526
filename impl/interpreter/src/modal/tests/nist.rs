//! Choices that the report on NIST's interpreter decides differently from LinuxCNC, as far as they concern modes.

use gaugeblock_vocabulary::FaultKind::{
    BadArc, MissingWord, ModalConflict, WordOutOfRange, ZeroFeed,
};

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

#[test]
fn cycle_returns_to_the_level_before_it_by_choice() {
    let program = "f9 g99 g0 z3; g81 x1 z0 r1; g98 x2";
    check(program, After("position = (x2 z3)"));
    check_under(&[("cycles.old-level", "cycle")], &[(program, After("position = (x2 z1)"))]);
}

#[test]
fn cycle_needs_no_feed_rate_by_choice() {
    let program = "g99 g0 z3; g81 x4 z1 r2";
    check(program, Refused(ZeroFeed));
    check_under(&[("cycles.feed-rate", "any")], &[(program, After("position = (x4 z2)"))]);
}

#[test]
fn cycle_leaves_the_path_control_mode_after_it() {
    let program = "f9 g64 p0.5 g99 g0 z3; g81 x4 z1 r2 l3";
    let after = After("path = continuous, blend_tolerance = 0.5");
    check(program, after);
    check_under(&[("cycles.path-mode", "exact-path")], &[(program, after)]);
}

#[test]
fn tap_without_p_does_not_dwell_by_choice() {
    check_under(
        &[("cycles.tap-without-dwell", "none"), ("cycles.tap-override-switches", "kept")],
        &[(
            "s9 m3 f9 g99 g0 z2; g84 z1 r2",
            Effects(
                "1 straight_traverse end=(z2); 2 straight_traverse end=(z2); 2 straight_feed end=(z1); \
                 2 straight_feed end=(z2)",
            ),
        )],
    );
}

#[test]
fn compensation_is_for_one_plane_by_choice() {
    check("g18; g41", After("compensation = left"));
    check_under(
        &[("tool.compensation-in-zx", "refused")],
        &[("g18; g41", Refused(ModalConflict)), ("g17; g41", After("compensation = left"))],
    );
}

#[test]
fn rate_of_the_last_move_counts_after_inverse_time_by_choice() {
    check("g93 g1 x5 f4; g94", After("feed_rate = 0"));
    check_under(
        &[
            ("feed.after-mode-change", "of-last-move"),
            ("program-end.feed-after-mode-change", "of-last-move"),
        ],
        &[
            ("g93 g1 x5 f4; g94", After("feed_rate = 20")),
            ("g93 g1 x3 y4 a90 f4; m2", After("feed_rate = 20")),
            ("g93 g1 a90 f2; g94", After("feed_rate = 180")),
            ("g93 g2 x2 i1 f2; g94", After("feed_rate = 6.283185307179586")),
            ("g93 g3 x0 i1 f2; g94", After("feed_rate = 12.566370614359172")),
            ("f7; g93; g0 x9; g94", After("feed_rate = 7")),
        ],
    );
}

#[test]
fn lengths_are_stored_as_programmed_by_choice() {
    check_under(
        &[("offsets.stored-unit", "as-programmed")],
        &[
            ("g20; g10 l2 p2 x1; g21 g55", After("g5x_offset = (x1), #5241 = 1")),
            ("g20 g54; g92 x1; g21", After("g92_offset = (x-25.4), #5211 = -1")),
        ],
    );
}

#[test]
fn offsets_have_no_flag_and_no_rotation_by_choice() {
    check("g92 x7", After("#5210 = 1"));
    check("g10 l2 p1 r90; g54", After("rotation = 90"));
    let fixture = "g10 l2 p9 r180; g10 l11 p1 y1; g43 h1";
    check(fixture, After("tool_offset = (x0.00000000000000012246467991473532 y1 z10)"));
    check_under(
        &[("offsets.flag-and-rotation", "none")],
        &[
            ("g92 x7", After("#5210 = 0, #5211 = -7")),
            ("g92 x7; g92.2; g92.3", After("#5210 = 0, g92_offset = (x-7)")),
            ("g10 l2 p1 r90; g54", After("rotation = 0, #5230 = 90")),
            (fixture, After("tool_offset = (y-1 z10)")),
        ],
    );
}
