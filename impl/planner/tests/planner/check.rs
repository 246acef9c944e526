//! Runs programs cycle by cycle, and checks samples against the limits by their differences.

use gaugeblock_planner::{
    Axes, Dynamics, InputParameter, NotQueued, OutputParameter, Path, Phase, Planner, Segment,
};

use super::programs::distance;

pub(crate) const CYCLE: f64 = 0.001;

/// X Y Z as for `known_times`, all other axes alike.
pub(crate) fn dynamics() -> Dynamics {
    Dynamics {
        velocity: [250.0; 9],
        acceleration: [2000.0; 9],
        jerk: None,
        cycle: CYCLE,
        queue: 2500,
    }
}

/// The samples and outputs of a run.
pub(crate) struct Run {
    /// Positions, the first at rest.
    pub(crate) samples: Vec<Axes>,
    pub(crate) outputs: Vec<OutputParameter>,
}

/// When segments are queued.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Feeding {
    /// As many as the queue has room for.
    Full,
    /// A number at first, then one per number of cycles.
    Every(usize, usize),
}

impl Run {
    /// Seconds from the first to the last moving cycle.
    pub(crate) fn time(&self) -> f64 {
        let moves = |two: &[Axes]| distance(&two[0], &two[1]) > 0.0;
        let first = self.samples.windows(2).position(moves).unwrap_or(0);
        let last = self.samples.windows(2).rposition(moves).unwrap_or(0);
        f64::from(u32::try_from(last + 1 - first).expect("a count of cycles")) * CYCLE
    }

    /// The greatest use of a limit of velocity and of acceleration; 1 is the limit.
    pub(crate) fn worst(&self, dynamics: &Dynamics) -> (f64, f64) {
        let h = dynamics.cycle;
        let (mut speed, mut change) = (0.0_f64, 0.0_f64);
        let end = self.samples[self.samples.len() - 1];
        let all: Vec<Axes> = [self.samples[0]; 2]
            .into_iter()
            .chain(self.samples.iter().copied())
            .chain([end; 2])
            .collect();
        for three in all.windows(3) {
            let limits = dynamics.velocity.iter().zip(&dynamics.acceleration).enumerate();
            for (axis, (velocity, acceleration)) in limits {
                let [a, b, c] = [three[0][axis], three[1][axis], three[2][axis]];
                let rounding = 2.0 * (b.abs() * f64::EPSILON) / (h * h);
                let second = ((c - b) - (b - a)).abs() / (h * h) - rounding;
                speed = speed.max((b - a).abs() / h / velocity);
                change = change.max(second / acceleration);
            }
        }
        (speed, change)
    }

    /// The greatest use of a limit of jerk in third differences of samples; 1 is the limit.
    pub(crate) fn worst_jerk(&self, dynamics: &Dynamics) -> f64 {
        let (Some(jerk), h) = (dynamics.jerk, dynamics.cycle) else { return 0.0 };
        let end = self.samples[self.samples.len() - 1];
        let all: Vec<Axes> = [self.samples[0]; 3]
            .into_iter()
            .chain(self.samples.iter().copied())
            .chain([end; 3])
            .collect();
        let mut most = 0.0_f64;
        for four in all.windows(4) {
            for (axis, limit) in jerk.iter().enumerate() {
                let [a, b, c, d] = [four[0][axis], four[1][axis], four[2][axis], four[3][axis]];
                let rounding = 4.0 * b.abs().max(c.abs()) * f64::EPSILON / (h * h * h);
                let third = ((d - c) - 2.0 * (c - b) + (b - a)).abs() / (h * h * h) - rounding;
                most = most.max(third / limit);
            }
        }
        most
    }

    /// The greatest use of a limit of acceleration at the end of a cycle, as the planner reports it.
    pub(crate) fn reported(&self, dynamics: &Dynamics) -> f64 {
        let uses = self.outputs.iter().flat_map(|output| {
            let axes = output.acceleration.iter().zip(&dynamics.acceleration);
            axes.map(|(acceleration, limit)| acceleration.abs() / limit)
        });
        uses.fold(0.0, f64::max)
    }
}

