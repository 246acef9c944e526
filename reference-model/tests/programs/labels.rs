//! Conditions, loops, and the labels that they carry.

use super::{ending, gives, outcome, outcome_under, parameter, refuses};

#[test]
fn the_first_true_branch_counts() {
    let program = |value: u32| {
        format!(
            "#1 = {value}\no1 if [#1 eq 1]\n#31 = 1\no1 elseif [#1 eq 2]\n#31 = 2\no1 elseif [#1 le 3]\n#31 = 3\no1 else\n#31 = 4\no1 endif\nm2\n"
        )
    };
    for value in 1..=4 {
        gives(&program(value), &[(31, f64::from(value))]);
    }
}

#[test]
fn a_condition_after_the_true_one_is_not_evaluated() {
    let program = "o1 if [1]\n#31 = 1\no1 elseif [1 / 0]\no1 endif\nm2\n";
    gives(program, &[(31, 1.0)]);
    let observed = outcome_under(&[("rs274.later-conditions-evaluated", "observed")], program);
    assert_eq!(ending(&observed), "divide_by_zero at main.ngc:3");
}

#[test]
fn loops_run_and_are_left() {
    gives("o1 while [#31 lt 4]\n#31 = [#31 + 1]\no1 endwhile\nm2\n", &[(31, 4.0)]);
    gives("o1 do\n#31 = [#31 + 1]\no1 while [#31 lt 3]\nm2\n", &[(31, 3.0)]);
    gives(
        "o1 repeat [3]\no2 repeat [2]\n#31 = [#31 + 1]\no2 endrepeat\no1 endrepeat\nm2\n",
        &[(31, 6.0)],
    );
    gives(
        "o1 while [1]\no2 repeat [5]\n#31 = [#31 + 1]\no1 break\no2 endrepeat\no1 endwhile\nm2\n",
        &[(31, 1.0)],
    );
    gives(
        "o1 do\n#31 = [#31 + 1]\no2 if [#31 lt 3]\no1 continue\no2 endif\n#32 = 1\no1 while [#31 lt 3]\nm2\n",
        &[(31, 3.0), (32, 1.0)],
    );
}

#[test]
fn a_return_leaves_loops_which_work_again() {
    let program = "o1 sub\no2 repeat [3]\n#31 = [#31 + 1]\no3 if [#1 eq 1]\no1 return\no3 endif\no2 endrepeat\no1 endsub\no1 call [1]\no1 call [2]\nm2\n";
    gives(program, &[(31, 4.0)]);
    let shared = outcome_under(&[("rs274.repeat-counter-shared", "observed")], program);
    assert!((parameter(&shared, 31) - 3.0).abs() < 1e-9);
}

#[test]
fn a_label_is_defined_once_in_its_sub() {
    refuses(
        "o1 if [1]\no1 endif\no1 repeat [1]\no1 endrepeat\nm2\n",
        "duplicate_label at main.ngc:3",
    );
    refuses("o1 if [1]\no1 if [1]\no1 endif\no1 endif\nm2\n", "duplicate_label at main.ngc:2");
    refuses(
        "o1 sub\no1 if [1]\no1 endif\no1 endsub\no1 call\nm2\n",
        "duplicate_label at main.ngc:2",
    );
    gives(
        "o1 sub\no9 if [1]\n#31 = 1\no9 endif\no1 endsub\no9 while [#32 lt 2]\n#32 = [#32 + 1]\no1 call\no9 endwhile\nm2\n",
        &[(31, 1.0), (32, 2.0)],
    );
}

#[test]
fn a_skip_passes_over_subs_inside_it() {
    gives(
        "o9 if [0]\no1 sub\no9 else\n#31 = 1\no1 endsub\no9 endif\n#32 = 1\nm2\n",
        &[(31, 0.0), (32, 1.0)],
    );
}

#[test]
fn labels_point_to_open_structures_of_their_kind() {
    for (program, line) in [
        ("o1 break\nm2\n", 1),
        ("o1 repeat [1]\no1 continue\no1 endrepeat\nm2\n", 2),
        ("o1 else\no1 endif\nm2\n", 1),
        ("o1 while [1]\no1 endif\nm2\n", 2),
        ("o1 if [1]\no1 endif\no1 endif\nm2\n", 3),
        ("o1 repeat [2]\no1 endwhile\nm2\n", 2),
    ] {
        refuses(program, &format!("unknown_label at main.ngc:{line}"));
    }
    refuses("o1 if [0]\nm2\n", "missing_end at main.ngc:1");
}

#[test]
fn computed_labels_are_followed() {
    gives("#1 = 7\no[#1] while [#31 lt 3]\n#31 = [#31 + 1]\no7 endwhile\nm2\n", &[(31, 3.0)]);
    gives("#1 = 7\no7 if [0]\n#31 = 1\no#1 else\n#31 = 2\no[#1] endif\nm2\n", &[(31, 2.0)]);
}

#[test]
fn overlapping_structures_are_not_specified() {
    let overlap = outcome("o1 while [1]\no2 if [1]\no2 do\nm2\n");
    assert_eq!(ending(&overlap), "unspecified at main.ngc:3");
    let crossed = outcome("o1 if [1]\no2 if [1]\no1 endif\no2 endif\nm2\n");
    assert_eq!(ending(&crossed), "unspecified at main.ngc:3");
    // The skipped condition leads out of the loop in which it begins.
    let behind = outcome("o1 while [1]\no2 if [0]\no1 endwhile\no2 endif\no1 break\nm2\n");
    assert_eq!(ending(&behind), "unspecified at main.ngc:5");
}

#[test]
fn which_while_ends_which_do_is_not_specified_where_both_have_one_label() {
    let nested = "o#31 do\no#31 do\no#31 while [0]\no#31 while [0]\nm2\n";
    let each = outcome_under(&[("control.do-label", "each")], nested);
    assert_eq!(ending(&each), "unspecified at main.ngc:2");
    let refused = outcome_under(&[("control.do-label", "refused")], nested);
    assert_eq!(ending(&refused), "duplicate_label at main.ngc:2");
}

#[test]
fn a_condition_that_goes_on_behind_a_numbered_program_is_left_open_by_a_computed_label_too() {
    for label in ["o0", "o#101"] {
        let program = format!("{label} if [0]\no100\n{label} elseif [1]\nm2\n");
        assert_eq!(ending(&outcome(&program)), "unspecified at main.ngc:1");
    }
}

/// The number of a sub may have to be computed: what stands up to its own end belongs to it, and not what stands up
/// to any end.
#[test]
fn a_sub_with_a_computed_number_holds_what_stands_before_its_own_end() {
    let program = "#1 = 9\no#1 sub\no6 endsub\no3 repeat [2]\no3 endrepeat\no9 endsub\no3 repeat [2]\n#31 = [#31 + 1]\no3 endrepeat\nm2\n";
    for option in ["counts", "does-not-count"] {
        let found = outcome_under(&[("control.skipped-definition", option)], program);
        assert_eq!(parameter(&found, 31).to_string(), "2", "{option}");
    }
}

#[test]
fn the_number_of_a_program_may_have_as_many_digits_as_a_number() {
    for number in ["18446744073709551616", "99999999999999999999", "9000000000000001"] {
        gives(&format!("m98 p{number}\nm2\no{number}\n#31 = 1\nm99\n"), &[(31, 1.0)]);
        refuses(&format!("m98 p{number}\nm2\no7\nm99\n"), "unknown_sub at main.ngc:1");
    }
}
