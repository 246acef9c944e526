//! The INI file, as far as an interpreter needs it.

use std::collections::BTreeMap;

/// Entries by section and name. Names are compared literally; the first of several counts.
#[derive(Clone, Debug, Default)]
pub(super) struct Ini {
    entries: Vec<(String, String, String)>,
}

impl Ini {
    /// Reads the text of an INI file and skips lines that are not entries.
    pub(super) fn read(text: &str) -> Self {
        let mut entries = Vec::new();
        let mut section = String::new();
        for line in text.lines().map(str::trim) {
            if line.starts_with(['#', ';']) {
                continue;
            }
            if let Some(name) = line.strip_prefix('[').and_then(|rest| rest.split(']').next()) {
                name.clone_into(&mut section);
            } else if let Some((name, value)) = line.split_once('=') {
                let value = value.split(['#', ';']).next().unwrap_or_default();
                entries.push((section.clone(), name.trim().to_owned(), value.trim().to_owned()));
            }
        }
        Self { entries }
    }

    /// Whether there is no entry in a section.
    pub(super) fn is_empty(&self) -> bool {
        !self.entries.iter().any(|(section, ..)| !section.is_empty())
    }

    /// The value of an entry.
    pub(super) fn get(&self, section: &str, name: &str) -> Option<&str> {
        let mut found = self.entries.iter().filter(|entry| entry.0 == section && entry.1 == name);
        found.next().map(|entry| entry.2.as_str())
    }

    /// The value of an entry that is a number.
    pub(super) fn number(&self, section: &str, name: &str) -> Option<f64> {
        self.get(section, name)?.parse().ok()
    }

    /// Whether an entry is there and is not zero.
    pub(super) fn on(&self, section: &str, name: &str) -> bool {
        self.number(section, name).is_some_and(|value| value.abs() > 0.0)
    }

    /// All entries that are numbers, by `[SECTION]NAME` in upper case: what `#<_ini[section]name>` reads.
    pub(super) fn numbers(&self) -> BTreeMap<String, f64> {
        let mut numbers = BTreeMap::new();
        for (section, name, value) in &self.entries {
            if let Ok(value) = value.parse() {
                let name = format!("[{section}]{name}").to_uppercase();
                numbers.entry(name).or_insert(value);
            }
        }
        numbers
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn entries_are_read() {
        let ini = Ini::read("[A]\nX = 1 # one\nX=2\n; Y=3\n[B]\nX = a:b\n");
        assert_eq!(ini.get("A", "X"), Some("1"));
        assert_eq!(ini.get("B", "X"), Some("a:b"));
        assert_eq!(ini.get("A", "Y"), None);
        assert!(ini.on("A", "X"));
        assert_eq!(ini.numbers(), BTreeMap::from([("[A]X".to_owned(), 1.0)]));
    }
}
