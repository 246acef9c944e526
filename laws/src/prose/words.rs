//! House words and where they occur in a text.

use std::fs;

use crate::files;

/// What `laws/words.toml` says.
#[derive(Debug, Clone, Default)]
pub struct Rules {
    /// Words that are refused.
    pub words: Vec<Word>,
    /// How many may be left of each kind of text.
    pub ceiling: toml::Table,
}

/// Words that are refused for one reason.
#[derive(Debug, Clone, Default)]
pub struct Word {
    /// Words and phrases, each as its words in lower case.
    pub refuse: Vec<Vec<String>>,
    /// Phrases in which they have their plain meaning.
    pub except: Vec<Vec<String>>,
    /// Whether they may begin a sentence or a clause.
    pub may_begin: bool,
}

impl Rules {
    /// Reads the file.
    ///
    /// # Panics
    ///
    /// When it is not in the form that its head describes.
    #[must_use]
    pub fn read() -> Self {
        let path = files::root().join("laws/words.toml");
        let text = fs::read_to_string(path).expect("laws/words.toml can be read");
        let file: toml::Table = text.parse().expect("laws/words.toml is TOML");
        let words = file["word"].as_array().expect("laws/words.toml lists words").iter();
        let word = |word: &toml::Value| Word {
            refuse: phrases(word.get("refuse")),
            except: phrases(word.get("except")),
            may_begin: word.get("may_begin").and_then(toml::Value::as_bool).unwrap_or_default(),
        };
        Self {
            words: words.map(word).collect(),
            ceiling: file["ceiling"].as_table().cloned().unwrap_or_default(),
        }
    }
}

fn phrases(list: Option<&toml::Value>) -> Vec<Vec<String>> {
    let list = list.and_then(toml::Value::as_array).into_iter().flatten();
    let texts = list.filter_map(toml::Value::as_str);
    texts.map(|text| text.split(' ').map(str::to_lowercase).collect()).collect()
}

/// A word of a text.
struct Token {
    text: String,
    /// Line of the text, from zero.
    line: usize,
    /// What is between the word before and this one.
    before: String,
}

/// House words of a text, each with its line from zero.
#[must_use]
pub fn found_in(rules: &Rules, text: &str) -> Vec<(usize, String)> {
    let tokens = tokens(text);
    let mut found = Vec::new();
    for place in 0..tokens.len() {
        for word in &rules.words {
            let refused = word.refuse.iter().filter(|phrase| is_at(&tokens, place, phrase));
            let refused = refused.filter(|phrase| !is_excepted(&tokens, place, phrase, word));
            found.extend(refused.map(|phrase| (tokens[place].line, phrase.join(" "))));
        }
    }
    found
}

fn tokens(text: &str) -> Vec<Token> {
    let mut tokens: Vec<Token> = Vec::new();
    let mut line = 0;
    let mut before = String::new();
    let mut word = String::new();
    for letter in text.chars().chain([' ']) {
        if letter.is_alphanumeric() || (!word.is_empty() && ['-', '\'', '_'].contains(&letter)) {
            word.extend(letter.to_lowercase());
            continue;
        }
        if !word.is_empty() {
            tokens.push(Token {
                text: std::mem::take(&mut word),
                line,
                before: std::mem::take(&mut before),
            });
        }
        before.push(letter);
        line += usize::from(letter == '\n');
    }
    tokens
}

fn is_at(tokens: &[Token], place: usize, phrase: &[String]) -> bool {
    let Some(there) = tokens.get(place..place + phrase.len()) else { return false };
    let is_joined = |token: &Token| token.before.trim_matches(['*', '_']).trim().is_empty();
    let is_phrase = there.iter().zip(phrase).all(|(token, word)| token.text == *word);
    is_phrase && there.iter().skip(1).all(is_joined)
}

fn is_excepted(tokens: &[Token], place: usize, phrase: &[String], word: &Word) -> bool {
    let before = tokens[place].before.trim();
    let begins = place == 0 || before.ends_with(['.', ':', ';', '|', '?', '(', '…', '-', '–', '*']);
    let is_within = |exception: &Vec<String>| {
        let starts = (0..exception.len()).filter(|start| exception[*start..].starts_with(phrase));
        let mut starts = starts.filter_map(|start| place.checked_sub(start));
        starts.any(|start| is_at(tokens, start, exception))
    };
    (word.may_begin && begins) || word.except.iter().any(is_within)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn found(text: &str) -> Vec<String> {
        let phrases = |list: &[&str]| {
            list.iter().map(|text| text.split(' ').map(str::to_owned).collect()).collect()
        };
        let word = |refuse: &[&str], except: &[&str], may_begin| Word {
            refuse: phrases(refuse),
            except: phrases(except),
            may_begin,
        };
        let words = vec![
            word(&["is no"], &["there is no", "is no longer"], false),
            word(&["otherwise"], &[], true),
        ];
        let rules = Rules { words, ceiling: toml::Table::new() };
        found_in(&rules, text).into_iter().map(|(line, word)| format!("{line} {word}")).collect()
    }

    #[test]
    fn phrase_goes_on_in_the_next_line() {
        assert_eq!(found("a sub\nThis is\nno sub."), ["1 is no"]);
    }

    #[test]
    fn exceptions_cover_the_words_around_a_phrase() {
        assert!(found("There is no sub; it is no longer there. It is. No sub.").is_empty());
    }

    #[test]
    fn word_may_begin_a_clause() {
        assert_eq!(found("Otherwise none; otherwise two. Done otherwise."), ["0 otherwise"]);
    }

    #[test]
    fn part_of_a_word_is_not_the_word() {
        assert!(found("This no-one knows; otherwise-named").is_empty());
    }
}
