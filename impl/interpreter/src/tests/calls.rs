//! Subs, calls, files, values (11.7.4, 11.7.9, 11.7.10).

use alloc::format;
use alloc::string::String;

use super::{Case, check, check_all};
use crate::Limits;

#[test]
fn percent_line_begins_a_file_only_on_its_first_line() {
    for (head, block_delete) in [("(c)\n", false), ("/\n", false), ("/g0\n", true)] {
        let text = format!("{head}%\n%\no<x> sub\n#31=1\no<x> endsub\n");
        let files = [("x.ngc", text.as_str())].into();
        let case = Case { files, block_delete, ..Case::default() };
        case.check("o<x> call\nm2\n", "accepted; #31 = 1");
    }
    let files = [("x.ngc", "\n  \n%\n%\no<x> sub\no<x> endsub\n")].into();
    let begun = Case { files, ..Case::default() };
    begun.check("o<x> call\nm2\n", "refused at 1 unknown_sub");
}

#[test]
fn a_body_runs_when_it_is_called() {
    check_all(&[
        ("o1 sub\n#31=[#31+1]\no1 endsub\nm2\n", "#31 = 0"),
        ("o1 sub\n#31=[#31+1]\no1 endsub\no1 call\no1 call\nm2\n", "#31 = 2"),
        ("o<Ab C> sub\n#31=#1\no<abc> endsub\no<ABC> call [7]\nm2\n", "#31 = 7"),
        ("o1 sub\n#31=5\no[0+1] endsub\no[2-1] call\nm2\n", "#31 = 5"),
        ("o1 sub\no2 call\no1 endsub\no2 sub\n#31=1\no2 endsub\no1 call\nm2\n", "#31 = 1"),
        (
            "o1 sub\n#31=[#31+#1]\no2 if [#1 gt 1]\no1 call [#1-1]\no2 endif\no1 endsub\no1 call [4]\nm2\n",
            "#31 = 10",
        ),
        (
            "o1 sub\no2 while [1]\n#31=[#31+1]\no1 return\no2 endwhile\no1 endsub\no1 call\no1 call\nm2\n",
            "#31 = 2",
        ),
        (
            "o1 sub\n#32=[#32+1]\no2 repeat [2]\n#31=[#31+1]\no3 if [#1]\no1 call [0]\no3 endif\no2 endrepeat\no1 endsub\no1 call [1]\nm2\n",
            "#31 = 6; #32 = 3",
        ),
        (
            "o9 repeat [2]\no1 sub\n#31=[#31+1]\no1 endsub\no1 call\no9 endrepeat\no1 call\nm2\n",
            "#31 = 3",
        ),
        ("o1 sub\nm2\no1 endsub\no1 call\n[\n", "accepted"),
        ("o0007 sub\n#31=1\no7 endsub\no07 call\nm2\n", "#31 = 1"),
    ]);
}

#[test]
fn arguments_are_the_subs_own() {
    check_all(&[
        (
            "o1 sub\n#31=#1 #32=#2 #33=#3\n#1=9 #3=9\no1 endsub\n#1=1 #2=2 #3=3\no1 call [10] [20]\n#34=#1 #35=#3\nm2\n",
            "#31 = 10; #32 = 20; #33 = 3; #34 = 1; #35 = 3",
        ),
        ("o1 sub\n#40=9\no1 endsub\no1 call\nm2\n", "#40 = 9"),
        ("o1 sub\n#31=#1\no1 endsub\n#1=4\no1 call [#1*2]\nm2\n", "#31 = 8; #1 = 4"),
    ]);
    let call =
        |count: usize| format!("o1 sub\n#31=#30\no1 endsub\no1 call {}\nm2\n", "[7]".repeat(count));
    check(&call(30), "#31 = 7");
    check(&call(31), "refused at 4 too_many_arguments");
}

