//! Statements of a block or of the newline procedure.

use std::fmt::Write as _;

use super::values;
use super::variable::Variable;
use crate::generate::Entropy;

const COMPARISONS: &[&str] =
    &["==", "!=", "<", "<=", ">", ">=", "_EQ_", "_NE_", "_LT_", "_LE_", "_GT_", "_GE_"];

/// Writes statements, a line each.
pub(super) struct Writer<'w, 'd> {
    entropy: &'w mut Entropy<'d>,
    known: &'w [Variable],
    /// The symbol of the newline procedure, where it may stand.
    symbol: Option<&'w str>,
    old_words: bool,
    pub(super) text: String,
}

impl<'w, 'd> Writer<'w, 'd> {
    pub(super) fn new(
        entropy: &'w mut Entropy<'d>,
        known: &'w [Variable],
        symbol: Option<&'w str>,
        old_words: bool,
    ) -> Self {
        Self { entropy, known, symbol, old_words, text: String::new() }
    }

    fn line(&mut self, line: &str) {
        self.text.push_str(line);
        self.text.push(if self.entropy.chance(6) { ' ' } else { '\n' });
    }

    /// Gives most variables a value.
    pub(super) fn first_values(&mut self) {
        for variable in self.known {
            let members = variable.size.map_or(1, |size| size);
            for member in 1..=members {
                if self.entropy.chance(4) {
                    continue;
                }
                let to = match variable.size {
                    Some(_) => format!("{}[{member}]", variable.name),
                    None => variable.name.clone(),
                };
                let value = if variable.text {
                    values::text(self.entropy)
                } else {
                    self.entropy.below(9).to_string()
                };
                self.line(&format!("{to} = {value};"));
            }
        }
        self.text.push('\n');
    }

    pub(super) fn statements(&mut self, count: u32, depth: u32) {
        for _ in 0..count {
            self.statement(depth);
        }
        self.text.push('\n');
    }

    fn statement(&mut self, depth: u32) {
        match self.entropy.below(if depth < 3 { 20 } else { 14 }) {
            0..=4 => self.assignment(),
            5..=9 => self.print(),
            10..=12 => self.switch(),
            13 => self.line("OUTPUT ;"),
            14..=16 => self.condition(depth),
            17 | 18 => self.if_set(depth),
            _ => self.repeat(depth),
        }
    }

    /// A variable of a type, with its index where it is an array.
    fn variable(&mut self, text: Option<bool>) -> Option<String> {
        let fitting: Vec<&Variable> =
            self.known.iter().filter(|known| text.is_none_or(|text| known.text == text)).collect();
        if fitting.is_empty() {
            return None;
        }
        let variable = *self.entropy.pick(&fitting);
        let name = values::spelled(&variable.name, self.entropy);
        let Some(size) = variable.size else { return Some(name) };
        let index = match self.entropy.below(30) {
            0 => self.number(1),
            1 => format!("{}.5", self.entropy.range(1, size)),
            3..=5 => {
                format!("{}.{}", self.entropy.range(1, size), self.entropy.pick(&["4", "49", "2"]))
            }
            2 if size > 1 => format!("{} + 1", self.entropy.range(1, size - 1)),
            _ => self.entropy.range(1, size).to_string(),
        };
        Some(format!("{name}[{index}]"))
    }

    /// An expression.
    fn number(&mut self, depth: u32) -> String {
        match self.entropy.below(if depth < 3 { 12 } else { 6 }) {
            0..=2 => values::number(self.entropy),
            3..=5 => self.variable(Some(false)).unwrap_or_else(|| values::number(self.entropy)),
            6..=9 => {
                let sign = *self.entropy.pick(&["+", "-", "*", "/", "+"]);
                format!("{} {sign} {}", self.number(depth + 1), self.number(depth + 1))
            }
            10 => format!("({})", self.number(depth + 1)),
            _ => format!("-{}", self.number(depth + 2)),
        }
    }

    fn assignment(&mut self) {
        let text = self.entropy.chance(30);
        let Some(to) = self.variable(Some(text)) else { return };
        let value = match self.entropy.below(4) {
            _ if text && self.entropy.chance(50) => values::text(self.entropy),
            0 | 1 if !text => self.number(0),
            2 if !text => values::number(self.entropy),
            _ => self.variable(Some(text)).unwrap_or_else(|| to.clone()),
        };
        self.line(&format!("{to} = {value};"));
    }

