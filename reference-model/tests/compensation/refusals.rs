//! What is refused, and what is left open.

use gaugeblock_vocabulary::End;

use super::{Move, completed, ending, leads, moves, outcome, outcome_under};

/// Whether a program ends so at a line; its first block is line 2.
#[track_caller]
fn ends(blocks: &str, end: (&str, u32)) {
    let outcome = outcome(&format!("{blocks}; m2"));
    assert_eq!(ending(&outcome), end, "{blocks}\n{}", outcome.to_text());
}

#[test]
fn an_entry_is_as_long_as_the_radius() {
    for entry in ["g1 x.1", "g1 z1", "g0 a3", "g1 x0", "g2 x.2 i.1", "g2 i1"] {
        ends(&format!("g41.1 d.5; {entry}"), ("gouging", 3));
    }
    ends("g42.1 d.5; g2 x.2 y.2 i.2", ("gouging", 3));
    for entry in ["g1 x.25", "g1 x.2501", "g2 x.25 i.125"] {
        completed(&format!("g41.1 d.5; {entry}"));
    }
    let observed = [("rs274.compensation-entry-equal", "observed")];
    for entry in ["g1 x.25", "g2 x.25 i.125"] {
        let outcome = outcome_under(&observed, &format!("g41.1 d.5; {entry}; m2"));
        assert_eq!(ending(&outcome), ("gouging", 3), "{entry}");
    }
}

#[test]
fn an_arc_around_the_tool_is_larger() {
    ends("g41.1 d.5; g1 x1; x2; g3 x2.1 y.1 j.1", ("gouging", 5));
    ends("g41.1 d.5; g1 x1; x2; g3 x2.25 y.25 j.25", ("gouging", 5));
    completed("g42.1 d.5; g1 x1; x2; g3 x2.1 y.1 j.1");
}

#[test]
fn curves_of_an_inner_corner_cross() {
    ends("g41.1 d.5; g1 x5; g3 x5.1 y.1 r.1", ("gouging", 4));
    ends("g41.1 d2; g1 x5; y2; g3 x4.8 y1.9 r1.1", ("gouging", 5));
}

#[test]
fn the_tool_fits_between_two_corners() {
    ends("g41.1 d.5; g1 x1; y.4; x0; y3", ("gouging", 5));
    ends("g41.1 d.5; g1 x1; y.2; x5", ("gouging", 5));
    ends("g41.1 d.5; g1 x1; y.2; g40", ("gouging", 5));
    ends("g41.1 d.5; g1 x1; y.2; m0", ("gouging", 5));
    ends("g41.1 d.5; g1 x1; y.2", ("gouging", 5));
    ends("g42.1 d.5; g1 x2; g2 x2.1 y-.2 r1; g1 x1.5", ("gouging", 5));
    // In front of an outer corner with an arc it is not checked.
    completed("g41.1 d.5; g1 x1; y.2; g2 x2 y1.2 i1; g40; g1 x8");
}

#[test]
fn codes_are_refused_along_a_path() {
    let observed = [
        ("offsets.change-under-compensation", "refused"),
        ("tool.change-under-compensation", "refused"),
        ("tool.length-under-compensation", "refused"),
        ("overrides.under-compensation", "refused"),
        ("outputs.under-compensation", "refused"),
        ("inputs.under-compensation", "refused"),
        ("units-planes.plane-under-compensation", "refused"),
        ("rs274.path-under-compensation", "observed"),
        ("rs274.retract-under-compensation", "observed"),
        ("rs274.position-under-compensation", "observed"),
    ];
    for code in [
        "g41.1 d.5",
        "g42 d10",
        "g18",
        "g19",
        "g28",
        "g30",
        "g28.1",
        "g30.1",
        "g53 g0 x0",
        "g92 x1",
        "g52 x1",
        "g10 l2 p1 x1",
        "g10 l20 p1 x1",
        "g54",
        "g59.3",
        "g38.2 x5",
        "g81 r1 z0",
        "g43 h10",
        "g43.1 z1",
        "g49",
        "t10 m6",
        "g5 i1 j1 p1 q1 x5 y5",
        "g5.1 i1 x5 y5",
        "g61",
        "g64",
        "g98",
        "g99",
        "m48",
        "m50",
        "m62 p0",
        "m64 p0",
        "m66 p0",
        "m68 e0 q1",
        "#1=#5420",
        "g71 q100",
        "g72 q100",
        "g71.2 q100",
    ] {
        let outcome = outcome_under(&observed, &format!("g41.1 d.5; g1 x1; y1; {code}; m2"));
        assert_eq!(ending(&outcome), ("compensation_active", 5), "{code}\n{}", outcome.to_text());
    }
}

#[test]
fn other_codes_are_accepted_along_a_path() {
    let path = moves(&completed("g41.1 d.5; g1 x1; y1; x0; g40; x3"));
    for code in [
        "g7; g8",
        "g90",
        "g91.1",
        "g90.1",
        "g94",
        "f3",
        "s100",
        "m3",
        "m5",
        "m7",
        "m9",
        "t10",
        "m70",
        "m71",
        "m73",
        "g17",
        "g20",
        "g80",
        "g10 l2 p2 x1",
        "g92.1",
        "g92.2",
        "g92.3",
        "(msg,here)",
        "#1=5",
        "o1 if [1]; o1 endif",
        "m19 r0 q1",
        "g4 p1",
    ] {
        let program = format!("m70; g41.1 d.5; g1 x1; y1; {code}; g1 x0; g40; x3");
        leads(&moves(&completed(&program)), &path);
    }
}

