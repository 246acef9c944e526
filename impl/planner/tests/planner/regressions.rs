//! Regressions: motions that random tests found, each of which failed once.

use gaugeblock_planner::{
    Axes, Feed, Hold, InputParameter, OutputParameter, OutputSwitch, PathControl, Planner, Segment,
};

use super::check::{Feeding, Run, dynamics, farthest, programmed, run, run_with};
use super::programs::{arc, at, dense, distance, line};

const ORIGIN: Axes = [0.0; 9];

fn operated(start: Axes, program: &[Segment], wants: impl FnMut(usize) -> InputParameter) -> Run {
    let mut planner = Planner::new(dynamics(), start).expect("limits");
    run_with(&mut planner, start, program, Feeding::Full, wants)
}

#[test]
fn corner_is_as_narrow_as_its_stricter_segment() {
    let start = at(169.0, 49.3, 0.0);
    for tolerances in [(0.01, 0.005), (0.005, 0.01), (f64::INFINITY, 0.005)] {
        let blend = |tolerance: f64| {
            if tolerance.is_finite() {
                PathControl::Within(tolerance)
            } else {
                PathControl::BetweenMidpoints
            }
        };
        let program = [
            line(at(172.0, 46.0, 0.0), blend(tolerances.0)),
            line(at(171.39, 44.21, 0.0), blend(tolerances.1)),
        ];
        let samples = run(start, &program, Feeding::Full).samples;
        let far = farthest(&samples, &programmed(start, &program).0);
        assert!(far <= 0.005, "{tolerances:?}: {far}");
    }
}

#[test]
fn exact_path_is_not_left_and_not_crawled_along() {
    let program = dense(PathControl::ExactPath);
    let run = run(ORIGIN, &program, Feeding::Full);
    let (path, vertices) = programmed(ORIGIN, &program);
    let (speed, change) = run.worst(&dynamics());
    assert!(speed <= 1.0 + 1e-9 && change <= 1.0 + 1e-9, "{speed} {change}");
    let every_tenth: Vec<Axes> = run.samples.iter().step_by(10).copied().collect();
    assert!(farthest(&every_tenth, &path) <= 1e-9);
    // Between two samples a motion can deviate from their chord by an eighth of what the acceleration of a cycle
    // makes.
    let missed = farthest(&vertices[..200], &run.samples[..1500.min(run.samples.len())]);
    assert!(missed <= 2000.0 * 1.7321 * 1e-6 / 8.0, "{missed}");
    assert!(run.time() < 6.0, "{}", run.time());
}

#[test]
fn arc_whose_end_is_rounded_nears_its_axis_evenly() {
    let start = at(1.0, 0.0, 0.0);
    let quarter = std::f64::consts::FRAC_PI_2;
    let end = at(0.0, 1.000_01, 0.0);
    let program = [arc(start, end, (-1.0, 0.0), quarter, PathControl::ExactStop)];
    for point in run(start, &program, Feeding::Full).samples {
        let share = libm::atan2(point[1], point[0]) / quarter;
        let radius = libm::hypot(point[0], point[1]);
        assert!((radius - 1.0 - 1e-5 * share).abs() < 1e-12, "{share} {radius}");
    }
}

#[test]
fn feed_per_revolution_is_kept_from_the_start_and_overridden() {
    let mut program = vec![
        line(at(20.0, 0.0, 0.0), PathControl::Within(0.01)),
        line(at(30.0, 0.0, 0.0), PathControl::Within(0.01)),
        line(at(30.0, 5.0, 0.0), PathControl::Within(0.01)),
        line(at(40.0, 5.0, 0.0), PathControl::Within(0.01)),
    ];
    program[1].feed = Feed::PerTurn(0.5);
    program[2].feed = Feed::PerTurn(0.5);
    for (feed_override, most) in [(1.0, 5.0), (0.5, 2.5)] {
        let mut turns = 0.0;
        let run = operated(ORIGIN, &program, |_| {
            turns += 10.0 * 0.001;
            InputParameter { feed_override, spindle_turns: turns, ..InputParameter::default() }
        });
        let (speed, change) = run.worst(&dynamics());
        assert!(speed <= 1.0 + 1e-9 && change <= 1.0 + 1e-9, "{speed} {change}");
        let within = |output: &&OutputParameter| matches!(output.segment, 2 | 3);
        // The cycle that passes the corner has a part of both.
        let seen = run.outputs.iter().filter(within).skip(1).map(|output| output.speed);
        let fastest = seen.fold(0.0, f64::max);
        assert!((fastest - most).abs() <= 1e-9 * most, "{fastest} of {most}");
    }
}

