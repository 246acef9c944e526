//! The laws of compensated contours, of `docs/compensation.md`.

use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;

use proptest::prelude::*;

use crate::math::{direction, hypotenuse};

use super::compensation::path;

/// A move of a contour: a line to a point, or an arc about a centre by degrees.
#[derive(Clone, Debug)]
enum Step {
    Line([f64; 2]),
    Arc { centre: [f64; 2], degrees: f64 },
}

/// A contour from the origin.
fn contour() -> impl Strategy<Value = Vec<Step>> {
    let coordinate = || -4.0..4.0_f64;
    let line = [coordinate(), coordinate()].prop_map(Step::Line);
    let arc = ([coordinate(), coordinate()], 20.0..300.0_f64, any::<bool>()).prop_map(
        |(centre, degrees, back)| Step::Arc {
            centre,
            degrees: if back { -degrees } else { degrees },
        },
    );
    prop::collection::vec(prop_oneof![line, arc], 2..7)
}

/// A motion of the plane: turned, scaled, shifted, and perhaps mirrored.
#[derive(Clone, Copy, Debug)]
struct Motion {
    degrees: f64,
    scale: f64,
    shift: [f64; 2],
    mirrors: bool,
}

const NONE: Motion = Motion { degrees: 0.0, scale: 1.0, shift: [0.0; 2], mirrors: false };

impl Motion {
    fn vector(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let (sine, cosine) = direction(self.degrees);
        let y = if self.mirrors { -y } else { y };
        [(x * cosine - y * sine) * self.scale, (x * sine + y * cosine) * self.scale]
    }

    fn point(&self, point: [f64; 2]) -> [f64; 2] {
        let [x, y] = self.vector(point);
        [x + self.shift[0], y + self.shift[1]]
    }
}

/// The program of a contour that is moved, with blocks between its moves.
fn program(contour: &[Step], (left, diameter): (bool, f64), by: Motion, between: &str) -> String {
    let [x, y] = by.point([0.0, 0.0]);
    let code = if left { "g41.1" } else { "g42.1" };
    let mut text = format!("g20 f10;g0 x{x} y{y};{code} d{diameter}");
    let mut at = [0.0, 0.0];
    for step in contour {
        match step {
            Step::Line(end) => {
                at = *end;
                let [x, y] = by.point(at);
                text += &format!(";g1 x{x} y{y}");
            }
            Step::Arc { centre, degrees } => {
                let (sine, cosine) = direction(*degrees);
                let (p, q) = (at[0] - centre[0], at[1] - centre[1]);
                let [i, j] = by.vector([-p, -q]);
                at = [centre[0] + p * cosine - q * sine, centre[1] + p * sine + q * cosine];
                let [x, y] = by.point(at);
                let code = if (*degrees > 0.0) == by.mirrors { "g2" } else { "g3" };
                text += &format!(";{code} x{x} y{y} i{i} j{j}");
            }
        }
        text += between;
    }
    text + ";m2"
}

/// The moves of a program, or that it is refused; the first move leads to its start.
fn moves(program: &str) -> (Vec<Vec<f64>>, bool) {
    let (path, _, result) = path(program);
    (path.0.into_iter().skip(1).collect(), result.is_ok())
}

fn near(found: &[f64], expected: &[f64]) -> bool {
    found.len() == expected.len()
        && found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-6 * b.abs().max(1.0))
}