#[test]
fn a_local_offset_neither_goes_nor_comes_back_along_a_path() {
    let path = "g41.1 d.5; g1 x7; y2; CODE; x3; g40; x2; y5";
    let expected = moves(&completed(&format!("g92 x5; {}", path.replace("CODE", "g4 p0"))));
    leads(&moves(&completed(&format!("g92 x5; {}", path.replace("CODE", "g92.1")))), &expected);
}

#[test]
fn no_arc_follows_compensation() {
    ends("g41.1 d.5; g1 x1; y1; g40; g2 x3 i1", ("modal_conflict", 6));
    ends("g41.1 d.5; g1 x1; y1; g40; g41.1 d.5; g2 x3 y1 i1", ("modal_conflict", 7));
    ends("g41.1 d.5; g40; g2 x2 i1", ("modal_conflict", 4));
    ends("g41.1 d.5; g40; g40; g2 x2 i1", ("modal_conflict", 5));
    completed("g41.1 d.5; g1 x1; y1; g40; m3 s100; g33 z-1 k.1; g2 x3 y1 i1");
    completed("g41.1 d.5; g1 x1; y1; g40; g28; g2 x2 y0 i1");
    completed("g40; g2 x2 i1");
    let observed = [("rs274.compensation-exit-arc", "observed")];
    let observed = |blocks: &str| outcome_under(&observed, &format!("{blocks}; m2"));
    assert_eq!(observed("g41.1 d.5; g40; g2 x2 i1").end, End::ProgramEnd);
    let after_position = observed("g41.1 d.5; g1 x1; y1; g40; g28; g2 x2 y0 i1");
    assert_eq!(ending(&after_position), ("modal_conflict", 7));
}

#[test]
fn the_line_after_compensation_is_longer_than_the_diameter() {
    let path = "g41.1 d.5; g1 x1; y1; g40";
    for line in ["g0 x1.2", "g1 x.9", "g0 z.3", "g1 x1", "g91 g1 y.2", "g41.1 d.1; g1 x1.2"] {
        let blocks = format!("{path}; {line}");
        let last = 5 + u32::from(line.contains(';'));
        ends(&blocks, ("gouging", last + 1));
        let observed = [("rs274.compensation-exit-length", "observed")];
        assert_eq!(outcome_under(&observed, &format!("{blocks}; m2")).end, End::ProgramEnd);
    }
    for line in ["g0 x1.6", "g1 z.6", "g1 x.2", "g4 p1; g0 x3", "g21; g0 x40", "g92 x5; g0 x6"] {
        completed(&format!("{path}; {line}"));
    }
    // Longer from one of both points, as long, by other axes, turned.
    for line in ["g0 x.45", "g0 a90", "g0 x1.2 u1"] {
        ends(&format!("{path}; {line}"), ("unspecified", 6));
    }
    ends("g41.1 d.5; g40; g0 x.5", ("unspecified", 4));
    ends(&format!("{path}; g10 l2 p1 r30; g0 x5"), ("unspecified", 7));
}

#[test]
fn an_arc_in_front_of_a_traverse_needs_a_feed_rate() {
    let arc = [("compensation.corner-before-traverse", "arc")];
    let blocks = "g42.1 d.5; g0 x1; y1; m2";
    let joined = moves(&outcome_under(&arc, blocks));
    leads(&joined[1..2], &[Move::Arc([1.25, 0.0], [1.0, 0.0], 1)]);
    let outcome = outcome_under(&arc, &format!("g93; {blocks}"));
    assert_eq!(ending(&outcome), ("unspecified", 5));
}

#[test]
fn a_tool_with_an_orientation_needs_the_plane_of_a_lathe() {
    for orientation in 1..=8 {
        ends(&format!("g41 d{}", 10 + orientation), ("modal_conflict", 2));
    }
    completed("g41 d19");
}

#[test]
fn what_is_open_is_not_specified() {
    for (blocks, line) in [
        ("g41.1 d.5; g1 x1; x2; m1; g3 x0 y0 i-1", 6),
        ("g42.1 d.5; g1 x1; x2; m1; g3 x4 i1", 6),
        ("g18 g41 d12; g2 x1 z1 k1", 3),
        ("g42.1 d1; g2 x.966 y.304 i1.0104688 j-1.5241; g1 x2.6 y-4.3", 4),
        ("g41.1 d.5; g1 x1 u1", 3),
        ("g41.1 d.5; g1 x1; y1; m61 q10", 5),
        ("m70; g41.1 d.5; g1 x1; y1; m70; g40; g42.1 d.5; g1 x3; m72", 10),
    ] {
        ends(blocks, ("unspecified", line));
    }
}

#[test]
fn a_restore_of_g40_ends_the_path() {
    leads(
        &moves(&completed("m70; g41.1 d.5; g1 x1; y1; m72; g1 x3; y0")),
        &moves(&completed("g41.1 d.5; g1 x1; y1; g40; x3; y0")),
    );
    leads(
        &moves(&completed("o1 sub; m73; g41.1 d.5; g1 x1; y1; o1 endsub; o1 call; g1 x3; y0")),
        &moves(&completed("g41.1 d.5; g1 x1; y1; g40; x3; y0")),
    );
}
