//! After an error the state is that after the block before, also for what the block had set before it was refused.

use super::{Case, check_all};

#[test]
fn settings_of_parameters() {
    check_all(&[
        ("#31=1\n#31=2 g1 x1\n", "refused at 2 zero_feed; #31 = 1"),
        ("#31=1\n#31=2 #31=3 g1 x1\n", "refused at 2 zero_feed; #31 = 1"),
        ("#<a>=1\n#<a>=2 #<b>=3 g1 x1\n", "refused at 2; #<a> = 1; no #<b>"),
        ("#<_g>=1\n#<_g>=2 #<_h>=3 f-1\n", "refused at 2; #<_g> = 1; no #<_h>"),
        ("#31=1\n#31=2 (abort, no)\n", "refused at 2 aborted_by_program; #31 = 1"),
        ("#31=1\n#31=2 m98 p7\nm2\n", "refused at 2 unknown_sub; #31 = 1"),
        ("f1\n#31=2 g38.2 x0\n", "refused at 2 probe; #31 = 0"),
        // The settings of the block before stay, whatever is refused behind it.
        ("#31=1\n#31=2\no1 endsub\n", "refused at 3; #31 = 2"),
        ("#31=1\n#31=2\n#31=[1/0]\n", "refused at 3; #31 = 2"),
        ("#31=1\n#31=2\ng1 x1\n", "refused at 3; #31 = 2"),
    ]);
}

#[test]
fn parameters_of_offsets() {
    check_all(&[
        ("f1 g0 x3\ng28.1 g2 x3\n", "refused at 2; #5161 = 0"),
        ("f1 g0 x3\ng92.3 g2 x3\n", "refused at 2; #5210 = 0"),
        ("f1\ng55 g2 x3\n", "refused at 2; #5220 = 1"),
    ]);
}

/// The short way of a line and the long one.
#[test]
fn feed_and_place() {
    let last = "f5 g1 x1 i3";
    for (program, settings) in [
        ("f2\nf0 g1 x1\n", "f2"),
        ("f2\ng0 x1 i3 f4\n", "f2"),
        ("f2\ng2 x1 f4\n", "f2"),
        ("f2\ng2 x1 i3 f4\n", "f2"),
        ("f2\ng90 g2 x1 i3 f4\n", "f2"),
        ("f2 g20\ng21 g2 x1 f4\n", "f2 g20"),
    ] {
        let outcome = Case::default().run(program.as_bytes());
        assert!(outcome.meets("refused at 2"), "{program}: {}", outcome.show());
        let alone = alloc::format!("{settings}\n{last}\n");
        let alone = Case::default().run(alone.as_bytes());
        assert_eq!(outcome.settings, alone.settings, "{program}");
        assert_eq!(outcome.state, alone.state, "{program}");
    }
}
