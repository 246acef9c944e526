//! Lines, numbers, comments, percent signs (11.4.1, 11.4.2, 11.4.21).

use alloc::format;
use alloc::string::{String, ToString as _};

use super::{Case, check, check_all};

#[test]
fn blanks_and_case_mean_nothing() {
    check_all(&[
        ("g0x +0. 12 34y 7\nm2\n", "at 1 straight_traverse end=(x0.1234 y7)"),
        ("G 0 X\t1 . 5\nM 2\n", "at 1 straight_traverse end=(x1.5)"),
        ("n10 #3 1 = 4\nn20.5 m2\n", "#31 = 4"),
        ("  \n\n#31=1\r\n\rm2\r", "#31 = 1; accepted"),
        ("#31 = [ 1 * * 2 + s q r t [ 4 ] ]\nm2\n", "#31 = 3"),
        ("#31=1 e 5\nm2\n", "refused at 1"),
        ("/#31=1\nm2\n", "#31 = 1"),
        ("m2", "accepted"),
        ("m2\nanything goes [\n", "accepted"),
    ]);
}

#[test]
fn blocks_are_deleted() {
    let case = Case { block_delete: true, ..Case::default() };
    case.check("/#31=1\n / #32=1\n#33=1\nm2\n", "#31 = 0; #32 = 0; #33 = 1");
    case.check("/[\n/o1 sub\nm2\n", "accepted");
    check("//#31=1\nm2\n", "refused at 1 bad_character");
    check("n1/#31=1\nm2\n", "refused at 1 bad_character");
}

#[test]
fn invalid_lines_are_refused() {
    check_all(&[
        ("g0 x1.2.3\nm2\n", "refused at 1 bad_number"),
        ("g0 x.\nm2\n", "refused at 1 bad_number"),
        ("g0 x\nm2\n", "refused at 1 bad_number"),
        ("g0 x--1\nm2\n", "refused at 1 bad_number"),
        ("g0 x-+1\nm2\n", "refused at 1 bad_number"),
        ("#1=--#2\nm2\n", "refused at 1 bad_number"),
        ("12\nm2\n", "refused at 1 bad_block"),
        ("x1 n5\nm2\n", "refused at 1 bad_block"),
        ("x1 o5 call\nm2\n", "refused at 1 bad_block"),
        ("nx\nm2\n", "refused at 1 bad_number"),
        ("n1. x1\nm2\n", "refused at 1 bad_number"),
        ("n-1\nm2\n", "refused at 1 bad_number"),
        ("g0 x1 & y1\nm2\n", "refused at 1 bad_character"),
        ("g0 x1 \u{e9}\nm2\n", "refused at 1 bad_character"),
        ("g0 x1 \0\nm2\n", "refused at 1 bad_character"),
        ("g0 x1 %\nm2\n", "refused at 1 bad_character"),
        ("#31\nm2\n", "refused at 1 bad_block"),
        ("#=3\nm2\n", "refused at 1 bad_expression"),
        ("g0 x1 x2\nm2\n", "refused at 1 repeated_word"),
        ("m3 $0 $0\nm2\n", "refused at 1 repeated_word"),
        ("g-1\nm2\n", "refused at 1 unknown_code"),
        ("g0.05\nm2\n", "refused at 1 unknown_code"),
        ("g100\nm2\n", "refused at 1 unknown_code"),
        ("m-2\nm2\n", "refused at 1 unknown_code"),
        ("m2.5\nm2\n", "refused at 1 unknown_code"),
        ("#1=-1\ng[#1]\nm2\n", "refused at 2 unknown_code"),
    ]);
}

#[test]
fn keyword_beyond_the_longest_line_is_not_found() {
    let far = |keyword: &str| format!("{}{keyword}", " ".repeat(300));
    let near = |keyword: &str| format!("{keyword}{}", " ".repeat(300));
    let skipping = |line: String| format!("o1 if [0]\n{line}\no1 endif\n#31=1\nm2\n");
    check(&skipping(far("o1 endif")), "accepted; #31 = 1");
    check(&skipping(far("/n5 o[2/2] endif")), "accepted; #31 = 1");
    check(&skipping(near("o1 endif")), "refused at 2 line_too_long");
    check(&skipping(near("/n5 o[2/2] endif")), "refused at 2 line_too_long");
    let looping = format!("o1 repeat [2]\n{}\no1 endrepeat\nm2\n", far("o1 endrepeat"));
    check(&looping, "refused at 2 line_too_long");
    let program =
        format!("o1 sub\no2 if [0]\n{}\no2 endif\no1 endsub\no1 call\nm2\n", far("o1 endsub"));
    check(&program, "accepted");
    // A character of several bytes is one.
    let behind = |characters: usize| format!("({})o1 endif", "\u{e9}".repeat(characters));
    check(&skipping(behind(251)), "accepted; #31 = 1");
    check(&format!("o1 if [0]\n{}\n#31=1\nm2\n", behind(245)), "accepted; #31 = 1");
}

#[test]
fn codes_are_close_to_integers() {
    check_all(&[
        ("g1.00000001 f10 x1\nm2\n", "at 1 straight_feed end=(x1)"),
        ("#1=0\ng#1 x1\nm[1+1]\n", "at 2 straight_traverse end=(x1); accepted"),
        ("g[5/10*0] x1\nm2.00005\n", "accepted"),
    ]);
}

