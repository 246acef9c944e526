//! The search, and measurements of the controllers of this project.

use super::*;

#[test]
fn edge_of_whole_numbers_is_exact() {
    let scale = Scale::Whole { low: 1, high: 4096 };
    for edge in [1.0, 2.0, 9.0, 1000.0] {
        let found = search(scale, |value| Ok(value <= edge));
        assert_eq!(found, Ok(Measured::Edge { accepted: edge, refused: edge + 1.0 }));
    }
    assert_eq!(search(scale, |_| Ok(true)), Ok(Measured::AtLeast(4096.0)));
    assert_eq!(search(scale, |_| Ok(false)), Ok(Measured::Below(1.0)));
}

#[test]
fn edge_of_numbers_is_as_close_as_the_scale_says() {
    let scale = Scale::Real { low: 1e-9, high: 100.0, closeness: 1e-4 };
    for edge in [3e-9, 0.00254, 0.5] {
        let Ok(Measured::Edge { accepted, refused }) = search(scale, |value| Ok(value <= edge))
        else {
            panic!("{edge} has no edge");
        };
        assert!(accepted <= edge && edge < refused, "{accepted} {edge} {refused}");
        assert!(refused - accepted <= 1e-4 * accepted, "{accepted} {refused}");
    }
}

#[test]
fn reason_why_nothing_is_measured_is_kept() {
    let scale = Scale::Whole { low: 1, high: 8 };
    assert_eq!(search(scale, |_| Err("no o-words".to_owned())), Err("no o-words".to_owned()));
    let beyond = |value: f64| if value > 2.0 { Err("too long".to_owned()) } else { Ok(true) };
    assert_eq!(search(scale, beyond), Ok(Measured::AtLeast(2.0)));
}

#[test]
fn ids_are_unique() {
    let mut ids: Vec<_> = QUANTITIES.iter().map(|quantity| quantity.id).collect();
    ids.sort_unstable();
    ids.dedup();
    assert_eq!(ids.len(), QUANTITIES.len());
}
