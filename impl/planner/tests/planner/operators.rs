//! Operators: hold, overrides, adaptive feed, abort, outputs and probes during a motion.

use gaugeblock_planner::{
    Axes, Dynamics, Feed, Hold, InputParameter, OutputParameter, OutputSwitch, Path, PathControl,
    Phase, Planner, Segment,
};
use proptest::prelude::*;

use super::check::{Feeding, Run, dynamics, farthest, programmed, run_with};
use super::programs::{FEED, at, dense, distance, line, segment, zig};
use super::random::{RandomMotion, last_end, random_motion, restless};

const ORIGIN: Axes = [0.0; 9];

fn operated(program: &[Segment], wants: impl FnMut(usize) -> InputParameter) -> Run {
    let mut planner = Planner::new(dynamics(), ORIGIN).expect("limits");
    run_with(&mut planner, ORIGIN, program, Feeding::Full, wants)
}

#[track_caller]
fn keeps_limits(run: &Run) {
    let (speed, change) = run.worst(&dynamics());
    assert!(speed <= 1.0 + 1e-9 && change <= 1.0 + 1e-9, "{speed} {change}");
}

/// With an override of zero the phase is `Moving`. It is `Waiting` only in a dwell or for the spindle.
#[test]
fn phase_is_waiting_only_in_a_dwell_or_for_the_spindle() {
    let dwell = segment(Path::Dwell { seconds: 0.02 }, PathControl::ExactStop);
    let program = [dwell, line(at(1.0, 0.0, 0.0), PathControl::ExactStop)];
    let stopped = InputParameter { feed_override: 0.0, ..InputParameter::default() };
    let input = |cycle| if (40..80).contains(&cycle) { stopped } else { InputParameter::default() };
    let run = operated(&program, input);
    let mut phases: Vec<Phase> = run.outputs.iter().map(|output| output.phase).collect();
    assert_eq!((phases[70], run.outputs[70].velocity), (Phase::Moving, ORIGIN));
    phases.dedup();
    assert_eq!(phases, [Phase::Waiting, Phase::Moving, Phase::Idle]);
}

#[test]
fn hold_stops_within_the_stopping_distance_and_goes_on() {
    let program = [line(at(100.0, 0.0, 0.0), PathControl::ExactStop)];
    let run = operated(&program, |cycle| InputParameter {
        hold: if (500..700).contains(&cycle) { Hold::Hold } else { Hold::Run },
        ..InputParameter::default()
    });
    keeps_limits(&run);
    let (before, after) = (run.samples[500][0], run.samples[699][0]);
    let stopping = FEED * FEED / (2.0 * 2000.0);
    assert!(after - before <= stopping + 2.0 * FEED * 0.001, "{}", after - before);
    assert_eq!(run.outputs[698].phase, Phase::Holding);
    assert_eq!(run.samples.last(), Some(&at(100.0, 0.0, 0.0)));
}

#[test]
fn adaptive_feed_below_zero_retraces_the_path() {
    let program = zig(PathControl::Within(0.1));
    let run = operated(&program, |cycle| InputParameter {
        adaptive_feed: if (400..700).contains(&cycle) { -1.0 } else { 1.0 },
        ..InputParameter::default()
    });
    keeps_limits(&run);
    let (turning, back) = (run.samples[400], run.samples[690]);
    assert!(back[0] < turning[0] - 4.0, "{} {}", turning[0], back[0]);
    let (path, _) = programmed(ORIGIN, &program);
    assert!(farthest(&run.samples, &path) <= 0.1);
    assert_eq!(run.samples.last(), Some(&at(100.0, 0.0, 0.0)));
}

/// The last elements are planned for reverse motion first: the motion must not wait until all remembered ones are.
#[test]
fn long_path_is_reversed_at_once_and_to_its_beginning() {
    let program = dense(PathControl::Within(0.01));
    let run = operated(&program, |cycle| InputParameter {
        adaptive_feed: if (1500..3400).contains(&cycle) { -1.0 } else { 1.0 },
        ..InputParameter::default()
    });
    keeps_limits(&run);
    let rests =
        run.samples[1500..1700].windows(2).filter(|two| distance(&two[0], &two[1]) <= 0.0).count();
    assert!(rests <= 40, "it rests for {rests} cycles");
    // Not much longer than the way forward.
    let start = run.samples[1500..].iter().position(|sample| distance(sample, &ORIGIN) <= 0.0);
    assert!(start.is_some_and(|cycles| cycles <= 1800), "{start:?}");
    let (path, _) = programmed(ORIGIN, &program);
    assert!(farthest(&run.samples, &path) <= 0.01);
    assert_eq!(run.samples.last(), path.last());
}