#[test]
fn numbers_are_read_exactly() {
    check_all(&[
        ("#31=0.1 #32=007.50 #33=+3. #34=-.5\nm2\n", "#31 = 0.1; #32 = 7.5; #33 = 3; #34 = -0.5"),
        ("#31=123456789.123456789\nm2\n", "#31 = 123456789.123456789"),
        (
            "#31=[0.00000000000000000000000000000001*100000000000000000000000000000000]\nm2\n",
            "#31 = 1",
        ),
        (
            "#31=9007199254740993000000000000000000\n#32=[#31/9007199254740993000000000000000000]\nm2\n",
            "#32 = 1",
        ),
        ("#31=0.10000000000000000000000000\nm2\n", "#31 = 0.1"),
    ]);
}

#[test]
fn numbers_of_every_length_are_read() {
    for whole in 0..18_usize {
        for decimals in 0..18_usize {
            for rest in ["", " ", " y1", "\t#33=1", "(c)", "#33=1 #34=2 #35=3"] {
                let digits = "98765432109876543210";
                let number = format!("{}.{}", &digits[..whole], &digits[2..2 + decimals]);
                if whole + decimals == 0 {
                    continue;
                }
                let outcome =
                    Case::default().run(format!("g0 #31={number}{rest}\nm2\n").as_bytes());
                let wanted: f64 = number.parse().unwrap();
                let found = outcome.parameters.get(&31).copied().unwrap_or(0.0);
                assert_eq!(found.to_bits(), wanted.to_bits(), "{number}{rest}");
            }
        }
    }
}

#[test]
fn a_line_has_at_most_256_characters() {
    let line = |length: usize| format!("#31=1{}\nm2\n", " ".repeat(length - 5));
    check(&line(255), "accepted; #31 = 1");
    check(&line(256), "refused at 1 line_too_long");
    check(&line(3000), "refused at 1 line_too_long");
    let case =
        Case { options: [("text.line-end-counted", "not-counted")].into(), ..Case::default() };
    case.check(&line(256), "accepted");
    case.check(&line(257), "refused at 1 line_too_long");
    // What is not executed is not looked at.
    check(&format!("o1 if [0]\n{}o1 endif\nm2\n", line(300).replace("m2\n", "")), "accepted");
    check(&format!("(a{}\nm2\n", "b".repeat(900)), "refused at 1 line_too_long");
    // Characters are counted, not their bytes, also where the line has no end.
    for character in ["\u{e9}", "\u{fffd}", "\u{1f600}"] {
        check(&format!("m2 ({})", character.repeat(250)), "accepted");
        check(&format!("m2 ({})", character.repeat(251)), "refused at 1 line_too_long");
    }
}

#[test]
fn percent_signs_enclose_a_file() {
    check_all(&[
        ("%\n#31=1\n%\n[[[\n", "ends percent_end; #31 = 1"),
        ("\n  % \n#31=1\n\t%\n", "ends percent_end"),
        ("%\n#31=1\n", "refused missing_end"),
        ("#31=1\n", "refused missing_end"),
        ("", "refused missing_end"),
        ("%\nm2\n", "accepted"),
        ("#31=1\n%\n", "refused at 2 bad_character"),
        ("(a comment)\n%\nm2\n", "refused at 2"),
        ("%\no1 while [1]\no1 if [#1 gt 3]\no1 endif\n%\n", "refused at 3 duplicate_label"),
        ("%\no1 repeat [2]\n#31=[#31+1]\n%\no1 endrepeat\n", "ends percent_end; #31 = 1"),
        ("%\no1 if [0]\n%\no1 endif\n", "refused at 2"),
    ]);
    let case =
        Case { options: [("text.percent-unclosed-ended", "refused")].into(), ..Case::default() };
    case.check("%\nm2\n", "refused missing_end");
    case.check("%\nm2\n[\n%\n", "accepted");
}

#[test]
fn comments_stand_between_words() {
    check_all(&[
        ("g0 (to; the start) x1 (b) y2;c (d\nm2 ; (e\n", "at 1 straight_traverse end=(x1 y2)"),
        ("(a) (b) ; c\nm2\n", "accepted"),
        ("g0 x(a)1\nm2\n", "refused at 1 bad_comment"),
        ("#31=[1 (a) +1]\nm2\n", "refused at 1 bad_expression"),
        ("g0 x1 (a\nm2\n", "refused at 1 bad_comment"),
        ("g0 x1 (a (b)\nm2\n", "refused at 1 bad_comment"),
        ("g0 x1 a)\nm2\n", "refused at 1 bad_number"),
        ("g0 x1 (\u{e4}\u{f6})\nm2\n", "accepted"),
    ]);
}

#[test]
fn fault_reports_its_place() {
    let outcome = Case::default().run(b"g0 x1\n g0  y1..5 \nm2\n");
    let Err(crate::Error::Fault(fault)) = outcome.end else { panic!("accepted") };
    assert_eq!(fault.block.unwrap().to_string(), "main.ngc:2");
    let span = fault.span.unwrap();
    assert_eq!((span.start, span.end), (8, 9));
}
