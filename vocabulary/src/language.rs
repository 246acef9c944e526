//! The languages under test, and how their texts divide into lines.

use crate::words::words;

words! {
    /// A programming language under test.
    pub enum Language {
        /// LinuxCNC's dialect of RS-274.
        Rs274 = "rs274",
        /// NCT custom macros.
        Nct = "nct",
        /// GPP post-processor variables.
        Gpp = "gpp",
    }
}

impl Language {
    /// The lines of a program's text, as blocks are numbered, without their ends: a line feed, a carriage return
    /// before it too, and in RS-274 also a carriage return alone.
    pub fn lines(self, text: &str) -> impl Iterator<Item = &str> {
        let ends: &[char] = match self {
            Self::Rs274 => &['\r', '\n'],
            Self::Gpp | Self::Nct => &['\n'],
        };
        let mut rest = text;
        core::iter::from_fn(move || {
            if rest.is_empty() {
                return None;
            }
            let (line, end) = rest.split_at(rest.find(ends).unwrap_or(rest.len()));
            rest = end.strip_prefix("\r\n").or_else(|| end.get(1..)).unwrap_or_default();
            Some(line.strip_suffix('\r').unwrap_or(line))
        })
    }
}

#[cfg(test)]
mod tests {
    use alloc::vec::Vec;

    use super::*;

    #[test]
    fn lines_end_as_those_of_their_language() {
        let lines = |language: Language| language.lines("a\rb\r\n\nc\r").collect::<Vec<_>>();
        assert_eq!(lines(Language::Rs274), ["a", "b", "", "c"]);
        assert_eq!(lines(Language::Nct), ["a\rb", "", "c"]);
        assert_eq!(Language::Rs274.lines("").next(), None);
    }
}