/// Values of an earlier reverse run are not used: once one broke a limit by a factor of 3.4.
#[test]
fn path_is_reversed_again_after_a_short_request() {
    let quick = Dynamics { velocity: [500.0; 9], acceleration: [20_000.0; 9], ..dynamics() };
    let mut planner = Planner::new(quick, ORIGIN).expect("limits");
    let mut next = ORIGIN;
    for number in 1..=700 {
        next[0] += 0.05;
        planner.prevent_merge();
        let feed = Feed::PerSecond(150.0);
        let chord = Segment { number, feed, ..line(next, PathControl::ExactPath) };
        planner.queue(&chord).expect("room");
    }
    let run = run_with(&mut planner, ORIGIN, &[], Feeding::Full, |cycle| InputParameter {
        adaptive_feed: match cycle {
            170..270 | 280 | 284..584 => -1.0,
            _ => 1.0,
        },
        ..InputParameter::default()
    });
    let (speed, change) = run.worst(&quick);
    assert!(speed <= 1.0 + 1e-9 && change <= 1.0 + 1e-9, "{speed} {change}");
    assert!(run.samples[583][0] < 10.0, "{}", run.samples[583][0]);
}

/// A blend that was planned for another override is passed again after an element that has been planned again: its old
/// plan is not valid.
#[test]
fn blend_is_passed_again_at_a_lower_override() {
    let corner = at(50.0037, 0.0, 0.0);
    let (sine, cosine) = libm::sincos(0.003);
    let end = at(corner[0] + 50.0 * cosine, 50.0 * sine, 0.0);
    let slow = Segment { feed: Feed::PerSecond(25.0), ..line(end, PathControl::Within(3e-6)) };
    let program = [line(corner, PathControl::Within(3e-6)), slow];
    let run = operated(&program, |cycle| InputParameter {
        feed_override: if cycle < 369 { 2.0 } else { 0.5 },
        adaptive_feed: if (498..1039).contains(&cycle) { -1.0 } else { 1.0 },
        ..InputParameter::default()
    });
    keeps_limits(&run);
    assert!(run.samples[1030][0] < corner[0] - 5.0, "{}", run.samples[1030][0]);
}

/// Elements that were planned for a higher override are planned again before they are passed again: once a slower
/// segment was entered four times too fast.
#[test]
fn slower_segment_is_entered_at_its_own_feed_after_reversing() {
    let to = |x: f64| line(at(x, 0.0, 0.0), PathControl::ExactPath);
    let slow = |x: f64| Segment { feed: Feed::PerSecond(20.0), ..to(x) };
    let program = [to(100.0), slow(120.0), slow(140.0), slow(200.0)];
    let run = operated(&program, |cycle| InputParameter {
        feed_override: if cycle < 1250 { 2.0 } else { 0.5 },
        adaptive_feed: if (1300..6000).contains(&cycle) { -1.0 } else { 1.0 },
        ..InputParameter::default()
    });
    keeps_limits(&run);
    assert!(run.samples[1250][0] > 110.0 && run.samples[6000][0] < 80.0);
    for output in run.outputs[6000..].iter().filter(|output| output.position[0] > 100.0) {
        assert!(output.speed <= 10.0 + 1e-9, "{} at {}", output.speed, output.position[0]);
    }
}

