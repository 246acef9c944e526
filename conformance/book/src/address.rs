//! Addresses of pages within the site, and of the public documents.

use gaugeblock_suite::ledger::Ledger;
use gaugeblock_suite::{Source, sections};
use serde::Serialize;

/// The page of a rule, by its id.
pub fn rule(id: &str) -> String {
    format!("rules/{id}.html")
}

/// The page of a choice or a quirk, by its id.
pub fn choice(id: &str) -> String {
    format!("choices/{id}.html")
}

/// The page of a code such as M73.
pub fn code(code: &str) -> String {
    format!("codes/{code}.html")
}

pub(crate) fn chapter(chapter: &str) -> String {
    format!("chapters/{chapter}.html")
}

pub(crate) fn document(document: &str) -> String {
    format!("documents/{document}.html")
}

pub(crate) fn edition(edition: &str) -> String {
    format!("editions/{edition}.html")
}

/// The name of a place in a page: lower-case letters and digits, each run of other characters as one hyphen.
pub fn anchor(text: &str) -> String {
    let mut name = String::new();
    for c in text.chars() {
        if c.is_ascii_alphanumeric() {
            name.push(c.to_ascii_lowercase());
        } else if !name.ends_with('-') && !name.is_empty() {
            name.push('-');
        }
    }
    name.trim_end_matches('-').to_owned()
}

/// Public documents: the document, the beginning of its sections, and their page.
const PUBLIC: [(&str, &str, &str); 19] = [
    ("linuxcnc-2.9", "2.3.", "https://linuxcnc.org/docs/2.9/html/user/user-concepts.html"),
    ("linuxcnc-2.9", "9.6.", "https://linuxcnc.org/docs/2.9/html/remap/remap.html"),
    ("linuxcnc-2.9", "11.1", "https://linuxcnc.org/docs/2.9/html/gcode/coordinates.html"),
    ("linuxcnc-2.9", "11.2", "https://linuxcnc.org/docs/2.9/html/gcode/tool-compensation.html"),
    ("linuxcnc-2.9", "11.4", "https://linuxcnc.org/docs/2.9/html/gcode/overview.html"),
    ("linuxcnc-2.9", "11.5", "https://linuxcnc.org/docs/2.9/html/gcode/g-code.html"),
    ("linuxcnc-2.9", "11.6", "https://linuxcnc.org/docs/2.9/html/gcode/m-code.html"),
    ("linuxcnc-2.9", "11.7", "https://linuxcnc.org/docs/2.9/html/gcode/o-code.html"),
    ("linuxcnc-2.9", "11.8", "https://linuxcnc.org/docs/2.9/html/gcode/other-code.html"),
    ("linuxcnc-2.8", "", "https://linuxcnc.org/docs/2.8/html/gcode/m-code.html"),
    ("grbl-1.1", "", "https://github.com/gnea/grbl/blob/v1.1h.20190825/README.md"),
    (
        "grbl-1.1-commands",
        "",
        "https://github.com/gnea/grbl/blob/v1.1h.20190825/doc/markdown/commands.md",
    ),
    (
        "grbl-1.1-interface",
        "",
        "https://github.com/gnea/grbl/blob/v1.1h.20190825/doc/markdown/interface.md",
    ),
    ("grbl-1.1-gcode", "", "https://github.com/gnea/grbl/blob/v1.1h.20190825/grbl/gcode.c"),
    ("grbl-1.1-numbers", "", "https://github.com/gnea/grbl/blob/v1.1h.20190825/grbl/nuts_bolts.c"),
    ("grbl-1.1-protocol", "", "https://github.com/gnea/grbl/blob/v1.1h.20190825/grbl/protocol.c"),
    ("grblhal", "", "https://github.com/grblHAL/core/blob/master/README.md"),
    ("grblhal-gcode", "", "https://github.com/grblHAL/core/blob/master/gcode.c"),
    ("nist-rs274ngc-3", "", "https://doi.org/10.6028/NIST.IR.6556"),
];

/// Where a section of a document can be read. A page of a manual is opened at the section's title.
pub(crate) fn public(document: &str, section: &str) -> Option<String> {
    let is_page =
        |(own, begins, _): &&(&str, &str, &str)| *own == document && section.starts_with(begins);
    let (_, _, page) = PUBLIC.iter().find(is_page)?;
    let is_manual = page.contains("/html/");
    let title = section.trim_start_matches(|c: char| c.is_ascii_digit() || c == '.').trim();
    if !is_manual || title.is_empty() {
        return Some((*page).to_owned());
    }
    Some(format!("{page}#:~:text={}", percent_encoded(title)))
}

fn percent_encoded(text: &str) -> String {
    let encoded = text.bytes().map(|byte| match byte {
        b'A'..=b'Z' | b'a'..=b'z' | b'0'..=b'9' | b'.' | b'_' | b'~' => {
            char::from(byte).to_string()
        }
        _ => format!("%{byte:02X}"),
    });
    encoded.collect()
}

/// A section that is a source: as text, its page in this site, and where it can be read.
#[derive(Debug, Serialize)]
pub(crate) struct SourceLink {
    text: String,
    /// Its place in this site, where the document has a ledger with the section.
    page: Option<String>,
    public: Option<String>,
}

/// One link for each section of the sources.
pub(crate) fn links(sources: &[Source], ledgers: &[Ledger]) -> Vec<SourceLink> {
    let is_listed = |source: &Source| {
        let mut of_document = ledgers.iter().filter(|it| it.document == source.document);
        of_document.any(|ledger| ledger.section(&source.section).is_some())
    };
    let texts = sections(sources);
    let mut firsts: Vec<&Source> = Vec::new();
    for source in sources {
        let is_same = |it: &&Source| it.document == source.document && it.section == source.section;
        if !firsts.iter().any(is_same) {
            firsts.push(source);
        }
    }
    let link = |(text, source): (String, &Source)| SourceLink {
        text,
        page: is_listed(source)
            .then(|| format!("{}#{}", document(&source.document), anchor(&source.section))),
        public: public(&source.document, &source.section),
    };
    texts.into_iter().zip(firsts).map(link).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn section_of_a_manual_is_opened_at_its_title() {
        let address = public("linuxcnc-2.9", "11.6.15 M62 - M65 Digital Output Control");
        assert_eq!(
            address.as_deref(),
            Some(
                "https://linuxcnc.org/docs/2.9/html/gcode/m-code.html#:~:text=M62%20%2D%20M65%20Digital%20Output%20Control"
            )
        );
        assert_eq!(public("m70-draft", "Saving"), None);
    }

    #[test]
    fn anchor_has_letters_digits_and_single_hyphens() {
        assert_eq!(anchor("11.5.5 G2, G3 Arcs"), "11-5-5-g2-g3-arcs");
        assert_eq!(anchor("(a)"), "a");
    }
}
