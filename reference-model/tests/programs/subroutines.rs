//! Calls, frames, files, numbered programs.

use gaugeblock_reference::run;
use gaugeblock_vocabulary::Scenario;

use super::{ending, gives, outcome, outcome_under, parameter, refuses};

#[test]
fn a_body_runs_when_it_is_called() {
    gives(
        "o1 sub\n#31 = [#31 * 10 + #1]\no1 endsub\no1 call [1]\no1 call [2]\nm2\n",
        &[(31, 12.0)],
    );
}

#[test]
fn what_is_never_reached_is_never_refused() {
    gives(
        "o1 sub\nthis is no block\no1 endsub\no2 if [0]\nneither ! this\no2 endif\n#31 = 1\nm2\n",
        &[(31, 1.0)],
    );
}

#[test]
fn frames_keep_thirty_parameters() {
    let program = "o1 sub\n#32 = #2\n#2 = 9\n#30 = 9\n#31 = 9\no1 endsub\n#2 = 5\n#30 = 6\no1 call [1]\n#33 = #2\n#34 = #30\nm2\n";
    gives(program, &[(31, 9.0), (32, 5.0), (33, 5.0), (34, 6.0)]);
    let zero = outcome_under(&[("rs274.unpassed-arguments-zero", "observed")], program);
    assert!(parameter(&zero, 32).abs() < 1e-9);
}

#[test]
fn recursion_carries_values_up() {
    let program = "o1 sub\no2 if [#1 le 1]\no1 return [1]\no2 endif\no1 call [#1 - 1]\no1 endsub [#1 * #<_value>]\no1 call [5]\n#31 = #<_value>\n#32 = #<_value_returned>\nm2\n";
    gives(program, &[(31, 120.0), (32, 1.0)]);
}

#[test]
fn ten_levels_and_no_more() {
    let program = |levels: u32| {
        format!(
            "o1 sub\n#31 = [#31 + 1]\no2 if [#1 gt 1]\no1 call [#1 - 1]\no2 endif\no1 endsub\no1 call [{levels}]\nm2\n"
        )
    };
    gives(&program(10), &[(31, 10.0)]);
    refuses(&program(11), "too_many_levels at main.ngc:4");
    let nine = outcome_under(&[("rs274.nine-levels", "observed")], &program(10));
    assert_eq!(ending(&nine), "too_many_levels at main.ngc:4");
}

#[test]
fn files_are_found_by_name_in_lower_case() {
    let mut scenario = Scenario::of("o<Cave> call [7]\no[100 + 23] call\n#33 = 1\nm2\n");
    let file = "(a file)\no<cave> sub\n#31 = #1\no<CAVE> endsub\nm2\n";
    scenario.program.files.insert("cave.ngc".to_owned(), file.to_owned());
    let numbered = "%\no123 sub\n#32 = 2\no123 endsub\n%\n";
    scenario.program.files.insert("123.ngc".to_owned(), numbered.to_owned());
    let (outcome, _) = run(&scenario);
    assert_eq!(ending(&outcome), "program_end", "{}", outcome.to_text());
    for (number, value) in [(31, 7.0), (32, 2.0), (33, 1.0)] {
        assert!((parameter(&outcome, number) - value).abs() < 1e-9, "#{number}");
    }
    let blocks: Vec<_> = outcome.steps.iter().map(|step| step.block.to_string()).collect();
    assert_eq!(blocks[..3], ["main.ngc:1", "cave.ngc:3", "cave.ngc:4"]);
}

#[test]
fn a_fault_in_a_file_is_there() {
    let mut scenario = Scenario::of("o<cave> call\nm2\n");
    let file = "o<cave> sub\n#31 = [1 / 0]\no<cave> endsub\n";
    scenario.program.files.insert("cave.ngc".to_owned(), file.to_owned());
    assert_eq!(ending(&run(&scenario).0), "divide_by_zero at cave.ngc:2");
}

#[test]
fn definitions_are_unique_closed_and_not_nested() {
    refuses("o1 sub\no1 endsub\no1 sub\no1 endsub\nm2\n", "duplicate_sub at main.ngc:3");
    refuses("o1 sub\no2 sub\no2 endsub\no1 endsub\nm2\n", "nested_sub at main.ngc:2");
    refuses("o1 sub\nm2\n", "missing_end at main.ngc:1");
    refuses("o1 call\nm2\no1 sub\no1 endsub\n", "unknown_sub at main.ngc:1");
    refuses("#31 = 1\no1 endsub\nm2\n", "outside_sub at main.ngc:2");
    refuses("o1 if [1]\no1 return\no1 endif\nm2\n", "outside_sub at main.ngc:2");
}