#[test]
fn values_are_returned() {
    check_all(&[
        (
            "o1 sub\no1 endsub [3*4]\no1 call\n#31=#<_value> #32=#<_value_returned>\nm2\n",
            "#31 = 12; #32 = 1",
        ),
        ("o1 sub\no1 return [#1]\no1 endsub\no1 call [5]\n#31=#<_value>\nm2\n", "#31 = 5"),
        (
            "o1 sub\no1 endsub\no2 sub\no2 endsub [5]\no2 call\no1 call\n#31=#<_value> #32=#<_value_returned>\nm2\n",
            "#31 = 0; #32 = 0",
        ),
        (
            "o1 sub\n#33=#<_value>\no1 endsub\no2 sub\no2 endsub [5]\no2 call\no1 call\nm2\n",
            "#33 = 0",
        ),
        ("o1 sub\no1 endsub [1/0]\no1 call\nm2\n", "refused at 2 divide_by_zero"),
        ("o1 sub\no1 endsub [1] [2]\no1 call\nm2\n", "refused at 2 bad_block"),
    ]);
}

#[test]
fn unknown_sub_is_refused() {
    check_all(&[
        ("o1 call\no1 sub\no1 endsub\nm2\n", "refused at 1 unknown_sub"),
        ("o<a> call\nm2\n", "refused at 1 unknown_sub"),
        ("o<a/b> call\nm2\n", "refused at 1 unknown_sub"),
        ("o1 return\nm2\n", "refused at 1 outside_sub"),
        ("o1 endsub\nm2\n", "refused at 1 outside_sub"),
        ("o1 sub\no2 sub\no2 endsub\no1 endsub\nm2\n", "refused at 2 nested_sub"),
        (
            "o9 repeat [1]\no1 sub\no2 sub\no2 endsub\no1 endsub\no9 endrepeat\nm2\n",
            "refused at 3 nested_sub",
        ),
        ("o1 sub\no1 endsub\no1 sub\no1 endsub\nm2\n", "refused at 3 duplicate_sub"),
        ("o1 sub\n#31=1\nm2\n", "refused at 1"),
        ("o1 sub\no2 endsub\no1 endsub\no1 call\nm2\n", "refused at 2 unknown_label"),
        (
            "o1 sub\no2 endif\no1 endsub\no2 if [1]\no1 call\no2 endif\nm2\n",
            "refused at 2 unknown_label",
        ),
        ("o1 sub\no2 if [0]\no1 endsub\no1 call\nm2\n", "refused at 2 unknown_label"),
        ("o1 sub x1\no1 endsub\nm2\n", "refused at 1 bad_block"),
        ("o1 call x1\nm2\n", "refused at 1 bad_block"),
        ("o1 call 5\nm2\n", "refused at 1 bad_block"),
        ("o call\nm2\n", "refused at 1 bad_block"),
        ("o foo[1] call\nm2\n", "refused at 1 bad_block"),
        // Only letters of ASCII are capital or not.
        ("o<\u{c9}> sub\no<\u{c9}> endsub\no<\u{e9}> call\nm2\n", "refused at 3 unknown_sub"),
    ]);
}

#[test]
fn levels_are_counted() {
    let program = |depth: u32| {
        format!(
            "o1 sub\n#31=[#31+1]\no2 if [#1 gt 1]\no1 call [#1-1]\no2 endif\no1 endsub\no1 call [{depth}]\nm2\n"
        )
    };
    check(&program(10), "accepted; #31 = 10");
    check(&program(11), "refused at 4 too_many_levels");
    let limits = Limits { call_depth: 2, ..Limits::default() };
    let case = Case { limits, ..Case::default() };
    case.check(&program(2), "accepted");
    case.check(&program(3), "refused at 4 too_many_levels");
}

