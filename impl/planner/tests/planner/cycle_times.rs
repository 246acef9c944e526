//! The servo cycles of programs are those in `cycle_times.txt`. A change of the planner changes that file, so a review
//! sees each gain and each loss.

use std::fmt::Write as _;
use std::path::Path as FilePath;

use gaugeblock_planner::{
    Axes, Dynamics, Feed, InputParameter, Path, PathControl, Planner, Segment,
};
use libm::{cos, sin};

use super::check::{Feeding, dynamics, run_with};
use super::jerk::with_jerk;
use super::programs::{arcs, arcs_with_corners, at, dense, distance, helix, line, square, zig};
use super::random::{Dice, random_motion, restless};

const ORIGIN: Axes = [0.0; 9];
const FILE: &str = "tests/planner/cycle_times.txt";

const PATH_CONTROLS: [(&str, PathControl); 5] = [
    ("exact stop", PathControl::ExactStop),
    ("exact path", PathControl::ExactPath),
    ("P0.01", PathControl::Within(0.01)),
    ("P0.1", PathControl::Within(0.1)),
    ("without P", PathControl::BetweenMidpoints),
];

/// A part of the list: a title, and cycles for each of its lines.
struct Table {
    text: String,
}

impl Table {
    fn part(&mut self, title: &str) {
        let _infallible = writeln!(self.text, "\n# {title}");
    }

    fn row(&mut self, name: &str, cycles: impl IntoIterator<Item = usize>) {
        let cycles: Vec<_> = cycles.into_iter().map(|cycles| cycles.to_string()).collect();
        let _infallible = writeln!(self.text, "{name}: {}", cycles.join(" "));
    }
}

fn cycles(
    dynamics: Dynamics,
    start: Axes,
    program: &[Segment],
    feeding: Feeding,
    operator: &[InputParameter],
) -> usize {
    let mut planner = Planner::new(dynamics, start).expect("limits");
    let input = |cycle: usize| operator.get(cycle).copied().unwrap_or_default();
    run_with(&mut planner, start, program, feeding, input).outputs.len()
}

fn at_feed(program: &[Segment], per_minute: f64) -> Vec<Segment> {
    let feed = Feed::PerSecond(per_minute / 60.0);
    program.iter().map(|segment| Segment { feed, ..*segment }).collect()
}

/// The cycles of a program at slow, moderate and fast feeds.
fn at_feeds(dynamics: Dynamics, start: Axes, program: &[Segment]) -> Vec<usize> {
    let feeds = [600.0, 3000.0, 12_000.0];
    feeds.map(|feed| cycles(dynamics, start, &at_feed(program, feed), Feeding::Full, &[])).to_vec()
}

/// Chords of a curve through X, Y and Z, rounded as a post rounds them.
fn rounded(chord: f64, decimals: f64, control: PathControl) -> Vec<Segment> {
    let curve = |t: f64| at(12.0 * sin(t), 8.0 * sin(2.0 * t), 1.5 * cos(3.0 * t) - 1.5);
    let (mut t, mut here) = (0.0, ORIGIN);
    let mut program = Vec::new();
    while t < std::f64::consts::TAU {
        t += 0.001;
        if distance(&curve(t), &here) >= chord {
            here = curve(t);
            let end = here.map(|value| (value * decimals).round() / decimals);
            program.push(line(end, control));
        }
    }
    program
}

/// Corners of every kind: lines and arcs of many lengths, at feeds and rapids, along three axes or with a rotation.
fn corners(seed: u64, control: PathControl) -> Vec<Segment> {
    let mut dice = Dice::new(seed);
    let (mut here, mut heading) = (ORIGIN, 0.0_f64);
    let mut program = Vec::new();
    for _ in 0..40 {
        heading += dice.between(-2.5, 2.5);
        let length = dice.any_size(0.05, 8.0);
        let mut end = here;
        end[0] += length * cos(heading);
        end[1] += length * sin(heading);
        match dice.below(6) {
            0 => end[2] += dice.between(-length, length),
            1 => end[3] += dice.between(-20.0, 20.0),
            _ => {}
        }
        let path = if dice.below(3) == 0 {
            let side = if dice.below(2) == 0 { 1.0 } else { -1.0 };
            let middle = [0.5 * (here[0] + end[0]), 0.5 * (here[1] + end[1])];
            let centre = [middle[0], middle[1], here[2]];
            Path::Arc { end, centre, normal: [0.0, 0.0, 1.0], angle: side * std::f64::consts::PI }
        } else {
            Path::Straight { end }
        };
        let feed = match dice.below(5) {
            0 => Feed::Rapid,
            1 => Feed::InTime(dice.between(0.05, 0.5)),
            _ => Feed::PerSecond(dice.any_size(3.0, 200.0)),
        };
        program.push(Segment { number: 0, path, feed, path_control: control, probing: false });
        here = end;
    }
    program
}