/// A new segment changes the plan of elements that the motion has passed, since it may reverse and return: once the
/// motion came to the end of the path at full speed.
#[test]
fn changed_path_is_followed_after_reversing() {
    let (mut here, mut heading, mut program) = (ORIGIN, 0.3, Vec::new());
    for place in 1..=30_u32 {
        heading += if place % 7 == 0 { 1.5 } else { 0.02 };
        here[0] += 0.5 * libm::cos(heading);
        here[1] += 0.5 * libm::sin(heading);
        program.push(line(here, PathControl::Within(0.1)));
    }
    for begun in 10..200 {
        let mut planner = Planner::new(dynamics(), ORIGIN).expect("limits");
        let every = Feeding::Every(1, 10);
        let run = run_with(&mut planner, ORIGIN, &program, every, |cycle| InputParameter {
            adaptive_feed: if (begun..begun + 60).contains(&cycle) { -1.0 } else { 1.0 },
            ..InputParameter::default()
        });
        keeps_limits(&run);
    }
}

/// A lowered override is followed as soon as the next elements are planned for it: once the motion crept until a long
/// queue was planned.
#[test]
fn lowered_override_is_followed_at_once_on_a_long_queue() {
    let run = operated(&dense(PathControl::Within(0.01)), |cycle| InputParameter {
        feed_override: if (300..700).contains(&cycle) { 0.3 } else { 1.0 },
        ..InputParameter::default()
    });
    keeps_limits(&run);
    for output in &run.outputs[345..700] {
        assert!((output.speed - 0.3 * FEED).abs() < 0.01 * FEED, "{}", output.speed);
    }
}

/// Elements far ahead are planned for a lowered override before the motion reaches them, however short they are: once
/// a slower row was entered at 9 times its feed.
#[test]
fn lowered_override_is_followed_at_a_slower_row_of_short_segments() {
    let program: Vec<Segment> = (1..=1500_u32)
        .map(|place| {
            let feed = Feed::PerSecond(if place <= 750 { 150.0 } else { 15.0 });
            Segment { feed, ..line(at(0.005 * f64::from(place), 0.0, 0.0), PathControl::ExactPath) }
        })
        .collect();
    for falls in (150..240).step_by(3) {
        let run = operated(&program, |cycle| InputParameter {
            feed_override: if cycle < falls { 1.0 } else { 0.1 },
            ..InputParameter::default()
        });
        keeps_limits(&run);
        // The row is so short that it is passed at 15 mm/s, from which a stop takes 8 cycles.
        let late = run.outputs.iter().skip(falls + 20);
        for output in late.filter(|output| output.position[0] > 0.005 * 750.0) {
            assert!(output.speed <= 1.5 + 1e-9, "{falls}: {}", output.speed);
        }
    }
}

/// The same where a segment without motion is queued in the cycle after the change.
#[test]
fn corner_queued_right_after_a_lowered_override_is_feasible() {
    let slow = |end: Axes, blend| Segment { feed: Feed::PerSecond(50.0), ..line(end, blend) };
    let row = (1..=60_u32)
        .map(|place| slow(at(0.2 * f64::from(place), 0.0, 0.0), PathControl::ExactPath));
    let last = slow(at(13.0, 0.0, 0.0), PathControl::Within(1.0));
    let (sine, cosine) = libm::sincos(3.0);
    let corner = slow(at(13.0 + cosine, sine, 0.0), PathControl::Within(1.0));
    for falls in 80..140 {
        let mut planner = Planner::new(dynamics(), ORIGIN).expect("limits");
        for segment in row.clone().chain([last]) {
            planner.queue(&segment).expect("room");
        }
        let (mut output, mut run) =
            (OutputParameter::default(), Run { samples: vec![ORIGIN], outputs: vec![] });
        for cycle in 0..2000 {
            let later = [(falls + 1, last), (falls + 2, corner)];
            for (_, segment) in later.iter().filter(|(queued, _)| *queued == cycle) {
                planner.queue(segment).expect("room");
            }
            let feed_override = if cycle < falls { 2.0 } else { 0.1 };
            planner.update(
                &InputParameter { feed_override, ..InputParameter::default() },
                &mut output,
            );
            run.samples.push(output.position);
            run.outputs.push(output);
        }
        keeps_limits(&run);
    }
}

