//! Operators, precedence, functions (11.4.5 to 11.4.8).

use alloc::format;

use super::{Case, check, check_all};

/// `#1` to `#4` are 1 to 4, so that nothing is known before the block is executed.
#[track_caller]
fn gives(expression: &str, value: f64) {
    check(
        &format!("#1=1 #2=2 #3=3 #4=4\n#31={expression}\nm2\n"),
        &format!("accepted; #31 = {value}"),
    );
}

#[track_caller]
fn refused(expression: &str, kind: &str) {
    check(&format!("#1=1 #2=2\n#31={expression}\nm2\n"), &format!("refused at 2 {kind}"));
}

#[test]
fn groups_go_by_precedence_and_from_the_left() {
    for (expression, value) in [
        ("[2.0 / 3 * 1.5 - 5.5 / 11.0]", 0.5),
        ("[1 + 2 * 3]", 7.0),
        ("[#1 + #2 * #3]", 7.0),
        ("[#1 * #2 + #3]", 5.0),
        ("[#4 - #2 - #1]", 1.0),
        ("[2 ** 3 ** 2]", 64.0),
        ("[#2 ** #3 ** #2]", 64.0),
        ("[2 * #3 ** 2 * 2]", 36.0),
        ("[-2 ** 2]", 4.0),
        ("[1 - -2]", 3.0),
        ("[1--#2]", 3.0),
        ("[1 + 1 eq 2]", 1.0),
        ("[1 eq 1 and 2 eq 2]", 1.0),
        ("[1 or 0 and 0]", 0.0),
        ("[#1 lt #2 xor #2 lt #1]", 1.0),
        ("[10 mod 4 * 2]", 4.0),
        ("[[#1 + #2] * [#3 + #4]]", 21.0),
        ("[#1 - [#2 - [#3 - #4]]]", -2.0),
        ("[#4/#2/#2]", 1.0),
        ("[#[1+1] + ##2 + #[#1+#2]]", 7.0),
        ("[1 + acos[0] - [#3 ** [4.0/2]]]", 82.0),
        ("-[#1+#2]", -3.0),
        ("+#3", 3.0),
        ("-abs[-5]", -5.0),
        ("[-#1+-2]", -3.0),
    ] {
        gives(expression, value);
    }
}

#[test]
fn operators_and_functions() {
    for (expression, value) in [
        ("[7 mod 3]", 1.0),
        ("[#2-9 mod 3]", 2.0),
        ("[7.5 mod -2]", 1.5),
        ("[1 eq 1.00005]", 1.0),
        ("[1 eq 1.0002]", 0.0),
        ("[1 ne 1.00005]", 0.0),
        ("[#1 gt #2]", 0.0),
        ("[#2 ge #2]", 1.0),
        ("[#1 le #2]", 1.0),
        ("[5 and -0.5]", 1.0),
        ("[0 or 0]", 0.0),
        ("[2 xor 3]", 0.0),
        ("fix[2.8]", 2.0),
        ("fix[-2.8]", -3.0),
        ("fup[2.8]", 3.0),
        ("fup[-2.8]", -2.0),
        ("round[2.5]", 3.0),
        ("round[-2.5]", -3.0),
        ("sin[30]", 0.5),
        ("cos[#1*60]", 0.5),
        ("tan[45]", 1.0),
        ("asin[1]", 90.0),
        ("acos[-1]", 180.0),
        ("atan[1]/[1]", 45.0),
        ("atan[1]/[-1]", 135.0),
        ("atan[-#1]/[-#1]", -135.0),
        ("ln[exp[2]]", 2.0),
        ("sqrt[#4*4]", 4.0),
        ("abs[-#3]", 3.0),
        ("sqrt[abs[sin[#1*0]-16]]", 4.0),
        ("[#2**-1]", 0.5),
        ("[4**0.5]", 2.0),
    ] {
        gives(expression, value);
    }
}