#[test]
fn rapid_override_applies_to_a_blend_with_a_rapid_move() {
    let mut program = [
        line(at(0.0, -20.0, 0.0), PathControl::Within(0.5)),
        line(at(0.0, -40.0, 5.0), PathControl::Within(0.5)),
    ];
    program[0].feed = Feed::PerSecond(240.0);
    program[1].feed = Feed::Rapid;
    let input = InputParameter { rapid_override: 0.2, ..InputParameter::default() };
    let run = operated(ORIGIN, &program, |_| input);
    let late = run.outputs.iter().filter(|output| output.position[2] > 0.0);
    let fastest = late.map(|output| output.velocity[1].abs()).fold(0.0, f64::max);
    assert!(fastest <= 50.0, "{fastest}");
}

#[test]
fn output_does_not_switch_while_its_move_is_held() {
    let mut planner = Planner::new(dynamics(), ORIGIN).expect("limits");
    let mut output = OutputParameter::default();
    planner.queue(&line(at(1.0, 0.0, 0.0), PathControl::Within(0.01))).expect("room");
    for _ in 0..200 {
        planner.update(&InputParameter::default(), &mut output);
    }
    planner.queue_output(OutputSwitch { output: 1, value: 1.0 }).expect("room");
    planner.queue(&line(at(2.0, 0.0, 0.0), PathControl::Within(0.01))).expect("room");
    for cycle in 0..200 {
        let hold = if cycle < 100 { Hold::Hold } else { Hold::Run };
        planner.update(&InputParameter { hold, ..InputParameter::default() }, &mut output);
        let switched = planner.next_switched_output().is_some();
        assert_eq!(switched, cycle == 100, "{cycle}");
    }
}

#[test]
fn hold_on_an_arc_uses_the_limits_of_the_axes_in_each_direction() {
    let mut circle =
        arc(ORIGIN, ORIGIN, (1.24155, -0.44987), std::f64::consts::TAU, PathControl::ExactStop);
    circle.feed = Feed::InTime(60.0 / 831.0);
    let run = operated(ORIGIN, &[circle], |cycle| InputParameter {
        hold: if (80..400).contains(&cycle) { Hold::Hold } else { Hold::Run },
        ..InputParameter::default()
    });
    let (speed, change) = run.worst(&dynamics());
    assert!(speed <= 1.0 + 1e-9 && change <= 1.0 + 1e-9, "{speed} {change}");
    let steps = run.samples[81..400].windows(2).map(|two| distance(&two[0], &two[1]));
    let way: f64 = steps.sum();
    // The stopping time by the limits of the axes, plus two cycles.
    assert!(way <= 0.634 + 2.0 * 51.0 * 0.001 + 1e-3, "{way}");
}

/// A long flat blend had one acceleration, so all of it was as slow as the corners at its ends.
#[test]
fn long_flat_blend_speeds_up_and_slows_down() {
    let start = at(0.0, 159.429_93, -78.820_16);
    let time = |tolerance: f64| {
        let to = |y: f64, z: f64| Segment {
            feed: Feed::PerSecond(12741.0 / 60.0),
            ..line(at(0.0, y, z), PathControl::Within(tolerance))
        };
        let program = [to(159.435_01, -78.9409), to(159.438_23, -79.067_15), to(159.0, -79.0)];
        run(start, &program, Feeding::Full).time()
    };
    let (strict, loose) = (time(0.000_29), time(0.000_8));
    assert!(loose <= strict + 0.002, "{strict} s, {loose} s with more allowed");
}

