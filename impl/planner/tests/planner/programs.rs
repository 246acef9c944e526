//! Programs whose times on LinuxCNC are known, as segments.

use gaugeblock_planner::{Axes, Feed, Path, PathControl, Segment};
use libm::{cos, sin};
use std::f64::consts::{PI, TAU};

/// Millimetres per second: F6000.
pub(crate) const FEED: f64 = 100.0;

pub(crate) fn at(x: f64, y: f64, z: f64) -> Axes {
    [x, y, z, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]
}

pub(crate) fn segment(path: Path, blend: PathControl) -> Segment {
    Segment { number: 0, path, feed: Feed::PerSecond(FEED), path_control: blend, probing: false }
}

pub(crate) fn line(end: Axes, blend: PathControl) -> Segment {
    segment(Path::Straight { end }, blend)
}

/// In the plane of X and Y; the centre as an offset from the start; positive turns counterclockwise.
pub(crate) fn arc(
    start: Axes,
    end: Axes,
    (i, j): (f64, f64),
    angle: f64,
    blend: PathControl,
) -> Segment {
    let centre = [start[0] + i, start[1] + j, start[2]];
    segment(Path::Arc { end, centre, normal: [0.0, 0.0, 1.0], angle }, blend)
}

pub(crate) fn zig(blend: PathControl) -> Vec<Segment> {
    let corner = |i: u32| at(0.5 * f64::from(i), 0.5 * f64::from(i % 2), 0.0);
    (1..=200).map(|i| line(corner(i), blend)).collect()
}

pub(crate) fn square(blend: PathControl) -> Vec<Segment> {
    [(40.0, 0.0), (40.0, 40.0), (0.0, 40.0), (0.0, 0.0)]
        .map(|(x, y)| line(at(x, y, 0.0), blend))
        .to_vec()
}

pub(crate) fn arcs(blend: PathControl) -> Vec<Segment> {
    let origin = at(0.0, 0.0, 0.0);
    let mut program = vec![
        arc(origin, origin, (10.0, 0.0), -TAU, blend),
        arc(origin, origin, (1.0, 0.0), TAU, blend),
    ];
    for i in 0..10_u32 {
        let x = 4.0 * f64::from(i);
        let angle = if i % 2 == 0 { PI } else { -PI };
        program.push(arc(at(x, 0.0, 0.0), at(x + 4.0, 0.0, 0.0), (2.0, 0.0), angle, blend));
    }
    program.push(line(at(0.0, 10.0, 0.0), blend));
    program
}

pub(crate) fn helix(blend: PathControl) -> Vec<Segment> {
    vec![arc(at(0.0, 0.0, 0.0), at(0.0, 0.0, -10.0), (5.0, 0.0), -10.0 * TAU, blend)]
}

/// Chords of 0.1 mm of (15 sin 2t, 10 sin 3t, 2 sin 5t), with five decimals.
pub(crate) fn dense(blend: PathControl) -> Vec<Segment> {
    let curve = |t: f64| at(15.0 * sin(2.0 * t), 10.0 * sin(3.0 * t), 2.0 * sin(5.0 * t));
    let rounded = |p: Axes| p.map(|value| (value * 1e5).round() / 1e5);
    let mut t = 0.0;
    let mut program = Vec::new();
    for _ in 0..2000 {
        let here = curve(t);
        let (mut low, mut high) = (t, t + 0.02);
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if distance(&here, &curve(middle)) < 0.1 { low = middle } else { high = middle }
        }
        t = high;
        program.push(line(rounded(curve(t)), blend));
    }
    program
}

/// Arcs of 4 mm that meet at corners, from X1.
pub(crate) fn arcs_with_corners(blend: PathControl) -> (Axes, Vec<Segment>) {
    let start = at(1.0, 0.0, 0.0);
    let mut here = start;
    let mut program = Vec::new();
    for i in 0..60_u32 {
        let (sweep, direction) = (0.35 + 0.2 * f64::from(i % 3), 0.9 * sin(1.7 * f64::from(i)));
        let chord = 8.0 * sin(0.5 * sweep);
        let end = at(here[0] + chord * cos(direction), here[1] + chord * sin(direction), 0.0);
        let height = 4.0 * cos(0.5 * sweep);
        let centre = (
            0.5 * (end[0] - here[0]) - height * sin(direction),
            0.5 * (end[1] - here[1]) + height * cos(direction),
        );
        program.push(arc(here, end, centre, sweep, blend));
        here = end;
    }
    (start, program)
}

pub(crate) fn distance(a: &Axes, b: &Axes) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum::<f64>().sqrt()
}
