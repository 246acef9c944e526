//! After set-up a planner allocates nothing: not for a segment, an output or a cycle, with a full queue and any
//! operator.

use std::hint::black_box;

use allocation_counter::measure;
use gaugeblock_planner::{
    Axes, Dynamics, Hold, InputParameter, NotQueued, OutputParameter, OutputSwitch, PathControl,
    Phase, Planner, Segment,
};

use super::check::dynamics;
use super::programs::{arcs, arcs_with_corners, dense, helix, zig};

/// The most cycles of a run; the programs take fewer.
const MOST: usize = 100_000;

/// Queues as much as there is room for, switches an output with each segment, and changes inputs. Returns how often
/// the queue was full, and how many outputs switched.
fn drive(planner: &mut Planner, program: &[Segment]) -> (usize, usize) {
    let mut segments = program.iter().peekable();
    let mut output = OutputParameter::default();
    let (mut full, mut switched) = (0, 0);
    for cycle in 0..MOST {
        while let Some(segment) = segments.peek() {
            if planner.queue(segment) == Err(NotQueued::Full) {
                full += 1;
                break;
            }
            let _whether_there_is_room =
                planner.queue_output(OutputSwitch { output: 0, value: 1.0 });
            segments.next();
        }
        // The operator changes inputs at first, and lets the program run in the end.
        let hold = if cycle < 3000 && cycle % 700 > 600 { Hold::Hold } else { Hold::Run };
        let hold = if cycle == 3500 { Hold::Abort } else { hold };
        let busy = cycle < 3000;
        let feed_override = if busy && cycle % 500 > 300 { 0.3 } else { 1.0 };
        let adaptive_feed = if busy && cycle % 900 > 800 { -1.0 } else { 1.0 };
        let input =
            InputParameter { feed_override, adaptive_feed, hold, ..InputParameter::default() };
        let phase = planner.update(&input, &mut output);
        while planner.next_switched_output().is_some() {
            switched += 1;
        }
        if phase == Phase::Idle && segments.peek().is_none() {
            return (full, switched);
        }
    }
    panic!("it does not come to its end");
}

#[test]
fn allocation_counter_counts_one() {
    assert!(measure(|| drop(black_box(vec![1_u8]))).count_total > 0);
}

#[test]
fn planner_allocates_nothing_after_set_up() {
    let origin = [0.0; 9];
    let (start, corners) = arcs_with_corners(PathControl::Within(0.1));
    let programs: [(Axes, Vec<Segment>); 6] = [
        (origin, zig(PathControl::Within(0.1))),
        (origin, zig(PathControl::ExactStop)),
        (origin, arcs(PathControl::ExactPath)),
        (origin, helix(PathControl::Within(0.01))),
        (origin, dense(PathControl::BetweenMidpoints)),
        (start, corners),
    ];
    for (number, (start, program)) in programs.iter().enumerate() {
        for jerk in [None, Some([1e5; 9])] {
            let limits = Dynamics { queue: 20, jerk, ..dynamics() };
            let mut planner = Planner::new(limits, *start).expect("limits are numbers above 0");
            let mut seen = (0, 0);
            let counted = measure(|| seen = drive(&mut planner, program));
            assert_eq!(counted.count_total, 0, "program {number}");
            assert_eq!(
                seen.0 > 0,
                program.len() > 20,
                "program {number} fills the queue: {seen:?}"
            );
            assert!(seen.1 > 0 || program.len() < 2, "program {number} switches outputs: {seen:?}");
        }
    }
}