/// A blend with a feed per revolution that was queued with the next move did not follow the spindle and never ended.
#[test]
fn blend_after_the_last_feed_per_revolution_follows_the_spindle() {
    for (feed, blend) in
        [(Feed::Rapid, PathControl::BetweenMidpoints), (Feed::Rapid, PathControl::Within(0.1))]
    {
        let mut program = [
            line(at(2.0, 0.0, 0.0), blend),
            line(at(2.5, 2.0, 0.0), blend),
            line(at(4.0, 2.0, 0.0), blend),
            line(at(4.0, 4.0, 0.0), blend),
        ];
        program[0].feed = Feed::PerTurn(0.5);
        program[1].feed = Feed::PerTurn(0.5);
        program[2].feed = feed;
        for last in [2, 3, 4] {
            let mut turns = 0.0;
            let run = operated(ORIGIN, &program[..last], |_| {
                turns += 10.0 * 0.001;
                InputParameter { spindle_turns: turns, ..InputParameter::default() }
            });
            assert!(run.time() < 1.2, "{last}: {} s", run.time());
        }
    }
}

/// A blend of many cycles between two stops or slow corners was passed with one acceleration, so that a longer one
/// took longer.
#[test]
fn blend_speeds_up_within_its_length_and_slows_down_again() {
    let time = |feed: f64, tolerance: f64, ends: &[(f64, f64)]| {
        let to = |(x, y): &(f64, f64)| Segment {
            feed: Feed::PerSecond(feed / 60.0),
            ..line(at(*x, *y, 0.0), PathControl::Within(tolerance))
        };
        run(ORIGIN, &ends.iter().map(to).collect::<Vec<_>>(), Feeding::Full).time()
    };
    let corner = [(-0.020_35, -0.032_95), (-0.039_98, -0.066_34), (-0.03, -0.09)];
    assert!(time(4545.0, 0.0002, &corner) <= time(4545.0, 0.000_146, &corner) + 0.002);
    let slow = [(-0.021_94, 0.018_57), (-0.13, 0.17)];
    assert!(time(120.0, 0.002, &slow) <= time(120.0, 0.001, &slow) + 0.002);
    let row = [(0.143_35, 0.037_83), (0.143_01, 0.033_51), (0.142_66, 0.029_19), (0.14, 0.03)];
    let divided = [row[0], row[1], (0.142_891_04, 0.032_041_695), row[2], row[3]];
    let (whole, parts) = (time(1777.0, 0.000_01, &row), time(1777.0, 0.000_01, &divided));
    assert!((whole - parts).abs() <= 0.002, "{whole} s, {parts} s in smaller steps");
}

/// The motion stopped at its end with the last bit of a cycle, and rounding left it a speed for ever.
#[test]
fn program_that_ends_with_a_cycle_comes_to_its_end() {
    let mut dynamics = dynamics();
    dynamics.cycle = 0.002;
    dynamics.acceleration[2] = 3_029.563_855_379_82;
    let to = |y: f64, z: f64| Segment {
        feed: Feed::PerSecond(5302.0 / 60.0),
        ..line(at(0.0, y, z), PathControl::BetweenMidpoints)
    };
    let program = [to(0.003_16, -0.003_69), to(0.006_23, -0.007_46)];
    let mut planner = Planner::new(dynamics, ORIGIN).expect("limits");
    let input = InputParameter::default();
    let run = run_with(&mut planner, ORIGIN, &program, Feeding::Full, |_| input);
    assert_eq!(run.samples.last(), Some(&at(0.0, 0.006_23, -0.007_46)));
}

/// A blend was passed no faster than its slower end: a longer one took longer where another axis limits the speed
/// after the corner.
#[test]
fn blend_is_as_fast_at_each_end_as_the_axes_allow_there() {
    let mut dynamics = dynamics();
    dynamics.velocity = [447.0, 447.0, 41.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0];
    dynamics.acceleration = [861.0, 2920.0, 9640.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0];
    let time = |tolerance: f64, sense: f64| {
        let to = |x: f64, z: f64| Segment {
            feed: Feed::PerSecond(4828.0 / 60.0),
            ..line(at(x, 0.0, z), PathControl::Within(tolerance))
        };
        let mut program = [to(-35.0, 63.0), to(-12.0, 63.0)];
        let mut start = ORIGIN;
        if sense < 0.0 {
            start = at(-12.0, 0.0, 63.0);
            program = [to(-35.0, 63.0), to(0.0, 0.0)];
        }
        let mut planner = Planner::new(dynamics, start).expect("limits");
        let input = InputParameter::default();
        let run = run_with(&mut planner, start, &program, Feeding::Full, |_| input);
        let (speed, change) = run.worst(&dynamics);
        assert!(speed <= 1.0 + 1e-9 && change <= 1.0 + 1e-9, "{speed} {change}");
        run.time()
    };
    for sense in [1.0, -1.0] {
        let (strict, loose) = (time(2.0, sense), time(4.1, sense));
        assert!(loose <= strict + 0.002, "{strict} s, {loose} s with more allowed");
    }
}

