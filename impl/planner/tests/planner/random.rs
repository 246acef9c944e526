//! Random programs, limits and operators, from a seed.

use libm::{cos, sin};

use gaugeblock_planner::{Axes, Dynamics, Feed, Hold, InputParameter, Path, PathControl, Segment};

use super::check::{CYCLE, Feeding};

/// Pseudo-random numbers from a seed.
pub(crate) struct Dice(u64);

impl Dice {
    pub(crate) fn new(seed: u64) -> Self {
        Self(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) ^ 0x2545_f491_4f6c_dd1d)
    }

    fn next(&mut self) -> u64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        self.0.wrapping_mul(0x2545_f491_4f6c_dd1d)
    }

    pub(crate) fn below(&mut self, end: usize) -> usize {
        usize::try_from(self.next() >> 33).unwrap_or(0) % end
    }

    /// From 0 to 1.
    pub(crate) fn share(&mut self) -> f64 {
        let bits = u32::try_from(self.next() >> 32).unwrap_or(0);
        f64::from(bits) / 4_294_967_296.0
    }

    pub(crate) fn between(&mut self, low: f64, high: f64) -> f64 {
        low + self.share() * (high - low)
    }

    /// With a uniform logarithm.
    pub(crate) fn any_size(&mut self, low: f64, high: f64) -> f64 {
        low * libm::pow(high / low, self.share())
    }
}

pub(crate) struct RandomMotion {
    pub(crate) dynamics: Dynamics,
    pub(crate) start: Axes,
    pub(crate) program: Vec<Segment>,
    pub(crate) feeding: Feeding,
    pub(crate) operator: Vec<InputParameter>,
}

/// The case of a seed. Without an operator nothing is overridden.
pub(crate) fn random_motion(seed: u64, operated: bool) -> RandomMotion {
    let mut dice = Dice::new(seed);
    let dynamics = dynamics(&mut dice);
    let axes = [3, 3, 3, 4, 9][dice.below(5)];
    let start =
        std::array::from_fn(|axis| if axis < axes { dice.between(-50.0, 50.0) } else { 0.0 });
    let program = program(&mut dice, start, axes);
    let feeding = match dice.below(6) {
        0 => Feeding::Full,
        1 => Feeding::Every(3, 1),
        2 => Feeding::Every(0, 1),
        3 => Feeding::Every(1, 5),
        4 => Feeding::Every(0, 20),
        _ => Feeding::Every(2, 1 + dice.below(80)),
    };
    let operator = if operated { operator(&mut dice) } else { Vec::new() };
    RandomMotion { dynamics, start, program, feeding, operator }
}

fn dynamics(dice: &mut Dice) -> Dynamics {
    let mut dynamics = Dynamics {
        velocity: [250.0; 9],
        acceleration: [2000.0; 9],
        jerk: None,
        cycle: CYCLE,
        queue: u32::try_from(5 + dice.below(100)).unwrap_or(5),
    };
    if dice.below(2) == 0 {
        dynamics.velocity = std::array::from_fn(|_| dice.any_size(10.0, 600.0));
        dynamics.acceleration = std::array::from_fn(|_| dice.any_size(100.0, 10_000.0));
    }
    dynamics
}

fn program(dice: &mut Dice, start: Axes, axes: usize) -> Vec<Segment> {
    let size = dice.any_size(1e-3, 30.0);
    let mut blend = any_blend(dice);
    let mut feed = any_feed(dice);
    let mut here = start;
    let mut direction = 0.0_f64;
    let mut program = Vec::new();
    for _ in 0..2 + dice.below(40) {
        if dice.below(8) == 0 {
            blend = any_blend(dice);
        }
        if dice.below(8) == 0 {
            feed = any_feed(dice);
        }
        let length = if dice.below(3) == 0 { dice.any_size(1e-4, 50.0) } else { size };
        direction += match dice.below(6) {
            0 => 0.0,
            1 => std::f64::consts::PI,
            2 => std::f64::consts::FRAC_PI_2,
            3 => dice.any_size(1e-9, 1.0),
            _ => dice.between(-0.3, 0.3),
        };
        let path = match dice.below(12) {
            0 => Path::Straight { end: here },
            1 => Path::Dwell { seconds: dice.between(0.0, 0.02) },
            2..=4 => any_arc(dice, here, &mut direction, length),
            _ => {
                let mut end = here;
                end[0] += length * cos(direction);
                end[1] += length * sin(direction);
                if dice.below(3) == 0 {
                    for place in end.iter_mut().take(axes).skip(2) {
                        *place += dice.between(-length, length);
                    }
                }
                Path::Straight { end }
            }
        };
        if let Path::Straight { end } | Path::Arc { end, .. } = path {
            here = end;
        }
        program.push(Segment { number: 0, path, feed, path_control: blend, probing: false });
    }
    program
}