proptest! {
    /// Law 1: a contour that is mirrored with the other side, turned, shifted or scaled with its tool has the same
    /// path.
    #[test]
    fn symmetry(
        contour in contour(), diameter in 0.1..1.5_f64, left: bool, mirrors: bool,
        degrees in -180.0..180.0_f64, scale in 0.2..5.0_f64, shift in [-9.0..9.0_f64, -9.0..9.0_f64],
    ) {
        let by = Motion { degrees, scale, shift, mirrors };
        let (plain, accepted) = moves(&program(&contour, (left, diameter), NONE, ""));
        let moved = (left != mirrors, diameter * scale);
        let (found, also) = moves(&program(&contour, moved, by, ""));
        prop_assert_eq!(accepted, also);
        prop_assert_eq!(plain.len(), found.len());
        for (plain, found) in plain.iter().zip(&found) {
            let [x, y] = by.point([plain[0], plain[1]]);
            let mut expected: Vec<f64> = [x, y].into();
            if let [_, _, i, j, turns] = plain[..] {
                expected.extend(by.point([i, j]));
                expected.push(if mirrors { -turns } else { turns });
            }
            prop_assert!(near(found, &expected), "{:?} {:?}", found, expected);
        }
    }

    /// Law 2: a negative diameter on one side is the positive one on the other.
    #[test]
    fn negative_diameters(contour in contour(), diameter in 0.1..1.5_f64, left: bool) {
        let plain = moves(&program(&contour, (left, diameter), NONE, ""));
        prop_assert_eq!(plain, moves(&program(&contour, (!left, -diameter), NONE, "")));
    }

    /// Law 6: moves out of the plane, and what waits, change no point of the plane.
    #[test]
    fn blocks_between(contour in contour(), diameter in 0.1..1.5_f64, left: bool) {
        let (plain, accepted) = moves(&program(&contour, (left, diameter), NONE, ""));
        let between = ";g4 p1;f20 s5 m3;g91;g1 z1;g90;m9";
        let (found, also) = moves(&program(&contour, (left, diameter), NONE, between));
        prop_assert_eq!(accepted, also);
        if accepted {
            // The moves out of the plane are straight and end where the move before them does.
            let mut kept: Vec<Vec<f64>> = Vec::new();
            for found in found {
                let repeats = kept.last().is_some_and(|last| found.len() == 2 && last[..2] == found[..]);
                if !repeats {
                    kept.push(found);
                }
            }
            prop_assert_eq!(plain, kept);
        }
    }

    /// Law 4: each point of a compensated line is R from its programmed one, except next to a tangent corner; and law
    /// 5: a convex closed contour, passed outside, is longer by the circumference of the cutter.
    #[test]
    fn convex_contours(
        corners in 3_u8..9, start in 0.0..360.0_f64, diameter in 0.1..1.5_f64, wide in 2.0..5.0_f64,
    ) {
        let angle = 360.0 / f64::from(corners);
        let place = |number: u8| {
            let (sine, cosine) = direction(start + angle * f64::from(number % corners));
            [wide * cosine, wide * sine]
        };
        let middle = |a: [f64; 2], b: [f64; 2]| [(a[0] + b[0]) / 2.0, (a[1] + b[1]) / 2.0];
        // The contour starts and ends in the middle of a side, which the entry meets in its direction.
        let (first, last) = (place(0), place(corners - 1));
        let begin = middle(last, first);
        let before = [begin[0] * 2.0 - first[0], begin[1] * 2.0 - first[1]];
        let away = [before[0] * 2.0 - begin[0], before[1] * 2.0 - begin[1]];
        let mut text = format!("g20 f10;g0 x{} y{};g42.1 d{diameter};", away[0], away[1]);
        text += &format!("g1 x{} y{}", before[0], before[1]);
        text += &format!(";x{} y{}", begin[0], begin[1]);
        for number in 0..corners {
            let [x, y] = place(number);
            text += &format!(";x{x} y{y}");
        }
        text += &format!(";x{} y{};m2", begin[0], begin[1]);
        let (found, accepted) = moves(&text);
        prop_assert!(accepted);
        // The entry, and the line to the beginning.
        let mut at = [found[1][0], found[1][1]];
        let mut length = 0.0;
        for found in &found[2..] {
            let chord = hypotenuse(found[0] - at[0], found[1] - at[1]);
            length += if found.len() == 2 {
                chord
            } else {
                diameter / 2.0 * angle.to_radians()
            };
            at = [found[0], found[1]];
        }
        let [a, b] = [place(0), place(1)];
        let programmed = f64::from(corners) * hypotenuse(a[0] - b[0], a[1] - b[1]);
        let round = core::f64::consts::PI * diameter;
        prop_assert!((length - programmed - round).abs() < 1e-9, "{} {} {}", length, programmed, round);
    }
}