    fn print(&mut self) {
        let word =
            *self.entropy.pick(&["OUTPUT", "OUTPUT", "PRINT", "PRINT0", "PRINT10", "print3"]);
        let mut line = values::spelled(word, self.entropy);
        for _ in 0..self.entropy.range(1, 5) {
            let item = match self.entropy.below(10) {
                0..=4 => self.variable(None).unwrap_or_default(),
                5 | 6 => values::text(self.entropy),
                7 => "\\J".to_owned(),
                _ => self.symbol.unwrap_or_default().to_owned(),
            };
            let _infallible = write!(line, " {item}");
        }
        self.line(&format!("{line};"));
    }

    fn switch(&mut self) {
        let words: &[&str] =
            if self.old_words { &["SET_ON", "SET_OFF", "RESET"] } else { &["SET_ON", "SET_OFF"] };
        let word = *self.entropy.pick(words);
        let mut line = values::spelled(word, self.entropy);
        for _ in 0..self.entropy.range(1, 3) {
            let whole = self.known.iter().filter(|known| known.size.is_some()).collect::<Vec<_>>();
            let target = if self.old_words && self.entropy.chance(8) {
                "ALL_VAR".to_owned()
            } else if !whole.is_empty() && self.entropy.chance(40) {
                self.entropy.pick(&whole).name.clone()
            } else {
                self.variable(None).unwrap_or_else(|| "ALL_VAR".to_owned())
            };
            let _infallible = write!(line, " {target}");
        }
        self.line(&format!("{line};"));
    }

    fn test(&mut self) -> String {
        match self.entropy.below(8) {
            0 | 1 => {
                let word = *self.entropy.pick(&["VAR_SET", "VAR_NOTSET"]);
                let Some(variable) = self.variable(None) else { return "1 == 1".to_owned() };
                format!("{word}({variable})")
            }
            2 => {
                let side = |writer: &mut Self| {
                    if writer.entropy.chance(60) {
                        writer.variable(Some(true)).unwrap_or_else(|| "\"a\"".to_owned())
                    } else {
                        values::text(writer.entropy)
                    }
                };
                let (left, right) = (side(self), side(self));
                format!("{left} {} {right}", self.entropy.pick(&["==", "!=", "_EQ_", "_NE_"]))
            }
            _ => {
                let (left, right) = (self.number(1), self.number(1));
                format!("{left} {} {right}", self.entropy.pick(COMPARISONS))
            }
        }
    }

    fn tests(&mut self) -> String {
        let mut tests = self.test();
        while self.entropy.chance(25) {
            tests = format!("{tests} && {}", self.test());
        }
        tests
    }

    fn condition(&mut self, depth: u32) {
        let tests = self.tests();
        self.line(&format!("IF ({tests})"));
        self.branches(depth);
    }

    fn if_set(&mut self, depth: u32) {
        let Some(mut tests) = self.variable(None) else { return };
        if self.old_words && self.entropy.chance(40) {
            tests = match self.entropy.below(3) {
                0 => self.tests(),
                1 => format!("{tests} && {}", self.test()),
                _ => format!("{} && {tests}", self.test()),
            };
        }
        self.line(&format!("IF_SET ({tests})"));
        self.branches(depth);
    }

    fn branches(&mut self, depth: u32) {
        for _ in 0..self.entropy.below(3) {
            self.statement(depth + 1);
        }
        if self.entropy.chance(40) {
            self.line("ELSE");
            for _ in 0..self.entropy.below(3) {
                self.statement(depth + 1);
            }
        }
        self.line("END_IF;");
    }

    fn repeat(&mut self, depth: u32) {
        let alone = self.known.iter().find(|known| !known.text && known.size.is_none());
        let counter = alone.map(|known| known.name.clone());
        let counter = counter.filter(|_| self.entropy.chance(80));
        if let Some(counter) = &counter {
            self.line(&format!("{counter} = 0;"));
        }
        self.line("REPEAT");
        for _ in 0..self.entropy.range(0, 2) {
            self.statement(depth + 1);
        }
        let tests = match counter {
            Some(counter) => {
                self.line(&format!("{counter} = {counter} + 1;"));
                format!("{counter} > {}", self.entropy.below(4))
            }
            None if self.entropy.chance(50) => {
                self.variable(None).unwrap_or_else(|| "1 == 1".to_owned())
            }
            None => self.tests(),
        };
        self.line(&format!("UNTIL ({tests});"));
    }
}