fn table() -> String {
    let mut table = Table { text: String::from(HEAD) };
    let (start, _) = arcs_with_corners(PathControl::ExactStop);
    let jerks = [("", dynamics()), (", jerk 1e5", with_jerk(1e5))];
    table.part("Known programs at F600, F3000 and F12000");
    for (jerk, dynamics) in jerks {
        for (name, control) in PATH_CONTROLS {
            let programs = [
                ("zig-zag", ORIGIN, zig(control)),
                ("square", ORIGIN, square(control)),
                ("arcs", ORIGIN, arcs(control)),
                ("helix", ORIGIN, helix(control)),
                ("arcs with corners", start, arcs_with_corners(control).1),
            ];
            for (program, start, segments) in programs {
                table
                    .row(&format!("{program}, {name}{jerk}"), at_feeds(dynamics, start, &segments));
            }
        }
    }
    table.row("dense, P0.01", at_feeds(dynamics(), ORIGIN, &dense(PathControl::Within(0.01))));
    table.part("Curves of chords, by length and decimals, at F600, F3000 and F12000");
    for chord in [0.016, 0.05, 0.3] {
        for (unit, decimals) in [("0.01", 100.0), ("0.001", 1000.0), ("exact", 1e12)] {
            for (name, control) in PATH_CONTROLS.into_iter().skip(2) {
                let program = rounded(chord, decimals, control);
                let cycles = at_feeds(dynamics(), ORIGIN, &program);
                table.row(&format!("chords of {chord}, {unit}, {name}"), cycles);
            }
        }
    }
    table.part("Corners of all kinds, by path control, of twelve programs each");
    for (jerk, dynamics) in jerks {
        for (name, control) in PATH_CONTROLS {
            let of = |seed| cycles(dynamics, ORIGIN, &corners(seed, control), Feeding::Full, &[]);
            table.row(&format!("corners, {name}{jerk}"), (0..12).map(of));
        }
    }
    table.part("Random motions, ten of them in a line");
    for tens in 0_u64..8 {
        let of = |seed| {
            let it = random_motion(seed, false);
            cycles(it.dynamics, it.start, &it.program, it.feeding, &it.operator)
        };
        table.row(&format!("untouched {tens}"), (10 * tens..10 * tens + 10).map(of));
    }
    for tens in 0_u64..8 {
        let of = |seed| {
            let it = random_motion(1000 + seed, true);
            cycles(it.dynamics, it.start, &it.program, it.feeding, &it.operator)
        };
        table.row(&format!("with an operator {tens}"), (10 * tens..10 * tens + 10).map(of));
    }
    for tens in 0_u64..4 {
        let of = |seed| {
            let it = restless(2000 + seed);
            cycles(it.dynamics, it.start, &it.program, it.feeding, &it.operator)
        };
        table.row(&format!("with a restless operator {tens}"), (10 * tens..10 * tens + 10).map(of));
    }
    table.text
}

const HEAD: &str = "\
# Servo cycles of 0.001 s from the first segment to rest, by program.
# `GAUGEBLOCK_BLESS=1 cargo test -p gaugeblock-planner --test planner cycle_times` writes this file.
";

#[test]
fn programs_take_the_cycles_that_are_listed() {
    let path = FilePath::new(env!("CARGO_MANIFEST_DIR")).join(FILE);
    let table = table();
    if std::env::var_os("GAUGEBLOCK_BLESS").is_some() {
        std::fs::write(&path, &table).expect("the list can be written");
    }
    let listed = std::fs::read_to_string(&path).expect("the list");
    let changed: Vec<_> = listed.lines().zip(table.lines()).filter(|(a, b)| a != b).collect();
    let number = (listed.lines().count(), table.lines().count());
    assert!(
        changed.is_empty() && number.0 == number.1,
        "{number:?} lines; listed, and now: {changed:#?}"
    );
}
