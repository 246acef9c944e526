//! How long the planner takes for curves whose chords end on a grid, as posts round them, against the exact curve.
//!
//! `cargo bench -p gaugeblock-benches --bench rounded`
//!
//! Each curve is written as chords of a length, their ends are rounded to a step, and a feed of 200 mm/s is requested
//! with two tolerances. Printed are servo cycles, and the cycles that the exact curve takes at the same limits. A
//! tolerance may make a path faster than the exact curve. With `-- circle` it prints the circle at more tolerances.
#![expect(clippy::print_stdout, reason = "a measurement is printed")]

use std::env;
use std::f64::consts::TAU;
use std::io::{Error, Result};

use gaugeblock_planner::Planner;
use gaugeblock_planner::{
    Axes, Dynamics, Feed, InputParameter, NotQueued, OutputParameter, Path, PathControl, Phase,
    Segment,
};
use libm::{cos, sin};

const FEED: f64 = 200.0;
const VELOCITY: f64 = 250.0;
const ACCELERATION: f64 = 2000.0;
const CYCLE: f64 = 0.001;
/// The points at which an exact curve is planned.
const EXACT_POINTS: u32 = 20_000;
/// Steps of rounding and the lengths of chords that posts write with them, millimetres.
const CHORDS: [(f64, [f64; 3]); 3] =
    [(0.01, [0.053, 0.16, 0.3]), (0.00254, [0.016, 0.053, 0.16]), (0.001, [0.016, 0.053, 0.16])];

/// A curve by a parameter between 0 and 1.
type Curve = fn(f64) -> [f64; 3];

const CURVES: [(&str, Curve); 4] =
    [("circle", circle), ("sine", wave), ("spiral", spiral), ("space curve", space)];

fn circle(t: f64) -> [f64; 3] {
    [25.4 * cos(TAU * t), 25.4 * sin(TAU * t), 0.0]
}

fn wave(t: f64) -> [f64; 3] {
    [80.0 * t, 10.0 * sin(2.0 * TAU * t), 0.0]
}

fn spiral(t: f64) -> [f64; 3] {
    let radius = 3.0 + 12.0 * t;
    [radius * cos(4.0 * TAU * t), radius * sin(4.0 * TAU * t), 0.0]
}

fn space(t: f64) -> [f64; 3] {
    let t = TAU * t;
    [15.0 * sin(2.0 * t), 10.0 * sin(3.0 * t), 2.0 * sin(5.0 * t)]
}

fn main() -> Result<()> {
    if env::args().any(|argument| argument == "circle") {
        return circles();
    }
    println!("curve        step     chord   exact    P0.01     P0.1   lines");
    for (name, curve) in CURVES {
        let exact = exact_cycles(curve);
        for (step, lengths) in CHORDS {
            for length in lengths {
                let ends = rounded(curve, step, length);
                let times = [0.01, 0.1].map(|tolerance| cycles(&ends, tolerance));
                let [narrow, wide] = times;
                print!("{name:12} {step:<8} {length:<6} {exact:6.0}");
                println!("  {:7}  {:7}  {:6}", narrow?, wide?, ends.len());
            }
        }
    }
    Ok(())
}

/// The circle at more tolerances.
fn circles() -> Result<()> {
    println!("chord   step       P0.005    P0.01    P0.02    P0.05     P0.1");
    for (length, step) in [(0.053, 0.001), (0.053, 0.01), (0.016, 0.00254), (0.16, 0.01)] {
        print!("{length:<7} {step:<8}");
        for tolerance in [0.005, 0.01, 0.02, 0.05, 0.1] {
            print!("  {:7}", cycles(&rounded(circle, step, length), tolerance)?);
        }
        println!();
    }
    Ok(())
}

/// The ends of chords of a length, rounded to a step.
fn rounded(curve: Curve, step: f64, length: f64) -> Vec<Axes> {
    let (mut ends, mut walked): (Vec<Axes>, f64) = (Vec::new(), 0.0);
    let mut last = curve(0.0);
    let fine = 400_000_u32;
    for i in 0..=fine {
        let here = curve(f64::from(i) / f64::from(fine));
        walked += apart(&last, &here);
        last = here;
        if walked >= length || i == 0 || i == fine {
            walked = if i == fine { 0.0 } else { (walked - length).max(0.0) };
            let mut end: Axes = [0.0; 9];
            for (end, value) in end.iter_mut().zip(&here) {
                *end = libm::round(value / step) * step;
            }
            ends.push(end);
        }
    }
    ends
}

