//! What makes a comment active.

use crate::Choices;
use crate::ids::{Rule, choice, rule};

/// What an active comment does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Active {
    /// MSG: display a text.
    Message,
    /// DEBUG: display a text with values.
    Debug,
    /// PRINT: print a text with values.
    Print,
    /// LOG: write a text with values into the log file.
    Log,
    /// LOGOPEN: begin a log file.
    LogOpen,
    /// LOGAPPEND: go on with a log file.
    LogAppend,
    /// LOGCLOSE.
    LogClose,
    /// PROBEOPEN: begin a file for probed points.
    ProbeOpen,
    /// PROBECLOSE.
    ProbeClose,
    /// ABORT: end the program with an error.
    Abort,
}

impl Active {
    /// The rule that states what it does.
    pub(super) fn rule(self) -> Rule {
        match self {
            Self::Message => rule::active_comments::MSG,
            Self::Debug => rule::active_comments::DEBUG,
            Self::Print => rule::active_comments::PRINT,
            Self::Log => rule::active_comments::LOG,
            Self::LogOpen | Self::LogAppend | Self::LogClose => rule::active_comments::LOG_OPEN,
            Self::ProbeOpen | Self::ProbeClose => rule::active_comments::PROBE_LOG,
            Self::Abort => rule::active_comments::ABORT,
        }
    }
}

/// Keywords that a comma and a text follow.
const WITH_TEXT: [(&str, Active); 7] = [
    ("msg", Active::Message),
    ("debug", Active::Debug),
    ("print", Active::Print),
    ("log", Active::Log),
    ("logopen", Active::LogOpen),
    ("logappend", Active::LogAppend),
    ("abort", Active::Abort),
];

/// What an active comment does and its text; `None` for a plain one.
///
/// Rule active-comments.msg-spelling. MSG may have blanks within and before it and lower case letters; the other
/// keywords are read in the same way. Choice active-comments.msg-without-comma: whether MSG without a comma is a
/// message.
pub(super) fn active<'a>(comment: &'a str, choices: &Choices) -> Option<(Active, &'a str)> {
    if let Some((before, text)) = comment.split_once(',') {
        let keyword = choices.dialect().keyword(before, choices);
        if let Some((_, active)) = WITH_TEXT.iter().find(|(known, _)| *known == keyword) {
            return Some((*active, text));
        }
    }
    if spelled(comment) == "logclose" {
        return Some((Active::LogClose, ""));
    }
    if spelled(comment) == "probeclose" {
        return Some((Active::ProbeClose, ""));
    }
    if let Some(file) = text_after(comment, "probeopen") {
        return Some((Active::ProbeOpen, file));
    }
    if choices.is(choice::active_comments::MsgWithoutComma::Message) {
        return text_after(comment, "msg").map(|text| (Active::Message, text));
    }
    None
}

/// Whether a comment contains MSG and a comma after other printing characters.
pub(super) fn has_msg_inside(comment: &str) -> bool {
    spelled(comment).contains("msg,")
}

/// A keyword without its blanks and in lower case.
pub(super) fn spelled(text: &str) -> String {
    text.chars()
        .filter(|character| !is_blank(*character))
        .map(|character| character.to_ascii_lowercase())
        .collect()
}

/// The text after a keyword at the beginning of a comment; blanks between its letters are ignored.
fn text_after<'a>(comment: &'a str, keyword: &str) -> Option<&'a str> {
    let mut rest = comment;
    for wanted in keyword.chars() {
        rest = rest.trim_start_matches(is_blank);
        let next = rest.chars().next().filter(|next| next.to_ascii_lowercase() == wanted)?;
        rest = &rest[next.len_utf8()..];
    }
    Some(rest)
}

/// Spaces and tabs are blanks; other control characters are not.
pub(super) fn is_blank(character: char) -> bool {
    matches!(character, ' ' | '\t')
}
