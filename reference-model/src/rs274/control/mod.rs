//! Which block comes next: O-words, calls, M98 and M99.
//!
//! | room | what it settles |
//! | --- | --- |
//! | [`files`] | the files of the program, each with its labels |
//! | [`labels`] | where each label is written, and in which sub |
//! | [`values`] | the label and the values of an O-word, evaluated |
//! | [`subs`] | sub, endsub, return, call |
//! | [`conditions`] | if, elseif, else, endif |
//! | [`loops`] | while, do, repeat, break, continue |
//! | [`numbered`] | Fanuc-style programs: M98, M99 |
//!
//! Errors arise when a block is reached. Skipped blocks are only searched for labels.

mod conditions;
mod files;
pub(crate) mod labels;
pub(crate) mod loops;
pub(crate) mod numbered;
pub(crate) mod subs;
mod values;

use std::collections::{BTreeMap, BTreeSet};

use gaugeblock_vocabulary::{End, FaultKind, Program};

pub use super::state::{Call, Frame, Open, Structure, Style};
pub use super::text::Place;
pub(crate) use conditions::ConditionRules;
pub use files::{ENTRIES, Files};
pub(crate) use loops::LoopRules;
pub(crate) use numbered::NumberedRules;
pub(crate) use subs::SubroutineRules;
use values::{condition, evaluated, single};
pub(crate) use values::{label_of, o_word};

use super::evaluate::Words;
use super::parameters::Name;
use super::refusal::{StepError, refuse};
use super::state::State;
use super::syntax::{Block, Keyword, Label, OWord};
use super::task::Record;
use crate::dialects::ControlMemory;
use crate::ids::{choice, rule};

/// What a search further on in a file looks for.
#[derive(Clone, Copy, Debug)]
#[cfg_attr(
    not(feature = "dialects"),
    expect(dead_code, reason = "by the documents, what is passed over does not depend on it")
)]
pub(crate) enum SearchTarget<'a> {
    /// The next branch or the end of a condition or loop.
    Structure {
        /// Its label.
        label: &'a str,
        /// What it may end with, or go on with.
        ends: &'a [Keyword],
    },
    /// The endsub of the sub that is defined.
    EndSub {
        /// The label of that sub.
        label: &'a str,
    },
    /// A sub that is called.
    Called {
        /// Its label.
        label: &'a str,
        /// The arguments that are passed to it.
        arguments: &'a [f64],
    },
    /// A numbered program that is called.
    Numbered {
        /// Its number.
        label: &'a str,
    },
}

/// The rules of searches for labels that a controller's dialect may replace.
pub(crate) trait ControlRules {
    /// Passes over the lines between the current block and the target of a search. By the documents nothing in them is
    /// refused. `_end` is the line of the target, if the search found it.
    fn pass_over(
        &self,
        _control: &mut Control,
        _target: SearchTarget<'_>,
        _end: Option<u32>,
        _state: &mut State,
    ) -> Result<(), StepError> {
        Ok(())
    }

    /// Rule control.missing-end. Line of the next block after `after` in this sub that ends a condition or loop, or
    /// goes on with it.
    fn end_further_on(
        &self,
        control: &Control,
        label: &str,
        keywords: &[Keyword],
        after: u32,
        state: &mut State,
    ) -> Option<u32> {
        control.find(label, keywords, after, state)
    }

    /// Whether, between two lines, a sub begins or ends whose number must be computed. The documents then do not say
    /// where the sub ends.
    fn has_computed_subs(&self, control: &Control, after: u32, until: u32, _state: &State) -> bool {
        control.files.labels(control.place.file).computed_between(after, until)
    }
}

/// The main program among the files.
pub const MAIN: usize = 0;

/// The current block, and the subs and labels that the run has met.
#[derive(Clone, Debug)]
pub struct Control {
    /// The files of the program.
    pub files: Files,
    /// The current block. If the run ends with a fault, this is the block of the fault.
    pub place: Place,
    /// The subs defined so far, by number or name: the block with the keyword `sub`.
    pub(crate) subs: BTreeMap<String, Place>,
    /// The block that defined each label first, by file, scope and label.
    defined: BTreeMap<(usize, usize, String), u32>,
    /// Numbered subprograms that were called before.
    pub(crate) called: BTreeSet<Place>,
    /// What the dialect remembers; nothing by the documents.
    #[cfg_attr(not(feature = "dialects"), expect(dead_code, reason = "only a dialect reads it"))]
    pub(crate) memory: ControlMemory,
    /// Whether a block with words, or an O-word that does something, was executed.
    begun: bool,
    /// Whether the program has ended, and what is executed now was entered by hand.
    program_is_over: bool,
}

/// Which block comes next.
#[derive(Clone, Debug, PartialEq)]
pub enum Next {
    /// The one after this.
    Following,
    /// Another one.
    At(Place),
    /// None.
    End(End),
}

impl Control {
    /// At the first block of the main program.
    pub fn new(program: &Program, state: &mut State) -> Self {
        let mut files = Files::new(program);
        let place = files.begin_main(&program.main, state);
        Self {
            files,
            place,
            subs: BTreeMap::new(),
            defined: BTreeMap::new(),
            called: BTreeSet::new(),
            memory: ControlMemory::default(),
            begun: false,
            program_is_over: false,
        }
    }

    /// What is executed from here on was entered by hand; `place` is its first block.
    pub fn begin_by_hand(&mut self, place: Place) {
        self.place = place;
        self.program_is_over = true;
    }

