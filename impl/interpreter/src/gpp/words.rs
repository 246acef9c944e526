//! Words that mean something by themselves.

use super::formats;

/// A comparison.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Compare {
    Equal,
    NotEqual,
    Less,
    LessOrEqual,
    Greater,
    GreaterOrEqual,
}

impl Compare {
    /// The comparison of a sign.
    pub(super) fn of_sign(sign: &str) -> Option<Self> {
        Some(match sign {
            "==" => Self::Equal,
            "!=" => Self::NotEqual,
            "<" => Self::Less,
            "<=" => Self::LessOrEqual,
            ">" => Self::Greater,
            ">=" => Self::GreaterOrEqual,
            _ => return None,
        })
    }

    /// Whether it is one of order.
    pub(super) fn is_of_order(self) -> bool {
        !matches!(self, Self::Equal | Self::NotEqual)
    }

    /// The result for two numbers.
    #[expect(clippy::float_cmp, reason = "both were rounded, and are compared as they are printed")]
    pub(super) fn holds(self, left: f64, right: f64) -> bool {
        match self {
            Self::Equal => left == right,
            Self::NotEqual => left != right,
            Self::Less => left < right,
            Self::LessOrEqual => left <= right,
            Self::Greater => left > right,
            Self::GreaterOrEqual => left >= right,
        }
    }
}

/// A word of the language.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Keyword {
    Format,
    Modal,
    NonModal,
    Identical,
    NewLineIs,
    Output,
    Print,
    SetOn,
    SetOff,
    Reset,
    If,
    IfSet,
    Else,
    EndIf,
    Repeat,
    Until,
    VarSet,
    VarNotSet,
    AllVar,
    Compare(Compare),
}

/// The keyword that a word in capitals is.
pub(super) fn keyword(word: &str) -> Option<Keyword> {
    Some(match word {
        "FORMAT" => Keyword::Format,
        "MODAL" => Keyword::Modal,
        "NON_MODAL" => Keyword::NonModal,
        "IDENTICAL" => Keyword::Identical,
        "NEW_LINE_IS" => Keyword::NewLineIs,
        "OUTPUT" => Keyword::Output,
        "PRINT" => Keyword::Print,
        "SET_ON" => Keyword::SetOn,
        "SET_OFF" => Keyword::SetOff,
        "RESET" => Keyword::Reset,
        "IF" => Keyword::If,
        "IF_SET" => Keyword::IfSet,
        "ELSE" => Keyword::Else,
        "END_IF" => Keyword::EndIf,
        "REPEAT" => Keyword::Repeat,
        "UNTIL" => Keyword::Until,
        "VAR_SET" => Keyword::VarSet,
        "VAR_NOTSET" => Keyword::VarNotSet,
        "ALL_VAR" => Keyword::AllVar,
        "_EQ_" => Keyword::Compare(Compare::Equal),
        "_NE_" => Keyword::Compare(Compare::NotEqual),
        "_LT_" => Keyword::Compare(Compare::Less),
        "_LE_" => Keyword::Compare(Compare::LessOrEqual),
        "_GT_" => Keyword::Compare(Compare::Greater),
        "_GE_" => Keyword::Compare(Compare::GreaterOrEqual),
        _ => return printing(word),
    })
}

/// PRINT0 to PRINT10.
fn printing(word: &str) -> Option<Keyword> {
    let number = word.strip_prefix("PRINT")?;
    let single = number.len() == 1 && number.bytes().all(|byte| byte.is_ascii_digit());
    (single || number == "10").then_some(Keyword::Print)
}

/// Whether a word in capitals can be no variable's name.
pub(super) fn is_taken(word: &str) -> bool {
    keyword(word).is_some() || formats::named(word).is_some()
}
