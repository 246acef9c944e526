//! Tests the parser of blocks: spans, precedence, and the rule that refuses each invalid line.

use super::*;
use crate::rs274::refusal::{Refusal, StepError};

fn parsed(line: &str) -> Block {
    parse(line, &mut State::under(&[])).expect("the line is a block")
}

/// The rule that refuses a line.
fn refused(line: &str) -> &'static str {
    match parse(line, &mut State::under(&[])) {
        Err(StepError::Refused(Refusal { rule, .. })) => rule.id(),
        other => panic!("{line:?}: {other:?}"),
    }
}

/// An expression with all its brackets.
fn text(expression: &Expression) -> String {
    match expression {
        Expression::Number(number) => number.to_string(),
        Expression::Parameter(Parameter::Numbered(number)) => format!("#{}", text(number)),
        Expression::Parameter(Parameter::Named(name)) => format!("#<{name}>"),
        Expression::Negate(value) => format!("-{}", text(value)),
        Expression::Function(function, argument) => format!("{function:?}({})", text(argument)),
        Expression::ArcTangent(opposite, adjacent) => {
            format!("atan({}, {})", text(opposite), text(adjacent))
        }
        Expression::Exists(parameter) => {
            format!("exists({})", text(&Expression::Parameter(parameter.clone())))
        }
        Expression::Binary(operator, left, right) => {
            format!("({} {operator:?} {})", text(left), text(right))
        }
    }
}

fn check_value(value: &str, expect: &str) {
    assert_eq!(text(&parsed(&format!("x{value}")).words[0].value), expect, "{value}");
}

fn check_refused(rule: &str, lines: &[&str]) {
    for line in lines {
        assert_eq!(refused(line), rule, "{line}");
    }
}

#[test]
fn a_block_has_slash_number_words_settings_and_comment() {
    let block = parsed("/ N10.5 G1 (a) x -1. 5#3=4 ( B c)");
    assert!(block.block_delete);
    assert_eq!(block.line_number.as_deref(), Some("10.5"));
    let letters: Vec<char> = block.words.iter().map(|word| word.letter).collect();
    assert_eq!(letters, ['g', 'x']);
    assert_eq!(block.words[1].value, Expression::Number(-1.5));
    assert_eq!(block.settings.len(), 1);
    assert_eq!(block.comment.map(|comment| comment.text).as_deref(), Some(" B c"));
}

#[test]
fn spans_point_at_the_text() {
    let line = "g1 x [1 + 2] #3 = 4";
    let block = parsed(line);
    let part = |span: gaugeblock_vocabulary::Span| &line[span.start as usize..span.end as usize];
    assert_eq!(part(block.words[1].span), "x [1 + 2]");
    assert_eq!(part(block.settings[0].span), "#3 = 4");
}

#[test]
fn operators_bind_by_group_and_from_the_left() {
    check_value("[1+2*3**2]", "(1 Add (2 Multiply (3 Power 2)))");
    check_value("[8-3-2]", "((8 Subtract 3) Subtract 2)");
    check_value("[2**3**2]", "((2 Power 3) Power 2)");
    check_value("[1 or 1 and 0]", "((1 Or 1) And 0)");
    check_value("[1 and 2 + 3 gt 4]", "(1 And ((2 Add 3) Greater 4))");
    check_value("[[1+2]*3]", "((1 Add 2) Multiply 3)");
    check_value("[5--2]", "(5 Subtract -2)");
    check_value("[-2**2]", "(-2 Power 2)");
    check_value("[-#2]", "-#2");
    check_value("[#1+2]", "(#1 Add 2)");
    check_value("##[1+2]", "##(1 Add 2)");
    check_value("atan[1]/[2]", "atan(1, 2)");
    check_value("exists[#< A b>]", "exists(#<ab>)");
    check_value("S Q R T[4]", "SquareRoot(4)");
}

