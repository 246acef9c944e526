//! Tests numbered, named and predefined parameters.

use std::collections::BTreeMap;

use gaugeblock_vocabulary::Machine;

use super::*;
use crate::Choices;
use crate::rs274::control::Frame;
use crate::rs274::refusal::Refusal;

fn named(name: &str) -> Name {
    Name::Named(name.to_owned())
}

fn rule(result: Result<f64, StepError>) -> &'static str {
    match result {
        Err(StepError::Refused(Refusal { rule, .. })) => rule.id(),
        other => panic!("{other:?}"),
    }
}

fn check(name: &Name, state: &State, expect: f64) {
    let value = value(name, state).expect("it exists");
    assert!((value - expect).abs() < 1e-12, "{name:?} is {value}");
}

#[test]
fn stored_parameters_are_there_at_the_start_and_volatile_ones_are_not() {
    let parameters = [
        (31, 7.5),
        (5070, 1.0),
        (5241, 10.0),
        (5420, 3.0),
        (5599, 0.0),
        (9999, 1.0),
        (40, f64::NAN),
    ];
    let machine = Machine { parameters: parameters.into_iter().collect(), ..Machine::default() };
    let parameters = Parameters::new(&machine, &Choices::default());
    let nonzero: Vec<u32> = parameters.nonzero().0.keys().copied().collect();
    assert_eq!(nonzero, [31, 5220, 5241, 5599]);
}

#[test]
fn local_parameters_belong_to_their_frame() {
    let mut state = State::under(&[]);
    assign(&named("depth"), 2.0, &mut state).expect("assigned");
    assign(&named("_depth"), 3.0, &mut state).expect("assigned");
    assign(&Name::Numbered(1), 4.0, &mut state).expect("assigned");
    state.frames.push(Frame::default());
    assert_eq!(rule(value(&named("depth"), &state)), "parameters.named-local");
    check(&named("_depth"), &state, 3.0);
    check(&Name::Numbered(1), &state, 0.0);
    assign(&named("width"), 5.0, &mut state).expect("assigned");
    state.frames.pop();
    assert_eq!(rule(value(&named("width"), &state)), "parameters.local-deleted");
    assert_eq!(rule(value(&named("height"), &state)), "parameters.named-absent");
    check(&named("depth"), &state, 2.0);
    check(&Name::Numbered(1), &state, 4.0);
}

#[test]
fn predefined_parameters_are_read_only() {
    let mut state = State::under(&[]);
    let names = [
        "_x",
        "_w",
        "_abs_c",
        "_vmajor",
        "_selected_pocket",
        "_remap_level",
        "_ini[a]b",
        "_hal[a.b]",
    ];
    for name in names {
        assert!(assign(&named(name), 1.0, &mut state).is_err(), "{name}");
    }
    for name in ["_", "_abs_u", "_xy", "x", "_inia", "_hal"] {
        assert!(assign(&named(name), 1.0, &mut state).is_ok(), "{name}");
    }
    assert!(assign(&Name::Numbered(5420), 1.0, &mut state).is_err());
    assert!(assign(&Name::Numbered(5221), 1.0, &mut state).is_ok());
}

#[test]
fn a_position_that_a_program_wrote_is_still_the_position() {
    let mut state = State::under(&[("parameters.read-only-numbered", "written")]);
    assign(&Name::Numbered(5420), 7.0, &mut state).expect("assigned");
    check(&Name::Numbered(5420), &state, 0.0);
}

#[test]
fn hal_items_can_be_assigned_where_that_is_shown() {
    let mut state = State::under(&[("rs274.hal-assignment", "observed")]);
    assert_eq!(rule(value(&named("_hal[a]"), &state)), "parameters.ini-absent");
    assign(&named("_hal[a]"), 1.0, &mut state).expect("assigned");
    check(&named("_hal[a]"), &state, 1.0);
}

#[test]
fn ini_entries_have_values() {
    let mut state = State::under(&[]);
    state.machine.ini = BTreeMap::from([("[SETUP]DEPTH".to_owned(), 3.25)]);
    check(&named("_ini[setup]depth"), &state, 3.25);
    assert!(exists(&named("_ini[setup]depth"), &state));
    assert!(!exists(&named("_ini[setup]width"), &state));
    assert_eq!(rule(value(&named("_ini[setup]width"), &state)), "parameters.ini-absent");
}

#[test]
fn only_letters_of_ascii_have_a_case_in_ini_entries() {
    let entries = [("[a]b", 1.0), ("[A]É", 2.0), ("[Two]same", 4.0), ("[TWO]Same", 3.0)];
    let mut state = State::under(&[]);
    state.machine.ini = entries.map(|(key, value)| (key.to_owned(), value)).into();
    check(&named("_ini[a]b"), &state, 1.0);
    check(&named("_ini[a]É"), &state, 2.0);
    assert_eq!(rule(value(&named("_ini[a]é"), &state)), "parameters.ini-absent");
    // Of two keys that differ by case alone it is the first.
    check(&named("_ini[two]same"), &state, 3.0);
}

#[test]
fn tool_parameters_are_those_of_the_tool_in_the_spindle() {
    let mut state = State::under(&[]);
    let tool = gaugeblock_vocabulary::Tool {
        number: 7,
        diameter: 3.0,
        ..gaugeblock_vocabulary::Tool::default()
    };
    state.machine.tools = vec![tool];
    check(&Name::Numbered(5410), &state, 0.0);
    state.known_tool = 7;
    check(&Name::Numbered(5400), &state, 7.0);
    check(&Name::Numbered(5410), &state, 3.0);
    check(&Name::Numbered(5403), &state, 0.0);
}

#[test]
fn every_predefined_parameter_has_a_value_and_a_rule() {
    let state = State::under(&[]);
    for name in predefined::names() {
        assert!(exists(&named(name), &state), "{name}");
        assert!(value(&named(name), &state).is_ok_and(f64::is_finite), "{name}");
        assert!(predefined::rule(name, &state).is_some(), "{name}");
    }
}
