//! G10 L11 under an option that no edition with this code has.

use gaugeblock_reference::run;
use gaugeblock_vocabulary::{Scenario, Tool};

use super::{ending, parameter};

#[test]
fn rotation_of_the_fixture_is_a_parameter_like_any_other_by_choice() {
    for (option, y) in [("stored", -1.0), ("none", 1.0)] {
        let mut scenario = Scenario::of("g10 l2 p9 r180\ng10 l11 p1 x0 y1\ng43 h1\nm2\n");
        scenario.machine.tools = vec![Tool { number: 1, ..Tool::default() }];
        scenario.options.0 =
            [("offsets.flag-and-rotation".to_owned(), option.to_owned())].into_iter().collect();
        let outcome = run(&scenario).0;
        assert_eq!(ending(&outcome), "program_end", "{}", outcome.to_text());
        assert!((parameter(&outcome, 5421) - y).abs() < 1e-9, "{option}: {}", outcome.to_text());
    }
}
