//! The laws of compensated contours, on random ones.

use super::{Move, moves, outcome};
use gaugeblock_vocabulary::Outcome;
use proptest::collection::vec;
use proptest::prelude::{ProptestConfig, Strategy, any, prop_assert, prop_assume, proptest};

/// A programmed move from the point before: a way of this length and direction, straight or along an arc of so many
/// radians, to the left for a positive number.
#[derive(Clone, Copy, Debug)]
struct Programmed {
    length: f64,
    direction: f64,
    bend: Option<f64>,
}

/// A contour with its tool: on the left or not, and its diameter.
#[derive(Clone, Debug)]
struct Contour {
    left: bool,
    diameter: f64,
    moves: Vec<Programmed>,
}

/// How a contour is changed: mirrored about X, turned, scaled, shifted.
#[derive(Clone, Copy, Debug)]
struct Change {
    mirrors: bool,
    turn: f64,
    scale: f64,
    shift: [f64; 2],
}

const NONE: Change = Change { mirrors: false, turn: 0.0, scale: 1.0, shift: [0.0, 0.0] };

impl Change {
    fn of(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let y = if self.mirrors { -y } else { y };
        let (sine, cosine) = libm::sincos(self.turn);
        let turned = [x * cosine - y * sine, x * sine + y * cosine];
        [0, 1].map(|place| turned[place] * self.scale + self.shift[place])
    }

    fn of_move(&self, one: &Move) -> Move {
        let sense = if self.mirrors { -1 } else { 1 };
        match one {
            Move::Rapid(end) => Move::Rapid(self.of(*end)),
            Move::Line(end) => Move::Line(self.of(*end)),
            Move::Arc(end, centre, turns) => {
                Move::Arc(self.of(*end), self.of(*centre), turns * sense)
            }
        }
    }
}

impl Programmed {
    /// Its end and the centre of an arc, from its start; the first move of a contour is a line.
    fn leads(&self, start: [f64; 2], may_bend: bool) -> ([f64; 2], Option<[f64; 2]>) {
        let (sine, cosine) = libm::sincos(self.direction);
        let end = [start[0] + self.length * cosine, start[1] + self.length * sine];
        let centre = self.bend.filter(|_| may_bend).map(|bend| {
            let to_left = self.length / 2.0 / libm::tan(bend / 2.0);
            let middle = [0, 1].map(|place| f64::midpoint(start[place], end[place]));
            [middle[0] - to_left * sine, middle[1] + to_left * cosine]
        });
        (end, centre)
    }
}

impl Contour {
    /// The blocks of the contour, as it is changed, from its start to G40.
    fn blocks(&self, change: &Change, diameter: f64, between: &str) -> String {
        let mut here = [0.0, 0.0];
        let [x, y] = change.of(here);
        let left = self.left != change.mirrors;
        let code = if left { "g41.1" } else { "g42.1" };
        let mut blocks = vec![format!("g0 x{x:.12} y{y:.12}"), format!("{code} d{diameter:.12}")];
        for (place, one) in self.moves.iter().enumerate() {
            let (end, centre) = one.leads(here, place > 0);
            let [x, y] = change.of(end);
            blocks.push(match centre {
                None => format!("g1 x{x:.12} y{y:.12}"),
                Some(centre) => {
                    let to_left = one.bend.is_some_and(|bend| bend > 0.0);
                    let code = if to_left == change.mirrors { "g2" } else { "g3" };
                    let ([from_x, from_y], [i, j]) = (change.of(here), change.of(centre));
                    let (i, j) = (i - from_x, j - from_y);
                    format!("{code} x{x:.12} y{y:.12} i{i:.12} j{j:.12}")
                }
            });
            if place > 0 && !between.is_empty() {
                blocks.push(between.to_owned());
            }
            here = end;
        }
        blocks.push("g40".to_owned());
        blocks.push("m2".to_owned());
        blocks.join(";")
    }

    fn run(&self, change: &Change) -> Outcome {
        outcome(&self.blocks(change, self.diameter * change.scale, ""))
    }
}

