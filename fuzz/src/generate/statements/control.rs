//! Branches, loops, subs, numbered programs.

use super::super::kind::StatementKind;
use super::super::state::Sub;
use super::super::writer::{Statement, Writer};

/// Parameters that loops count in begin here; nothing else sets them.
const COUNTERS: u32 = 200;

pub(in super::super) const STATEMENTS: &[Statement] = &[
    Statement::any("control.if", StatementKind::Control, 12, |w| {
        let (label, condition) = (w.new_label(), w.condition());
        w.structure(&format!("o{label} if [{condition}]"));
        w.body(3);
        if w.entropy.chance(25) {
            let condition = w.condition();
            w.structure(&format!("o{label} elseif [{condition}]"));
            w.body(2);
        }
        if w.entropy.chance(40) {
            w.structure(&format!("o{label} else"));
            w.body(2);
        }
        w.structure(&format!("o{label} endif"));
    }),
    Statement::any("control.while", StatementKind::Control, 8, |w| {
        let label = w.new_label();
        let (counter, times) = (COUNTERS + label, w.entropy.range(1, 3));
        w.structure(&format!("#{counter} = 0"));
        w.structure(&format!("o{label} while [#{counter} lt {times}]"));
        w.structure(&format!("#{counter} = [#{counter} + 1]"));
        w.loop_body(label, 3);
        w.structure(&format!("o{label} endwhile"));
    }),
    Statement::any("control.do", StatementKind::Control, 5, |w| {
        let label = w.new_label();
        let (counter, times) = (COUNTERS + label, w.entropy.range(0, 2));
        w.structure(&format!("#{counter} = 0"));
        w.structure(&format!("o{label} do"));
        w.structure(&format!("#{counter} = [#{counter} + 1]"));
        w.loop_body(label, 3);
        w.structure(&format!("o{label} while [#{counter} lt {times}]"));
    }),
    Statement::any("control.repeat", StatementKind::Control, 7, |w| {
        let label = w.new_label();
        let times = match w.entropy.below(8) {
            0 => "0".to_owned(),
            1 => "2.4".to_owned(),
            2 => format!("{} mod 3", w.value(1)),
            _ => w.entropy.range(1, 3).to_string(),
        };
        w.structure(&format!("o{label} repeat [{times}]"));
        w.body(3);
        w.structure(&format!("o{label} endrepeat"));
    }),
    Statement::when(
        "control.break",
        StatementKind::Control,
        3,
        |s| !s.loops.is_empty(),
        |w| {
            let loops = w.state.loops.clone();
            let (label, outer) = (w.new_label(), *w.entropy.pick(&loops));
            let how = *w.entropy.pick(&["break", "continue"]);
            let condition = w.condition();
            w.structure(&format!("o{label} if [{condition}]"));
            w.structure(&format!("o{outer} {how}"));
            w.structure(&format!("o{label} endif"));
        },
    ),
    Statement::when(
        "sub.define-and-call",
        StatementKind::Sub,
        14,
        |s| !s.nested,
        |w| {
            let label = if w.entropy.chance(30) {
                format!("<{}{}>", w.entropy.pick(&["bore", "Face", "a_b"]), w.new_label())
            } else {
                w.new_label().to_string()
            };
            w.structure(&format!("o{label} sub"));
            if w.entropy.chance(25) {
                w.structure("m73");
            }
            w.sub_body(5);
            if w.entropy.chance(20) {
                let (branch, condition) = (w.new_label(), w.condition());
                let value = w.returned();
                // Whether any return leaves the sub is a choice.
                let own = if w.entropy.chance(5) { branch.to_string() } else { label.clone() };
                w.structure(&format!("o{branch} if [{condition}]"));
                w.structure(&format!("o{own} return{value}"));
                w.structure(&format!("o{branch} endif"));
            }
            let value = w.returned();
            w.structure(&format!("o{label} endsub{value}"));
            w.call(&label);
            w.state.subs.push(Sub { label, numbered: false });
        },
    ),
    Statement::when(
        "sub.own-label",
        StatementKind::Sub,
        1,
        |s| !s.nested,
        |w| {
            let label = w.new_label();
            let head = *w.entropy.pick(&["do", "if [1]", "repeat [1]", "while [0]"]);
            let end = match head {
                "do" => "while [0]",
                "if [1]" => "endif",
                "repeat [1]" => "endrepeat",
                _ => "endwhile",
            };
            w.structure(&format!("o{label} sub"));
            w.structure(&format!("o{label} {head}"));
            w.structure(&format!("o{label} {end}"));
            w.structure(&format!("o{label} endsub"));
            w.structure(&format!("o{label} call"));
        },
    ),
    Statement::when(
        "sub.recursive",
        StatementKind::Sub,
        3,
        |s| !s.nested,
        |w| {
            let (label, branch) = (w.new_label(), w.new_label());
            w.structure(&format!("o{label} sub"));
            w.sub_body(2);
            w.structure(&format!("o{branch} if [#1 gt 0]"));
            w.structure(&format!("o{label} call [#1 - 1]"));
            w.structure(&format!("o{branch} endif"));
            w.structure(&format!("o{label} endsub"));
            let depth = w.entropy.range(1, 9);
            w.structure(&format!("o{label} call [{depth}]"));
            w.state.forget_modes();
        },
    ),
    Statement::when(
        "sub.call-again",
        StatementKind::Sub,
        10,
        |s| s.subs.iter().any(|sub| !sub.numbered),
        |w| {
            let subs: Vec<_> = w.state.subs.iter().filter(|sub| !sub.numbered).cloned().collect();
            let sub = w.entropy.pick(&subs).clone();
            w.call(&sub.label);
        },
    ),
    Statement::when(
        "numbered.call",
        StatementKind::Numbered,
        10,
        |s| s.fanuc && !s.in_sub && !s.nested,
        |w| {
            let known: Vec<_> = w.state.subs.iter().filter(|sub| sub.numbered).cloned().collect();
            let label = if known.is_empty() || w.entropy.chance(40) {
                w.numbered_program()
            } else {
                w.entropy.pick(&known).label.clone()
            };
            let times = *w.entropy.pick(&["", "", " l1", " l2", " l3"]);
            w.structure(&format!("m98 p{label}{times}"));
            w.state.forget_modes();
            w.state.per_minute = false;
            w.state.names.clear();
        },
    ),
    Statement::when(
        "numbered.local-name",
        StatementKind::Numbered,
        2,
        |s| s.fanuc && !s.in_sub && !s.nested,
        |w| {
            let label = w.new_label();
            // Where subprograms have a scope of their own the name is unknown there.
            let value = *w.entropy.pick(&["exists[#<width>]", "exists[#<width>]", "#<width>"]);
            w.structure("#<width> = 3");
            w.structure(&format!("m98 p{label}"));
            w.after_program_end(&format!("o{label}\n#32 = {value}\nm99\n"));
        },
    ),
    Statement::when(
        "numbered.saved",
        StatementKind::Numbered,
        1,
        |s| s.fanuc && !s.in_sub && !s.nested,
        |w| {
            let label = w.new_label();
            // Each level has saved modes of its own, so that one restores only what it saved itself.
            let pairs =
                [("m70", "m70"), ("m70", "m70"), ("g40", "m70"), ("g40", "m70"), ("m70", "g40")];
            let (caller, called) = *w.entropy.pick(&pairs);
            w.structure(caller);
            w.structure(&format!("m98 p{label}"));
            w.after_program_end(&format!("o{label}\n{called}\ng91\nm72\nm99\n"));
            w.state.forget_modes();
            w.state.per_minute = false;
        },
    ),
    Statement::when(
        "numbered.deep",
        StatementKind::Numbered,
        1,
        |s| s.fanuc && !s.in_sub && !s.nested,
        |w| {
            // Ten levels are allowed.
            let levels = *w.entropy.pick(&[8, 9, 9, 10, 11]);
            let labels: Vec<u32> = (0..levels).map(|_| w.new_label()).collect();
            for (place, label) in labels.iter().enumerate() {
                let next = labels.get(place + 1).map(|next| format!("m98 p{next}\n"));
                w.after_program_end(&format!("o{label}\n{}m99\n", next.unwrap_or_default()));
            }
            let first = labels.first().copied().unwrap_or_default();
            w.structure(&format!("m98 p{first}"));
        },
    ),
];

impl Writer<'_, '_> {
    fn loop_body(&mut self, label: u32, few: u32) {
        let before = self.state.clone();
        self.state.loops.push(label);
        // What holds before the first turn need not hold before the second.
        self.state.forget_modes();
        if self.entropy.chance(50) {
            let feed = self.within(1, 900);
            self.block(format!("g94 f{feed}"));
            self.state.feed = true;
            self.state.per_minute = true;
        } else {
            self.state.per_minute = false;
        }
        self.body(few);
        self.state.join(&before);
    }

    fn returned(&mut self) -> String {
        if !self.entropy.chance(35) {
            return String::new();
        }
        format!(" [{}]", self.expression(1))
    }

    fn call(&mut self, label: &str) {
        let mut arguments = String::new();
        for _ in 0..self.entropy.below(4) {
            arguments.push_str(&format!(" [{}]", self.expression(1)));
        }
        self.structure(&format!("o{label} call{arguments}"));
        self.state.forget_modes();
        self.state.per_minute = false;
        if self.entropy.chance(30) {
            self.structure("#31 = #<_value>");
        }
    }
}
