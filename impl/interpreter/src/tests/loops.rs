//! Conditions and loops (11.7.5 to 11.7.8) and their errors (11.7.11).

use alloc::format;

use super::{Case, check, check_all};

#[test]
fn the_first_true_branch_is_taken() {
    for (value, result) in [("1", "1"), ("2", "2"), ("3", "3"), ("4", "4")] {
        let program = alloc::format!(
            "#1={value}\no1 if [#1 eq 1]\n#31=1\no1 elseif [#1 eq 2]\n#31=2\no1 elseif [#1 eq 3]\n#31=3\no1 else\n#31=4\no1 endif\n#32=9\nm2\n"
        );
        check(&program, &alloc::format!("#31 = {result}; #32 = 9"));
        // The same within a loop, where it is packed.
        let body = program.strip_suffix("m2\n").unwrap();
        check(
            &alloc::format!("o9 repeat [2]\n{body}o9 endrepeat\nm2\n"),
            &alloc::format!("#31 = {result}"),
        );
    }
    check_all(&[
        ("o1 if [1]\no1 elseif [1/0]\no1 endif\nm2\n", "accepted"),
        ("o1 if [0]\no1 elseif [1/0]\no1 endif\nm2\n", "refused at 2 divide_by_zero"),
        ("o1 if [0]\no2 if [1]\no1 endif\nm2\n", "accepted"),
        ("o1 if [0]\no2 else\no1 else\n#31=1\no1 endif\nm2\n", "#31 = 1"),
        ("O101 IF [#31 EQ 0]\n#31=1\nO 1 0 1 ENDIF\nm2\n", "#31 = 1"),
        ("o<a b> if [1]\n#31=1\no<AB> endif\nm2\n", "#31 = 1"),
        ("o1if[-0.5]\n#31=1\no1endif\nm2\n", "#31 = 1"),
    ]);
}

#[test]
fn loops_turn() {
    check_all(&[
        ("o1 while [#31 lt 3]\n#31=[#31+1]\no1 endwhile\n#32=#31\nm2\n", "#31 = 3; #32 = 3"),
        ("o1 while [0]\n#31=1\no1 endwhile\nm2\n", "#31 = 0"),
        ("o1 do\n#31=[#31+1]\no1 while [#31 lt 3]\nm2\n", "#31 = 3"),
        ("o1 do\n#31=[#31+1]\no1 while [0]\nm2\n", "#31 = 1"),
        ("o1 repeat [3]\n#31=[#31+1]\no1 endrepeat\nm2\n", "#31 = 3"),
        ("o1 repeat [0]\n#31=1\no1 endrepeat\nm2\n", "#31 = 0"),
        ("o1 repeat [-2]\n#31=1\no1 endrepeat\nm2\n", "#31 = 0"),
        ("o1 repeat [2]\no2 repeat [3]\n#31=[#31+1]\no2 endrepeat\no1 endrepeat\nm2\n", "#31 = 6"),
        (
            "o1 while [#31 lt 2]\n#32=0\no2 while [#32 lt 2]\n#33=[#33+1]\n#32=[#32+1]\no2 endwhile\n#31=[#31+1]\no1 endwhile\nm2\n",
            "#33 = 4",
        ),
        ("o1 repeat [3]\no2 do\n#31=[#31+1]\no2 while [#31 mod 2]\no1 endrepeat\nm2\n", "#31 = 6"),
        ("o1 while [1]\nm2\no1 endwhile\n", "accepted"),
        ("o1 repeat [2]\n\n/\n#31=[#31+1]\n(c)\no1 endrepeat\nm2\n", "#31 = 2"),
        ("o1 repeat [2]\no1 endrepeat\no2 repeat [2]\n#31=[#31+1]\no2 endrepeat\nm2\n", "#31 = 2"),
    ]);
}

