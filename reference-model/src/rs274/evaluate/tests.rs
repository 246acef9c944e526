//! Tests the evaluation of words, expressions and settings.

use super::*;
use crate::rs274::refusal::Refusal;
use crate::rs274::syntax::parse;

fn words(line: &str, state: &mut State) -> Result<Words, StepError> {
    let block = parse(line, state)?;
    super::words(&block, state)
}

fn value(expression: &str, options: &[(&str, &str)]) -> f64 {
    let words =
        words(&format!("x{expression}"), &mut State::under(options)).expect("it has a value");
    words.letters.get(&'x').copied().unwrap_or(f64::NAN)
}

fn check(expression: &str, expect: f64) {
    check_under(expression, &[], expect);
}

fn check_under(expression: &str, options: &[(&str, &str)], expect: f64) {
    let value = value(expression, options);
    assert!((value - expect).abs() < 1e-9, "{expression} is {value}");
}

fn refused(line: &str) -> &'static str {
    match words(line, &mut State::under(&[])) {
        Err(StepError::Refused(Refusal { rule, .. })) => rule.id(),
        other => panic!("{line:?}: {other:?}"),
    }
}

#[test]
fn expressions_have_values() {
    check("[1 + acos[0] - [#3 ** [4.0/2]]]", 91.0);
    check("[2.0 / 3 * 1.5 - 5.5 / 11.0]", 0.5);
    check("fix[-2.8]", -3.0);
    check("fup[-2.8]", -2.0);
    check("[-7 mod 3]", 2.0);
    check("[10 mod -3]", 1.0);
    check("[1 eq 1.00005]", 1.0);
    check("[1 lt 1.00005]", 1.0);
    check("[0.00001 and 1]", 1.0);
    check("round[-2.5]", -3.0);
    check("atan[-2]/[2]", -45.0);
    check("exists[#<_feed>]", 1.0);
    check("exists[#<a>]", 0.0);
}

#[test]
fn choices_decide_values() {
    check_under("[-7 mod 3]", &[("expressions.modulus-sign", "dividend")], -1.0);
    check_under("round[-2.5]", &[("expressions.round-half", "up")], -2.0);
    check_under("round[2.5]", &[("expressions.round-half", "even")], 2.0);
    check_under("[3 gt 2]", &[("expressions.true-value", "minus-one")], -1.0);
    check_under("[1 ge 1.00005]", &[("expressions.order-tolerance", "tolerant")], 1.0);
    check_under("[1 lt 1.00005]", &[("expressions.order-tolerance", "tolerant")], 0.0);
    check_under("atan[-2]/[2]", &[("expressions.arctangent-range", "full-turn")], 315.0);
    check_under("#<_a_b>", &[("parameters.absent-global", "zero")], 0.0);
    check_under("--1", &[("rs274.repeated-signs", "observed")], 1.0);
}

#[test]
fn what_has_no_value_is_refused() {
    assert_eq!(refused("x[1/0]"), "expressions.division-by-zero");
    assert_eq!(refused("x[5 mod #99]"), "expressions.modulus-zero");
    assert_eq!(refused("x[-4**0.5]"), "expressions.power-domain");
    assert_eq!(refused("x[0**-1]"), "expressions.power-domain");
    assert_eq!(refused("x[10**300*10**300]"), "expressions.domain");
    assert_eq!(refused("xexp[1000]"), "expressions.domain");
    assert_eq!(refused("xln[0]"), "expressions.domain");
    assert_eq!(refused("xsqrt[-1]"), "expressions.domain");
    assert_eq!(refused("xasin[1.01]"), "expressions.domain");
    assert_eq!(refused("x#<a>"), "parameters.named-absent");
    assert_eq!(refused("x#0"), "parameters.range");
    assert_eq!(refused("x#5603"), "parameters.range");
    assert_eq!(refused("x#[10**300]"), "parameters.range");
    assert_eq!(refused("x#1.5"), "parameters.index-integer");
}

#[test]
fn codes_are_close_to_integers() {
    let words = words("g17.000005 g38.2 m2.00005 x1", &mut State::under(&[])).expect("words");
    assert_eq!(words.g_tenths, [170, 382]);
    assert_eq!(words.m, [2]);
    assert_eq!(refused("g17.0001"), "numbers.not-near-integer");
    assert_eq!(refused("m3.5"), "numbers.not-near-integer");
    assert_eq!(refused("g-1"), "modal-groups.g-code-out-of-range");
    assert_eq!(refused("m-1"), "modal-groups.m-code-out-of-range");
    assert_eq!(refused("x1 y2 x3"), "modal-groups.repeated-letter");
    assert_eq!(refused("g0 x1 e2"), "text.word-letters");
    assert_eq!(m_codes("m66 e0 l0"), [66]);
    assert_eq!(m_codes(&format!("m{}", "9".repeat(200))), [u32::MAX]);
}

#[test]
fn settings_wait_and_keep_their_order() {
    let mut state = State::under(&[]);
    let read = words("#31=1 x#31 #31=[#31+2]", &mut state).expect("words");
    assert_eq!(read.settings, [(Name::Numbered(31), 1.0), (Name::Numbered(31), 2.0)]);
    assert!(read.letters.get(&'x').is_some_and(|x| x.abs() < 1e-12));
    assert!(state.parameters.stored(31).abs() < 1e-12);
}

#[test]
fn a_named_parameter_exists_early_where_that_is_shown() {
    assert_eq!(refused("#<a>=1 x#<a>"), "parameters.named-absent");
    let mut state = State::under(&[("rs274.named-exists-early", "observed")]);
    assert!(words("#<a>=1 x#<a>", &mut state).is_ok());
    assert!(words("x#<b> #<b>=1", &mut state).is_err());
}

fn m_codes(line: &str) -> Vec<u32> {
    words(line, &mut State::under(&[])).expect("words").m
}
