//! The part of the language that a controller has. The referee reads programs and leaves out those that need more.

use alloc::collections::{BTreeMap, BTreeSet};
use alloc::format;
use alloc::string::String;

use crate::Scenario;

/// The part of RS-274 that a controller has. A member that is left out limits nothing.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(deny_unknown_fields, default)
)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct DeclaredLanguage {
    /// G codes, such as `"0"` and `"38.2"`.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub g: Option<BTreeSet<String>>,
    /// M codes, such as `"3"`.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub m: Option<BTreeSet<String>>,
    /// Letters that a code can have in its block, axes among them, by the name of the code: `{"G43.1": "Z"}`. A code
    /// that is not listed can have those of the documents. G10 can be listed by its L word: `G10 L2` and `G10 L20`
    /// exclude every other L.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "BTreeMap::is_empty"))]
    pub words: BTreeMap<String, String>,
    /// Axis letters, with `@` and `^` of polar words: `"XYZ"`.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub axes: Option<String>,
    /// Which of the letters `F`, `S`, `T` and `N` a block can have.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub letters: Option<String>,
    /// Kinds of parameters; an empty list for none.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub parameters: Option<BTreeSet<ParameterKind>>,
    /// The greatest number of a numbered parameter that a program writes.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub greatest_parameter: Option<u32>,
    /// Whether there are expressions in square brackets.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub expressions: Option<bool>,
    /// Whether expressions have comparisons, such as EQ, and EXISTS.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub comparisons: Option<bool>,
    /// Whether there are O-words.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub o_words: Option<bool>,
    /// Kinds of comments; an empty list for none.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub comments: Option<BTreeSet<CommentKind>>,
}

/// Checks that a program is in a declared language: the referee has a parser, adapters have none.
///
/// The error says what the program needs in addition.
pub type LanguageCheck = fn(&DeclaredLanguage, &Scenario) -> Result<(), String>;

/// A kind of parameters.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(rename_all = "snake_case")
)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub enum ParameterKind {
    /// `#31`.
    Numbered,
    /// `#<name>`.
    Named,
}

/// A kind of comments.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(rename_all = "snake_case")
)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub enum CommentKind {
    /// In parentheses.
    Parentheses,
    /// After a semicolon.
    Semicolon,
    /// `(MSG,…)`.
    Message,
    /// Those that do something, such as `(DEBUG,…)`, and `(MSG,…)`.
    Active,
}

/// Letters that a block can have without a code.
const LETTERS: &str = "FSTN";

/// Letters of axes and polar words.
const AXES: &str = "XYZABCUVW@^";

impl DeclaredLanguage {
    /// Checks the names of codes and letters.
    ///
    /// # Errors
    /// What is not a code or a letter, as a sentence.
    pub fn check(&self) -> Result<(), String> {
        for (place, codes) in [("g", &self.g), ("m", &self.m)] {
            if let Some(code) = codes.iter().flatten().find(|code| !is_number(code)) {
                return Err(format!(
                    "invalid code {code:?} in `language.{place}`: expected a number such as \"{}\"",
                    if place == "g" { "38.2" } else { "3" }
                ));
            }
        }
        for (code, letters) in &self.words {
            let (name, kind) =
                code.split_once(" L").map_or((code.as_str(), None), |(g, l)| (g, Some(l)));
            let number = name.strip_prefix(['G', 'M']);
            let is_kind = kind.is_none_or(|kind| name == "G10" && is_number(kind));
            if !number.is_some_and(is_number) || !is_kind {
                return Err(format!(
                    "invalid code {code:?} in `language.words`: expected a code such as \"G43.1\", \"M66\" or \"G10 L2\""
                ));
            }
            letters_of("words", letters, "ABCDEFGHIJKLMNOPQRSTUVWXYZ$@^")?;
        }
        letters_of("axes", self.axes.as_deref().unwrap_or_default(), AXES)?;
        letters_of("letters", self.letters.as_deref().unwrap_or_default(), LETTERS)
    }
}

fn is_number(text: &str) -> bool {
    let (whole, tenths) = text.split_once('.').unwrap_or((text, "0"));
    let digits = |text: &str| !text.is_empty() && text.bytes().all(|byte| byte.is_ascii_digit());
    // As people write it: `3`, not `03` or `3.0`.
    let is_plain = whole == "0" || !whole.starts_with('0');
    digits(whole) && is_plain && digits(tenths) && (tenths.len() == 1) && !text.ends_with(".0")
}

fn letters_of(place: &str, letters: &str, known: &str) -> Result<(), String> {
    match letters.chars().find(|letter| !known.contains(*letter)) {
        Some(letter) => Err(format!(
            "invalid letter {letter:?} in `language.{place}`: expected some of {known}"
        )),
        None => Ok(()),
    }
}

#[cfg(all(test, feature = "serde"))]
mod tests {
    use alloc::string::ToString as _;

    use super::*;

    fn checked(json: &str) -> Result<(), String> {
        let language: DeclaredLanguage =
            serde_json::from_str(json).map_err(|error| error.to_string())?;
        language.check()
    }

    #[test]
    fn language_of_a_controller_is_read() {
        let all = r#"{"g":["0","38.2","10"],"m":["2"],"words":{"G10 L2":"PXYZ","M66":"PLQ"},"axes":"XYZ",
            "letters":"FS","parameters":["numbered"],"expressions":false,"o_words":false,"comments":["semicolon"]}"#;
        assert_eq!(checked(all), Ok(()));
        assert_eq!(checked("{}"), Ok(()));
    }

    #[test]
    fn misspelt_language_is_an_error() {
        for (json, expect) in [
            (r#"{"g":["G0"]}"#, "invalid code \"G0\" in `language.g`"),
            (r#"{"g":["03"]}"#, "invalid code \"03\" in `language.g`"),
            (r#"{"m":["3.0"]}"#, "invalid code \"3.0\" in `language.m`"),
            (r#"{"words":{"43":"Z"}}"#, "invalid code \"43\" in `language.words`"),
            (r#"{"words":{"G43 L1":"Z"}}"#, "invalid code \"G43 L1\" in `language.words`"),
            (r#"{"words":{"G43":"z"}}"#, "invalid letter 'z' in `language.words`"),
            (r#"{"axes":"XF"}"#, "invalid letter 'F' in `language.axes`"),
            (r#"{"letters":"FX"}"#, "invalid letter 'X' in `language.letters`"),
            (r#"{"comments":["brackets"]}"#, "unknown variant `brackets`"),
            (r#"{"o_word":false}"#, "unknown field `o_word`"),
        ] {
            let error = checked(json).expect_err(json);
            assert!(error.starts_with(expect), "{json}: {error}");
        }
    }
}