fn contour() -> impl Strategy<Value = Contour> {
    let bend =
        (0.1_f64..4.0, any::<bool>()).prop_map(|(bend, left)| if left { bend } else { -bend });
    let one = (0.3_f64..3.0, -3.1_f64..3.1, proptest::option::of(bend))
        .prop_map(|(length, direction, bend)| Programmed { length, direction, bend });
    (any::<bool>(), 0.05_f64..0.5, vec(one, 1..6)).prop_map(|(left, diameter, moves)| Contour {
        left,
        diameter,
        moves,
    })
}

/// Whether both runs make the same moves, to what twelve decimals leave of a contour.
fn agree(one: &[Move], other: &[Move]) -> bool {
    one.len() == other.len() && one.iter().zip(other).all(|(one, other)| near(one, other))
}

fn near(one: &Move, other: &Move) -> bool {
    let near = |one: &[f64; 2], other: &[f64; 2]| {
        (0..2).all(|place| (one[place] - other[place]).abs() < 1e-5)
    };
    match (one, other) {
        (Move::Rapid(one), Move::Rapid(other)) | (Move::Line(one), Move::Line(other)) => {
            near(one, other)
        }
        (Move::Arc(end, centre, turns), Move::Arc(other_end, other_centre, other_turns)) => {
            near(end, other_end) && near(centre, other_centre) && turns == other_turns
        }
        _ => false,
    }
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(400) })]

    #[test]
    fn a_changed_contour_has_the_changed_path(
        contour in contour(),
        mirrors in any::<bool>(),
        turn in -3.0_f64..3.0,
        scale in 0.5_f64..3.0,
        shift in [-5.0_f64..5.0, -5.0_f64..5.0],
    ) {
        let change = Change { mirrors, turn, scale, shift };
        let (plain, changed) = (contour.run(&NONE), contour.run(&change));
        prop_assert!(super::ending(&plain) == super::ending(&changed));
        let expected: Vec<_> = moves(&plain).iter().map(|one| change.of_move(one)).collect();
        prop_assert!(agree(&moves(&changed), &expected));
    }

    #[test]
    fn a_negative_diameter_is_the_other_distance(contour in contour()) {
        let other = Contour { left: !contour.left, ..contour.clone() };
        let plain = contour.run(&NONE);
        let negative = outcome(&other.blocks(&NONE, -contour.diameter, ""));
        prop_assert!(plain.end.name() == negative.end.name());
        prop_assert!(agree(&moves(&plain), &moves(&negative)));
    }

    #[test]
    fn what_waits_changes_no_point_of_the_plane(contour in contour()) {
        let plain = contour.run(&NONE);
        prop_assume!(plain.end.name() == "program_end");
        let with = outcome(&contour.blocks(&NONE, contour.diameter, "g1 z1;z2;g4 p1;s100"));
        prop_assert!(agree(&without_points(moves(&with)), &without_points(moves(&plain))));
    }

    #[test]
    fn each_move_is_a_radius_away_from_the_programmed_one(contour in contour()) {
        let outcome = contour.run(&NONE);
        prop_assume!(outcome.end.name() == "program_end");
        let radius = contour.diameter / 2.0;
        let mut here = [0.0, 0.0];
        for (place, programmed) in contour.moves.iter().enumerate() {
            let (end, centre) = programmed.leads(here, place > 0);
            let (from, to, found_centre) = last_move_of(&outcome, place + 4);
            let away = |point: [f64; 2]| match centre {
                None => distance_to_line(point, here, end),
                Some(centre) => (distance(point, centre) - distance(end, centre)).abs(),
            };
            prop_assert!((away(to) - radius).abs() < 1e-6);
            if place > 0 {
                // A tangent corner may bend by 0.05 radian.
                prop_assert!((away(from) - radius).abs() < 0.002 * radius + 1e-6);
                let concentric = match (centre, found_centre) {
                    (Some(centre), Some(found)) => distance(centre, found) < 1e-6,
                    (None, None) => true,
                    (Some(_), None) | (None, Some(_)) => false,
                };
                prop_assert!(concentric);
            }
            here = end;
        }
    }

    #[test]
    fn a_convex_contour_is_longer_by_a_circle(
        steps in vec((0.3_f64..2.0, 0.2_f64..1.2), 6..12),
        radius in 0.05_f64..0.8,
    ) {
        let longer = longer_outdistance(&steps, radius);
        prop_assume!(longer.is_some());
        let longer = longer.unwrap_or_default();
        prop_assert!((longer - std::f64::consts::TAU * radius).abs() < 1e-6, "{longer}");
    }
}