#[test]
fn what_has_no_value_is_refused() {
    for (expression, kind) in [
        ("[1/0]", "divide_by_zero"),
        ("[#1/#30]", "divide_by_zero"),
        ("[#1 mod 0]", "divide_by_zero"),
        ("[0**-1]", "divide_by_zero"),
        ("sqrt[-1]", "out_of_domain"),
        ("sqrt[-#1]", "out_of_domain"),
        ("asin[1.1]", "out_of_domain"),
        ("acos[#2]", "out_of_domain"),
        ("ln[0]", "out_of_domain"),
        ("ln[-#1]", "out_of_domain"),
        ("[-1**0.5]", "out_of_domain"),
        ("exp[10000]", "out_of_domain"),
        ("[1", "bad_expression"),
        ("[1 #2]", "bad_expression"),
        ("[1+]", "bad_number"),
        ("[]", "bad_number"),
        ("[1 foo 2]", "bad_expression"),
        ("[1+2]]", "bad_character"),
        ("sin30", "bad_expression"),
        ("sinh[1]", "bad_expression"),
        ("atan[1]", "bad_expression"),
        ("atan[1]*[2]", "bad_expression"),
        ("[1 === 2]", "bad_expression"),
        ("[not 1]", "bad_expression"),
        ("exists[5]", "bad_expression"),
        ("exists[#5]", "bad_expression"),
        ("exists[#<a>+1]", "bad_expression"),
        ("exists #<a>", "bad_expression"),
    ] {
        refused(expression, kind);
    }
}

#[test]
fn an_error_waits_for_its_block() {
    check("o1 if [0]\n#31=[1/0]\n#31=]]\no1 endif\nm2\n", "accepted");
    check("o1 sub\n#31=[1/0]\no1 endsub\nm2\n", "accepted");
    check("o1 sub\n#31=[1/0]\no1 endsub\no1 call\nm2\n", "refused at 2 divide_by_zero");
    check(
        "o1 repeat [2]\n#31=[#31+1]\no1 if [#31 eq 2]\ng0 x..\no1 endif\no1 endrepeat\nm2\n",
        "refused at 3",
    );
    check(
        "o1 repeat [2]\n#31=[#31+1]\no2 if [#31 eq 2]\ng0 x..\no2 endif\no1 endrepeat\nm2\n",
        "refused at 4; #31 = 2",
    );
}

#[test]
fn brackets_are_bounded() {
    let nested = |depth: usize| format!("#31={}1{}\nm2\n", "[".repeat(depth), "]".repeat(depth));
    check(&nested(64), "accepted; #31 = 1");
    check(&nested(65), "beyond");
    check(&format!("#31={}5\nm2\n", "#".repeat(64)), "refused at 1");
    check(&format!("#31={}5\nm2\n", "#".repeat(80)), "beyond");
}

#[test]
fn words_take_any_value() {
    check_all(&[
        (
            "#2=3\ng0 x#2 y[#2*2] z-#2 a sin[90] b-2\nm2\n",
            "at 2 straight_traverse end=(x3 y6 z-3 a1 b-2)",
        ),
        ("g[0] x##1\nm2\n", "refused at 1 parameter_out_of_range"),
    ]);
    let case = Case { options: [("expressions.unary-minus", "refused")].into(), ..Case::default() };
    case.check("#31=-#1\nm2\n", "refused at 1");
    case.check("#31=[1--1]\nm2\n", "#31 = 2");
}

/// However halves are rounded; which zero it is ATAN tells.
#[test]
fn round_up_to_zero_gives_negative_zero() {
    for option in ["away", "up", "even"] {
        let options =
            [("expressions.negative-zero", "kept"), ("expressions.round-half", option)].into();
        let case = Case { options, ..Case::default() };
        case.check("#31=atan[0]/[round[-0.25]]\nm2\n", "#31 = 180");
    }
}
