//! Limits of jerk.

use gaugeblock_planner::{
    Axes, Dynamics, Feed, Hold, InputParameter, OutputParameter, OutputSwitch, PathControl, Phase,
    Planner, Segment,
};
use proptest::prelude::*;

use super::check::{CYCLE, Feeding, Run, dynamics, farthest, programmed, run, run_with};
use super::programs::{arcs, at, dense, helix, line, square, zig};
use super::random::{Dice, RandomMotion, last_end, random_motion, restless};

const ORIGIN: Axes = [0.0; 9];
const PATH_CONTROLS: [PathControl; 5] = [
    PathControl::ExactStop,
    PathControl::ExactPath,
    PathControl::Within(0.01),
    PathControl::Within(0.1),
    PathControl::BetweenMidpoints,
];

pub(crate) fn with_jerk(jerk: f64) -> Dynamics {
    Dynamics { jerk: Some([jerk; 9]), ..dynamics() }
}

fn smooth(jerk: f64, program: &[Segment]) -> Run {
    let mut planner = Planner::new(with_jerk(jerk), ORIGIN).expect("limits");
    run_with(&mut planner, ORIGIN, program, Feeding::Full, |_| InputParameter::default())
}

/// The greatest use of a limit of velocity, acceleration or jerk in a run.
fn used(run: &Run, dynamics: &Dynamics) -> f64 {
    let (speed, change) = run.worst(dynamics);
    speed.max(change).max(run.reported(dynamics)).max(run.worst_jerk(dynamics))
}

/// The same motion on a machine with random limits of jerk.
fn with_random_jerk(mut motion: RandomMotion, seed: u64) -> RandomMotion {
    let mut dice = Dice::new(seed ^ 0x1e7c);
    let jerk = match dice.below(3) {
        0 => [dice.any_size(1e3, 1e8); 9],
        1 => std::array::from_fn(|_| dice.any_size(1e4, 1e6)),
        _ => {
            let seconds = dice.any_size(1e-3, 0.2);
            motion.dynamics.acceleration.map(|limit| limit / seconds)
        }
    };
    motion.dynamics.jerk = Some(jerk);
    motion
}

fn executed(motion: &RandomMotion) -> (f64, Run) {
    let mut planner = Planner::new(motion.dynamics, motion.start).expect("limits");
    let wants = |cycle: usize| motion.operator.get(cycle).copied().unwrap_or_default();
    let run = run_with(&mut planner, motion.start, &motion.program, motion.feeding, wants);
    (used(&run, &motion.dynamics), run)
}

/// How far a program may be left.
fn tolerance(path_control: PathControl) -> f64 {
    match path_control {
        PathControl::ExactStop | PathControl::ExactPath => 0.0,
        PathControl::Within(tolerance) => tolerance,
        PathControl::BetweenMidpoints => f64::INFINITY,
    }
}

#[test]
fn known_programs_keep_limits_and_tolerances() {
    for control in PATH_CONTROLS {
        let programs = [zig(control), square(control), arcs(control)];
        for (number, program) in programs.iter().enumerate() {
            for jerk in [1e6, 1e5] {
                let run = smooth(jerk, program);
                let used = used(&run, &with_jerk(jerk));
                assert!(used <= 1.0 + 1e-9, "{control:?} {number} {jerk}: {used}");
                let (path, vertices) = programmed(ORIGIN, program);
                assert_eq!(run.samples.last(), vertices.last(), "{control:?} {number} {jerk}");
                let far = farthest(&run.samples, &path);
                // Chords of arcs are 0.01² r/8 inside them.
                let chords = if number > 1 { 1.3e-4 } else { 1e-12 };
                assert!(far <= tolerance(control) + chords, "{control:?} {number} {jerk}: {far}");
            }
        }
    }
    for control in PATH_CONTROLS {
        for (jerk, program) in [(1e5, dense(control)), (1e7, helix(control)), (2e4, helix(control))]
        {
            let run = smooth(jerk, &program);
            let used = used(&run, &with_jerk(jerk));
            assert!(used <= 1.0 + 1e-9, "{control:?} {jerk}: {used}");
        }
    }
}

/// The least time of a line from rest to rest.
fn closed_form(length: f64, velocity: f64, acceleration: f64, jerk: f64) -> f64 {
    // The speed that is reached where the acceleration has no limit, and then the time up to a speed.
    let cube = libm::cbrt(length * length * jerk / 4.0);
    let up_to = |speed: f64| {
        if speed * jerk >= acceleration * acceleration {
            speed / acceleration + acceleration / jerk
        } else {
            2.0 * libm::sqrt(speed / jerk)
        }
    };
    let mut top = velocity.min(cube);
    if top * jerk > acceleration * acceleration {
        let coast = acceleration * acceleration / jerk;
        let reached = 0.5 * (libm::sqrt(coast * coast + 4.0 * acceleration * length) - coast);
        top = velocity.min(reached);
    }
    up_to(top) + length / top
}

#[test]
fn exact_stop_line_takes_the_time_of_the_closed_form() {
    for jerk in [1e6, 1e5, 2e4, 5e3] {
        for length in [0.05, 0.5, 2.0, 10.0, 50.0, 300.0] {
            for feed in [10.0, 100.0, 250.0] {
                let line = line(at(length, 0.0, 0.0), PathControl::ExactStop);
                let program = [Segment { feed: Feed::PerSecond(feed), ..line }];
                let time = smooth(jerk, &program).time();
                let least = closed_form(length, feed, 2000.0, jerk);
                assert!(time >= least - CYCLE, "{length} {feed} {jerk}: {time} < {least}");
                assert!(
                    time <= least * 1.005 + 2.0 * CYCLE,
                    "{length} mm, {feed} mm/s, {jerk} mm/s³: {time} s, possible {least} s"
                );
            }
        }
    }
}

