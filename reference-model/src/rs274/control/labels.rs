//! Where each label is written, and in which sub.
//!
//! Rule control.labels-in-subs. A label of a condition or loop is known in its sub only. There is a scope for each sub,
//! one for each numbered program, and one for the blocks outside of them. A file is read once for its labels, so that a
//! jump costs a look-up.

use std::collections::{BTreeMap, BTreeSet};

use super::values::label_of;
use crate::rs274::state::State;
use crate::rs274::syntax::{self, Expression, Keyword, Label};

/// The labels of one file.
#[derive(Clone, Debug, Default)]
pub(crate) struct Labels {
    /// Every O-word, in the order of the text.
    pub(crate) marks: Vec<Mark>,
    /// The scope that begins at a line.
    scopes: Vec<(u32, usize)>,
    /// Places in `marks` by scope and label.
    by_label: BTreeMap<(usize, String), Vec<usize>>,
    /// Places in `marks` of those whose label must be computed, by scope.
    computed: BTreeMap<usize, Vec<usize>>,
    definitions: BTreeMap<(usize, String), Vec<Definition>>,
    /// The scopes that define a label.
    definers: BTreeMap<String, BTreeSet<usize>>,
    /// Lines with the keyword sub, by label.
    subs: BTreeMap<String, Vec<u32>>,
    /// Lines of the subs without an end.
    unended: Vec<u32>,
    /// Lines with a number alone, by number.
    numbers: BTreeMap<String, Vec<u32>>,
    /// Lines with a number alone inside a sub.
    numbers_in_subs: BTreeSet<u32>,
    /// Last line of each sub whose end depends on a computed label, by the line of its head; known once the sub is
    /// defined.
    ends: BTreeMap<u32, u32>,
}

/// An O-word.
#[derive(Clone, Debug)]
pub(crate) struct Mark {
    /// Its line.
    pub(crate) line: u32,
    /// None when it must be computed.
    pub(crate) label: Option<String>,
    written: Label,
    /// What it does.
    pub(crate) keyword: Keyword,
    scope: usize,
}

/// What defines a label.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Definition {
    pub(super) line: u32,
    pub(super) keyword: Keyword,
}

impl Mark {
    /// Whether it has this label. A label that must be computed is computed with the current parameters.
    pub(crate) fn has(&self, label: &str, state: &mut State) -> bool {
        match &self.label {
            Some(own) => own == label,
            None => label_of(&self.written, state).is_ok_and(|own| own == label),
        }
    }
}

impl Labels {
    /// Takes the O-word of a line, if it has one.
    pub(super) fn read_line(&mut self, line: u32, text: &str, state: &mut State) {
        if let Some(word) = syntax::mark_of(text, state) {
            let Some(label) = written_label(&word.label, state) else { return };
            let (written, keyword) = (word.label, word.keyword);
            self.marks.push(Mark { line, label, written, keyword, scope: 0 });
        }
    }

    /// Gives each mark its scope: the blocks between a sub and its endsub are one, and so are those after a program's
    /// number. A sub without endsub has no scope.
    pub(super) fn finish(&mut self) {
        let (marks, ends) = (std::mem::take(&mut self.marks), std::mem::take(&mut self.ends));
        *self = Self { marks, ends, ..Self::default() };
        self.scopes.push((0, 0));
        let ends = Ends::of(&self.marks);
        let (mut outer, mut scopes) = (0, 1);
        let mut sub: Option<(u32, usize)> = None;
        for mark in &mut self.marks {
            mark.scope = sub.as_ref().map_or(outer, |(_, scope)| *scope);
            match (mark.keyword, &sub) {
                (Keyword::Sub, None) => {
                    let known = self.ends.get(&mark.line).copied();
                    let Some(end) = known.or_else(|| ends.of_sub(mark)) else {
                        self.unended.push(mark.line);
                        continue;
                    };
                    sub = Some((end, scopes));
                    self.scopes.push((mark.line + 1, scopes));
                    scopes += 1;
                }
                (Keyword::EndSub, Some((end, _))) if *end == mark.line => {
                    sub = None;
                    self.scopes.push((mark.line + 1, outer));
                }
                (Keyword::ProgramNumber, None) => {
                    outer = scopes;
                    mark.scope = outer;
                    self.scopes.push((mark.line, outer));
                    scopes += 1;
                }
                (Keyword::ProgramNumber, Some(_)) => {
                    self.numbers_in_subs.insert(mark.line);
                }
                _ => {}
            }
        }
        self.sort();
    }

