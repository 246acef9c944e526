//! Programs whose times on LinuxCNC are known: never slower than that, and near the optimum.

use gaugeblock_planner::{Axes, Path, PathControl, Segment};

use super::check::{Feeding, Run, dynamics, farthest, programmed, run};
use super::programs::{arcs, arcs_with_corners, at, dense, helix, line, square, zig};

const ORIGIN: Axes = [0.0; 9];
pub(crate) const FEEDINGS: [Feeding; 6] = [
    Feeding::Full,
    Feeding::Every(0, 1),
    Feeding::Every(0, 5),
    Feeding::Every(0, 20),
    Feeding::Every(0, 31),
    Feeding::Every(0, 80),
];

fn time(program: &[Segment]) -> f64 {
    run(ORIGIN, program, Feeding::Full).time()
}

/// The time is within a ratio of the known least time, and at most that of LinuxCNC.
#[track_caller]
fn takes(program: &[Segment], least: f64, share: f64, linuxcnc: f64) {
    let time = time(program);
    assert!(time <= linuxcnc, "{time} s, LinuxCNC {linuxcnc} s");
    assert!(time <= least * (1.0 + share) + 0.001, "{time} s, possible {least} s");
}

#[test]
fn zig_zag_is_near_the_bound_of_its_axes() {
    takes(&zig(PathControl::Within(0.01)), 6.197, 0.002, 6.447);
    takes(&zig(PathControl::Within(0.1)), 4.899, 0.004, 5.476);
    takes(&zig(PathControl::BetweenMidpoints), 4.509, 0.0, 4.509);
}

#[test]
fn stops_take_the_time_of_the_closed_form() {
    takes(&zig(PathControl::ExactStop), 6.325, 0.005, 6.402);
    takes(&zig(PathControl::ExactPath), 6.325, 0.005, 6.802);
    takes(&square(PathControl::ExactStop), 1.8, 0.005, 1.802);
    takes(&[line(at(100.0, 0.0, 0.0), PathControl::Within(0.01))], 1.05, 0.005, 1.102);
}

#[test]
fn arcs_and_corners_are_faster_than_on_linuxcnc() {
    takes(&square(PathControl::Within(0.1)), 1.83, 0.0, 1.83);
    takes(&arcs(PathControl::Within(0.01)), 2.543, 0.0, 2.543);
    takes(&helix(PathControl::Within(0.01)), 3.193, 0.02, 3.564);
}

#[test]
fn dense_polyline_is_near_the_smooth_curve() {
    takes(&dense(PathControl::Within(0.01)), 2.075, 0.02, 2.148);
    takes(&dense(PathControl::Within(0.1)), 2.075, 0.02, 2.151);
    takes(&dense(PathControl::BetweenMidpoints), 2.075, 0.02, 2.312);
    takes(&dense(PathControl::ExactPath), 23.636, 0.0, 23.636);
}

#[test]
fn blending_is_never_slower_than_stopping() {
    for program in [zig, square, arcs, dense, helix] {
        let stopping = time(&program(PathControl::ExactStop));
        for tolerance in [0.0001, 0.001, 0.01, 0.1, 1.0] {
            let blending = time(&program(PathControl::Within(tolerance)));
            assert!(blending <= stopping, "{tolerance}: {blending} s, stopping {stopping} s");
        }
    }
}

#[track_caller]
fn keeps_limits(run: &Run) {
    let (speed, change) = run.worst(&dynamics());
    assert!(speed <= 1.0 + 1e-9 && change <= 1.0 + 1e-9, "{speed} {change}");
}

#[test]
fn no_limit_is_broken_at_any_feeding() {
    let (start, corners) = arcs_with_corners(PathControl::Within(0.1));
    let programs = [
        (0.01, ORIGIN, zig(PathControl::Within(0.01))),
        (0.1, ORIGIN, zig(PathControl::Within(0.1))),
        (0.0, ORIGIN, zig(PathControl::ExactStop)),
        (0.1, ORIGIN, square(PathControl::Within(0.1))),
        (0.01, ORIGIN, arcs(PathControl::Within(0.01))),
        (0.1, start, corners),
    ];
    for (tolerance, start, program) in &programs {
        for feeding in FEEDINGS {
            let run = run(*start, program, feeding);
            keeps_limits(&run);
            let (path, vertices) = programmed(*start, program);
            assert_eq!(run.samples.last(), vertices.last(), "{feeding:?}");
            if matches!(feeding, Feeding::Full | Feeding::Every(0, 31)) {
                // Chords of arcs are 0.01² r/8 inside them; between samples the path deviates by an eighth of a
                // cycle's square.
                let (arcs, chord) = (1.3e-4, 2000.0 * 1.5 * 1e-6 / 8.0);
                let (far, missed) =
                    (farthest(&run.samples, &path), farthest(&vertices, &run.samples));
                assert!(far <= tolerance + arcs, "{feeding:?}: {far}");
                assert!(missed <= tolerance + chord, "{feeding:?}: {missed}");
            }
        }
    }
}

#[test]
fn samples_do_not_depend_on_feeding() {
    for program in [
        zig(PathControl::Within(0.1)),
        arcs(PathControl::Within(0.01)),
        square(PathControl::Within(0.1)),
    ] {
        let all = run(ORIGIN, &program, Feeding::Full);
        for feeding in [Feeding::Every(5, 1), Feeding::Every(50, 3), Feeding::Every(3, 5)] {
            assert!(run(ORIGIN, &program, feeding).samples == all.samples, "{feeding:?}");
        }
    }
}

#[test]
fn more_tolerance_never_costs_time() {
    for program in [zig, square, arcs, dense] {
        let mut last = f64::INFINITY;
        for tolerance in [0.0001, 0.0003, 0.001, 0.003, 0.01, 0.03, 0.1, 0.3, 1.0] {
            let time = time(&program(PathControl::Within(tolerance)));
            assert!(time <= last * 1.001 + 0.002, "{tolerance}: {time} s after {last} s");
            last = time;
        }
    }
}

/// A program at another place, with its axes in another order or direction.
fn moved(program: &[Segment], place: impl Fn(&Axes) -> Axes) -> Vec<Segment> {
    let moved = |segment: &Segment| {
        let path = match segment.path {
            Path::Straight { end } => Path::Straight { end: place(&end) },
            other @ (Path::Arc { .. } | Path::Dwell { .. }) => other,
        };
        Segment { path, ..*segment }
    };
    program.iter().map(moved).collect()
}

#[test]
fn place_order_and_sense_of_axes_cost_no_time() {
    for program in [
        zig(PathControl::Within(0.05)),
        square(PathControl::Within(0.2)),
        dense(PathControl::Within(0.01)),
    ] {
        let there = time(&program);
        let mirrored = moved(&program, |end| end.map(|value| -value));
        let turned =
            moved(&program, |[x, y, z, a, b, c, u, v, w]| [*z, *x, *y, *a, *b, *c, *u, *v, *w]);
        let others =
            moved(&program, |[x, y, z, a, b, c, _, _, _]| [0.0, 0.0, 0.0, *a, *b, *c, *x, *y, *z]);
        for other in [mirrored, turned, others] {
            let time = time(&other);
            assert!((time - there).abs() <= 0.0021, "{time} s, {there} s");
        }
        let start = [3.0, -700.0, 11.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0];
        let far = moved(&program, |end| std::array::from_fn(|axis| end[axis] + start[axis]));
        let time = run(start, &far, Feeding::Full).time();
        assert!((time - there).abs() <= 0.0021, "{time} s, {there} s");
    }
}
