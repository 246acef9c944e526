//! A call in progress: its parameters, its saved state, its open conditions and loops.

use std::collections::{BTreeMap, BTreeSet};

use crate::rs274::modes::SavedState;
use crate::rs274::syntax::Keyword;
use crate::rs274::text::Place;

/// A call in progress, or the main program.
#[derive(Clone, Debug, Default)]
pub struct Frame {
    /// Local named parameters, by name without the marks.
    pub locals: BTreeMap<String, f64>,
    /// Parameters #1 to #30.
    pub arguments: [f64; 30],
    /// What M70 or M73 saved last at this level.
    pub saved: Option<SavedState>,
    /// What M70 saved last at this level.
    pub saved_by_m70: Option<SavedState>,
    /// What M73 saved at this level, to be restored when it is left.
    pub restore_at_return: Option<SavedState>,
    /// The call that made it; none for the main program.
    pub call: Option<Call>,
    /// Conditions and loops in progress, innermost last.
    pub open: Vec<Open>,
    /// Labels of conditions that have ended.
    pub ended_conditions: BTreeSet<String>,
    /// Loops that have ended by label: the keyword with which each began, and its line.
    pub ended_loops: BTreeMap<String, (Keyword, u32)>,
}

/// How a frame was called, and what comes when it is left.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Call {
    /// Number or name of the sub.
    pub label: String,
    /// The block after the call.
    pub back: Place,
    /// By an O-word or by M98.
    pub style: Style,
}

/// The two styles of subroutines, which do not mix.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Style {
    /// `o100 call`: begun by sub, ended by endsub.
    OWord,
    /// M98: begun by its number alone, ended by M99.
    Numbered {
        /// Its first block.
        first: Place,
        /// How many turns follow this one.
        turns_left: u64,
    },
}

/// A condition or loop in progress.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Open {
    /// Its label.
    pub label: String,
    /// Line of its first block.
    pub line: u32,
    /// What it is.
    pub structure: Structure,
}

/// Conditions and loops.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Structure {
    /// `if`.
    If {
        /// Whether one of its branches was taken.
        taken: bool,
    },
    /// `while` … `endwhile`.
    While,
    /// `do` … `while`.
    Do,
    /// `repeat`.
    Repeat {
        /// How many turns follow this one.
        turns_left: u64,
    },
}

impl Structure {
    /// The keyword with which it begins.
    pub fn head(self) -> Keyword {
        match self {
            Self::If { .. } => Keyword::If,
            Self::While => Keyword::While,
            Self::Do => Keyword::Do,
            Self::Repeat { .. } => Keyword::Repeat,
        }
    }

    /// The keyword with which it ends.
    pub fn end(self) -> Keyword {
        match self {
            Self::If { .. } => Keyword::EndIf,
            Self::While => Keyword::EndWhile,
            Self::Do => Keyword::While,
            Self::Repeat { .. } => Keyword::EndRepeat,
        }
    }
}

impl Frame {
    /// Nothing is saved at this level any more.
    pub fn forget_saved(&mut self) {
        self.saved = None;
        self.saved_by_m70 = None;
        self.restore_at_return = None;
    }

    /// A condition or loop ends.
    pub fn end(&mut self, open: Open) {
        if matches!(open.structure, Structure::If { .. }) {
            self.ended_conditions.insert(open.label);
        } else {
            self.ended_loops.insert(open.label, (open.structure.head(), open.line));
        }
    }

    /// Whether a condition or loop with this label has begun in this call.
    pub fn has_met(&self, label: &str) -> bool {
        self.open.iter().any(|open| open.label == label)
            || self.ended_conditions.contains(label)
            || self.ended_loops.contains_key(label)
    }

    /// Whether it is a sub that ends with endsub.
    pub fn is_sub(&self) -> bool {
        self.call.as_ref().is_some_and(|call| call.style == Style::OWord)
    }

    /// Whether it is a numbered subprogram, which shares its caller's parameters.
    pub fn shares_parameters(&self) -> bool {
        self.call.is_some() && !self.is_sub()
    }

    /// The first line of the numbered subprogram that it is a call of.
    pub fn numbered_line(&self) -> Option<u32> {
        match self.call.as_ref().map(|call| &call.style) {
            Some(Style::Numbered { first, .. }) => Some(first.line),
            Some(Style::OWord) | None => None,
        }
    }

    /// Whether it is a call of this sub.
    pub fn is_called(&self, label: &str) -> bool {
        self.call.as_ref().is_some_and(|call| call.label == label)
    }

    /// Whether a branch was taken of the innermost open condition with this label.
    pub fn open_condition(&mut self, label: &str) -> Option<&mut bool> {
        self.open.iter_mut().rev().find_map(|open| match &mut open.structure {
            Structure::If { taken } => (open.label == label).then_some(taken),
            Structure::While | Structure::Do | Structure::Repeat { .. } => None,
        })
    }

    /// Place in `open` of the innermost condition or loop with a label that satisfies `kind`.
    pub fn find_open(&self, label: &str, kind: impl Fn(Structure) -> bool) -> Option<usize> {
        self.open.iter().rposition(|open| open.label == label && kind(open.structure))
    }
}