    fn sort(&mut self) {
        let mut in_do = BTreeSet::new();
        for (place, mark) in self.marks.iter().enumerate() {
            let Some(label) = &mark.label else {
                self.computed.entry(mark.scope).or_default().push(place);
                continue;
            };
            let key = (mark.scope, label.clone());
            let (line, keyword) = (mark.line, mark.keyword);
            if keyword == Keyword::Sub {
                self.subs.entry(label.clone()).or_default().push(line);
            } else if keyword == Keyword::ProgramNumber {
                self.numbers.entry(label.clone()).or_default().push(line);
            } else if defines(keyword, &key, &mut in_do) {
                self.definers.entry(label.clone()).or_default().insert(mark.scope);
                self.definitions.entry(key.clone()).or_default().push(Definition { line, keyword });
            }
            self.by_label.entry(key).or_default().push(place);
        }
    }

    /// Line of the endsub of a sub that is being defined: the first endsub after it that has its label. Labels that
    /// must be computed are computed now. From now on the blocks before that endsub belong to the sub.
    pub(super) fn end_of_defined(
        &mut self,
        label: &str,
        sub: u32,
        state: &mut State,
    ) -> Option<u32> {
        let from = self.marks.partition_point(|mark| mark.line <= sub);
        let later = self.marks[from..].iter().filter(|mark| mark.keyword == Keyword::EndSub);
        let end = later.clone().find(|mark| mark.has(label, state)).map(|mark| mark.line)?;
        let own = self.marks[..from].last().into_iter();
        let mut all = own.chain(later).filter(|mark| mark.line <= end);
        let computed = all.any(|mark| mark.label.is_none());
        if computed && self.ends.get(&sub) != Some(&end) {
            self.ends.insert(sub, end);
            self.finish();
        }
        Some(end)
    }

    /// The scope of a line.
    pub(super) fn scope(&self, line: u32) -> usize {
        let after = self.scopes.partition_point(|(first, _)| *first <= line);
        self.scopes[after - 1].1
    }

    /// Line of the next block after `after` with this label and one of these keywords, in the scope of line `at`.
    pub(super) fn find(
        &self,
        label: &str,
        keywords: &[Keyword],
        after: u32,
        at: u32,
        state: &mut State,
    ) -> Option<u32> {
        let scope = self.scope(at);
        let fits = |mark: &&Mark| mark.line > after && keywords.contains(&mark.keyword);
        let written = self.by_label.get(&(scope, label.to_owned())).and_then(|places| {
            let later = places.partition_point(|place| self.marks[*place].line <= after);
            places[later..].iter().map(|place| &self.marks[*place]).find(fits)
        });
        let computed = self.computed.get(&scope).and_then(|places| {
            let later = places.partition_point(|place| self.marks[*place].line <= after);
            let mut later = places[later..].iter().map(|place| &self.marks[*place]).filter(fits);
            later.find(|mark| label_of(&mark.written, state).is_ok_and(|found| found == label))
        });
        let lines = written.into_iter().chain(computed).map(|mark| mark.line);
        lines.min()
    }

    /// Whether a block with this label and one of these keywords is further on, after the beginning of a numbered
    /// program.
    pub(super) fn ends_in_program(
        &self,
        label: &str,
        keywords: &[Keyword],
        after: u32,
        state: &mut State,
    ) -> bool {
        let later = self.marks.iter().filter(|mark| mark.line > after);
        let behind = later.skip_while(|mark| mark.keyword != Keyword::ProgramNumber);
        behind.filter(|mark| keywords.contains(&mark.keyword)).any(|mark| mark.has(label, state))
    }

    /// The blocks that define a label in the scope of a line, in the order of the text: if, do, repeat, and a while
    /// that does not end a do.
    pub(super) fn definitions(&self, label: &str, at: u32) -> &[Definition] {
        let found = self.definitions.get(&(self.scope(at), label.to_owned()));
        found.map_or(&[], Vec::as_slice)
    }

    /// Whether several scopes define a label.
    pub(super) fn is_shared(&self, label: &str) -> bool {
        self.definers.get(label).is_some_and(|scopes| scopes.len() > 1)
    }

    /// Lines of the subs with a number or name.
    pub(super) fn subs(&self, label: &str) -> &[u32] {
        self.subs.get(label).map_or(&[], Vec::as_slice)
    }

    /// Lines of the numbered programs with a number.
    pub(crate) fn numbers(&self, label: &str) -> &[u32] {
        self.numbers.get(label).map_or(&[], Vec::as_slice)
    }

