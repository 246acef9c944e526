//! `gaugeblock suite profiles`: what a vendor can claim.

use std::fmt::Write as _;

use clap::Args;
use gaugeblock_suite::{Edition, Profile, Rule, Suite};
use serde_json::json;

use crate::arguments::Format;
use crate::documents;
use crate::error::CliError;
use crate::streams::write_out;

#[derive(Debug, Args)]
#[command(after_help = "Examples:
  gaugeblock suite profiles                       each profile, and how many rules it has
  gaugeblock suite profiles --edition grbl-1.1    those that this edition has rules of
  gaugeblock rules --profile rs274-core           the rules of one profile
  gaugeblock certify --profile rs274-core         claim one

Exit status: 0 printed; 2 wrong call or input.")]
pub(crate) struct ProfileArguments {
    /// Count only the rules of this edition
    #[arg(long, value_name = "EDITION")]
    edition: Option<String>,
    /// Output format
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
}

/// Lists the profiles with their rules.
pub(crate) fn profiles(suite: &Suite, arguments: &ProfileArguments) -> Result<u8, CliError> {
    let edition = arguments.edition.as_deref();
    let edition = edition.map(|id| documents::any_edition(suite, id)).transpose()?;
    let profiles: Vec<_> = suite
        .profiles
        .iter()
        .map(|profile| (profile, rules_in(suite, profile, edition)))
        .filter(|(_, rules)| !rules.is_empty())
        .collect();
    match arguments.format {
        Format::Text => write_out(&text(&profiles)),
        Format::Json => write_out(&format!("{:#}\n", document(&profiles, edition))),
    }
    Ok(0)
}

fn rules_in<'a>(suite: &'a Suite, profile: &Profile, edition: Option<&Edition>) -> Vec<&'a Rule> {
    let mut rules = suite.rules_of(profile);
    rules.retain(|rule| edition.is_none_or(|edition| rule.is_judged_in(edition)));
    rules
}

fn text(profiles: &[(&Profile, Vec<&Rule>)]) -> String {
    let mut text = String::new();
    for (profile, rules) in profiles {
        let Profile { id, sentence, .. } = profile;
        let _infallible = writeln!(text, "{id:<18}{:>4} rules  {sentence}", rules.len());
    }
    let rules: usize = profiles.iter().map(|(_, rules)| rules.len()).sum();
    let _infallible = writeln!(text, "\n{} profiles, {rules} rules", profiles.len());
    text
}

fn document(profiles: &[(&Profile, Vec<&Rule>)], edition: Option<&Edition>) -> serde_json::Value {
    let profiles = profiles.iter().map(|(profile, rules)| {
        let ids: Vec<&str> = rules.iter().map(|rule| rule.id.as_str()).collect();
        json!({
            "profile": profile.id, "version": profile.version, "sentence": profile.sentence,
            "lineages": profile.lineages, "count": ids.len(), "rules": ids,
        })
    });
    json!({
        "gaugeblock": "profiles", "schema": gaugeblock_vocabulary::schema::VERSION,
        "edition": edition.map(|edition| &edition.id), "profiles": profiles.collect::<Vec<_>>(),
    })
}
