//! What is recorded of a run.

use gaugeblock_vocabulary::{Event, Settings, State};

use super::outcome;

#[test]
fn the_settings_at_the_start_are_whole() {
    let outcome = outcome("m2\n");
    let recorded: Vec<_> = outcome.start.entries().iter().map(|entry| entry.field).collect();
    for field in Settings::FIELDS {
        assert!(recorded.contains(field), "{field}");
    }
}

#[test]
fn a_setting_stands_before_the_effect_that_it_governs() {
    let outcome = outcome("g1 x1 f100\nm2\n");
    let events = &outcome.steps[0].events;
    let set =
        |event: &Event| matches!(event, Event::Set(settings) if settings.feed_rate == Some(100.0));
    let moved =
        |event: &Event| matches!(event, Event::Do(effect) if effect.name() == "straight_feed");
    let (set, moved) = (events.iter().position(set), events.iter().position(moved));
    assert!(set.is_some() && set < moved, "{events:?}");
}

#[test]
fn blocks_of_control_have_no_state() {
    let outcome = outcome("o1 if [1]\ng0 x1\no1 endif\nm98 p5\nm2\no5\nm99\n");
    let states: Vec<_> =
        outcome.steps.iter().map(|step| (step.block.line, step.state.is_some())).collect();
    assert_eq!(states, [(1, false), (2, true), (3, false), (4, false), (7, false), (5, true)]);
}

#[test]
fn a_comment_that_says_nothing_is_no_block() {
    let outcome = outcome("(nothing)\n\n; neither\n(MSG,something)\nn10\nm2\n");
    let lines: Vec<_> = outcome.steps.iter().map(|step| step.block.line).collect();
    assert_eq!(lines, [4, 5, 6]);
}

#[test]
fn a_state_tells_which_parameters_the_block_changed() {
    let outcome = outcome("#31 = 5 #<_depth> = 2\n#31 = 5\n#<width> = 1\nm2\n");
    let changed: Vec<Vec<(String, f64)>> = outcome
        .steps
        .iter()
        .filter_map(|step| match &step.state {
            Some(State::Rs274(state)) => {
                Some(state.parameter.clone().unwrap_or_default().0.into_iter().collect())
            }
            _ => None,
        })
        .collect();
    let named = |pairs: &[(&str, f64)]| -> Vec<(String, f64)> {
        pairs.iter().map(|(name, value)| ((*name).to_owned(), *value)).collect()
    };
    assert_eq!(
        changed,
        [named(&[("31", 5.0), ("_depth", 2.0)]), named(&[]), named(&[("width", 1.0)]), named(&[])]
    );
}

#[test]
fn the_call_level_is_that_after_the_block() {
    let outcome = outcome("o1 sub\n#31 = 1\no1 endsub\ng0\no1 call\nf1 g1\nm2\n");
    let mut level = None;
    let mut levels = Vec::new();
    for step in &outcome.steps {
        if let Some(State::Rs274(state)) = &step.state {
            level = state.call_level.or(level);
            levels.push((step.block.line, level));
        }
    }
    assert_eq!(levels, [(4, Some(0)), (2, Some(1)), (6, Some(0)), (7, Some(0))]);
}

/// The call level and the parameters that each state records.
fn scopes(program: &str) -> Vec<(u32, Option<u32>, String)> {
    let outcome = outcome(program);
    let states = outcome.steps.iter().filter_map(|step| match &step.state {
        Some(State::Rs274(state)) => {
            let parameters = state.parameter.iter().flat_map(|parameters| &parameters.0);
            let texts: Vec<_> = parameters.map(|(name, value)| format!("{name}={value}")).collect();
            Some((step.block.line, state.call_level, texts.join(" ")))
        }
        _ => None,
    });
    states.collect()
}

#[test]
fn after_a_call_or_return_a_state_tells_whose_parameters_are_in_sight() {
    let program =
        "o1 sub\n#<w> = 9 #1 = 3\no1 endsub\n#<w> = 5 #<v> = 6 #1 = 4\no1 call [7]\ng0\nm2\n";
    let record = |line, level, parameters: &str| (line, level, parameters.to_owned());
    assert_eq!(
        scopes(program),
        [
            record(4, Some(0), "1=4 v=6 w=5"),
            record(2, Some(1), "1=3 w=9"),
            record(6, Some(0), "1=4 v=6 w=5"),
            record(7, None, ""),
        ]
    );
}

#[test]
fn a_call_right_after_a_return_is_another_level_of_the_same_depth() {
    let program = "o1 sub\n#<w> = 9\no1 endsub\no2 sub\ng0\no2 endsub\no1 call\no2 call [2]\nm2\n";
    let record = |line, level, parameters: &str| (line, level, parameters.to_owned());
    assert_eq!(
        scopes(program),
        [record(2, Some(1), "w=9"), record(5, Some(1), "1=2"), record(9, Some(0), "1=0")]
    );
}

#[test]
fn a_program_end_leaves_every_call() {
    let program = "o1 sub\n#1 = 3\nm2\no1 endsub\nm98 p5\nm2\no5\n#1 = 7\no1 call [2]\nm99\n";
    let record = |line, level, parameters: &str| (line, level, parameters.to_owned());
    assert_eq!(
        scopes(program),
        [
            record(8, Some(1), "1=7"),
            record(2, Some(2), "1=3"),
            // A numbered subprogram works on the main program's parameters.
            record(3, Some(0), "1=7"),
        ]
    );
}

#[test]
fn whatever_changes_a_parameter_it_is_recorded() {
    let system = |program: &str| -> Vec<String> {
        let texts = scopes(program).into_iter().map(|(_, _, parameters)| parameters);
        texts.filter(|text| text.contains("5220")).collect()
    };
    assert_eq!(system("g55\nm70\ng56\nm72\nm2\n"), ["5220=2", "5220=3", "5220=2", "5220=1"]);
    assert_eq!(system("o1 sub\nm73\ng56\no1 endsub\no1 call\ng0\nm30\n"), ["5220=3", "5220=1"]);
    assert_eq!(scopes("m98 p5 #31=8\ng0\nm2\no5\nm99\n")[0].2, "31=8");
}
