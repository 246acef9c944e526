//! What is recorded of a run.

use gaugeblock_trace::{Event, Settings, State};

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
    let outcome = outcome("o1 sub\n#31 = 1\no1 endsub\ng0\no1 call\ng1\nm2\n");
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
