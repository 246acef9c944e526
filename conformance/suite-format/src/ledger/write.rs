//! Writes a ledger as the compact TOML file that [`Ledger::parse`] reads, one item per entry.

use std::collections::BTreeSet;
use std::fmt::Write;

use super::{Item, ItemGrid, Ledger};

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
            write_tables(&mut text, "items", section.items.iter().map(item_fields));
            if !section.grids.is_empty() {
                write_tables(&mut text, "grids", section.grids.iter().map(grid_fields));
            }
        }
        text
    }
}

/// Greatest length of a line, if breaking lists can achieve it.
const COLUMNS: usize = 120;

/// A value of an item.
enum Field {
    One(String),
    List(Vec<String>),
}

/// Writes a list of tables.
fn write_tables(
    text: &mut String,
    key: &str,
    tables: impl Iterator<Item = Vec<(&'static str, Field)>>,
) {
    line(text, &format!("{key} = ["));
    for fields in tables {
        line(text, &table(&fields));
    }
    line(text, "]");
}

/// Writes a table on one line, or breaks its longest lists until each line fits.
fn table(fields: &[(&str, Field)]) -> String {
    let mut broken = BTreeSet::new();
    loop {
        let written: Vec<_> = fields
            .iter()
            .map(|(key, field)| format!("{key} = {}", value(field, broken.contains(key))))
            .collect();
        let table = format!("  {{ {} }},", written.join(", "));
        let is_list = |(key, field): &&(&str, Field)| {
            matches!(field, Field::List(_)) && !broken.contains(key)
        };
        let longest =
            fields.iter().filter(is_list).max_by_key(|(_, field)| value(field, false).len());
        match longest {
            Some((key, _)) if table.lines().any(|line| line.chars().count() > COLUMNS) => {
                broken.insert(*key);
            }
            _ => return table,
        }
    }
}

fn value(field: &Field, is_broken: bool) -> String {
    let values = match field {
        Field::One(value) => return value.clone(),
        Field::List(values) if !is_broken => return format!("[{}]", values.join(", ")),
        Field::List(values) => values,
    };
    let (mut text, mut column) = ("[".to_owned(), COLUMNS);
    for value in values {
        let length = value.chars().count() + 2;
        if column + length > COLUMNS {
            text.push_str("\n   ");
            column = 3;
        }
        let _infallible = write!(text, " {value},");
        column += length;
    }
    text + "\n  ]"
}

fn item_fields(item: &Item) -> Vec<(&'static str, Field)> {
    let mut fields = vec![
        ("n", Field::One(item.n.to_string())),
        ("kind", Field::One(quoted(&item.kind.to_string()))),
        ("digest", Field::One(quoted(&item.digest))),
    ];
    for (key, ids) in [("rules", &item.rules), ("choices", &item.choices), ("quirks", &item.quirks)]
    {
        if !ids.is_empty() {
            fields.push((key, Field::List(ids.iter().map(|id| quoted(id)).collect())));
        }
    }
    for (key, reason) in [
        ("not_observable", &item.not_observable),
        ("out_of_scope", &item.out_of_scope),
        ("later", &item.later),
    ] {
        fields.extend(reason.as_ref().map(|reason| (key, Field::One(quoted(reason)))));
    }
    fields
}

fn grid_fields(grid: &ItemGrid) -> Vec<(&'static str, Field)> {
    let items = grid.n.iter().map(usize::to_string).collect();
    vec![("n", Field::List(items)), ("name", Field::One(quoted(&grid.name)))]
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
        items[1].rules = (0..20).map(|number| format!("a-chapter.a-rule-{number}")).collect();
        items[1].quirks = vec!["rs274.a".into()];
        items[2].not_observable = Some("it says \"so\"".into());
        ledger.sections[0].grids = vec![ItemGrid { n: vec![1, 2], name: "a.b / c".into() }];
        let written = ledger.to_toml();
        assert!(written.lines().all(|line| line.chars().count() <= COLUMNS), "{written}");
        assert_eq!(Ledger::parse(&written).unwrap(), ledger);
        assert_eq!(written.lines().filter(|line| line.starts_with("  { n = ")).count(), 4);
    }
}
