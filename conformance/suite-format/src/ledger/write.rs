//! Writes a ledger as the compact TOML file that [`Ledger::parse`] reads: an item per line.

use std::fmt::Write;

use super::{Item, Ledger};

impl Ledger {
    /// The text of the ledger's file.
    pub fn to_toml(&self) -> String {
        let mut text = String::new();
        let form =
            toml::Value::try_from(self.form).map_or_else(|_| String::new(), |f| f.to_string());
        for (key, value) in [
            ("document", quoted(&self.document)),
            ("title", quoted(&self.title)),
            ("edition", quoted(&self.edition)),
            ("form", form),
            ("sha256", quoted(&self.sha256)),
        ] {
            line(&mut text, &format!("{key} = {value}"));
        }
        if self.partial {
            line(&mut text, "partial = true");
        }
        for section in &self.sections {
            line(&mut text, "\n[[section]]");
            line(&mut text, &format!("name = {}", quoted(&section.name)));
            line(&mut text, "items = [");
            for item in &section.items {
                line(&mut text, &format!("  {{ {} }},", item_fields(item)));
            }
            line(&mut text, "]");
        }
        text
    }
}

fn item_fields(item: &Item) -> String {
    let mut fields =
        format!("n = {}, kind = \"{}\", digest = \"{}\"", item.n, item.kind, item.digest);
    for (key, ids) in [
        ("rules", &item.rules),
        ("grids", &item.grids),
        ("choices", &item.choices),
        ("quirks", &item.quirks),
    ] {
        if !ids.is_empty() {
            let ids: Vec<String> = ids.iter().map(|id| quoted(id)).collect();
            push(&mut fields, key, &format!("[{}]", ids.join(", ")));
        }
    }
    for (key, reason) in [
        ("not_observable", &item.not_observable),
        ("out_of_scope", &item.out_of_scope),
        ("later", &item.later),
    ] {
        if let Some(reason) = reason {
            push(&mut fields, key, &quoted(reason));
        }
    }
    fields
}

fn push(fields: &mut String, key: &str, value: &str) {
    // Writing to a string cannot fail.
    let _ = write!(fields, ", {key} = {value}");
}

fn line(text: &mut String, line: &str) {
    text.push_str(line);
    text.push('\n');
}

fn quoted(text: &str) -> String {
    toml::Value::String(text.to_owned()).to_string()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ledger::Form;

    #[test]
    fn what_is_written_reads_back() {
        let text = "= T\n\n== A \"B\"\n\nOne. Two.\n\n* Three\n";
        let mut ledger = Ledger::begin("ours", "Ours", Form::NumberedAsciidoc, text);
        ledger.form = Form::Asciidoc;
        ledger.sections = Ledger::begin("ours", "Ours", Form::Asciidoc, text).sections;
        ledger.partial = true;
        let items = &mut ledger.sections[0].items;
        items[0].rules = vec!["a.b".into(), "a.c".into()];
        items[0].later = Some("Motion, cycles and offsets".into());
        items[1].choices = vec!["a.b".into()];
        items[1].quirks = vec!["rs274.a".into()];
        items[2].not_observable = Some("it says \"so\"".into());
        let written = ledger.to_toml();
        assert_eq!(Ledger::parse(&written).unwrap(), ledger);
        assert_eq!(written.lines().filter(|line| line.starts_with("  { n = ")).count(), 3);
    }
}
