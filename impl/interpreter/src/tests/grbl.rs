//! Choices that Grbl 1.1h decides differently from LinuxCNC, as far as they concern text.

use alloc::format;

use gaugeblock_vocabulary::{Machine, Options};

use super::{Case, check};
use crate::{Error, Interpreter, Limits};

/// Checks programs under options.
#[track_caller]
fn check_under(options: &[(&str, &str)], table: &[(&str, &str)]) {
    let case = Case { options: options.into(), ..Case::default() };
    for (program, expectations) in table {
        case.check(program, expectations);
    }
}

const TO_LINE_END: (&str, &str) = ("text.comment-to-line-end", "to-line-end");
const REMOVED: (&str, &str) = ("text.comments-removed", "removed");

#[test]
fn comment_ends_with_its_line_by_choice() {
    check("g0 x1 (to the right\nm2\n", "refused at 1 bad_comment");
    check_under(
        &[TO_LINE_END],
        &[
            ("g0 x1 (to the right\nm2\n", "at 1 straight_traverse end=(x1); accepted"),
            ("g0 x1 (y2\nz3\nm2\n", "at 2 straight_traverse end=(x1 z3)"),
            ("g0 (a (b;c) x1\nm2\n", "at 1 straight_traverse end=(x1)"),
            ("g0 x1 (a (b;c\nm2\n", "at 1 straight_traverse end=(x1)"),
            ("(only this\nm2\n", "accepted"),
            ("g0 x1 (a) (b\nm2\n", "at 1 straight_traverse end=(x1)"),
            ("g0 x1 y2)\nm2\n", "refused at 1"),
            ("g0 x1 (a))\nm2\n", "refused at 1"),
            ("g0 x(far\nm2\n", "refused at 1"),
            ("(msg,hello\nm2\n", "messages: hello"),
            ("o1 if [1] (a\n#31=1\no1 endif (b\nm2 (c", "#31 = 1; accepted"),
        ],
    );
}

#[test]
fn comments_are_blanks_by_choice() {
    check("g0 x(far)1\nm2\n", "refused at 1");
    check_under(
        &[REMOVED],
        &[
            ("g0 x(far)1\nm2\n", "at 1 straight_traverse end=(x1)"),
            ("g(rapid)0 x2\nm(end)2\n", "at 1 straight_traverse end=(x2); accepted"),
            ("g0 x1(a)2\nm2\n", "at 1 straight_traverse end=(x12)"),
            ("g0 x-(a)1(b).5 y2 ;x3 (c\nm2\n", "at 1 straight_traverse end=(x-1.5 y2)"),
            ("g0 (far)x1\nm2\n", "at 1 straight_traverse end=(x1)"),
            ("#3(a)1=[1(b)+(c)2]\nm2\n", "#31 = 3"),
            ("#<a(b)c>=5\n#31=#<ac>\nm2\n", "#31 = 5"),
            ("n(a)5 g0 x1\n(a)n6 y2\nm2\n", "at 2 straight_traverse end=(x1 y2)"),
            ("o(a)1 if [0] (b)\n#31=1\no1 e(c)ndif\nm2\n", "#31 = 0; accepted"),
            ("g0 x(a)1 (msg,hi)\nm2\n", "messages: hi"),
            ("(msg,hi)\nm2\n", "messages: hi"),
            ("(msg,hi) g0 x(a)1\nm2\n", "messages: none"),
            ("(a) ; b\nm2\n", "accepted"),
        ],
    );
}

#[test]
fn invalid_comments_are_refused_where_comments_are_blanks() {
    check_under(
        &[REMOVED],
        &[
            ("g0 x1 (a\nm2\n", "refused at 1 bad_comment"),
            ("g0 x(1\nm2\n", "refused at 1"),
            ("g0 x1 (a(b) y2\nm2\n", "refused at 1 bad_comment"),
            ("g0 x1 a)\nm2\n", "refused at 1"),
            ("g0 x(a)\nm2\n", "refused at 1"),
            ("g0 x(a)1 x2\nm2\n", "refused at 1 repeated_word"),
        ],
    );
    check_under(
        &[REMOVED, TO_LINE_END],
        &[
            ("g0 x(a(b)1 (y2\nm2\n", "at 1 straight_traverse end=(x1)"),
            ("g0 x1(a)2(b\nm2\n", "at 1 straight_traverse end=(x12)"),
        ],
    );
}