/// Runs a program to its end with the inputs of each cycle.
pub(crate) fn run_with(
    planner: &mut Planner,
    start: Axes,
    program: &[Segment],
    feeding: Feeding,
    mut wants: impl FnMut(usize) -> InputParameter,
) -> Run {
    let mut output = OutputParameter::default();
    let mut run = Run { samples: vec![start], outputs: Vec::new() };
    let mut next = 0;
    for cycle in 0..1_000_000 {
        let wanted = match feeding {
            Feeding::Full => program.len(),
            Feeding::Every(first, cycles) => first + cycle / cycles,
        };
        while next < program.len().min(wanted) {
            let number = u64::try_from(next).unwrap_or(0) + 1;
            let segment = Segment { number, ..program[next] };
            match planner.queue(&segment) {
                Ok(()) => next += 1,
                Err(NotQueued::Full) => break,
                Err(NotQueued::Malformed) => panic!("{segment:?}"),
            }
        }
        let input = wants(cycle);
        let phase = planner.update(&input, &mut output);
        run.samples.push(output.position);
        run.outputs.push(output);
        if phase == Phase::Idle && next == program.len() {
            return run;
        }
    }
    panic!("the program does not end");
}

pub(crate) fn run(start: Axes, program: &[Segment], feeding: Feeding) -> Run {
    let mut planner = Planner::new(dynamics(), start).expect("limits");
    run_with(&mut planner, start, program, feeding, |_| InputParameter::default())
}

/// Points of the programmed path, so close that chords approximate it, and its vertices.
pub(crate) fn programmed(start: Axes, program: &[Segment]) -> (Vec<Axes>, Vec<Axes>) {
    let mut path = vec![start];
    let mut vertices = Vec::new();
    for segment in program {
        let here = path[path.len() - 1];
        match segment.path {
            Path::Straight { end } => path.push(end),
            Path::Arc { end, centre, angle, normal: _ } => {
                let radius = libm::hypot(here[0] - centre[0], here[1] - centre[1]);
                let begin = libm::atan2(here[1] - centre[1], here[0] - centre[0]);
                let mut turned = 0.0;
                while turned + 0.01 < angle.abs() {
                    turned += 0.01;
                    let share = turned / angle.abs();
                    let mut point = here;
                    for axis in 2..9 {
                        point[axis] += share * (end[axis] - here[axis]);
                    }
                    point[0] = centre[0] + radius * libm::cos(begin + share * angle);
                    point[1] = centre[1] + radius * libm::sin(begin + share * angle);
                    path.push(point);
                }
                path.push(end);
            }
            Path::Dwell { .. } => {}
        }
        vertices.push(path[path.len() - 1]);
    }
    (path, vertices)
}

/// The greatest distance of these points from a polyline.
pub(crate) fn farthest(points: &[Axes], line: &[Axes]) -> f64 {
    let nearest = |point: &Axes| {
        let chords = line.windows(2).map(|two| to_chord(point, &two[0], &two[1]));
        chords.fold(f64::INFINITY, f64::min)
    };
    points.iter().map(nearest).fold(0.0, f64::max)
}

fn to_chord(point: &Axes, from: &Axes, to: &Axes) -> f64 {
    let length = distance(from, to);
    let along: f64 = (0..9).map(|i| (point[i] - from[i]) * (to[i] - from[i])).sum();
    let share = if length > 0.0 { (along / (length * length)).clamp(0.0, 1.0) } else { 0.0 };
    let foot: Axes = std::array::from_fn(|i| from[i] + share * (to[i] - from[i]));
    distance(point, &foot)
}

/// Samples keep all limits, end where the program does, and follow it within the tolerance. Each programmed point is
/// near a sample: `apart` is half the way of a cycle, mm.
#[track_caller]
pub(crate) fn follows(run: &Run, program: &[Segment], tolerance: f64, apart: f64) {
    let (speed, change) = run.worst(&dynamics());
    assert!(speed <= 1.0 + 1e-9 && change <= 1.0 + 1e-9, "{speed} {change}");
    let (path, vertices) = programmed([0.0; 9], program);
    assert_eq!(run.samples.last(), vertices.last());
    let far = farthest(&run.samples, &path);
    assert!(far <= tolerance * (1.0 + 1e-9), "{far}");
    let between = 2000.0 * 1.5 * 1e-6 / 8.0;
    let missed = farthest(&vertices, &run.samples);
    assert!(missed <= tolerance + between + apart, "{missed}");
}