/// A corner can be reached by a motion that is still faster than a lowered override: once it was made for the
/// override.
#[test]
fn corner_queued_while_an_override_falls_is_feasible() {
    let mut motion = random_motion(151_772, false);
    motion.dynamics.queue = 7;
    motion.feeding = Feeding::Every(3, 40);
    let changes = [
        (18, 0.1),
        (26, 0.0),
        (35, 0.5),
        (53, 2.0),
        (68, 0.0),
        (83, 1.3),
        (85, 0.1),
        (104, 1.0),
        (106, 0.5),
        (118, 0.97),
        (150, 0.0),
    ];
    for (until, feed_override) in changes {
        let input = InputParameter { feed_override, ..InputParameter::default() };
        motion.operator.resize(until, input);
    }
    let used = used(&motion).0;
    assert!(used <= 1.0 + 1e-9, "{used}");
}

/// A corner that is queued while the motion slows down for a lower override is passed like any other: once it became a
/// stop.
#[test]
fn corners_queued_while_an_override_falls_are_passed() {
    let mut planner = Planner::new(Dynamics { queue: 10, ..dynamics() }, ORIGIN).expect("limits");
    let program = &dense(PathControl::Within(0.01))[..800];
    let run = run_with(&mut planner, ORIGIN, program, Feeding::Full, |cycle| InputParameter {
        feed_override: if cycle / 150 % 2 == 0 { 1.0 } else { 0.2 },
        ..InputParameter::default()
    });
    keeps_limits(&run);
    let within = &run.outputs[100..run.outputs.len() - 100];
    let slowest = within.iter().map(|output| output.speed).fold(f64::INFINITY, f64::min);
    assert!(slowest > 0.19 * FEED, "{slowest}");
}

#[test]
fn abort_clears_the_queue_at_rest() {
    let mut planner = Planner::new(dynamics(), ORIGIN).expect("limits");
    let mut output = OutputParameter::default();
    for segment in zig(PathControl::Within(0.1)) {
        planner.queue(&segment).expect("room");
    }
    let mut samples = vec![ORIGIN];
    for cycle in 0..400 {
        let hold = if cycle == 300 { Hold::Abort } else { Hold::Run };
        planner.update(&InputParameter { hold, ..InputParameter::default() }, &mut output);
        samples.push(output.position);
    }
    assert_eq!(output.phase, Phase::Idle);
    let rest = output.position;
    let end = at(rest[0] + 10.0, 0.0, 0.0);
    let rest_of =
        run_with(&mut planner, rest, &[line(end, PathControl::ExactStop)], Feeding::Full, |_| {
            InputParameter::default()
        });
    samples.extend(rest_of.samples);
    let run = Run { samples, outputs: Vec::new() };
    keeps_limits(&run);
    assert_eq!(run.samples.last(), Some(&end));
}

#[test]
fn feed_override_scales_the_speed() {
    for (feed_override, speed) in [(0.5, 50.0), (1.0, 100.0), (2.0, 200.0)] {
        let program = [line(at(100.0, 0.0, 0.0), PathControl::ExactStop)];
        let input = InputParameter { feed_override, ..InputParameter::default() };
        let run = operated(&program, |_| input);
        let most = run.outputs.iter().map(|output| output.speed).fold(0.0, f64::max);
        assert!((most - speed).abs() < 1e-6, "{most}");
    }
}

#[test]
fn feed_does_not_wait_for_the_rapid_override() {
    let program = zig(PathControl::Within(0.1));
    let input = InputParameter { rapid_override: 0.0, ..InputParameter::default() };
    let run = operated(&program, |_| input);
    keeps_limits(&run);
    assert!(run.time() < 5.2, "{}", run.time());
}

#[test]
fn slower_segment_is_entered_at_its_own_feed() {
    for feed_override in [0.3, 1.0, 1.7] {
        let mut program = vec![
            line(at(20.0, 0.0, 0.0), PathControl::Within(0.01)),
            line(at(40.0, 0.0, 0.0), PathControl::ExactStop),
        ];
        program[1].feed = Feed::PerSecond(10.0);
        let input = InputParameter { feed_override, ..InputParameter::default() };
        let run = operated(&program, |_| input);
        let late = run.outputs.iter().filter(|output| output.position[0] > 20.0);
        let most = late.map(|output| output.speed).fold(0.0, f64::max);
        assert!(most <= 10.0 * feed_override + 1e-6, "{most}");
    }
}