#[test]
fn removed_comments_count_to_the_length_of_a_line() {
    let case = Case { options: [REMOVED].into(), ..Case::default() };
    let line = |characters: usize| format!("m({})2\n", "\u{e9}".repeat(characters));
    case.check(&line(251), "accepted");
    case.check(&line(252), "refused at 1 line_too_long");
    let case = Case { block_delete: true, options: [REMOVED].into(), ..Case::default() };
    case.check("(a)/g0 x1\n/(a) g0 x2\nm2\n", "count straight_traverse = 0; accepted");
}

#[test]
fn line_number_has_seven_digits_by_choice() {
    for number in ["10000000", "4294967297", "99999999999999999999"] {
        let program = format!("g4 p1\nn{number} g0 x1\nm2\n");
        check(&program, "at 2 straight_traverse end=(x1)");
        check_under(
            &[("text.greatest-line-number", "seven-digits")],
            &[(&program, "refused at 2 word_out_of_range")],
        );
    }
    check_under(
        &[("text.greatest-line-number", "seven-digits")],
        &[
            ("n9999999 g0 x1\nm2\n", "at 1 straight_traverse end=(x1)"),
            ("n00000000012 g0 x1\nm2\n", "at 1 straight_traverse end=(x1)"),
            ("n999 9999 g0 x1\nm2\n", "at 1 straight_traverse end=(x1)"),
            ("n1000 0000 g0 x1\nm2\n", "refused at 1"),
        ],
    );
}

#[test]
fn decimals_of_codes_are_hundredths_by_choice() {
    check("g90\ng91.001\nm2\n", "refused at 2 unknown_code");
    let accepted = [
        ("g91.001 g0 x1\nx1\nm2\n", "at 2 straight_traverse end=(x2)"),
        ("#1=0.004\ng[91+#1] g0 x1\nx1\nm[2+#1]\n", "at 3 straight_traverse end=(x2); accepted"),
        ("g0.0 x1\nm2.0\n", "accepted"),
        ("m8.001\ng18.004\ng0.002 x1\nm2.004\n", "at 3 straight_traverse end=(x1); accepted"),
        ("g28.1\ng30.10\ng43.1 z1\ng92.1\ng91.1\ng91.104\ng92.096\nm2\n", "accepted"),
        ("g38.3 x1 f1\ng38.304 x2\ng38.497 y2\nm2\n", "count straight_probe = 3"),
    ];
    check_under(&[("modal-groups.code-decimals", "hundredths")], &accepted);
    for code in [
        "g0.5 x1",
        "g0.006 x1",
        "g18.05",
        "g38 x1",
        "g91.3",
        "g59.1",
        "g90.1",
        "g61.1",
        "g43.2 z1",
        "g92.2",
        "g-1",
        "g100",
        "m8.5",
        "m3.2",
        "m8.006",
        "m-1",
        "m65538",
        "g[18+0.05]",
        "m[8.5]",
    ] {
        let program = format!("f1\n{code}\nm2\n");
        check_under(
            &[("modal-groups.code-decimals", "hundredths")],
            &[(&program, "refused at 2 unknown_code")],
        );
    }
}

#[test]
fn block_without_words_has_no_feed_rate_under_inverse_time() {
    let options = [("feed.after-inverse-time", "zero")];
    for (line, feed) in [
        ("n5", 0.0),
        ("n5.5", 0.0),
        ("#31=1", 0.0),
        ("#31=1 (msg,a)", 0.0),
        ("(a)", 2.0),
        ("(msg,a)", 2.0),
        ("", 2.0),
    ] {
        let program = format!("g93 g1 x1 f2\n{line}\n");
        let case = Case { options: options.into(), ..Case::default() };
        let outcome = case.run(program.as_bytes());
        assert_eq!(outcome.settings.feed_rate, Some(feed), "{line}");
        assert_eq!(Case::default().run(program.as_bytes()).settings.feed_rate, Some(2.0), "{line}");
    }
}

#[test]
fn unknown_options_are_refused() {
    for id in [
        "modal-groups.code-decimals",
        "text.comment-to-line-end",
        "text.comments-removed",
        "text.greatest-line-number",
    ] {
        let options = Options([(id.into(), "observed".into())].into());
        let made = Interpreter::new(Machine::default(), options, Limits::default());
        assert!(matches!(made, Err(Error::Configuration(_))), "{id}");
    }
}
