//! Blocks of a program.

use super::values::{condition, expression, number, target, value, variable};
use crate::generate::Entropy;

/// Which program is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Place {
    Main,
    Called,
}

/// Writes the blocks of one program.
pub(super) struct Writer<'a, 'd> {
    entropy: &'a mut Entropy<'d>,
    place: Place,
    /// Programs that it may call.
    called: &'a [u32],
    pub(super) blocks: Vec<String>,
    /// The sequence number that was given last.
    label: u32,
    /// Loops that are open.
    loops: u32,
    /// Modal calls that this program has commanded and not cancelled.
    modal: u32,
    /// Whether they are by block.
    by_block: bool,
    /// Structures around the block.
    depth: u32,
}

/// The number of the last block of each program, which a return may name.
const LAST: u32 = 77;

impl<'a, 'd> Writer<'a, 'd> {
    pub(super) fn new(entropy: &'a mut Entropy<'d>, place: Place, called: &'a [u32]) -> Self {
        let label = entropy.range(100, 900);
        Self {
            entropy,
            place,
            called,
            blocks: Vec::new(),
            label,
            loops: 0,
            modal: 0,
            by_block: false,
            depth: 0,
        }
    }

    /// All blocks up to the end of the program.
    pub(super) fn body(&mut self) {
        if self.place == Place::Main && self.entropy.chance(95) {
            let code = *self.entropy.pick(&["G1 F100", "G01 X1 F50", "G0 F200", "F10 G1 Y-1"]);
            self.write(code);
        }
        let count = match self.place {
            Place::Main => self.entropy.range(2, 14),
            Place::Called => self.entropy.range(0, 6),
        };
        self.statements(count);
        if self.entropy.chance(3) {
            return;
        }
        let end = match self.place {
            Place::Main => *self.entropy.pick(&["M30", "M30", "M30", "M2", "M30", "M99"]),
            Place::Called if self.entropy.chance(6) => "M99 P77",
            Place::Called => "M99",
        };
        let label = if self.entropy.chance(80) { format!("N{LAST} ") } else { String::new() };
        self.write(&format!("{label}{end}"));
    }

    fn write(&mut self, block: &str) {
        self.blocks.push(block.to_owned());
    }

    fn statements(&mut self, count: u32) {
        for _ in 0..count {
            self.statement();
        }
    }

    fn statement(&mut self) {
        let nests = self.depth < 3;
        match self.entropy.below(100) {
            0..=27 => self.assignment(),
            28..=50 => self.motion(),
            51..=57 => self.modes(),
            58..=64 => self.call_once(),
            65..=68 => self.call_sub(),
            69..=78 if nests => self.modal_region(),
            79..=85 if nests => self.branch(),
            86..=90 if nests && self.loops < 3 => self.repetition(),
            91 => self.early_return(),
            92..=95 => self.other(),
            _ => self.assignment(),
        }
    }

    fn assignment(&mut self) {
        let (to, from) = (target(self.entropy), expression(self.entropy, 3));
        let from = if self.entropy.chance(20) { variable(self.entropy) } else { from };
        let slash = if self.entropy.chance(5) { "/" } else { "" };
        self.write(&format!("{slash}{to} = {from}"));
    }

    fn motion(&mut self) {
        if self.entropy.chance(18) {
            return self.arc();
        }
        let code = match self.entropy.below(8) {
            0 => "G0 ",
            1 => "G1 ",
            2 => "G91 G01 ",
            3 => "G90 G0 ",
            4 => "G01 ",
            _ => "",
        };
        // Behind an arc words of axes alone would be an arc.
        let code = if code.is_empty() && self.entropy.chance(80) { "G1 " } else { code };
        let mut block = code.to_owned();
        for axis in ["X", "Y", "Z", "A"] {
            if self.entropy.chance(40) {
                block += &format!("{axis}{} ", value(self.entropy));
            }
        }
        if self.entropy.chance(10) {
            block += "F100";
        }
        self.write(block.trim_end());
    }

    /// An arc that ends where it may.
    fn arc(&mut self) {
        let code = *self.entropy.pick(&["G2", "G3", "G02", "G03"]);
        let (plane, first, second, offsets) =
            *self.entropy.pick::<(&str, &str, &str, (&str, &str))>(&[
                ("G17", "X", "Y", ("I", "J")),
                ("G18", "Z", "X", ("K", "I")),
                ("G19", "Y", "Z", ("J", "K")),
            ]);
        let size = self.entropy.range(1, 9);
        let block = match self.entropy.below(5) {
            0 => format!("{plane} {code} {}{size}", offsets.0),
            1 => format!("{plane} {code} {}{size} {}-{size}", offsets.0, offsets.1),
            2 => format!("{plane} G91 {code} {first}{} {}{size}", size * 2, offsets.0),
            3 => format!("{plane} G91 {code} {first}{size} {second}{size} {}{size}", offsets.1),
            _ => {
                let sign = if self.entropy.chance(40) { "-" } else { "" };
                format!("{plane} G91 {code} {first}{size} {second}-{size} R{sign}{}", size * 2)
            }
        };
        let along = if self.entropy.chance(20) { " A5" } else { "" };
        self.write(&format!("{block}{along}"));
        if self.entropy.chance(80) {
            self.write("G90 G1");
        }
    }

    fn modes(&mut self) {
        let mut block = String::new();
        let groups: [&[&str]; 6] = [
            &["G17", "G18", "G19"],
            &["G90", "G91"],
            &["G20 F9", "G21 F150", "G94 F33", "G95 F0.5"],
            &["G54", "G55", "G56", "G57", "G58", "G59"],
            &["M3", "M4", "M5", "M03 S500"],
            &["M7", "M8", "M9"],
        ];
        for group in groups {
            if self.entropy.chance(30) {
                block += *self.entropy.pick::<&str>(group);
                block.push(' ');
            }
        }
        if self.entropy.chance(20) {
            block += &format!("S[ABS[{}]]", variable(self.entropy));
        }
        self.write(block.trim_end());
    }