fn any_arc(dice: &mut Dice, here: Axes, direction: &mut f64, radius: f64) -> Path {
    let sense = if dice.below(2) == 0 { 1.0 } else { -1.0 };
    let angle = sense * dice.any_size(0.01, 14.0);
    let outward = *direction - sense * std::f64::consts::FRAC_PI_2;
    let centre = [here[0] - radius * cos(outward), here[1] - radius * sin(outward), here[2]];
    let mut end = here;
    end[0] = centre[0] + radius * cos(outward + angle);
    end[1] = centre[1] + radius * sin(outward + angle);
    if dice.below(3) == 0 {
        end[2] += dice.between(-radius, radius);
    }
    if dice.below(3) == 0 {
        let rounded = |value: f64| (value * 1e5).round() / 1e5;
        end = [
            rounded(end[0]),
            rounded(end[1]),
            end[2],
            end[3],
            end[4],
            end[5],
            end[6],
            end[7],
            end[8],
        ];
    }
    *direction += angle;
    Path::Arc { end, centre, normal: [0.0, 0.0, 1.0], angle }
}

fn any_blend(dice: &mut Dice) -> PathControl {
    match dice.below(8) {
        0 => PathControl::ExactStop,
        1 => PathControl::ExactPath,
        2 => PathControl::BetweenMidpoints,
        _ => PathControl::Within(dice.any_size(1e-5, 2.0)),
    }
}

fn any_feed(dice: &mut Dice) -> Feed {
    match dice.below(6) {
        0 => Feed::Rapid,
        1 => Feed::InTime(dice.any_size(0.01, 0.3)),
        _ => Feed::PerSecond(dice.any_size(5.0, 400.0)),
    }
}

fn operator(dice: &mut Dice) -> Vec<InputParameter> {
    let mut wants = Vec::new();
    let mut input = InputParameter::default();
    let backwards = dice.below(2) == 0;
    for _ in 0..dice.below(12) {
        match dice.below(5) {
            0 => input.feed_override = [0.0, 0.1, 0.5, 0.97, 1.0, 1.3, 2.0][dice.below(7)],
            1 => input.rapid_override = [0.0, 0.05, 0.5, 1.0][dice.below(4)],
            2 if backwards => {
                input.adaptive_feed = [-1.0, -0.5, 0.0, 0.3, 1.0][dice.below(5)];
            }
            3 => input.hold = [Hold::Run, Hold::Hold][dice.below(2)],
            _ => input = InputParameter::default(),
        }
        let most = if dice.below(4) == 0 { 200 } else { 30 };
        for _ in 0..1 + dice.below(most) {
            if dice.below(200) == 0 {
                input.feed_override = dice.between(0.0, 2.0);
            }
            wants.push(input);
        }
    }
    wants
}

/// The same with a short queue, late segments, and an operator who changes inputs in each of some thousand cycles.
pub(crate) fn restless(seed: u64) -> RandomMotion {
    let mut motion = random_motion(seed, false);
    let mut dice = Dice::new(seed ^ 0x00ab_cdef);
    if dice.below(2) == 0 {
        motion.feeding = Feeding::Every(dice.below(4), [1, 2, 3, 5, 10, 20, 40][dice.below(7)]);
    }
    if dice.below(3) == 0 {
        motion.dynamics.queue = u32::try_from(4 + dice.below(8)).unwrap_or(4);
    }
    let (rocks, overrides, holds) = (dice.below(2) == 0, dice.below(2) == 0, dice.below(3) == 0);
    let most = [3, 10, 30, 100, 300][dice.below(5)];
    let mut input = InputParameter::default();
    while motion.operator.len() < 3000 {
        if rocks && dice.below(2) == 0 {
            input.adaptive_feed = [-1.0, -1.0, 1.0, 1.0, -0.5, 0.3, 0.0][dice.below(7)];
        }
        if overrides && dice.below(2) == 0 {
            input.feed_override = [0.0, 0.1, 0.5, 0.97, 1.0, 1.3, 2.0][dice.below(7)];
            input.rapid_override = [0.0, 0.05, 0.5, 1.0, 1.0, 1.0][dice.below(6)];
        }
        if holds && dice.below(2) == 0 {
            input.hold = [Hold::Run, Hold::Hold][dice.below(2)];
        }
        motion.operator.extend(std::iter::repeat_n(input, 1 + dice.below(most)));
    }
    motion
}

/// Where the program ends.
pub(crate) fn last_end(motion: &RandomMotion) -> Axes {
    let ends = motion.program.iter().rev().filter_map(|segment| match segment.path {
        Path::Straight { end } | Path::Arc { end, .. } => Some(end),
        Path::Dwell { .. } => None,
    });
    ends.into_iter().next().unwrap_or(motion.start)
}
