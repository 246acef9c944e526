//! The smallest motion program that still has a property.

use std::collections::BTreeMap;

use gaugeblock_vocabulary::motion::PathMode;

use super::{MotionProgram, Pace, Step};

/// Tries smaller motion programs, at most `attempts` of them, and keeps those for which `holds` is true. It reads no
/// clock and draws no random number.
pub fn shrunk(
    program: &MotionProgram,
    mut attempts: u32,
    holds: &mut dyn FnMut(&MotionProgram) -> bool,
) -> MotionProgram {
    let mut best = program.clone();
    loop {
        let before = best.clone();
        let mut attempt = |best: &mut MotionProgram, smaller: MotionProgram| {
            if attempts == 0 || smaller == *best {
                return false;
            }
            attempts -= 1;
            let kept = holds(&smaller);
            if kept {
                *best = smaller;
            }
            kept
        };
        fewer_steps(&mut best, &mut attempt);
        fewer_events(&mut best, &mut attempt);
        plainer(&mut best, &mut attempt);
        if best == before {
            return best;
        }
    }
}

type Attempt<'a> = dyn FnMut(&mut MotionProgram, MotionProgram) -> bool + 'a;

/// Rows of steps go, long ones first.
fn fewer_steps(best: &mut MotionProgram, attempt: &mut Attempt<'_>) {
    let mut row = best.steps.len() / 2;
    while row > 0 {
        let mut from = 0;
        while from + row <= best.steps.len() {
            let mut smaller = best.clone();
            smaller.steps.drain(from..from + row);
            if !attempt(best, smaller) {
                from += row;
            }
        }
        row /= 2;
    }
}

fn fewer_events(best: &mut MotionProgram, attempt: &mut Attempt<'_>) {
    let mut place = 0;
    while place < best.script.events.len() {
        let mut smaller = best.clone();
        smaller.script.events.remove(place);
        if !attempt(best, smaller) {
            place += 1;
        }
    }
    for place in 0..best.script.events.len() {
        for round in [100, 10] {
            let mut smaller = best.clone();
            let event = &mut smaller.script.events[place];
            event.cycle = event.cycle / round * round;
            if smaller.script.events.is_sorted_by_key(|event| event.cycle) {
                attempt(best, smaller);
            }
        }
    }
}

/// Conditions and numbers to start from.
fn plainer(best: &mut MotionProgram, attempt: &mut Attempt<'_>) {
    let smaller = MotionProgram { every: None, ..best.clone() };
    attempt(best, smaller);
    let mut smaller = best.clone();
    for limit in smaller.limits.axes.values_mut() {
        (limit.velocity, limit.acceleration) = (Some(250.0), Some(2000.0));
    }
    attempt(best, smaller);
    let mut smaller = best.clone();
    smaller.limits.axes.values_mut().for_each(|limit| limit.jerk = None);
    attempt(best, smaller);
    let mut smaller = best.clone();
    for limit in smaller.limits.axes.values_mut() {
        limit.jerk = limit.jerk.map(|_| 1e5);
    }
    attempt(best, smaller);
    let smaller = MotionProgram {
        limits: gaugeblock_vocabulary::motion::MotionLimits {
            period: 0.001,
            axes: BTreeMap::clone(&best.limits.axes),
        },
        ..best.clone()
    };
    attempt(best, smaller);
    for axis in (0..9).rev() {
        let mut smaller = best.clone();
        smaller.start[axis] = 0.0;
        smaller.steps.iter_mut().filter_map(Step::end_mut).for_each(|end| end[axis] = 0.0);
        attempt(best, smaller);
    }
    for place in 0..best.steps.len() {
        for digits in [1.0, 100.0] {
            let mut smaller = best.clone();
            round(&mut smaller.steps[place], digits);
            attempt(best, smaller);
        }
    }
}

/// To so many parts of one.
fn round(step: &mut Step, digits: f64) {
    let round = |value: f64| {
        let rounded = libm::round(value * digits) / digits;
        if rounded.abs() > 0.0 { rounded } else { value }
    };
    match step {
        Step::Mode(PathMode::Within { tolerance, .. }) => *tolerance = round(*tolerance),
        Step::Pace(Pace::PerMinute(feed) | Pace::PerMove(feed) | Pace::PerTurn(feed)) => {
            *feed = round(*feed);
        }
        Step::Line(end) | Step::Rapid(end) => *end = end.map(round),
        Step::Dwell(seconds) => *seconds = round(*seconds),
        Step::Mode(PathMode::ExactStop | PathMode::ExactPath | PathMode::BetweenMidpoints)
        | Step::Arc { .. }
        | Step::Output { .. } => {}
    }
}
