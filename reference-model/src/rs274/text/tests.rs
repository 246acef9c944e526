//! Tests the division of a file into lines: line ends, percent lines, block delete.

use super::*;

fn source(text: &str, options: &[(&str, &str)]) -> (Source, State) {
    let state = State::under(options);
    (Source::new("main.ngc", text, &state.choices), state)
}

/// The kinds of a file's lines, from its first useful one.
fn check(text: &str, options: &[(&str, &str)], expect: &[Line<'_>]) {
    let (source, mut state) = source(text, options);
    let lines: Vec<Line<'_>> =
        (source.first..).map_while(|index| source.line(index, false, &mut state)).collect();
    assert_eq!(lines, expect, "{text:?}");
}

fn block(text: &str) -> Line<'_> {
    Line::Block(text)
}

#[test]
fn lines_end_with_either_character_or_both() {
    check("a\nb\rc\r\nd", &[], &[block("a"), block("b"), block("c"), block("d")]);
    check("a\rb\r\n", &[("rs274.lone-return", "observed")], &[block("a\rb")]);
    check("", &[], &[]);
    check("\n \t\n", &[], &[Line::Nothing, Line::Nothing]);
}

#[test]
fn percent_lines_enclose_a_program() {
    check(" \n % \na\n%\n!", &[], &[block("a"), Line::End, block("!")]);
    check("% a\n%", &[], &[block("% a"), block("%")]);
    check("a\n%", &[("text.percent-alone", "ends")], &[block("a"), Line::End]);
    check("a\n%", &[("text.percent-alone", "ignored")], &[block("a"), Line::Nothing]);
}

#[test]
fn a_second_percent_line_is_missed_where_that_is_chosen() {
    let refused = [("text.percent-unclosed-ended", "refused")];
    for (text, options, ends) in [
        ("%\nm2", &[][..], true),
        ("%\nm2", &refused, false),
        ("%\nm2\n%", &refused, true),
        ("m2", &refused, true),
    ] {
        let (source, mut state) = source(text, options);
        assert_eq!(source.program_ends(&mut state).is_ok(), ends, "{text:?}");
    }
}

#[test]
fn block_delete_skips_lines_unread() {
    let (source, mut state) = source(" \t/g0 !!\na", &[]);
    assert_eq!(source.line(0, true, &mut state), Some(Line::Skipped(" \t/g0 !!")));
    assert_eq!(source.line(0, false, &mut state), Some(block(" \t/g0 !!")));
    assert_eq!(source.line(1, true, &mut state), Some(block("a")));
    assert_eq!(source.line(2, true, &mut state), None);
}