fn apart(one: &[f64; 3], other: &[f64; 3]) -> f64 {
    let sum: f64 = one.iter().zip(other).map(|(a, b)| (a - b) * (a - b)).sum();
    libm::sqrt(sum)
}

/// The servo cycles of a program of chords, from the first end on.
fn cycles(ends: &[Axes], tolerance: f64) -> Result<u32> {
    let dynamics = Dynamics {
        velocity: [VELOCITY; 9],
        acceleration: [ACCELERATION; 9],
        jerk: None,
        cycle: CYCLE,
        queue: 2000,
    };
    let (start, ends) = ends.split_first().ok_or_else(|| Error::other("no chords"))?;
    let mut planner = Planner::new(dynamics, *start).map_err(Error::other)?;
    let (input, mut output) = (InputParameter::default(), OutputParameter::default());
    let (mut cycles, mut next) = (0_u32, 0_usize);
    loop {
        while let Some(end) = ends.get(next) {
            let segment = Segment {
                number: 0,
                path: Path::Straight { end: *end },
                feed: Feed::PerSecond(FEED),
                path_control: PathControl::Within(tolerance),
                probing: false,
            };
            match planner.queue(&segment) {
                Ok(()) => next += 1,
                Err(NotQueued::Full) => break,
                Err(error) => return Err(Error::other(format!("{error:?}"))),
            }
        }
        if planner.update(&input, &mut output) == Phase::Idle && next == ends.len() {
            return Ok(cycles);
        }
        cycles += 1;
    }
}

/// The cycles of the exact curve: time-optimal at the limits, by a backward and a forward pass over squared speeds.
fn exact_cycles(curve: Curve) -> f64 {
    let places: Vec<[f64; 3]> =
        (0..=EXACT_POINTS).map(|i| curve(f64::from(i) / f64::from(EXACT_POINTS))).collect();
    let steps: Vec<f64> = places.windows(2).map(|two| apart(&two[0], &two[1])).collect();
    let inner = steps.len() - 1;
    // First and second derivatives at inner points.
    let bends: Vec<[[f64; 3]; 2]> = (0..inner).map(|i| derivatives(&places, &steps, i)).collect();
    let mut squares = vec![0.0; inner];
    let mut next = 0.0;
    for i in (0..inner).rev() {
        next = greatest(&bends[i], next, steps[i + 1]);
        squares[i] = next;
    }
    let (mut before, mut time) = (0.0_f64, 0.0);
    for i in 0..inner {
        let [first, second] = bends[i];
        let reversed = [first.map(|rate| -rate), second];
        let now = greatest(&reversed, before, steps[i]).min(squares[i]);
        time += 2.0 * steps[i] / (libm::sqrt(now) + libm::sqrt(before)).max(1e-9);
        before = now;
    }
    (time + 2.0 * steps[inner] / libm::sqrt(before).max(1e-9)) / CYCLE
}

fn derivatives(places: &[[f64; 3]], steps: &[f64], i: usize) -> [[f64; 3]; 2] {
    let (before, after) = (steps[i], steps[i + 1]);
    let mut result = [[0.0; 3]; 2];
    for axis in 0..3 {
        let [a, b, c] = [0, 1, 2].map(|k| places[i + k][axis]);
        let (one, other) = ((b - a) / before, (c - b) / after);
        result[0][axis] = 0.5 * (one + other);
        result[1][axis] = 2.0 * (other - one) / (before + after);
    }
    result
}

/// The greatest squared speed from which at most `next` can be reached in a step.
fn greatest([first, second]: &[[f64; 3]; 2], next: f64, step: f64) -> f64 {
    let fits = |square: f64| {
        let (mut low, mut high) = (0.0_f64, next);
        for (rate, bend) in first.iter().zip(second) {
            let slope = rate.abs() / (2.0 * step);
            let sense = if *rate < 0.0 { -1.0 } else { 1.0 };
            let rest = sense * bend * square - slope * square;
            if slope > 0.0 {
                low = low.max((-ACCELERATION - rest) / slope);
                high = high.min((ACCELERATION - rest) / slope);
            } else if rest.abs() > ACCELERATION {
                return false;
            }
            if rate * rate * square > VELOCITY * VELOCITY {
                return false;
            }
        }
        low <= high
    };
    let (mut low, mut high) = (0.0, FEED * FEED);
    if fits(high) {
        return high;
    }
    for _ in 0..50 {
        let middle = 0.5 * (low + high);
        if fits(middle) {
            low = middle;
        } else {
            high = middle;
        }
    }
    low
}
