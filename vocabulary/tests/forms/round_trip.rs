//! Random outcomes, scenarios, settings and effects are equal after they were written and read: as text, JSON and TOML.

use gaugeblock_vocabulary::{Effect, Event, Outcome, Scenario, Settings};
use proptest::prelude::*;

use crate::generate;

proptest! {
    #![proptest_config(ProptestConfig { cases: 512, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn outcome_as_text(outcome in generate::outcome()) {
        let text = outcome.to_text();
        let read = Outcome::from_text(&text).map_err(|error| TestCaseError::fail(format!("{error}\n{text}")))?;
        prop_assert_eq!(&read, &outcome);
        prop_assert_eq!(read.to_text(), text, "the form is not unique");
    }

    #[test]
    fn outcome_as_json(outcome in generate::outcome()) {
        let json = serde_json::to_string(&outcome).unwrap();
        let read: Outcome = serde_json::from_str(&json).map_err(|error| TestCaseError::fail(format!("{error}\n{json}")))?;
        prop_assert_eq!(&read, &outcome);
        prop_assert_eq!(serde_json::to_string(&read).unwrap(), json, "the form is not unique");
    }

    #[test]
    fn scenario_as_toml(scenario in generate::scenario()) {
        let text = scenario.to_text().unwrap();
        let read = Scenario::from_text(&text).map_err(|error| TestCaseError::fail(format!("{error}\n{text}")))?;
        prop_assert_eq!(&read, &scenario);
        prop_assert_eq!(read.to_text().unwrap(), text, "the form is not unique");
    }

    #[test]
    fn scenario_as_json(scenario in generate::scenario()) {
        let json = serde_json::to_string(&scenario).unwrap();
        let read: Scenario = serde_json::from_str(&json).map_err(|error| TestCaseError::fail(format!("{error}\n{json}")))?;
        prop_assert_eq!(&read, &scenario);
        prop_assert_eq!(serde_json::to_string(&read).unwrap(), json, "the form is not unique");
    }

    /// Settings are recorded as changes: the change applied to the earlier settings gives the later ones.
    #[test]
    fn settings_as_changes(earlier in generate::settings(), later in generate::settings()) {
        let mut whole = earlier.clone();
        whole.overlay(&later);
        let mut folded = earlier.clone();
        folded.overlay(&whole.since(&earlier));
        prop_assert_eq!(&folded, &whole);
        prop_assert!(whole.since(&whole).is_empty());
    }

    #[test]
    fn effect_by_name(effect in generate::effect()) {
        prop_assert!(Effect::NAMES.contains(&effect.name()));
        let json = serde_json::to_value(&effect).unwrap();
        prop_assert_eq!(json["effect"].as_str(), Some(effect.name()));
    }

    /// Reading a text with one wrong character gives an outcome or one error with its line.
    #[test]
    fn any_text_is_read_or_refused(
        outcome in generate::outcome(),
        at in any::<prop::sample::Index>(),
        put in any::<char>(),
    ) {
        let text = outcome.to_text();
        let mut chars: Vec<char> = text.chars().collect();
        let place = at.index(chars.len());
        chars[place] = put;
        let mutated: String = chars.into_iter().collect();
        match Outcome::from_text(&mutated) {
            Ok(read) => prop_assert_eq!(Outcome::from_text(&read.to_text()), Ok(read)),
            Err(error) => prop_assert!(error.line.is_some() && !error.message.is_empty()),
        }
    }
}

/// An indexed field without entries means the same as an absent field, in every form.
#[test]
fn nothing_by_index_is_nothing() {
    let settings = Settings { spindle_speed: Some(Default::default()), ..Settings::default() };
    assert!(settings.is_empty());
    assert_eq!(serde_json::to_string(&settings).unwrap(), "{}");
}

/// A misspelt field would be compared although the controller does not know it.
#[test]
fn unknown_fields_are_fields() {
    let event = |field: &str| format!(r#"{{"unknown":["{field}"]}}"#);
    assert!(serde_json::from_str::<Event>(&event("position")).is_ok());
    let error = serde_json::from_str::<Event>(&event("positon")).unwrap_err();
    assert!(error.to_string().contains("no field named `positon`"), "{error}");
}