    /// Whether a numbered program begins inside a sub.
    pub(super) fn is_inside_sub(&self, number: u32) -> bool {
        self.numbers_in_subs.contains(&number)
    }

    /// Every sub of the file in order: its line, and its label where that is written out.
    pub(super) fn all_subs(&self) -> impl Iterator<Item = (u32, Option<&str>)> {
        let marks = self.marks.iter().filter(|mark| mark.keyword == Keyword::Sub);
        marks.map(|mark| (mark.line, mark.label.as_deref()))
    }

    /// Whether a sub without its end begins between two lines.
    pub(super) fn unended_between(&self, after: u32, before: u32) -> bool {
        self.unended.iter().any(|line| (after..before).contains(line))
    }

    /// Whether a sub begins or ends between two lines with a number that must be computed.
    pub(super) fn computed_between(&self, after: u32, before: u32) -> bool {
        self.marks.iter().any(|mark| {
            let of_sub = matches!(mark.keyword, Keyword::Sub | Keyword::EndSub);
            of_sub && mark.label.is_none() && after < mark.line && mark.line < before
        })
    }

    /// Line of the first sub that begins after a line, but not after another one.
    pub(super) fn sub_between(&self, after: u32, before: u32) -> Option<u32> {
        let from = self.marks.partition_point(|mark| mark.line <= after);
        let inside = self.marks[from..].iter().take_while(|mark| mark.line < before);
        let mut subs = inside.filter(|mark| mark.keyword == Keyword::Sub);
        subs.next().map(|mark| mark.line)
    }
}

/// The label of an O-word: `Some(None)` if it depends on parameters, `None` if it cannot be a label. No jump leads to
/// the latter.
fn written_label(label: &Label, state: &mut State) -> Option<Option<String>> {
    match label {
        Label::Name(name) => Some(Some(name.clone())),
        Label::Number(expression) if is_constant(expression) => {
            label_of(label, state).ok().map(Some)
        }
        Label::Number(_) => Some(None),
    }
}

/// Whether an expression has the same value wherever it is evaluated.
fn is_constant(expression: &Expression) -> bool {
    match expression {
        Expression::Number(_) => true,
        Expression::Parameter(_) | Expression::Exists(_) => false,
        Expression::Negate(inner) | Expression::Function(_, inner) => is_constant(inner),
        Expression::ArcTangent(first, second) | Expression::Binary(_, first, second) => {
            is_constant(first) && is_constant(second)
        }
    }
}

/// Lines of the endsubs of a file.
struct Ends {
    all: Vec<u32>,
    /// By their label, where that is written out.
    written: BTreeMap<String, Vec<u32>>,
    computed: Vec<u32>,
}

impl Ends {
    fn of(marks: &[Mark]) -> Self {
        let mut ends = Self { all: Vec::new(), written: BTreeMap::new(), computed: Vec::new() };
        for mark in marks.iter().filter(|mark| mark.keyword == Keyword::EndSub) {
            ends.all.push(mark.line);
            match &mark.label {
                Some(label) => ends.written.entry(label.clone()).or_default().push(mark.line),
                None => ends.computed.push(mark.line),
            }
        }
        ends
    }

    /// The line that ends a sub, by the text alone: the endsub with its label, else the next endsub whose label must be
    /// computed.
    fn of_sub(&self, sub: &Mark) -> Option<u32> {
        let next = |lines: &[u32]| {
            let after = lines.partition_point(|line| *line <= sub.line);
            lines.get(after).copied()
        };
        let Some(label) = &sub.label else { return next(&self.all) };
        let own = self.written.get(label).and_then(|lines| next(lines));
        own.or_else(|| next(&self.computed))
    }
}

/// Whether a keyword defines its label. A while that ends a do does not.
fn defines(
    keyword: Keyword,
    label: &(usize, String),
    in_do: &mut BTreeSet<(usize, String)>,
) -> bool {
    match keyword {
        Keyword::If | Keyword::Repeat => true,
        Keyword::Do => {
            in_do.insert(label.clone());
            true
        }
        Keyword::While => !in_do.remove(label),
        Keyword::Sub
        | Keyword::EndSub
        | Keyword::Call
        | Keyword::Return
        | Keyword::ElseIf
        | Keyword::Else
        | Keyword::EndIf
        | Keyword::EndWhile
        | Keyword::EndRepeat
        | Keyword::Break
        | Keyword::Continue
        | Keyword::ProgramNumber => false,
    }
}
