//! Writes a program block by block, from the statements of the table, with noise that means nothing.

use std::collections::BTreeSet;

use gaugeblock_vocabulary::Scenario;

use super::config::GeneratorConfig;
use super::entropy::Entropy;
use super::kind::StatementKind;
use super::mutate;
use super::readable::Readable;
use super::state::{State, Sub};

/// Room for the text of most programs.
const MOST_TEXT: usize = 1024;

/// Percentage of the kinds of statements that a program uses.
const KIND_PERCENT: u32 = 70;

/// Deepest nesting of loops, branches and subs.
const DEEPEST: u32 = 4;

/// A statement that the generator can write.
#[derive(Debug)]
pub struct Statement {
    /// Its name; [`GeneratorConfig::only`](super::GeneratorConfig::only) selects statements by the start of it.
    pub name: &'static str,
    /// Its kind.
    pub kind: StatementKind,
    /// How often it is chosen, in proportion to the others.
    pub weight: u32,
    /// Whether it is allowed in a state of the program.
    pub(crate) possible: fn(&State) -> bool,
    /// Writes it and updates the state.
    pub(crate) write: fn(&mut Writer<'_, '_>),
}

impl Statement {
    /// A statement that is allowed everywhere.
    pub(crate) const fn any(
        name: &'static str,
        kind: StatementKind,
        weight: u32,
        write: fn(&mut Writer<'_, '_>),
    ) -> Self {
        Self { name, kind, weight, possible: |_| true, write }
    }

    /// A statement that is allowed in some states.
    pub(crate) const fn when(
        name: &'static str,
        kind: StatementKind,
        weight: u32,
        possible: fn(&State) -> bool,
        write: fn(&mut Writer<'_, '_>),
    ) -> Self {
        Self { name, kind, weight, possible, write }
    }
}

/// How a program is spelled.
#[derive(Clone, Copy, Debug, Default)]
struct Manner {
    upper: bool,
    spread: bool,
    noisy: bool,
    wrong: u32,
}

/// A program that is being written.
#[derive(Debug)]
pub(crate) struct Writer<'d, 'b> {
    /// Where choices come from.
    pub(crate) entropy: &'d mut Entropy<'b>,
    /// What is known at this place.
    pub(crate) state: State,
    text: String,
    manner: Manner,
    /// The statements that may be written, each with the sum of the weights up to it.
    statements: Vec<(u32, &'static Statement)>,
    /// The kinds that were written.
    kinds: BTreeSet<StatementKind>,
    total: u32,
    left: u32,
    last_label: u32,
    after_end: String,
    /// The machine of the program, and the limits of the controllers.
    readable: (&'d Scenario, Option<Readable<'d>>),
}

impl<'d, 'b> Writer<'d, 'b> {
    /// Before the first block; `table` has the statements to choose from.
    pub(crate) fn new(
        entropy: &'d mut Entropy<'b>,
        config: &GeneratorConfig,
        table: &[&'static [Statement]],
        state: State,
        readable: (&'d Scenario, Option<Readable<'d>>),
    ) -> Self {
        let left = entropy.range(config.blocks.0, config.blocks.1);
        let sloppy = entropy.chance(config.mutated_programs);
        let manner = Manner {
            upper: entropy.chance(15),
            spread: entropy.chance(10),
            noisy: entropy.chance(30),
            wrong: if sloppy { config.mutated_blocks } else { 0 },
        };
        let mut total = 0;
        let with_sum = |statement: &'static Statement| {
            total += statement.weight;
            (total, statement)
        };
        let statements = chosen_statements(entropy, config, table, readable.1)
            .into_iter()
            .map(with_sum)
            .collect();
        let (text, after_end) = (String::with_capacity(MOST_TEXT), String::new());
        Self {
            entropy,
            state,
            text,
            manner,
            statements,
            kinds: BTreeSet::new(),
            total,
            left,
            last_label: 100,
            after_end,
            readable,
        }
    }

    /// The kinds of statements that were written.
    pub(crate) fn into_kinds(self) -> BTreeSet<StatementKind> {
        self.kinds
    }