#[test]
fn files_hold_one_sub() {
    let case =
        |text| Case { files: [("mine.ngc", text), ("7.ngc", text)].into(), ..Case::default() };
    case("(c)\no<mine> sub\n#31=[#31+#1]\no<mine> endsub\nm2\n")
        .check("o<Mine> call [2]\no<mine> call [3]\nm2\n", "#31 = 5");
    case("o7 sub\n#31=1\no7 endsub\n").check("o7 call\nm2\n", "#31 = 1");
    case("o<other> sub\no<other> endsub\nm2\n").check("o<mine> call\nm2\n", "refused at 1");
    case("#31=1\nm2\n").check("o<mine> call\nm2\n", "refused at 1 unknown_sub; #31 = 0");
    case("o<mine> sub\no<mine> endsub\no<two> sub\no<two> endsub\nm2\n")
        .check("o<mine> call\nm2\n", "refused at 1");
    case("o<mine> sub\n\n[\no<mine> endsub\nm2\n")
        .check("o<mine> call\nm2\n", "refused at mine.ngc:3");
    case("o<mine> sub\no<x> sub\no<mine> endsub\nm2\n")
        .check("o<mine> call\nm2\n", "refused at mine.ngc:2 nested_sub");
    case("%\no<mine> sub\n#31=#<_line>\no<mine> endsub\n%\n")
        .check("\n\no<mine> call\n#32=#<_line>\nm2\n", "#31 = 3; #32 = 4");
    // The main program's own sub comes first.
    case("o<mine> sub\n#31=1\no<mine> endsub\nm2\n")
        .check("o<mine> sub\n#31=2\no<mine> endsub\no<mine> call\nm2\n", "#31 = 2");
}

#[test]
fn memory_is_bounded() {
    let limits = Limits { code_bytes: 20_000, ..Limits::default() };
    let case = Case { limits, ..Case::default() };
    let body = "#31=[#31+#32*2]\n".repeat(400);
    case.check(&format!("o1 repeat [2]\n{body}o1 endrepeat\nm2\n"), "beyond");
    case.check(&format!("o1 sub\n{body}o1 endsub\nm2\n"), "beyond");
    let ifs: String = (0..1000).map(|n| format!("o{n} if [1]\no{n} endif\n")).collect();
    case.check(&format!("{ifs}m2\n"), "beyond");
    check(&format!("{ifs}m2\n"), "accepted");
    case.check(&format!("{body}{body}o1 if [0]\n{body}o1 endif\nm2\n"), "accepted");
}

#[test]
fn blocks_are_reported_when_done() {
    let case =
        Case { files: [("f.ngc", "o<f> sub\n#31=1\no<f> endsub\n")].into(), ..Case::default() };
    let outcome = case.run(b"\n(c)\n(msg,c)\nn3 (c)\no<f> call\nm2\n");
    let done: alloc::vec::Vec<_> =
        outcome.recorder.done.iter().map(|(file, line)| format!("{file}:{line}")).collect();
    let expected = ["main.ngc:3", "main.ngc:4", "main.ngc:5", "f.ngc:2", "f.ngc:3", "main.ngc:6"];
    assert_eq!(done, expected);
}

#[test]
fn an_end_within_a_sub_leaves_it() {
    check_all(&[
        (
            "#1=3\no1 sub\n#2=5 #<x>=6\nm2\no1 endsub\no1 call [7]\n",
            "accepted; #1 = 3; #2 = 0; no #<x>",
        ),
        ("#<x>=4\no1 sub\n#<x>=6\nm30\no1 endsub\no1 call [7]\n", "accepted; #<x> = 4"),
        ("#1=3\nm98 p1\nm2\no1\n#1=5\nm2\n", "accepted; #1 = 5"),
    ]);
}

#[test]
fn sub_of_a_file_runs_up_to_the_end_of_the_file() {
    let case = Case { files: [("f.ngc", "o<f> sub\n#31=1\n")].into(), ..Case::default() };
    case.check("o<f> call\nm2\n", "refused missing_end; #31 = 1");
}

#[test]
fn percent_line_in_a_sub_is_refused_when_reached() {
    check_all(&[
        ("o1 sub\n%\no1 endsub\no1 call\nm2\n", "refused at 2 bad_character"),
        ("o1 sub\n%\no1 endsub\nm2\n", "accepted"),
    ]);
}