#[test]
fn dwell_rests_to_the_cycle() {
    let program = [
        line(at(10.0, 0.0, 0.0), PathControl::Within(0.1)),
        segment(Path::Dwell { seconds: 0.25 }, PathControl::Within(0.1)),
        line(at(20.0, 0.0, 0.0), PathControl::Within(0.1)),
    ];
    let run = operated(&program, |_| InputParameter::default());
    let rests = run.samples.windows(2).filter(|two| distance(&two[0], &two[1]) <= 0.0).count();
    assert!((249..=251).contains(&rests), "{rests}");
}

#[test]
fn outputs_switch_in_order_where_their_segment_begins() {
    let mut planner = Planner::new(dynamics(), ORIGIN).expect("limits");
    let mut output = OutputParameter::default();
    let mut seen = Vec::new();
    for number in 0..3_u16 {
        for value in [0.0, 1.0] {
            planner.queue_output(OutputSwitch { output: number, value }).expect("room");
        }
        let x = 10.0 * f64::from(number + 1);
        planner.queue(&line(at(x, 0.0, 0.0), PathControl::Within(0.01))).expect("room");
    }
    planner.queue_output(OutputSwitch { output: 9, value: 1.0 }).expect("room");
    for _ in 0..1000 {
        planner.update(&InputParameter::default(), &mut output);
        while let Some(switch) = planner.next_switched_output() {
            seen.push((switch.output, switch.value.to_bits(), output.position[0]));
        }
    }
    let order: Vec<_> = seen.iter().map(|(output, value, _)| (*output, *value)).collect();
    let one = 1.0_f64.to_bits();
    assert_eq!(order, [(0, 0), (0, one), (1, 0), (1, one), (2, 0), (2, one)]);
    for (output, _, x) in seen {
        let begins = 10.0 * f64::from(output);
        assert!((begins..=begins + 0.1).contains(&x), "{output} at {x}");
    }
}

#[test]
fn probe_ends_the_motion() {
    let mut planner = Planner::new(dynamics(), ORIGIN).expect("limits");
    let mut output = OutputParameter::default();
    let mut probing = line(at(0.0, 0.0, -50.0), PathControl::ExactStop);
    probing.probing = true;
    planner.queue(&probing).expect("room");
    let mut tripped = 0;
    for cycle in 0..400 {
        let input = InputParameter { probe: cycle >= 200, ..InputParameter::default() };
        planner.update(&input, &mut output);
        tripped += u32::from(output.probe_tripped);
    }
    assert_eq!((tripped, output.phase), (1, Phase::Idle));
    assert!(output.position[2] > -25.0, "{}", output.position[2]);
}

/// The greatest use of a limit in a run, in samples and in reported accelerations.
fn used(motion: &RandomMotion) -> (f64, Run) {
    let mut planner = Planner::new(motion.dynamics, motion.start).expect("limits");
    let wants = |cycle: usize| motion.operator.get(cycle).copied().unwrap_or_default();
    let run = run_with(&mut planner, motion.start, &motion.program, motion.feeding, wants);
    let (speed, change) = run.worst(&motion.dynamics);
    (speed.max(change).max(run.reported(&motion.dynamics)), run)
}

/// Each of these programs broke a limit once, or did not end, shortly before the end of a segment.
#[test]
fn restless_operator_breaks_no_limit() {
    for seed in [13_122, 19_056, 21_361, 21_517, 21_648, 21_999, 22_208, 29_000, 29_418, 222_037] {
        let used = used(&restless(seed)).0;
        assert!(used <= 1.0 + 1e-9, "{seed}: {used}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(150) })]

    #[test]
    fn random_motion_breaks_no_limit(seed in any::<u64>(), with_operator in any::<bool>()) {
        let motion = random_motion(seed, with_operator);
        let (used, run) = used(&motion);
        prop_assert!(used <= 1.0 + 1e-9, "{}", used);
        prop_assert_eq!(run.samples.last(), Some(&last_end(&motion)));
    }

    #[test]
    fn random_restless_operator_breaks_no_limit(seed in any::<u64>()) {
        let used = used(&restless(seed)).0;
        prop_assert!(used <= 1.0 + 1e-9, "{}", used);
    }
}