    /// Writes a whole main program.
    pub(crate) fn main(&mut self) -> String {
        let percent = self.entropy.chance(4);
        if percent {
            self.text.push_str("%\n");
        }
        if self.entropy.chance(85) {
            self.written(Self::feed_first);
        }
        while self.left > 0 && !self.entropy.is_exhausted() {
            self.statement();
        }
        let end = *self.entropy.pick(&["m2", "m2", "m2", "m2", "m2", "m2", "m30", "m30"]);
        let open_end = percent && self.entropy.chance(50);
        if !(open_end || self.written(|writer| writer.block(end))) {
            self.block("m2");
        }
        let after_end = std::mem::take(&mut self.after_end);
        self.text.push_str(&after_end);
        if percent {
            self.text.push_str("%\n");
        }
        let text = std::mem::take(&mut self.text);
        if self.entropy.chance(3) { text.replace('\n', "\r\n") } else { text }
    }

    /// Writes a subroutine file that defines the sub of a name.
    pub(crate) fn sub_file(&mut self, name: &str, blocks: u32) -> String {
        self.left = blocks;
        self.text = format!("o<{name}> sub\n");
        self.state.in_sub = true;
        while self.left > 0 && !self.entropy.is_exhausted() {
            self.statement();
        }
        self.text.push_str(&format!("o<{name}> endsub\nm2\n"));
        std::mem::take(&mut self.text)
    }

    /// F first, so that feed moves are allowed.
    fn feed_first(&mut self) {
        let feed = self.within(1, 2000);
        self.block(format!("f{feed}"));
        self.state.feed = true;
    }

    /// A row of the table that is possible here.
    fn statement(&mut self) {
        for _ in 0..8 {
            let at = self.entropy.below(self.total);
            let place = self.statements.partition_point(|(sum, _)| *sum <= at);
            let Some(&(_, statement)) = self.statements.get(place) else { break };
            let too_deep = statement.kind.nests() && self.state.depth >= DEEPEST;
            let possible = (statement.possible)(&self.state) && !too_deep;
            if possible && self.written(statement.write) {
                self.kinds.insert(statement.kind);
                return;
            }
        }
        self.left = self.left.saturating_sub(1);
    }

    /// Writes a statement, and removes it if the controllers do not support it. Returns whether it stays.
    fn written(&mut self, write: impl FnOnce(&mut Self)) -> bool {
        // Nested statements are checked together with the outermost one.
        let Some(readable) = self.readable.1.take() else {
            write(self);
            return true;
        };
        let (state, left) = (self.state.clone(), self.left);
        let (text, after_end) = (self.text.len(), self.after_end.len());
        write(self);
        let added = |whole: &str, from: usize| whole.get(from..).unwrap_or_default().to_owned();
        let blocks = added(&self.text, text) + &added(&self.after_end, after_end);
        let is_readable = readable.has(self.readable.0, blocks);
        self.readable.1 = Some(readable);
        if !is_readable {
            (self.state, self.left) = (state, left);
            self.text.truncate(text);
            self.after_end.truncate(after_end);
        }
        is_readable
    }

    /// A body of a loop or branch, of a few statements; `times` is how often it may run.
    pub(crate) fn body(&mut self, few: u32) {
        let before = self.state.clone();
        self.state.depth += 1;
        self.state.nested = true;
        for _ in 0..self.entropy.range(0, few) {
            if self.left == 0 || self.entropy.is_exhausted() {
                break;
            }
            self.statement();
        }
        self.state.join(&before);
    }

    /// The body of a sub, with a call level of its own.
    pub(crate) fn sub_body(&mut self, few: u32) {
        let before = self.state.clone();
        self.state.forget_modes();
        self.state.names.retain(|name| name.starts_with('_'));
        self.state.saved = false;
        self.state.in_sub = true;
        self.state.nested = true;
        self.state.depth += 1;
        self.state.loops.clear();
        for _ in 0..self.entropy.range(0, few) {
            if self.left > 0 && !self.entropy.is_exhausted() {
                self.statement();
            }
        }
        self.state = before;
    }