#[test]
fn a_definition_may_be_reached_again() {
    gives(
        "o9 repeat [2]\no1 sub\n#31 = [#31 + 1]\no1 endsub\no1 call\no9 endrepeat\nm2\n",
        &[(31, 2.0)],
    );
}

#[test]
fn numbered_programs_share_their_caller_s_parameters() {
    let program = "o1\n#1 = 0\n#<width> = 5\nm98 p100 l5\n#33 = #<width>\nm30\no100\n#1 = [#1 + 1]\nm98 p200 l5\n#<width> = [#<width> + 1]\nm99\no200\n#1 = [#1 + 0.01]\n#31 = [#31 + 1]\nm99\n";
    let shared = outcome_under(&[("fanuc-subs.named-locals", "shared")], program);
    for (number, expected) in [(1, 5.25), (31, 25.0), (33, 10.0)] {
        assert!((parameter(&shared, number) - expected).abs() < 1e-9, "#{number}");
    }
    refuses(program, "no_such_parameter at main.ngc:10");
}

#[test]
fn numbered_programs_follow_their_call() {
    refuses("m98 p7\nm2\no100\nm99\n", "unknown_sub at main.ngc:1");
    refuses("m98 p200\nm2\no100\nm99\no200\nm98 p100\nm99\n", "unknown_sub at main.ngc:6");
    refuses("m98\nm2\n", "missing_word at main.ngc:1");
    gives("m98 p100 l0\n#32 = 1\nm2\no100\n#31 = 1\nm99\n", &[(31, 0.0), (32, 1.0)]);
    assert_eq!(ending(&outcome("o1\n#31 = 1\nm99\n")), "endless");
}

#[test]
fn the_two_styles_do_not_mix() {
    for (program, line) in [
        ("o100 call\nm2\no100\nm99\n", 1),
        ("m98 p100\nm2\no100 sub\no100 endsub\n", 1),
        ("o100 sub\nm99\no100 endsub\no100 call\nm2\n", 2),
        ("m98 p100\nm2\no100\no100 endsub\n", 4),
        ("m98 p100\nm2\no100\no100 return\nm99\n", 4),
    ] {
        refuses(program, &format!("mixed_styles at main.ngc:{line}"));
    }
}

#[test]
fn disabled_numbered_programs_are_refused() {
    let mut scenario = Scenario::of("g0 x1\nm98 p100\nm2\no100\nm99\n");
    scenario.machine.fanuc_subs = false;
    assert_eq!(ending(&run(&scenario).0), "fanuc_disabled at main.ngc:2");
}

/// Its number is computed where its sub is defined. For a sub that is skipped, or defined in a loop, nothing says
/// when it is.
#[test]
fn a_computed_endsub_ends_the_sub_whose_label_it_has() {
    let body = "o[#1 + 2] endsub\n#31 = [#31 + 1]\no1 if [1]\no1 endif\no[#1 + 1] endsub\n";
    let behind = "o1 if [1]\no1 endif\n";
    let called = format!("o1 sub\n{body}{behind}m2\n");
    gives(&called, &[]);
    refuses(&called.replace("m2", "o1 call\nm2"), "unknown_label at main.ngc:2");
    refuses(&called.replace("#1 + 1", "#1 + 3"), "missing_end at main.ngc:1");
    refuses("o1 sub\no#0 endsub\no[#1 + 1] endsub\no#-1\n", "parameter_out_of_range at main.ngc:4");
    for around in ["if [0]\n", "while [#33 lt 2]\n#33 = [#33 + 1]\n"] {
        let keyword = around.split(' ').next().unwrap_or_default();
        let program = format!("o9 {around}o1 sub\n{body}o9 end{keyword}\nm2\n");
        let ending = ending(&outcome(&program));
        assert!(ending.starts_with("unspecified"), "{program}{ending}");
    }
    let own = outcome("o7 do\no#2 sub\no0 endsub\no7 while [0]\nm2\n");
    assert_eq!(ending(&own), "unspecified at main.ngc:2");
}

/// What is looked for is looked at for its label and for nothing else; the block is refused where it is come to.
#[test]
fn an_endsub_on_a_line_that_is_too_long_is_found() {
    for character in [" ", "\u{e9}", "\u{fffd}"] {
        let program = format!("o1 sub\n#31 = 1\no1 endsub{}\n", character.repeat(300));
        gives(&format!("{program}m2\n"), &[]);
        refuses(&format!("{program}o1 call\nm2\n"), "line_too_long at main.ngc:3");
    }
}