#[test]
fn a_function_may_follow_a_letter_that_spells_an_operator_with_it() {
    assert_eq!(parsed("x1gtan[45]").words[1].letter, 'g');
    assert_eq!(parsed("x1lexp[0]").words[1].letter, 'l');
}

#[test]
fn each_wrong_line_has_its_rule() {
    check_refused("text.line-length", &[&" ".repeat(256), &"é".repeat(256)]);
    check_refused("text.illegal-input", &["g0 x1 !", "x1 é", "x1 ,", "\u{0}", "x1 \\"]);
    check_refused("text.illegal-item", &["[1]", "x1 [2]", "x1=2", "-x1", "5", "<a>=1"]);
    check_refused("text.block-delete-place", &["n1 /g0", "g0/", "//g0", "x1 / y2"]);
    check_refused("text.line-number-place", &["g0 n1", "n1 n2", "(a) n1"]);
    check_refused("text.line-number-form", &["n", "n-5", "n5.", "n.5", "n[5]", "n1.2.3"]);
    check_refused("text.word-value", &["x", "x y1", "g0 x!"]);
    check_refused("text.word-letters", &["_2"]);
    check_refused("text.comment-inside-word", &["x(a)1", "#3=(a)4", "x[1(a)+2]", "x-(a)1"]);
    check_refused("text.comment-unclosed", &["(", "x1 (a", ")", "(a (b) c)", "((a)"]);
    check_refused("text.percent-line", &["% a", "g0 %"]);
    check_refused("numbers.digits", &["x.", "x-", "x-.", "x.-5"]);
    check_refused("numbers.form", &["x--1", "x1.2.3", "x1..2", "#3=1-"]);
    check_refused("numbers.no-exponent", &["x[1e2]"]);
    check_refused("expressions.unbalanced", &["x[1", "x[1+", "x1]", "x[[1]"]);
    check_refused(
        "expressions.incomplete",
        &["x[]", "x[1+]", "x[*2]", "x[[1][2]]", "x[#]", "x[1 and or 1]"],
    );
    check_refused(
        "expressions.unknown-operator",
        &["x[1==1]", "x[1 nand 2]", "x[y+1]", "x[7%4]", "#3=not[1]"],
    );
    check_refused(
        "expressions.operators-in-brackets",
        &["x1+2", "x2*3", "#3=4/2", "x7mod4", "#3=1 eq 1"],
    );
    check_refused("expressions.function-brackets", &["xsin30", "#3=sqrt#2", "#3=sqrt(9)"]);
    check_refused("expressions.arctangent", &["xatan[1]", "xatan[1]/2"]);
    check_refused("expressions.exists-argument", &["xexists[]", "xexists[#5]", "xexists[#<a>+1]"]);
    check_refused("parameters.assignment-form", &["#3", "#3=", "#3==4", "#=5", "#3=x5", "#<a>"]);
    check_refused("parameters.name-marks", &["#a=5", "#<a=5", "#<>=5", "x#<a"]);
    check_refused(
        "control.unrelated-words",
        &["g0 o1 sub", "o1 if [1] g0", "o1 x1", "o<a>", "o1 endif [1]"],
    );
    check_refused("subroutines.arguments-in-brackets", &["o1 call 1 2", "o1 call #5"]);
}

#[test]
fn signs_and_comments_are_read_as_chosen() {
    let accepted = |line: &str, id: &str, option: &str| {
        parse(line, &mut State::under(&[(id, option)])).is_ok()
    };
    assert!(accepted("x--1", "rs274.repeated-signs", "observed"));
    assert!(!accepted("x[-#2]", "expressions.unary-minus", "refused"));
    assert!(accepted("(a (b)", "text.comment-nested", "plain"));
    assert!(accepted(&format!("x1;{}", "a".repeat(253)), "text.line-end-counted", "not-counted"));
    assert!(!accepted(&format!("x1;{}", "a".repeat(250)), "rs274.shorter-lines", "observed"));
    assert!(accepted("xexists[#5]", "rs274.exists-numbered", "observed"));
}

