//! What holds for every arc.

use alloc::vec::Vec;

use gaugeblock_vocabulary::{Effect, Machine, Motion, Options, Plane};
use proptest::prelude::*;

use crate::math::{direction, hypotenuse};
use crate::parameters::Numbered;
use crate::words::Words;

use super::super::coordinates::Coordinates;
use super::super::{Flow, Modal, Refusal};
use super::{Recorder, words};

fn standing(place: [f64; 3], plane: Plane, units: &str) -> Modal {
    let mut numbered = Numbered::new();
    let mut modal = super::modal(&Machine::default(), &Options::default(), &mut numbered).unwrap();
    let mut sink = Recorder { settings: modal.settings(), ..Recorder::default() };
    let head = words(1, &alloc::format!("{units} f100"));
    assert!(modal.execute(&head, &mut numbered, &mut sink).is_ok());
    modal.active.put(|modes| &mut modes.plane, plane);
    let [x, y, z] = place;
    modal.position = Coordinates([x, y, z, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
    modal
}

fn coordinate() -> impl Strategy<Value = f64> {
    prop_oneof![4 => -100.0..100.0_f64, 1 => (-3_i8..4).prop_map(f64::from)]
}

fn point() -> impl Strategy<Value = [f64; 3]> {
    [coordinate(), coordinate(), coordinate()]
}

fn plane() -> impl Strategy<Value = Plane> {
    prop::sample::select(&[Plane::Xy, Plane::Zx, Plane::Yz][..])
}

/// First, second and normal coordinate.
fn in_plane([x, y, z]: [f64; 3], plane: Plane) -> [f64; 3] {
    match plane {
        Plane::Zx => [z, x, y],
        Plane::Yz => [y, z, x],
        Plane::Xy | Plane::Uv | Plane::Wu | Plane::Vw => [x, y, z],
    }
}

fn arc_words(pairs: &[(u8, f64)]) -> Words {
    let mut words = Words::new();
    for (letter, value) in pairs {
        words.set(letter - b'A', *value);
    }
    words
}

fn ends(pairs: [f64; 3]) -> Vec<(u8, f64)> {
    [b'X', b'Y', b'Z'].into_iter().zip(pairs).collect()
}

fn motion(counterclockwise: bool) -> Motion {
    if counterclockwise { Motion::ArcCounterclockwise } else { Motion::ArcClockwise }
}

/// Degrees that an arc turns through, above 0 up to 360.
fn sweep(start: [f64; 3], end: [f64; 3], centre: [f64; 2], counterclockwise: bool) -> f64 {
    let angle = |[first, second, _]: [f64; 3]| {
        crate::math::arctangent(second - centre[1], first - centre[0])
    };
    let turned = angle(end) - angle(start);
    (if counterclockwise { turned } else { -turned }).rem_euclid(360.0)
}

proptest! {
    /// Radius format: both ends are R from the centre, and the sign of R says which way round.
    #[test]
    fn radius_format(
        start in point(), end in point(), plane in plane(), factor in 1.001..50.0_f64, beyond: bool, counterclockwise: bool,
    ) {
        let ([a, b, _], [c, d, _]) = (in_plane(start, plane), in_plane(end, plane));
        let chord = hypotenuse(c - a, d - b);
        prop_assume!(chord > 0.01);
        let radius = chord / 2.0 * factor;
        let mut pairs = ends(end);
        pairs.push((b'R', if beyond { -radius } else { radius }));
        let mut modal = standing(start, plane, "g21");
        let from = modal.position;
        let [x, y, z] = end;
        modal.position = Coordinates([x, y, z, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
        let Ok(Effect::ArcFeed { first_centre, second_centre, turns, .. }) =
            modal.arc(&arc_words(&pairs), motion(counterclockwise), &from)
        else {
            panic!("refused")
        };
        prop_assert_eq!(turns, if counterclockwise { 1 } else { -1 });
        let near = |first: f64, second: f64| {
            (hypotenuse(first - first_centre, second - second_centre) - radius).abs() < 1e-9 * radius.max(1.0)
        };
        prop_assert!(near(a, b) && near(c, d));
        let (from, to) = (in_plane(start, plane), in_plane(end, plane));
        let sweep = sweep(from, to, [first_centre, second_centre], counterclockwise);
        prop_assert_eq!(sweep > 180.0, beyond, "{}", sweep);
    }

    /// A point that the arc's own centre turns to its end is accepted, incrementally and absolutely, with the same
    /// centre.
    #[test]
    fn centre_format(
        start in point(), centre in point(), angle in 0.0..360.0_f64, plane in plane(), counterclockwise: bool,
        turns in 1_u8..9,
    ) {
        let ([a, b, _], [first, second, _]) = (in_plane(start, plane), in_plane(centre, plane));
        prop_assume!(hypotenuse(a - first, b - second) > 0.01);
        let (sine, cosine) = direction(angle);
        let (c, d) = (
            first + (a - first) * cosine - (b - second) * sine,
            second + (a - first) * sine + (b - second) * cosine,
        );
        let (axes, offsets) = match plane {
            Plane::Zx => ([b'Z', b'X'], [b'K', b'I']),
            Plane::Yz => ([b'Y', b'Z'], [b'J', b'K']),
            Plane::Xy | Plane::Uv | Plane::Wu | Plane::Vw => ([b'X', b'Y'], [b'I', b'J']),
        };
        let mut modal = standing(start, plane, "g21");
        let p = (b'P', f64::from(turns));
        let incremental = arc_words(&[(axes[0], c), (axes[1], d), (offsets[0], first - a), (offsets[1], second - b), p]);
        let absolute = arc_words(&[(axes[0], c), (axes[1], d), (offsets[0], first), (offsets[1], second), p]);
        let from = modal.position;
        modal.position = modal.plain_end_point(&incremental);
        let found = modal.arc(&incremental, motion(counterclockwise), &from).unwrap();
        modal.active.put(|modes| &mut modes.arc_distance, gaugeblock_vocabulary::Distance::Absolute);
        let also = modal.arc(&absolute, motion(counterclockwise), &from).unwrap();
        let (
            Effect::ArcFeed { first_centre, second_centre, turns: found_turns, end },
            Effect::ArcFeed { first_centre: x, second_centre: y, .. },
        ) =
            (found, also)
        else {
            panic!("no arcs")
        };
        prop_assert!((first_centre - x).abs() < 1e-9 && (second_centre - y).abs() < 1e-9);
        let turns = i32::from(turns);
        prop_assert_eq!(found_turns, if counterclockwise { turns } else { -turns });
        prop_assert_eq!(end, modal.position.position());
    }
}

/// A block of motions alone, words for them more often than others.
fn moving_block() -> impl Strategy<Value = Words> {
    let value = prop_oneof![6 => (-3_i8..6).prop_map(f64::from), 1 => any::<f64>(), 1 => Just(1.5)];
    let letter = prop::sample::select(&b"XYZIJKRPFXYIJAUH"[..]);
    let letters = prop::collection::vec((letter, value), 0..5);
    (letters, prop::option::of(prop::sample::select(&[0_u16, 10, 20, 30, 20, 30][..]))).prop_map(
        |(letters, code)| {
            let mut words = Words::new();
            for (letter, value) in letters {
                words.set(letter - b'A', value);
            }
            if let Some(code) = code {
                words.push_g(code);
            }
            words
        },
    )
}

fn kind(result: &Result<Flow, Refusal>) -> bool {
    result.is_ok()
}

proptest! {
    /// The short ways of moves have the outcome of the whole order of execution.
    #[test]
    fn fast_paths(blocks in prop::collection::vec(moving_block(), 1..12), plane in plane(), incremental: bool, units: bool) {
        let mut modal = standing([1.0, 0.0, 0.0], plane, if units { "g21" } else { "g20" });
        let mut numbered = Numbered::new();
        if incremental {
            modal.select_distance(910);
            modal.select_arc_distance(901);
        }
        let mut whole = modal.clone();
        let (mut sink, mut whole_sink) = (Recorder::default(), Recorder::default());
        for words in blocks {
            if words.is_empty() {
                continue;
            }
            let short = modal.execute(&words, &mut numbered, &mut sink);
            let long = whole.whole_block(&words, &mut numbered, &mut whole_sink);
            prop_assert_eq!(kind(&short), kind(&long), "{:?} {:?}", short, long);
            prop_assert_eq!(&sink.effects, &whole_sink.effects);
            if short.is_err() {
                // Which of several mistakes is told may differ.
                break;
            }
            prop_assert_eq!(alloc::format!("{:?}", modal.state()), alloc::format!("{:?}", whole.state()));
        }
    }
}
