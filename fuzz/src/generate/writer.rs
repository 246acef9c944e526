//! Writes a program block by block, from the rows of the table, with noise that means nothing.

use super::GeneratorConfig;
use super::entropy::Entropy;
use super::mutate;
use super::state::{State, Sub};
use super::table::{Statement, StatementKind, TABLE};

/// Room for the text of most programs.
const MOST_TEXT: usize = 1024;

/// Deepest nesting of loops, branches and subs.
const DEEPEST: u32 = 4;

/// How a program is written, whatever it says.
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
    /// The rows, each with the sum of the weights up to it.
    rows: Vec<(u32, &'static Statement)>,
    total: u32,
    left: u32,
    last_label: u32,
    after_end: String,
}

impl<'d, 'b> Writer<'d, 'b> {
    /// Before the first block.
    pub(crate) fn new(
        entropy: &'d mut Entropy<'b>,
        config: &GeneratorConfig,
        state: State,
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
        let with_sum = |row: &'static Statement| {
            total += row.weight;
            (total, row)
        };
        let rows = chosen_rows(entropy, config).into_iter().map(with_sum).collect();
        let (text, after_end) = (String::with_capacity(MOST_TEXT), String::new());
        Self { entropy, state, text, manner, rows, total, left, last_label: 100, after_end }
    }

    /// Writes a whole main program.
    pub(crate) fn main(&mut self) -> String {
        let percent = self.entropy.chance(4);
        if percent {
            self.text.push_str("%\n");
        }
        if self.entropy.chance(85) {
            self.feed_first();
        }
        while self.left > 0 && !self.entropy.is_exhausted() {
            self.statement();
        }
        let end = *self.entropy.pick(&["m2", "m2", "m2", "m2", "m2", "m2", "m30", "m30"]);
        if !(percent && self.entropy.chance(50)) {
            self.block(end);
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
            let place = self.rows.partition_point(|(sum, _)| *sum <= at);
            let Some(&(_, row)) = self.rows.get(place) else { break };
            if (row.possible)(&self.state) && !(row.kind.nests() && self.state.depth >= DEEPEST) {
                (row.write)(self);
                return;
            }
        }
        self.left = self.left.saturating_sub(1);
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

    /// A program for M98 behind the end; it is written there so that it stands after every call.
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

    /// Writes lines behind the end, as a numbered program stands.
    pub(crate) fn behind_end(&mut self, lines: &str) {
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

/// The rows of a program: those of some kinds only, since what is rare shows best where the rest is absent.
fn chosen_rows(entropy: &mut Entropy<'_>, config: &GeneratorConfig) -> Vec<&'static Statement> {
    let named =
        |row: &&Statement| config.only.iter().any(|name| row.name.starts_with(name.as_str()));
    if !config.only.is_empty() {
        return TABLE.iter().copied().flatten().filter(named).collect();
    }
    let later = entropy.chance(config.later_programs);
    let mut is_chosen = [false; StatementKind::ALL.len()];
    let single = entropy.chance(config.single_kind_programs).then(|| {
        let kinds: Vec<StatementKind> =
            StatementKind::ALL.iter().copied().filter(|kind| !kind.is_later()).collect();
        *entropy.pick(&kinds)
    });
    for kind in StatementKind::ALL {
        let wanted = match single {
            Some(single) => *kind == single,
            None => entropy.chance(if kind.is_later() { 40 } else { 70 }),
        };
        if wanted && (later || !kind.is_later()) {
            is_chosen[*kind as usize] = true;
        }
    }
    let mut rows: Vec<&Statement> =
        TABLE.iter().copied().flatten().filter(|row| is_chosen[row.kind as usize]).collect();
    if rows.is_empty() {
        rows = TABLE
            .iter()
            .copied()
            .flatten()
            .filter(|row| row.kind == StatementKind::Motion)
            .collect();
    }
    rows
}