#[test]
fn motion_is_as_without_jerk_as_jerk_grows() {
    for control in PATH_CONTROLS {
        for program in [zig(control), square(control), arcs(control), helix(control)] {
            let plain = run(ORIGIN, &program, Feeding::Full).time();
            let time = smooth(1e9, &program).time();
            assert!((time - plain).abs() <= 2.0 * CYCLE, "{control:?}: {time} s, {plain} s");
        }
    }
}

#[test]
fn hold_and_abort_rest_on_the_path_within_limits() {
    let limits = with_jerk(1e5);
    for control in PATH_CONTROLS {
        for begun in [20, 57, 143, 400] {
            for hold in [Hold::Hold, Hold::Abort] {
                let mut planner = Planner::new(limits, ORIGIN).expect("limits");
                for segment in square(control) {
                    planner.queue(&segment).expect("room");
                }
                let mut output = OutputParameter::default();
                let mut run = Run { samples: vec![ORIGIN], outputs: Vec::new() };
                for cycle in 0..begun + 400 {
                    let hold = if cycle < begun { Hold::Run } else { hold };
                    let input = InputParameter { hold, ..InputParameter::default() };
                    planner.update(&input, &mut output);
                    run.samples.push(output.position);
                    run.outputs.push(output);
                }
                assert!(output.speed <= 0.0, "{control:?} {begun} {hold:?}");
                let used = used(&run, &limits);
                assert!(used <= 1.0 + 1e-9, "{control:?} {begun} {hold:?}: {used}");
                let expected = if hold == Hold::Abort { Phase::Idle } else { Phase::Holding };
                assert!(output.phase == expected || output.phase == Phase::Idle, "{output:?}");
            }
        }
    }
}

#[test]
fn outputs_switch_where_the_smoothed_motion_passes() {
    for control in PATH_CONTROLS {
        let mut planner = Planner::new(with_jerk(1e5), ORIGIN).expect("limits");
        let (mut output, mut seen) = (OutputParameter::default(), Vec::new());
        for number in 0..3_u16 {
            planner.queue_output(OutputSwitch { output: number, value: 1.0 }).expect("room");
            let x = 10.0 * f64::from(number + 1);
            planner.queue(&line(at(x, 0.0, 0.0), control)).expect("room");
        }
        let mut last = ORIGIN;
        while planner.update(&InputParameter::default(), &mut output) != Phase::Idle {
            while let Some(switch) = planner.next_switched_output() {
                seen.push((switch.output, last[0], output.position[0]));
            }
            last = output.position;
        }
        assert_eq!(seen.len(), 3, "{control:?}");
        for (number, (output, before, after)) in (0_u16..).zip(seen) {
            assert_eq!(number, output);
            let begins = 10.0 * f64::from(number);
            // Within a cycle of the sample that passes the start.
            assert!(
                (begins - 0.11..=begins + 0.11).contains(&after),
                "{control:?}: {before} {after}"
            );
        }
    }
}

#[test]
fn probe_ends_the_smoothed_motion() {
    let limits = with_jerk(1e5);
    let mut planner = Planner::new(limits, ORIGIN).expect("limits");
    let mut output = OutputParameter::default();
    let probing = Segment { probing: true, ..line(at(0.0, 0.0, -50.0), PathControl::ExactStop) };
    planner.queue(&probing).expect("room");
    let (mut tripped, mut run) = (0, Run { samples: vec![ORIGIN], outputs: Vec::new() });
    for cycle in 0..500 {
        let input = InputParameter { probe: cycle >= 200, ..InputParameter::default() };
        planner.update(&input, &mut output);
        tripped += u32::from(output.probe_tripped);
        run.samples.push(output.position);
        run.outputs.push(output);
    }
    assert_eq!((tripped, output.phase), (1, Phase::Idle));
    assert!(output.position[2] > -25.0, "{}", output.position[2]);
    assert!(used(&run, &limits) <= 1.0 + 1e-9);
}

#[test]
fn limits_of_jerk_must_be_above_zero() {
    for jerk in [0.0, -1.0, f64::NAN] {
        assert!(Planner::new(with_jerk(jerk), ORIGIN).is_err());
    }
    assert!(Planner::new(with_jerk(f64::INFINITY), ORIGIN).is_ok());
}

/// Each of these broke a limit once, or did not end.
#[test]
fn random_motion_that_broke_a_limit_keeps_it() {
    for seed in [
        9_659_304_825_983_585_075,
        12_027_205_005_134_831_127,
        12_046_752_304_082_942_878,
        9_818_157_396_578_182_329,
    ] {
        let (used, _) = executed(&with_random_jerk(restless(seed), seed));
        assert!(used <= 1.0 + 1e-9, "{seed}: {used}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(150) })]

    #[test]
    fn random_motion_breaks_no_limit(seed in any::<u64>(), with_operator in any::<bool>()) {
        let motion = with_random_jerk(random_motion(seed, with_operator), seed);
        let (used, run) = executed(&motion);
        prop_assert!(used <= 1.0 + 1e-9, "{}", used);
        prop_assert_eq!(run.samples.last(), Some(&last_end(&motion)));
    }

    #[test]
    fn random_restless_operator_breaks_no_limit(seed in any::<u64>()) {
        let (used, _) = executed(&with_random_jerk(restless(seed), seed));
        prop_assert!(used <= 1.0 + 1e-9, "{}", used);
    }
}
