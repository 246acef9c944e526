//! Probes, splines and threads with whatever words: what holds of every one of them.

use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;

use proptest::prelude::*;

use super::{Run, machine, run};

/// Eighths, which are exact and stay so when they are added.
fn eighths() -> impl Strategy<Value = f64> {
    (-80_i8..80).prop_map(|number| f64::from(number) / 8.0)
}

/// Coordinates of the end points of the effects of a line, where they have one.
fn ends(run: &Run, line: u32) -> Vec<(String, [f64; 3])> {
    let own = format!("{line} ");
    let effects = run.sink.effects.iter().filter_map(|effect| effect.strip_prefix(&own));
    effects.filter_map(|effect| Some((effect.split(' ').next()?.into(), end(effect)?))).collect()
}

fn end(effect: &str) -> Option<[f64; 3]> {
    let inner = effect.split_once("end=(")?.1.strip_suffix(')')?;
    let mut point = [0.0; 3];
    for word in inner.split(' ').filter(|word| !word.is_empty()) {
        let (axis, value) = word.split_at(1);
        point["xyz".find(axis)?] = value.parse().ok()?;
    }
    Some(point)
}

proptest! {
    /// The probe touches at Z-1 of the recorder's world, or never.
    #[test]
    fn probe_stores_its_contact(x in eighths(), z in eighths(), code in 2..6_u8, incremental: bool) {
        let mode = if incremental { "g91" } else { "g90" };
        let program = format!("f9; g0 x1.5; {mode}; g38.{code} x{x} z{z}");
        let run = run(&machine(), &[], &program);
        let (end_x, touches) = (if incremental { 1.5 + x } else { x }, z < -1.0);
        let stands = end_x.to_bits() == 1.5_f64.to_bits() && z.abs() <= 0.0;
        prop_assert_eq!(run.last.1.is_err(), stands || !touches && matches!(code, 2 | 4));
        if run.last.1.is_ok() {
            let found = if touches { -1.0 } else { z };
            for (parameter, value) in [("#5061", end_x), ("#5063", found), ("#5420", end_x), ("#5422", found)] {
                let found: f64 = run.value(parameter).parse().unwrap();
                prop_assert!((found - value).abs() <= 0.0, "{}", parameter);
            }
            prop_assert_eq!(run.value("#5070"), if touches { "1" } else { "0" });
        }
    }

    /// A curve is one effect, with a point more than was programmed, and ends in the last of them.
    #[test]
    fn a_data_block_is_a_curve(points in prop::collection::vec((eighths(), eighths()), 2..9), incremental: bool) {
        let mode = if incremental { "g91" } else { "g90" };
        let lines: Vec<_> = points.iter().map(|(x, y)| format!("x{x} y{y} p2")).collect();
        let run = run(&machine(), &[], &format!("f9 g5.2 {mode}; {}; g5.3", lines.join("; ")));
        prop_assert!(run.last.1.is_ok());
        prop_assert_eq!(run.sink.effects.len(), 1);
        let count = format!("nurbs_feed points={} ", points.len() + 1);
        prop_assert!(run.sink.effects[0].contains(&count), "{}", run.sink.effects[0]);
        let last = if incremental {
            points.iter().fold((0.0, 0.0), |sum, point| (sum.0 + point.0, sum.1 + point.1))
        } else {
            points[points.len() - 1]
        };
        let [x, y, _] = end(&run.sink.effects[0]).unwrap();
        prop_assert!((x - last.0).abs() + (y - last.1).abs() < 1e-12);
    }

    /// Each pass is deeper than the one before up to K, there is a way back to the drive line, and the tool ends at
    /// its end.
    #[test]
    fn a_thread_is_cut_in_passes(
        (first, full, degression) in (1_u8..9, 1_u8..30, 1_u8..4),
        (springs, taper, slide) in (0_u8..4, 0_u8..4, 0_u8..46),
        (inside, forward) in (any::<bool>(), any::<bool>()),
    ) {
        let (peak, to) = (if inside { 1 } else { -1 }, if forward { 8 } else { -8 });
        let words = format!(
            "p1 z{to} i{peak} j{} k{} r{degression} h{springs} l{taper} e0.5 q{slide}",
            f64::from(first) / 8.0,
            f64::from(full) / 8.0
        );
        let run = run(&machine(), &[], &format!("g18; g0 x20; g76 {words}"));
        prop_assert!(run.last.1.is_ok(), "{}", words);
        let ends = ends(&run, 3);
        let inward = f64::from(peak);
        let depth = |x: f64| (x - 20.0 - inward) * inward;
        // The deepest point between two ways out is the depth of a pass.
        let mut depths = Vec::new();
        for pass in ends.split(|(_, [x, _, _])| (x - 20.0).abs() <= 0.0).filter(|pass| !pass.is_empty()) {
            depths.push(pass.iter().map(|(_, [x, ..])| depth(*x)).fold(f64::MIN, f64::max));
        }
        let full = f64::from(full) / 8.0;
        prop_assert!((depths[0] - full.min(f64::from(first) / 8.0)).abs() < 1e-9, "{:?}", depths);
        prop_assert!(depths.windows(2).all(|pair| pair[1] - pair[0] > -1e-9), "{:?}", depths);
        let last = depths.iter().filter(|depth| (**depth - full).abs() < 1e-9).count();
        prop_assert_eq!(last, usize::from(springs) + 1, "{:?}", depths);
        prop_assert_eq!(run.value("position"), format!("(x20 z{to})"));
        let count = |name: &str| run.sink.effects.iter().filter(|effect| effect.contains(name)).count();
        // Each taper is synchronised with a way per revolution of its own.
        let starts = 1 + [0, 1, 1, 2][usize::from(taper)];
        prop_assert_eq!(count("start_spindle"), depths.len() * starts);
        prop_assert_eq!(count("stop_spindle"), depths.len());
    }
}