#[test]
fn loops_are_left_and_continued() {
    check_all(&[
        (
            "o1 while [1]\n#31=[#31+1]\no2 if [#31 eq 3]\no1 break\no2 endif\no1 endwhile\n#32=1\nm2\n",
            "#31 = 3; #32 = 1",
        ),
        (
            "o1 while [#31 lt 3]\n#31=[#31+1]\no1 continue\n#32=1\no1 endwhile\nm2\n",
            "#31 = 3; #32 = 0",
        ),
        ("o1 do\n#31=[#31+1]\no1 continue\n#32=1\no1 while [#31 lt 3]\nm2\n", "#31 = 3; #32 = 0"),
        ("o1 do\n#31=[#31+1]\no1 break\no1 while [1]\n#32=1\nm2\n", "#31 = 1; #32 = 1"),
        ("o1 while [1]\no2 while [1]\no1 break\no2 endwhile\no1 endwhile\n#31=1\nm2\n", "#31 = 1"),
        ("o1 repeat [2]\no1 break\no1 endrepeat\nm2\n", "refused at 2 unknown_label"),
        ("o1 repeat [2]\no1 continue\no1 endrepeat\nm2\n", "refused at 2 unknown_label"),
    ]);
}

#[test]
fn labels_are_checked_when_reached() {
    check_all(&[
        ("o1 endif\nm2\n", "refused at 1 unknown_label"),
        ("o1 else\nm2\n", "refused at 1 unknown_label"),
        ("o1 elseif [1]\nm2\n", "refused at 1 unknown_label"),
        ("o1 endwhile\nm2\n", "refused at 1 unknown_label"),
        ("o1 endrepeat\nm2\n", "refused at 1 unknown_label"),
        ("o1 break\nm2\n", "refused at 1 unknown_label"),
        ("o1 continue\nm2\n", "refused at 1 unknown_label"),
        ("o1 if [1]\no1 break\no1 endif\nm2\n", "refused at 2 unknown_label"),
        ("o1 if [1]\no1 endwhile\nm2\n", "refused at 2 unknown_label"),
        ("o1 while [1]\no1 endif\nm2\n", "refused at 2 unknown_label"),
        ("o1 do\no1 endwhile\nm2\n", "refused at 2 unknown_label"),
        ("o1 if [1]\no1 endif\no1 if [1]\no1 endif\nm2\n", "refused at 3 duplicate_label"),
        (
            "o1 while [0]\no1 endwhile\no1 while [0]\no1 endwhile\nm2\n",
            "refused at 3 duplicate_label",
        ),
        (
            "o1 repeat [1]\no1 endrepeat\no1 repeat [1]\no1 endrepeat\nm2\n",
            "refused at 3 duplicate_label",
        ),
        ("o1 if [0]\n#31=1\n", "refused at 1"),
        ("o1 while [0]\n#31=1\nm2\n", "refused at 1"),
        ("o1 while [1]\n#31=1\nm2\n", "accepted; #31 = 1"),
        ("o1 while [1]\n#31=1\no1 break\nm2\n", "refused at 3 unknown_label"),
        ("o1 while [1]\n#31=1\n", "refused missing_end"),
        ("o1\no1 if\nm2\n", "refused at 2 bad_expression"),
        ("o1 if 1\no1 endif\nm2\n", "refused at 1"),
        ("o1 if [1] [2]\no1 endif\nm2\n", "refused at 1 bad_block"),
        ("o1 if [0]\no1 endif x1\nm2\n", "refused at 2 bad_block"),
        ("o1 foo\nm2\n", "refused at 1 bad_block"),
        ("o if [1]\nm2\n", "refused at 1 bad_block"),
        ("o-1 if [1]\no1 endif\nm2\n", "refused at 2 unknown_label"),
        ("o<a>\nm2\n", "refused at 1 bad_block"),
    ]);
}

#[test]
fn labels_can_be_computed() {
    check_all(&[
        ("#1=5\no[#1+1] if [1]\n#31=1\no6 endif\nm2\n", "#31 = 1"),
        ("o6 if [0]\n#31=1\no[5+1] else\n#32=1\no[12/2] endif\nm2\n", "#31 = 0; #32 = 1"),
        (
            "o9 repeat [2]\no6 if [0]\n#31=1\no[5+1] else\n#32=1\no[12/2] endif\no9 endrepeat\nm2\n",
            "#31 = 0; #32 = 1",
        ),
        ("#1=3\no#1 repeat [2]\n#31=[#31+1]\no3 endrepeat\nm2\n", "#31 = 2"),
        ("o[1.5] if [1]\nm2\n", "refused at 1 not_an_integer"),
        ("o[0-1] if [1]\n#31=1\no-1 endif\nm2\n", "#31 = 1"),
        ("o[1/0] if [1]\nm2\n", "refused at 1 divide_by_zero"),
        ("o[1 if [1]\nm2\n", "refused at 1 bad_expression"),
    ]);
}

