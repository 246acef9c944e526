//! Choices that the report on NIST's interpreter decides differently from LinuxCNC, as far as they concern text.

use super::{Case, check};

/// Checks programs under options.
#[track_caller]
fn check_under(options: &[(&str, &str)], table: &[(&str, &str)]) {
    let case = Case { options: options.into(), ..Case::default() };
    for (program, expectations) in table {
        case.check(program, expectations);
    }
}

#[test]
fn logical_operators_are_among_sums_by_choice() {
    check("#31=[0 and 1 + 3] #32=[1 or 0 + 5]\nm2\n", "#31 = 0; #32 = 1");
    check_under(
        &[("expressions.logical-precedence", "with-addition")],
        &[
            ("#31=[0 and 1 + 3] #32=[1 or 0 + 5]\nm2\n", "#31 = 3; #32 = 6"),
            ("#1=3 #31=[0 and 1 + #1]\n#32=[0 xor 5 - #1]\nm2\n", "#32 = -2"),
            ("#31=[3 - 1 and 1] #32=[2 * 3 or 0 - 1]\nm2\n", "#31 = 1; #32 = 0"),
            ("#31=[1 and 2 ** 0] #32=[1 and 0 * 5]\nm2\n", "#31 = 1; #32 = 0"),
        ],
    );
}

#[test]
fn line_number_has_five_digits_by_choice() {
    check("n000009 g4 p0\nn1.5 g4 p0\nm2\n", "accepted");
    check_under(
        &[("text.greatest-line-number", "five-digits")],
        &[
            ("n99999 g4 p0\nn00009 g4 p0\nn 1 2 3 4 5 g4 p0\nm2\n", "accepted"),
            ("n000009 g4 p0\nm2\n", "refused at 1"),
            ("n100000 g4 p0\nm2\n", "refused at 1"),
            ("n1.5 g4 p0\nm2\n", "refused at 1"),
            ("n5. g4 p0\nm2\n", "refused at 1"),
        ],
    );
}

#[test]
fn parameters_end_at_5399_by_choice() {
    check("#31=#5400 #5600=1\nm2\n", "accepted");
    check_under(
        &[("parameters.greatest", "to-5399")],
        &[
            ("#5399=2 #1=5399\n#31=##1 #32=[#5399+1]\nm2\n", "#31 = 2; #32 = 3"),
            ("#31=#5400\nm2\n", "refused at 1"),
            ("#31=[#5420]\nm2\n", "refused at 1"),
            ("#1=5420\n#31=##1\nm2\n", "refused at 2"),
            ("#5500=1\nm2\n", "refused at 1"),
            ("#[5399+1]=1\nm2\n", "refused at 1"),
            ("g0 x#5421\nm2\n", "refused at 1"),
        ],
    );
}
