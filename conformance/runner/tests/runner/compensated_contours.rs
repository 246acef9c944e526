//! Compensated contours of model and production: one that is turned, mirrored, scaled or programmed in inches is the
//! same contour.

use std::f64::consts::{PI, TAU};

use gaugeblock_adapter::Adapter;
use gaugeblock_controllers::{Production, Reference};
use gaugeblock_vocabulary::{Effect, End, Event, LengthUnit, Machine, Outcome, Position, Scenario};

const SEED: u64 = 1;
const CONTOURS: usize = 3000;
/// Values that differ by less are equal, millimetres.
const ROUNDING: f64 = 1e-6;
const MM_PER_INCH: f64 = 25.4;

/// Random numbers: `SplitMix64`.
struct Random(u64);

impl Random {
    fn bits(&mut self) -> u32 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut bits = self.0;
        bits = (bits ^ (bits >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        bits = (bits ^ (bits >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        u32::try_from((bits ^ (bits >> 31)) >> 32).expect("32 bits are left")
    }

    /// A number from 0 to 1.
    fn share(&mut self) -> f64 {
        f64::from(self.bits()) / f64::from(u32::MAX)
    }

    fn between(&mut self, least: f64, most: f64) -> f64 {
        least + (most - least) * self.share()
    }

    fn chance(&mut self, share: f64) -> bool {
        self.share() < share
    }
}

/// A move of a contour in the plane: its end, and of an arc the centre and whether it goes counterclockwise.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Move {
    end: [f64; 2],
    arc: Option<([f64; 2], bool)>,
}

/// A contour from the origin, with its tool. Lengths are in millimetres.
#[derive(Clone, Debug)]
struct Contour {
    moves: Vec<Move>,
    left: bool,
    diameter: f64,
}

impl Contour {
    /// A contour of three to eight moves. Its corners turn to both sides, and few are tangent.
    fn random(random: &mut Random) -> Self {
        let (mut at, mut heading) = ([0.0, 0.0], random.between(0.0, TAU));
        let mut moves = Vec::new();
        for place in 0..3 + random.bits() % 6 {
            if place > 0 && !random.chance(0.1) {
                heading += random.between(-2.6, 2.6);
            }
            let size = random.between(3.0, 12.0);
            let arc = (place > 0 && random.chance(0.4)).then(|| {
                let sweep = random.between(0.3, 4.0);
                let counterclockwise = random.chance(0.5);
                let sense = if counterclockwise { 1.0 } else { -1.0 };
                let to_centre = heading + sense * PI / 2.0;
                let centre = ahead(at, to_centre, size);
                heading += sense * sweep;
                at = ahead(centre, to_centre + PI + sense * sweep, size);
                (centre, counterclockwise)
            });
            if arc.is_none() {
                at = ahead(at, heading, size);
            }
            moves.push(Move { end: at, arc });
        }
        Self { moves, left: random.chance(0.5), diameter: random.between(0.2, 4.0) }
    }

    /// The contour with each point changed; a change that mirrors exchanges the sides.
    fn changed(&self, change: Change) -> Self {
        let moves = self.moves.iter().map(|each| change.of_move(*each)).collect();
        Self { moves, left: self.left != change.mirrors, diameter: self.diameter * change.scale }
    }

    /// Its program, between the blocks that prepare it and M2.
    fn program(&self, before: &str) -> String {
        let side = if self.left { "g41.1" } else { "g42.1" };
        let mut text = format!("g90 g91.1 g94 f100\n{before}g0 x0 y0\n{side} d{}\n", self.diameter);
        let mut from = [0.0, 0.0];
        for Move { end: [x, y], arc } in &self.moves {
            text += &match arc {
                None => format!("g1 x{x:.12} y{y:.12}\n"),
                Some((centre, counterclockwise)) => {
                    let code = if *counterclockwise { "g3" } else { "g2" };
                    let [i, j] = [centre[0] - from[0], centre[1] - from[1]];
                    format!("{code} x{x:.12} y{y:.12} i{i:.12} j{j:.12}\n")
                }
            };
            from = [*x, *y];
        }
        text + "m2\n"
    }
}

/// The point at a distance in a direction, radians.
fn ahead([x, y]: [f64; 2], direction: f64, distance: f64) -> [f64; 2] {
    let [cosine, sine] = unit(direction);
    [x + distance * cosine, y + distance * sine]
}

/// The vector of length 1 in a direction, radians.
#[expect(clippy::disallowed_methods, reason = "its last bits do not matter: a contour is random")]
fn unit(direction: f64) -> [f64; 2] {
    let (sine, cosine) = direction.sin_cos();
    [cosine, sine]
}

/// A change of a contour: mirrored at the first axis, then turned by radians, then scaled.
#[derive(Clone, Copy, Debug)]
struct Change {
    mirrors: bool,
    turn: f64,
    scale: f64,
}

const SAME: Change = Change { mirrors: false, turn: 0.0, scale: 1.0 };

impl Change {
    fn of(self, [x, y]: [f64; 2]) -> [f64; 2] {
        let y = if self.mirrors { -y } else { y };
        let [cosine, sine] = unit(self.turn);
        [(x * cosine - y * sine) * self.scale, (x * sine + y * cosine) * self.scale]
    }

    fn of_move(self, Move { end, arc }: Move) -> Move {
        let arc = arc.map(|(centre, sense)| (self.of(centre), sense != self.mirrors));
        Move { end: self.of(end), arc }
    }
}

/// The compensated moves of a program, and the block that is refused if there is one.
#[derive(Debug)]
struct Path {
    moves: Vec<Move>,
    refused_at: Option<u32>,
}

impl Path {
    fn of(controller: &dyn Adapter, program: String) -> Self {
        let machine = Machine { length_unit: LengthUnit::Millimetre, ..Machine::default() };
        let scenario = Scenario { machine, ..Scenario::of(program) };
        let outcome = controller.run(&scenario).expect("both sides run in this process");
        let refused_at = if let End::Fault(fault) = &outcome.end {
            fault.block.as_ref().map(|block| block.line)
        } else {
            assert_eq!(outcome.end, End::ProgramEnd, "{}", scenario.program.main);
            None
        };
        Self { moves: moves(&outcome), refused_at }
    }

    /// Whether it is another path after a change, with blocks in front of its own.
    fn is(&self, change: Change, more_blocks: u32, other: &Self) -> bool {
        let close = |one: f64, other: f64| (one - other).abs() <= ROUNDING * other.abs().max(1.0);
        let point = |one: [f64; 2], other: [f64; 2]| (0..2).all(|at| close(one[at], other[at]));
        let same = |one: Move, other: Move| {
            point(one.end, other.end)
                && match (one.arc, other.arc) {
                    (None, None) => true,
                    (Some((one, sense)), Some((other, other_sense))) => {
                        sense == other_sense && point(one, other)
                    }
                    _ => false,
                }
        };
        self.refused_at == other.refused_at.map(|line| line + more_blocks)
            && self.moves.len() == other.moves.len()
            && other.moves.iter().zip(&self.moves).all(|(a, b)| same(change.of_move(*a), *b))
    }

    /// How many arcs about a corner it has: those that the contour does not program.
    fn joining_moves(&self, contour: &Contour) -> usize {
        let programmed = contour.moves.len();
        (self.moves.len().saturating_sub(1)).saturating_sub(programmed)
    }
}

fn moves(outcome: &Outcome) -> Vec<Move> {
    let in_plane = |end: &Position| [end.x, end.y];
    let events = outcome.steps.iter().flat_map(|step| &step.events);
    events
        .filter_map(|event| {
            let Event::Do(effect) = event else { return None };
            if let Effect::ArcFeed { end, first_centre, second_centre, turns } = effect {
                let arc = Some(([*first_centre, *second_centre], *turns > 0));
                return Some(Move { end: in_plane(end), arc });
            }
            let (Effect::StraightFeed { end } | Effect::StraightTraverse { end }) = effect else {
                return None;
            };
            Some(Move { end: in_plane(end), arc: None })
        })
        .collect()
}

/// Each way to program a contour, with the path that it has: a name, the program, the change of the path, and how many
/// blocks are in front of those of the plain program.
fn ways(contour: &Contour, random: &mut Random) -> Vec<(&'static str, String, Change, u32)> {
    let turn = random.between(-PI, PI);
    let mirrors = Change { mirrors: true, ..SAME };
    let scales = Change { scale: random.between(0.2, 5.0), ..SAME };
    let turns = Change { turn, ..SAME };
    let all = Change { mirrors: true, ..Change { turn, ..scales } };
    let inches = Change { scale: 1.0 / MM_PER_INCH, ..SAME };
    let by = |change: Change| contour.changed(change).program("g21\n");
    let rotation = format!("g21\ng10 l2 p1 r{:.12}\n", turn.to_degrees());
    vec![
        ("turned", by(turns), turns, 0),
        ("turned by G10 L2 R", contour.program(&rotation), SAME, 1),
        ("mirrored", by(mirrors), mirrors, 0),
        ("scaled", by(scales), scales, 0),
        ("turned, mirrored and scaled", by(all), all, 0),
        ("in inches", contour.changed(inches).program("g20\n"), inches, 0),
    ]
}

#[test]
fn changed_contour_has_the_same_compensated_path() {
    let mut random = Random(SEED);
    let (mut accepted, mut joining, mut shortened) = (0, 0, 0);
    let controllers: [&dyn Adapter; 2] = [&Reference::default(), &Production::default()];
    for _ in 0..CONTOURS {
        let contour = Contour::random(&mut random);
        let ways = ways(&contour, &mut random);
        let plain = contour.program("g21\n");
        let mut of_model: Option<Path> = None;
        for controller in controllers {
            let path = Path::of(controller, plain.clone());
            for (name, program, change, more_blocks) in &ways {
                let found = Path::of(controller, program.clone());
                let is_same = found.is(*change, *more_blocks, &path);
                assert!(is_same, "{name}:\n{plain}\n{program}\n{path:?}\n{found:?}");
            }
            if let Some(of_model) = &of_model {
                assert!(path.is(SAME, 0, of_model), "{plain}\n{of_model:?}\n{path:?}");
            }
            of_model = Some(path);
        }
        let path = of_model.expect("the model has run");
        if path.refused_at.is_none() {
            accepted += 1;
            let outer = path.joining_moves(&contour);
            joining += outer;
            shortened += contour.moves.len() - 1 - outer;
        }
    }
    // Enough of the contours go on to their end, with corners of both kinds.
    assert!(accepted >= CONTOURS / 4, "{accepted} are accepted");
    assert!(joining >= CONTOURS / 4, "{joining} corners are outer ones");
    assert!(shortened >= CONTOURS / 4, "{shortened} corners are inner or tangent ones");
}
