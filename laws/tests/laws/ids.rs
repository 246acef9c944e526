//! Ids of rules, choices and quirks in the text of the model.

use std::collections::BTreeSet;

use gaugeblock_laws::files::sources;
use gaugeblock_reference::{RULES, gpp, nct, rs274};

/// A rule that is not listed would be recorded nowhere.
#[test]
fn each_id_in_the_text_of_the_model_is_listed() {
    let choices = [rs274::choices::CHOICES, gpp::choices::CHOICES, nct::choices::CHOICES];
    let choices = choices.into_iter().flatten().map(|(id, _)| *id);
    let ids = RULES.lines().chain(choices).chain(rs274::choices::QUIRKS.iter().copied());
    let ids: BTreeSet<&str> = ids.collect();
    let chapters: BTreeSet<_> = ids.iter().filter_map(|id| id.split('.').next()).collect();
    let mut model = sources("reference-model/src");
    // Names of HAL look like ids.
    model.retain(|path, _| !path.ends_with("environment/hal.rs"));
    let mut found = 0;
    for (path, text) in &model {
        let text = text.split("#[cfg(test)]").next().unwrap_or_default();
        // Between two quotation marks is a literal, or what is between two of them; no id has a blank.
        for id in text.split('"').filter(|piece| !piece.contains([' ', '\n', '…'])) {
            let chapter = id.split_once('.').map(|(chapter, _)| chapter);
            if chapter.is_some_and(|chapter| chapters.contains(chapter)) {
                assert!(ids.contains(id), "{id} in {path}");
                found += 1;
            }
        }
    }
    assert!(found > 1000, "{found}");
}
