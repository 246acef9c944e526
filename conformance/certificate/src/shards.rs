//! Shards: all parts of one run, each exactly once.

use std::collections::BTreeMap;

use gaugeblock_report::{Header, merge};
use gaugeblock_runner::shard::Shard;

use super::digest::is_sha256;
use super::statement::{CertifiedShard, Statement};

/// What is wrong about the shards of a merged run; nothing if no shards are named.
pub(crate) fn merged_shards(shards: &[CertifiedShard], run: Shard) -> Vec<String> {
    let Some(first) = shards.first() else { return Vec::new() };
    let named: Vec<(Shard, String)> =
        shards.iter().map(|shard| (shard.shard, format!("merged shard {}", shard.shard))).collect();
    let mut problems = not_each_once(&named, first.shard.of);
    if run != Shard::WHOLE {
        problems.push("shards: a merged run is not a shard of another one".to_owned());
    }
    let undigested = shards.iter().filter(|shard| !is_sha256(&shard.report_sha256));
    problems.extend(
        undigested.map(|shard| format!("shards: the digest of {} is not a SHA-256", shard.shard)),
    );
    let mut digests = BTreeMap::new();
    for shard in shards {
        if let Some(other) = digests.insert(&shard.report_sha256, shard.shard) {
            problems.push(format!("shards: {other} and {} are the same report", shard.shard));
        }
    }
    problems
}

/// What is wrong about certificates that are to be all shards of one run, each with its name.
pub fn check_shards(parts: &[(String, Statement)]) -> Vec<String> {
    let Some((first_name, first)) = parts.first() else { return Vec::new() };
    let run = &first.predicate.run;
    let other = parts.iter().find_map(|(name, part)| {
        let shard = part.predicate.run.shard;
        let why = merge::first_difference(&Header { shard, ..run.clone() }, &part.predicate.run)?;
        Some(vec![format!("shards: {first_name} and {name} are not of one run: {why}")])
    });
    let named: Vec<(Shard, String)> =
        parts.iter().map(|(name, part)| (part.predicate.run.shard, name.clone())).collect();
    other.unwrap_or_else(|| not_each_once(&named, run.shard.of))
}

/// Shards that are missing, there twice, or of another number of shards.
fn not_each_once(named: &[(Shard, String)], of: u64) -> Vec<String> {
    let (mut problems, mut by_index) = (Vec::new(), BTreeMap::new());
    for (shard, name) in named {
        if shard.of != of {
            problems.push(format!("shards: {name} is {shard}, not one of {of}"));
        } else if let Some(other) = by_index.insert(shard.index, name) {
            problems.push(format!("shards: {other} and {name} are both shard {shard}"));
        }
    }
    let missing = (1..=of).find(|index| !by_index.contains_key(index));
    if let Some(index) = missing {
        let count = of - by_index.len() as u64;
        problems.push(format!("shards: {count} of {of} missing, first {index}/{of}"));
    }
    problems
}