/// The moves without lines that end where the move before does, as a move along Z does.
fn without_points(mut moves: Vec<Move>) -> Vec<Move> {
    moves.dedup_by(|later, before| {
        let (Move::Rapid(end) | Move::Line(end) | Move::Arc(end, ..)) = before;
        matches!(later, Move::Line(there) if distance(*end, *there) == 0.0)
    });
    moves
}

/// The last move of a block: from where, to where, and the centre of an arc.
fn last_move_of(outcome: &Outcome, line: usize) -> ([f64; 2], [f64; 2], Option<[f64; 2]>) {
    let lines = super::effects(outcome);
    let moves = moves(outcome);
    let last = (0..moves.len()).rfind(|place| lines[*place].0 as usize == line);
    let last = last.unwrap_or_default();
    let end = |one: &Move| match one {
        Move::Rapid(end) | Move::Line(end) | Move::Arc(end, ..) => *end,
    };
    let centre = match moves[last] {
        Move::Arc(_, centre, _) => Some(centre),
        Move::Rapid(_) | Move::Line(_) => None,
    };
    (end(&moves[last - 1]), end(&moves[last]), centre)
}

/// The distance of a point from the line through two others.
fn distance_to_line(point: [f64; 2], from: [f64; 2], to: [f64; 2]) -> f64 {
    let (way, there) =
        ([to[0] - from[0], to[1] - from[1]], [point[0] - from[0], point[1] - from[1]]);
    (way[0] * there[1] - way[1] * there[0]).abs() / distance(from, to)
}

/// The distance between two points.
fn distance(from: [f64; 2], to: [f64; 2]) -> f64 {
    libm::hypot(to[0] - from[0], to[1] - from[1])
}

/// By how much the path of the tool outside of a convex polygon on a circle is longer than the polygon.
fn longer_outdistance(steps: &[(f64, f64)], radius: f64) -> Option<f64> {
    let whole: f64 = steps.iter().map(|(_, angle)| angle).sum();
    let mut angles = vec![0.0_f64];
    for (_, angle) in steps {
        let last = *angles.last()?;
        angles.push(last + angle / whole * std::f64::consts::TAU);
    }
    let corner = |angle: f64| [5.0 * libm::cos(angle), 5.0 * libm::sin(angle)];
    let points: Vec<_> = angles.iter().map(|angle| corner(*angle)).collect();
    // The contour begins in the middle of its last side, so that its corners are all passed.
    let last = points[points.len() - 2];
    let start = [0, 1].map(|place| (last[place] + points[0][place]) / 2.0);
    let back = [0, 1].map(|place| 2.0 * last[place] - points[0][place]);
    let entry = [0, 1].map(|place| back[place] - (points[0][place] - last[place]));
    let diameter = 2.0 * radius;
    let mut blocks = vec![
        format!("g0 x{:.12} y{:.12}", entry[0], entry[1]),
        format!("g42.1 d{diameter:.12}"),
        format!("g1 x{:.12} y{:.12}", start[0], start[1]),
    ];
    for point in points[..points.len() - 1].iter().chain([&start]) {
        blocks.push(format!("x{:.12} y{:.12}", point[0], point[1]));
    }
    blocks.push("g40;m2".to_owned());
    let outcome = outcome(&blocks.join(";"));
    let found = moves(&outcome);
    (super::ending(&outcome).0 == "program_end").then(|| {
        let programmed: f64 = points.windows(2).map(|pair| distance(pair[0], pair[1])).sum();
        path_length(&found[1..]) - programmed
    })
}

/// The length of a path after its first move; each arc is less than half a circle.
fn path_length(path: &[Move]) -> f64 {
    let end = |one: &Move| match one {
        Move::Rapid(end) | Move::Line(end) | Move::Arc(end, ..) => *end,
    };
    path.windows(2)
        .map(|pair| {
            let (from, to) = (end(&pair[0]), end(&pair[1]));
            match &pair[1] {
                Move::Rapid(_) | Move::Line(_) => distance(from, to),
                Move::Arc(_, centre, _) => {
                    let radius = distance(*centre, to);
                    2.0 * radius * libm::asin(distance(from, to) / 2.0 / radius)
                }
            }
        })
        .sum()
}