#[test]
fn the_last_comment_counts() {
    assert_eq!(parsed("(a) x1 (b) ;c(").comment.map(|comment| comment.text).as_deref(), Some("c("));
    let mut plain = State::under(&[("rs274.semicolon-plain", "observed")]);
    let block = parse("(a) x1 (b) ;c(", &mut plain).expect("a block");
    assert_eq!(block.comment.map(|comment| comment.text).as_deref(), Some("b"));
}

#[test]
fn o_words_have_label_keyword_and_arguments() {
    let o_word = |line: &str| parsed(line).o_word.expect("an O-word");
    assert_eq!(o_word("n1 O 1 0 0 SUB").label, Label::Number(Expression::Number(100.0)));
    assert_eq!(o_word("o<My Sub>call[1][#2]").label, Label::Name("mysub".to_owned()));
    assert_eq!(o_word("o<My Sub>call[1][#2]").arguments.len(), 2);
    assert_eq!(o_word("o1 elseif [1]").keyword, Keyword::ElseIf);
    assert_eq!(o_word("o1 else (a)").keyword, Keyword::Else);
    assert_eq!(o_word("o1 (a title)").keyword, Keyword::ProgramNumber);
    assert_eq!(o_word("o#1call").keyword, Keyword::Call);
    assert!(matches!(o_word("o[#1+2] call").label, Label::Number(Expression::Binary(..))));
}

#[test]
fn o_words_are_found_in_lines_that_would_be_refused() {
    let found = |line: &str| o_word_of(line, &mut State::under(&[])).map(|o_word| o_word.keyword);
    assert_eq!(found(" /n5 o1 endif g0 x!"), Some(Keyword::EndIf));
    assert_eq!(found("o1 if [1/"), Some(Keyword::If));
    assert_eq!(found("o1 if"), Some(Keyword::If));
    assert_eq!(found("g0 o1 endif"), None);
    assert_eq!(found("o"), None);
    assert_eq!(found("#3="), None);
    assert_eq!(found("(o1 endif"), None);
    assert_eq!(found(&format!("o1 endif;{}", "a".repeat(300))), Some(Keyword::EndIf));
    assert_eq!(found(&format!("{}o1 endif", " ".repeat(300))), None);
}

#[test]
fn a_number_beside_anything_else_begins_no_program() {
    let found = |line: &str| o_word_of(line, &mut State::under(&[])).map(|o_word| o_word.keyword);
    for line in ["o1 x1", "o1 [1]", "o1[", "o1)", "o1 (a", "o1 (a) b"] {
        assert_eq!(found(line), None, "{line}");
    }
    assert_eq!(found("o1 (a)"), Some(Keyword::ProgramNumber));
}

#[test]
fn the_deepest_lines_parse() {
    drop(parsed(&format!("x{}1{}", "[".repeat(126), "]".repeat(126))));
    drop(parsed(&format!("x{}1", "#".repeat(250))));
    assert_eq!(refused(&format!("x{}", "[".repeat(250))), "expressions.unbalanced");
    assert_eq!(refused(&format!("x{}1", "-".repeat(250))), "numbers.form");
}

proptest::proptest! {
    #[test]
    fn no_line_panics(line in "[-+*/\\[\\]#<>=().;%a-zA-Z0-9 \t\\PC]{0,60}") {
        let mut state = State::under(&[("rs274.repeated-signs", "observed"), ("rs274.exists-numbered", "observed")]);
        drop(o_word_of(&line, &mut state));
        if let Ok(block) = parse(&line, &mut state) {
            drop(crate::rs274::evaluate::words(&block, &mut state));
        }
    }

    #[test]
    fn no_expression_panics(line in "x\\[([-+*/\\[\\]#.0-9]|mod|eq|and|sin\\[|atan\\[|fix\\[|ln\\[|\\*\\*){0,20}\\]") {
        let mut state = State::under(&[]);
        if let Ok(block) = parse(&line, &mut state) {
            drop(crate::rs274::evaluate::words(&block, &mut state));
        }
    }
}