/// A blend of a feed per revolution and a rapid move was longer where axes are faster, and all of it has the feed.
#[test]
fn faster_axes_do_not_lengthen_a_blend_that_follows_the_spindle() {
    let time = |velocity: f64| {
        let mut dynamics = dynamics();
        dynamics.velocity[0] = velocity;
        let mut program = [
            line(at(-0.39, 2.81, 0.0), PathControl::BetweenMidpoints),
            line(at(0.05, 3.44, 0.0), PathControl::BetweenMidpoints),
            line(at(3.0, 8.0, 0.0), PathControl::BetweenMidpoints),
        ];
        (program[0].feed, program[2].feed) = (Feed::PerTurn(1.0), Feed::PerTurn(1.0));
        program[1].feed = Feed::Rapid;
        let mut planner = Planner::new(dynamics, ORIGIN).expect("limits");
        let mut turns = 0.0;
        let run = run_with(&mut planner, ORIGIN, &program, Feeding::Full, |_| {
            turns += 10.0 * 0.001;
            InputParameter { spindle_turns: turns, ..InputParameter::default() }
        });
        run.time()
    };
    let (slow, fast) = (time(15.0), time(60.0));
    assert!(fast <= slow + 0.002, "{slow} s, {fast} s where an axis is faster");
}

#[test]
fn braking_leaves_acceleration_for_a_tangent_break_between_arcs() {
    let (mut here, mut heading, mut program) = (ORIGIN, 0.785_f64, Vec::new());
    for _ in 0..4 {
        let to_centre = (-2.0 * libm::sin(heading), 2.0 * libm::cos(heading));
        let end = at(
            here[0] + to_centre.0 + 2.0 * libm::sin(heading + 1.0),
            here[1] + to_centre.1 - 2.0 * libm::cos(heading + 1.0),
            0.0,
        );
        let arc = arc(here, end, to_centre, 1.0, PathControl::ExactPath);
        program.push(Segment { feed: Feed::PerSecond(20.0), ..arc });
        (here, heading) = (end, heading + 1.02);
    }
    for held in 95..115 {
        let run = operated(ORIGIN, &program, |cycle| {
            let hold = if (held..held + 100).contains(&cycle) { Hold::Hold } else { Hold::Run };
            InputParameter { hold, ..InputParameter::default() }
        });
        let (speed, change) = run.worst(&dynamics());
        assert!(speed <= 1.0 + 1e-9 && change <= 1.0 + 1e-9, "{held}: {speed} {change}");
    }
}

#[test]
fn hold_on_a_blend_entered_too_fast_to_coast_keeps_limits() {
    let (mut here, mut program) = (ORIGIN, Vec::new());
    for heading in [0.6, 0.3].into_iter().cycle().take(20) {
        here[0] += 0.3 * libm::cos(heading);
        here[1] += 0.3 * libm::sin(heading);
        program.push(line(here, PathControl::Within(0.01)));
    }
    for held in 0..100 {
        let run = operated(ORIGIN, &program, |cycle| {
            let hold = if (held..held + 50).contains(&cycle) { Hold::Hold } else { Hold::Run };
            InputParameter { hold, ..InputParameter::default() }
        });
        let told = run.reported(&dynamics());
        assert!(told <= 1.0 + 1e-9, "{held}: {told}");
    }
}

#[test]
fn look_ahead_catches_up_with_an_override_on_a_long_queue() {
    let end = |place: u32| line(at(0.1 * f64::from(place), 0.0, 0.0), PathControl::ExactPath);
    let program: Vec<Segment> = (1..=1000).map(end).collect();
    let twice = |_| InputParameter { feed_override: 2.0, ..InputParameter::default() };
    let time = operated(ORIGIN, &program, twice).time();
    // 100 mm at 200 mm/s, and a quarter of a second to reach that speed.
    assert!(time < 0.78, "{time}");
}