/// Its blocks are a scope of their own, be its beginning refused or another sub within it.
#[test]
fn skipped_sub_is_skipped_in_loops_and_called_programs() {
    let skipped = [
        "o5 sub !\no1 endwhile\n#31=1\no5 endsub\n",
        "o5 sub\no6 sub\no1 endwhile\n#31=1\no6 endsub\no5 endsub\n",
        "o5 sub\no6 sub\no1 endwhile\n#31=1\no5 endsub\n",
        "o5 sub !\no5 sub !\no1 endwhile\n#31=1\no5 endsub\n",
    ];
    for sub in skipped {
        let condition = format!("o1 while [0]\n{sub}o1 endwhile\n#32=2\n");
        for program in [
            format!("{condition}m2\n"),
            format!("o7 do\n{condition}o7 while [0]\nm2\n"),
            format!("m98 p100\nm2\no100\n{condition}m99\n"),
        ] {
            check(&program, "accepted; #31 = 0; #32 = 2");
        }
    }
}

/// Whether it is defined twice is seen where it is come to, before what is wrong within.
#[test]
fn nested_sub_in_a_loop_is_refused_when_reached() {
    let within = "o5 sub\no6 sub\no5 endsub\n";
    check_all(&[
        (&format!("o7 do\n{within}o7 while [0]\nm2\n"), "refused at 3 nested_sub"),
        (
            &format!("o7 do\no1 if [0]\no5 sub !\no5 endsub\no1 endif\n{within}o7 while [0]\nm2\n"),
            "refused at 7 nested_sub",
        ),
        (
            &format!("o5 sub\no5 endsub\no7 do\n{within}o7 while [0]\nm2\n"),
            "refused at 4 duplicate_sub",
        ),
        (&format!("{within}m2\n"), "refused at 2 nested_sub"),
        ("o5 sub\no6 sub\n", "refused at 2 nested_sub"),
    ]);
}

/// Nothing says when the number of a sub is computed that is defined in a loop; in a called program it is refused
/// whatever its number is.
#[test]
fn a_sub_in_a_loop_has_no_computed_label() {
    check("o7 do\no#2 sub\no0 endsub\no7 while [0]\nm2\n", "ends unspecified");
    check("o7 do\no8 if [0]\no#2 sub\no0 endsub\no8 endif\no7 while [0]\nm2\n", "accepted");
    check("m98 p100\nm2\no100\no#2 sub\no0 endsub\nm99\n", "refused at 4 nested_sub");
}

#[test]
fn structures_may_overlap() {
    check("o1 if [1]\no2 if [0]\no1 endif\n#31=1\no2 endif\n#32=1\nm2\n", "#31 = 0; #32 = 1");
    check(
        "o1 repeat [2]\no2 if [0]\no1 endrepeat\n#31=1\no2 endif\n#32=1\nm2\n",
        "#31 = 0; #32 = 1",
    );
}

#[test]
fn a_jump_back_to_an_ended_loop_goes_through_the_source() {
    let case = Case { options: [("control.ended-label", "followed")].into(), ..Case::default() };
    case.check(
        "o1 while [#31 lt 3]\n#31=[#31+1]\no1 endwhile\n#32=[#32+1]\no2 if [#32 lt 3]\n#31=0\no1 endwhile\no2 endif\nm2\n",
        "accepted; #31 = 3; #32 = 3",
    );
    case.check(
        "o1 repeat [2]\n#31=[#31+1]\no1 endrepeat\no2 if [#31 lt 5]\no1 endrepeat\no2 endif\nm2\n",
        "#31 = 6",
    );
    case.check("o1 do\n#31=[#31+1]\no1 while [0]\no1 while [#31 lt 4]\nm2\n", "#31 = 4");
    case.check(
        "o1 if [0]\no1 endif\no1 else\n#31=1\no1 endif\no1 endif\nm2\n",
        "accepted; #31 = 0",
    );
}
