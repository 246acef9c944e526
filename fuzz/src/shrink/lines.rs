//! Fewer lines: pieces of any length, and structures with or without what they hold.

use std::collections::BTreeSet;

use super::search::Search;

fn lines_of(text: &str) -> Vec<String> {
    text.lines().map(str::to_owned).collect()
}

fn text_of<'a>(lines: impl IntoIterator<Item = &'a String>) -> String {
    lines.into_iter().flat_map(|line| [line.as_str(), "\n"]).collect()
}

/// Leaves out pieces, long ones first.
pub(super) fn pieces(search: &mut Search<'_>, file: Option<&str>) {
    let mut length = lines_of(&search.text(file)).len();
    while length > 0 {
        let mut first = 0;
        loop {
            let lines = lines_of(&search.text(file));
            if first >= lines.len() {
                break;
            }
            let rest = lines[..first].iter().chain(lines.iter().skip(first + length));
            if !search.attempt_text(file, text_of(rest)) {
                first += length;
            }
        }
        length /= 2;
    }
}

/// Leaves out structures: all that lies between the o-words of a label, or those o-words alone.
pub(super) fn structures(search: &mut Search<'_>, file: Option<&str>) {
    let labels: BTreeSet<String> =
        lines_of(&search.text(file)).iter().filter_map(|line| label(line)).collect();
    for wanted in labels {
        let lines = lines_of(&search.text(file));
        let is_of = |line: &String| label(line).as_ref() == Some(&wanted);
        let first = lines.iter().position(is_of);
        let last = lines.iter().rposition(is_of);
        let (Some(first), Some(last)) = (first, last) else { continue };
        let outside = lines[..first].iter().chain(lines.iter().skip(last + 1));
        if search.attempt_text(file, text_of(outside)) {
            continue;
        }
        search.attempt_text(file, text_of(lines.iter().filter(|line| !is_of(line))));
    }
}

/// The label of an o-word at the start of a line, in lower case.
fn label(line: &str) -> Option<String> {
    let line = line.trim_start().to_ascii_lowercase();
    let rest = line.strip_prefix('o')?;
    let end = if rest.starts_with('<') {
        rest.find('>')? + 1
    } else {
        rest.find(|c: char| !c.is_ascii_digit()).unwrap_or(rest.len())
    };
    (end > 0).then(|| rest[..end].to_owned())
}
