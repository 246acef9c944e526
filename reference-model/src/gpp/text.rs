//! Words, numbers, texts and signs of a program, each with its line. Comments are gone here.

use gaugeblock_vocabulary::FaultKind;

/// Most characters of a text.
pub const LONGEST_TEXT: usize = 256;
/// Most characters of a number.
pub const LONGEST_NUMBER: usize = 40;

/// Signs, longer ones first: `<=` is one sign, and `< =` are two.
const SIGNS: &[&str] = &[
    "==", "!=", "<=", ">=", "&&", "||", "=", "<", ">", "(", ")", "[", "]", ";", ":", "+", "-", "*",
    "/", "!", "#", "$", "%", "&", "@", "?", "^", "~",
];

/// A part of a program.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Token {
    /// Letters, digits and underscores, in capitals.
    Word(String),
    /// A number as it is written.
    Number(String),
    /// What begins with a digit and is no number, in capitals: a word of a heading, such as `3D`, and nothing else.
    HeadingWord(String),
    /// What stands between double quotes.
    Text(String),
    /// One of the signs.
    Sign(&'static str),
    /// `\J`.
    LineFeed,
    /// What is none of these; refused by the statement that comes to it.
    Bad(FaultKind, String),
    /// The end of the program.
    End,
}

/// A part and its place.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Placed {
    /// The part.
    pub token: Token,
    /// Its line, from 1.
    pub line: u32,
    /// Whether it is the first of its line.
    pub begins_line: bool,
}

/// The parts of a program in order; the last is its end.
pub fn tokens(program: &str) -> Vec<Placed> {
    let mut all = Vec::new();
    let mut last_line = 1;
    for (text, line) in program.lines().zip(1_u32..) {
        last_line = line;
        if text.starts_with('*') {
            continue;
        }
        let mut rest = text.trim_start_matches([' ', '\t']);
        let mut begins_line = true;
        while !rest.is_empty() && !rest.starts_with("//") {
            let (token, length) = token(rest);
            all.push(Placed { token, line, begins_line });
            begins_line = false;
            rest = rest[length..].trim_start_matches([' ', '\t']);
        }
    }
    all.push(Placed { token: Token::End, line: last_line, begins_line: true });
    all
}

/// The part with which a text begins, and its length in bytes.
fn token(text: &str) -> (Token, usize) {
    let run = |belongs: fn(char) -> bool| text.find(|c| !belongs(c)).unwrap_or(text.len());
    match text.chars().next() {
        Some('"') => quoted(text),
        Some('\\') if text[1..].starts_with(['J', 'j']) => (Token::LineFeed, 2),
        Some(c) if c.is_ascii_alphabetic() || c == '_' => {
            let length = run(|c| c.is_ascii_alphanumeric() || c == '_');
            (Token::Word(text[..length].to_ascii_uppercase()), length)
        }
        Some(c) if c.is_ascii_digit() || c == '.' => {
            let length = run(|c| c.is_ascii_alphanumeric() || c == '_' || c == '.');
            (beginning_with_a_digit(&text[..length]), length)
        }
        first => match SIGNS.iter().find(|sign| text.starts_with(**sign)) {
            Some(sign) => (Token::Sign(sign), sign.len()),
            None => {
                let c = first.unwrap_or_default();
                let message = format!("this character belongs nowhere: {}", c.escape_default());
                (Token::Bad(FaultKind::BadCharacter, message), c.len_utf8())
            }
        },
    }
}

fn quoted(text: &str) -> (Token, usize) {
    let Some(length) = text[1..].find('"') else {
        let message = "a text that is not closed in its line".to_owned();
        return (Token::Bad(FaultKind::BadCharacter, message), text.len());
    };
    let inner = &text[1..=length];
    if inner.chars().count() > LONGEST_TEXT {
        let message = format!("a text has {LONGEST_TEXT} characters at most");
        return (Token::Bad(FaultKind::TextTooLong, message), length + 2);
    }
    (Token::Text(inner.to_owned()), length + 2)
}

/// A number, or a word of a heading such as `3D`.
fn beginning_with_a_digit(text: &str) -> Token {
    if is_number(text) {
        Token::Number(text.to_owned())
    } else if !text.contains('.') {
        Token::HeadingWord(text.to_ascii_uppercase())
    } else {
        Token::Bad(FaultKind::BadNumber, no_number(text))
    }
}

/// What is said of a text that is no number.
pub fn no_number(text: &str) -> String {
    format!("not a number: {text}")
}

/// Whether a text is `digits[.digits]` or `.digits`.
pub fn is_number(text: &str) -> bool {
    let (whole, fraction) = text.split_once('.').unwrap_or((text, "0"));
    let digits = |text: &str| text.chars().all(|c| c.is_ascii_digit());
    let whole_stands = !whole.is_empty() || text.starts_with('.');
    digits(whole)
        && digits(fraction)
        && whole_stands
        && !fraction.is_empty()
        && text.len() <= LONGEST_NUMBER
}