    /// A block without control: a numbered program cannot begin after it.
    pub fn begin(&mut self, words: &Words) {
        let empty = words.g_tenths.is_empty() && words.m.is_empty() && words.letters.is_empty();
        self.begun |= !empty || !words.settings.is_empty();
    }

    /// Rule control.unrelated-words. An O-word stands alone on its line; a line number is no word.
    ///
    /// Rule control.comment-after. A comment may follow it and changes nothing, not even when it is an active one. The
    /// title of a numbered program is a comment of its own kind.
    ///
    /// Rule control.named-labels. A label of a condition or loop may be a name instead of a number.
    ///
    /// # Errors
    /// The rule that refuses the block.
    pub fn o_word(
        &mut self,
        block: &Block,
        word: &OWord,
        state: &mut State,
        record: &mut Record,
    ) -> Result<Next, StepError> {
        if !block.words.is_empty() || !block.settings.is_empty() {
            let message = "other words on the line of an o-word";
            return Err(refuse(rule::control::UNRELATED_WORDS, FaultKind::BadBlock, message));
        }
        if block.line_number.is_some() {
            state.coverage.accepted(rule::control::UNRELATED_WORDS);
        }
        if block.comment.is_some() && word.keyword != Keyword::ProgramNumber {
            if state.choices.is(choice::control::CommentAfterOWord::Refused) {
                let message = "a comment on the line of an o-word";
                return Err(refuse(rule::control::COMMENT_AFTER, FaultKind::BadBlock, message));
            }
            state.coverage.accepted(rule::control::COMMENT_AFTER);
        }
        if matches!(word.label, Label::Name(_)) && !of_subs(word.keyword) {
            state.coverage.accepted(rule::control::NAMED_LABELS);
        }
        let label = label_of(&word.label, state)?;
        let next = self.perform(&label, word, state, record)?;
        self.begun |= word.keyword != Keyword::Sub;
        Ok(next)
    }

    fn perform(
        &mut self,
        label: &str,
        word: &OWord,
        state: &mut State,
        record: &mut Record,
    ) -> Result<Next, StepError> {
        let values = &word.arguments;
        match word.keyword {
            Keyword::Sub => state.dialect().define_sub(self, label, state),
            Keyword::EndSub => self.end_sub(label, values, state, record),
            Keyword::Return => state.dialect().return_from(self, label, values, state, record),
            Keyword::Call => self.call(label, word, state),
            Keyword::ProgramNumber => self.program_number(state),
            Keyword::If => self.if_(label, values, state),
            Keyword::ElseIf => self.else_if(label, values, state),
            Keyword::Else => self.else_(label, state),
            Keyword::EndIf => self.end_if(label, state),
            Keyword::While => self.while_(label, values, state),
            Keyword::EndWhile => self.end_while(label, state),
            Keyword::Do => self.do_(label, state),
            Keyword::Repeat => self.repeat(label, values, state),
            Keyword::EndRepeat => self.end_repeat(label, state),
            Keyword::Break => self.break_(label, state),
            Keyword::Continue => self.continue_(label, state),
        }
    }

    /// Line of the next block after `after` in this sub that has the label and one of the keywords.
    pub(crate) fn find(
        &self,
        label: &str,
        keywords: &[Keyword],
        after: u32,
        state: &mut State,
    ) -> Option<u32> {
        self.files.labels(self.place.file).find(label, keywords, after, self.place.line, state)
    }

    /// A line of the current file.
    pub(crate) fn line(&self, line: u32) -> Place {
        Place { file: self.place.file, line }
    }

    /// Rule control.missing-end. What is skipped must have its end further on, within its sub.
    ///
    /// Two cases stay unspecified: which blocks belong to a skipped sub without endsub, and when the number of a
    /// skipped sub or endsub is computed.
    pub(crate) fn end_of_skipped(
        &mut self,
        label: &str,
        keywords: &[Keyword],
        after: u32,
        state: &mut State,
    ) -> Result<u32, StepError> {
        let dialect = state.dialect();
        let end = dialect.end_further_on(self, label, keywords, after, state);
        let target = SearchTarget::Structure { label, ends: keywords };
        dialect.pass_over(self, target, end, state)?;
        let labels = self.files.labels(self.place.file);
        if end.is_none() && labels.ends_in_program(label, keywords, after, state) {
            let why =
                format!("{} continues after the beginning of a numbered program", o_word(label));
            return Err(StepError::Unspecified(why));
        }
        if end.is_some_and(|end| labels.unended_between(after, end)) {
            let why = "what a sub without its end holds, where it is skipped".to_owned();
            return Err(StepError::Unspecified(why));
        }
        let until = end.or((state.call_level() == 0).then_some(u32::MAX)).unwrap_or_default();
        if dialect.has_computed_subs(self, after, until, state) {
            let why = "where a sub ends that is skipped, with a number that must be computed";
            return Err(StepError::Unspecified(why.to_owned()));
        }
        end.ok_or_else(|| {
            let message = format!("{} has no end further on", o_word(label));
            refuse(rule::control::MISSING_END, FaultKind::MissingEnd, message)
        })
    }
}

/// Whether a keyword is one of subs: not of conditions and loops.
fn of_subs(keyword: Keyword) -> bool {
    use Keyword::{Call, EndSub, ProgramNumber, Return, Sub};
    matches!(keyword, Sub | EndSub | Call | Return | ProgramNumber)
}

/// Evaluated settings take effect; the block's own expressions were evaluated before.
///
/// # Errors
/// A parameter that cannot be set.
pub fn assign(settings: &[(Name, f64)], state: &mut State) -> Result<(), StepError> {
    settings.iter().try_for_each(|(name, value)| super::parameters::assign(name, *value, state))
}
