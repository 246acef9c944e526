//! What one program leaves for the next on the same controller.

use std::collections::BTreeSet;

use super::stream::Item;
use crate::instrumentation::source::{Source, code};

/// Names that a program may find given a value by a program before it: they stay for as long as the controller runs.
/// One that is given a value before it is looked at, and before anything jumps, is not among them.
pub(super) fn foreign_names(source: &Source) -> BTreeSet<String> {
    let mut own: BTreeSet<String> = BTreeSet::new();
    for (file, _, line) in source.all() {
        let text: String = line.to_lowercase().split_whitespace().collect();
        let assigned = text.strip_prefix("#<").and_then(|rest| rest.split_once(">="));
        let is_only = text.matches('#').count() == 1 || text.matches("#<").count() == 1;
        match assigned {
            Some((name, _)) if file == 0 && is_only => {
                own.insert(name.to_owned());
            }
            _ if text.starts_with('o') || text.contains("#<") => break,
            _ => {}
        }
    }
    let named = source.parameters().named.into_iter();
    named.filter(|name| !own.contains(name) && !name.contains('[')).collect()
}

/// Whether a run leaves something in the interpreter that no reset removes: a loop to leave or a call to repeat, or,
/// after some refusals, the refusal itself.
pub(super) fn leaves_traces(source: &Source, items: &[Item]) -> bool {
    let end = items.iter().position(Item::is_end).unwrap_or_default();
    let refuses_all = items[end..].iter().any(|item| matches!(item, Item::Refused(_)));
    refuses_all || words_leave_traces(source)
}

/// Whether a program has words that may leave residue, for example a changed tool table, or a dwell that a tap without
/// one takes over.
pub(super) fn words_leave_traces(source: &Source) -> bool {
    let dwells =
        ["g74", "g82", "g84", "g86", "g88", "g89"].into_iter().any(|word| has(source, word));
    if dwells && has(source, "p") {
        return true;
    }
    ["continue", "break", "m98", "g10l1"].into_iter().any(|word| has(source, word))
}

/// Whether the code of a program contains this.
pub(super) fn has(source: &Source, word: &str) -> bool {
    source.all().any(|(_, _, line)| code(line).contains(word))
}