    /// A program for M98. It is written after the end of the main program, so that it follows every call.
    pub(crate) fn numbered_program(&mut self) -> String {
        let label = self.new_label();
        let before = self.state.clone();
        let main = std::mem::take(&mut self.text);
        self.text = format!("o{label}\n");
        self.sub_body(4);
        self.text.push_str("m99\n");
        let program = std::mem::replace(&mut self.text, main);
        self.after_end.push_str(&program);
        self.state = before;
        let label = label.to_string();
        self.state.subs.push(Sub { label: label.clone(), numbered: true });
        label
    }

    /// Writes lines after the end of the main program.
    pub(crate) fn after_program_end(&mut self, lines: &str) {
        self.after_end.push_str(lines);
    }

    /// A label that nothing else has.
    pub(crate) fn new_label(&mut self) -> u32 {
        self.last_label += 1;
        self.last_label
    }

    /// Writes a block of words, with noise and perhaps something wrong.
    pub(crate) fn block(&mut self, words: impl Into<String>) {
        self.left = self.left.saturating_sub(1);
        let mut line = words.into();
        if self.manner.wrong > 0 && self.entropy.chance(self.manner.wrong) {
            line = mutate::mutated_block(&line, self.entropy);
        }
        if self.manner.noisy {
            match self.entropy.below(40) {
                0 | 1 => line.insert_str(0, &format!("n{} ", self.left)),
                2 => line.push_str(" (a comment)"),
                3 => line.push_str(" ; the rest"),
                4 => line.insert_str(0, "  "),
                5 => line.push('\t'),
                6 if self.entropy.chance(30) => line.insert(0, '/'),
                _ => {}
            }
        }
        self.write_line(&line);
    }

    /// Writes a line that structure hangs on: no noise that could remove it.
    pub(crate) fn structure(&mut self, words: &str) {
        self.left = self.left.saturating_sub(1);
        self.write_line(words);
    }

    fn write_line(&mut self, line: &str) {
        let speaks = || line.contains(['(', ';']);
        if self.manner.spread && !speaks() {
            for c in line.chars() {
                self.text.push(c);
                if c == '=' || c == ']' || c == '[' {
                    self.text.push(' ');
                }
            }
        } else if self.manner.upper && !speaks() {
            self.text.push_str(&line.to_ascii_uppercase());
        } else {
            self.text.push_str(line);
        }
        self.text.push('\n');
    }
}

/// The statements of a program: those of some kinds only, so that a rare statement is not masked by the others.
fn chosen_statements(
    entropy: &mut Entropy<'_>,
    config: &GeneratorConfig,
    table: &[&'static [Statement]],
    readable: Option<Readable<'_>>,
) -> Vec<&'static Statement> {
    let is_readable = |statement: &&Statement| {
        readable.is_none_or(|readable| !readable.unreadable.contains(statement.name))
    };
    let all = || table.iter().copied().flatten().filter(is_readable);
    if !config.only.is_empty() {
        let named = |name: &str| config.only.iter().any(|only| name.starts_with(only.as_str()));
        return all().filter(|statement| named(statement.name)).collect();
    }
    let with_rare = entropy.chance(config.rare_programs);
    let is_allowed = |kind: &StatementKind| with_rare || !kind.is_rare();
    let is_known =
        |kind: &StatementKind| readable.is_none() || all().any(|statement| statement.kind == *kind);
    let kinds: Vec<StatementKind> =
        StatementKind::ALL.iter().copied().filter(is_allowed).filter(is_known).collect();
    let chosen: Vec<StatementKind> = if entropy.chance(config.single_kind_programs) {
        vec![*entropy.pick(&kinds)]
    } else {
        kinds.into_iter().filter(|_| entropy.chance(KIND_PERCENT)).collect()
    };
    let statements: Vec<_> = all().filter(|statement| chosen.contains(&statement.kind)).collect();
    if statements.is_empty() {
        return all().filter(|statement| statement.kind == StatementKind::Motion).collect();
    }
    statements
}