    fn other(&mut self) {
        let block = match self.entropy.below(9) {
            0 => format!("G4 P{}", number(self.entropy)),
            1 => format!("T{}", self.entropy.range(0, 12)),
            2 => "M6".to_owned(),
            3 => {
                format!("T{} M06 G4 P[ABS[{}]]", self.entropy.range(0, 12), variable(self.entropy))
            }
            4 => {
                self.label += 1;
                format!("N{}", self.label)
            }
            5 => "(NOTHING)".to_owned(),
            6 => "/".to_owned(),
            7 => format!("F[ABS[{}] + 1]", variable(self.entropy)),
            _ => "#1 = #0".to_owned(),
        };
        self.write(&block);
    }

    /// P, and perhaps L, of a program that may be called.
    fn callee(&mut self) -> Option<String> {
        if self.called.is_empty() {
            return None;
        }
        let number = *self.entropy.pick(self.called);
        let number = match self.entropy.below(8) {
            0 => format!("[{} + 1]", number - 1),
            1 => format!("{number}.3"),
            _ => number.to_string(),
        };
        let repeats = match self.entropy.below(12) {
            0 => " L2",
            1 => " L3",
            2 => " L1.4",
            _ => "",
        };
        Some(format!("P{number}{repeats}"))
    }

    /// Arguments by letter, and sets of I, J and K.
    fn arguments(&mut self) -> String {
        let mut text = String::new();
        for letter in "ABCDEFHMQRSTUVWXYZ".chars() {
            if self.entropy.chance(12) {
                text += &format!(" {letter}{}", value(self.entropy));
            }
        }
        if self.entropy.chance(25) {
            for _ in 0..self.entropy.range(1, 9) {
                text += &format!(" {}{}", self.entropy.pick(&["I", "J", "K"]), value(self.entropy));
            }
        }
        text
    }

    fn call_once(&mut self) {
        // What a macro reaches that is called so under a modal call is open.
        if self.modal > 0 && self.entropy.chance(85) {
            return self.motion();
        }
        let arguments = self.arguments();
        match self.callee() {
            Some(callee) => self.write(&format!("G65 {callee}{arguments}")),
            None => self.assignment(),
        }
    }

    fn call_sub(&mut self) {
        if self.by_block {
            return self.assignment();
        }
        let before = *self.entropy.pick(&["", "", "", "M8 ", "S100 "]);
        match self.callee() {
            Some(callee) => self.write(&format!("{before}M98 {callee}")),
            None => self.motion(),
        }
    }

    /// Blocks under a modal call.
    fn modal_region(&mut self) {
        let allowed = self.place == Place::Main || self.entropy.chance(12);
        let Some(callee) = self.callee().filter(|_| allowed && self.modal < 4) else {
            return self.motion();
        };
        if self.modal == 0 {
            self.by_block = self.entropy.chance(35);
        }
        if self.by_block {
            self.write(&format!("G66.1 {callee}"));
        } else {
            let arguments = self.arguments();
            self.write(&format!("G66 {callee}{arguments}"));
        }
        self.modal += 1;
        self.depth += 1;
        let count = self.entropy.range(1, 4);
        self.statements(count);
        if self.entropy.chance(70) {
            self.motion();
        }
        self.depth -= 1;
        if self.entropy.chance(97) {
            self.write("G67");
        }
        self.modal -= 1;
        if self.modal == 0 {
            self.by_block = false;
        }
    }

    /// A jump ahead, with or without a condition.
    fn branch(&mut self) {
        self.label += 1;
        let label = self.label;
        let to = match self.entropy.below(6) {
            0 => format!("[{} + 2]", label - 2),
            1 => format!("{label}.4"),
            _ => label.to_string(),
        };
        if self.entropy.chance(85) {
            let condition = condition(self.entropy);
            self.write(&format!("IF [{condition}] GOTO{to}"));
        } else {
            self.write(&format!("GOTO {to}"));
        }
        self.depth += 1;
        let count = self.entropy.range(0, 2);
        self.statements(count);
        self.depth -= 1;
        let slash = if self.entropy.chance(5) { "/" } else { "" };
        let code = *self.entropy.pick(&["", "", " G90", " #101 = #101 + 1"]);
        self.write(&format!("{slash}N{label}{code}"));
    }

    /// A loop with a counter, out of which something may jump.
    fn repetition(&mut self) {
        self.loops += 1;
        self.depth += 1;
        let (number, counter) = (self.loops, 18 + self.loops);
        let turns = self.entropy.range(0, 3);
        self.write(&format!("#{counter} = 0"));
        self.write(&format!("WHILE [#{counter} LT {turns}] DO{number}"));
        let count = self.entropy.range(0, 3);
        self.statements(count);
        if self.entropy.chance(10) {
            let condition = condition(self.entropy);
            self.write(&format!("IF [{condition}] GOTO{LAST}"));
        }
        self.write(&format!("#{counter} = #{counter} + 1"));
        let slash = if self.entropy.chance(1) { "/" } else { "" };
        self.write(&format!("{slash}END{number}"));
        self.depth -= 1;
        self.loops -= 1;
    }

    fn early_return(&mut self) {
        if self.place == Place::Main {
            return self.motion();
        }
        let condition = condition(self.entropy);
        self.label += 1;
        let label = self.label;
        self.write(&format!("IF [{condition}] GOTO{label}"));
        self.write("M99");
        self.write(&format!("N{label}"));
    }
}
