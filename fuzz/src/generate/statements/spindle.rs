//! Spindles, coolant, overrides.

use super::super::kind::StatementKind;
use super::super::writer::{Statement, Writer};

pub(in super::super) const STATEMENTS: &[Statement] = &[
    Statement::any("spindle.speed", StatementKind::Spindle, 12, |w| {
        let (speed, which) = (w.within(1, 5000), w.spindle_word(40));
        w.block(format!("s{speed}{which}"));
    }),
    Statement::any("spindle.turn", StatementKind::Spindle, 14, |w| {
        let (code, which) = (*w.entropy.pick(&["m3", "m4", "m5"]), w.spindle_word(30));
        w.block(format!("{code}{which}"));
        w.state.turning &= code != "m5";
    }),
    Statement::any("spindle.turn-at", StatementKind::Spindle, 10, |w| {
        let (code, speed, which) =
            (*w.entropy.pick(&["m3", "m4"]), w.within(1, 9000), w.spindle_word(30));
        w.block(format!("{code} s{speed}{which}"));
        w.state.turning = true;
    }),
    Statement::any("spindle.surface-speed", StatementKind::Spindle, 4, |w| {
        w.turns_first();
        let (limit, speed, which) = (w.within(100, 3000), w.within(10, 300), w.spindle_word(20));
        w.block(format!("g96 d{limit} s{speed}{which}"));
    }),
    Statement::any("spindle.surface-speed-unlimited", StatementKind::Spindle, 3, |w| {
        w.turns_first();
        let (speed, which) = (w.within(10, 300), w.spindle_word(20));
        w.block(format!("g96 s{speed}{which}"));
    }),
    Statement::any("spindle.rpm", StatementKind::Spindle, 6, |w| {
        let which = w.spindle_word(20);
        w.block(format!("g97{which}"));
    }),
    Statement::any("spindle.orient", StatementKind::Spindle, 4, |w| {
        let (angle, which) = (w.within(0, 359), w.spindle_word(20));
        let more = if w.entropy.below(200) == 0 {
            " q0"
        } else {
            *w.entropy.pick(&[" q1", " p0 q1", " p1 q2", " p2 q0.5"])
        };
        w.block(format!("m19 r{angle}{more}{which}"));
    }),
    Statement::any("coolant", StatementKind::Coolant, 20, |w| {
        let both = w.entropy.below(1000) == 0;
        let code = if both { "m7 m8" } else { *w.entropy.pick(&["m7", "m8", "m9", "m9"]) };
        w.block(code);
    }),
    Statement::any("override.both", StatementKind::Override, 10, |w| {
        let (code, which) = (*w.entropy.pick(&["m48", "m49"]), w.spindle_word(4));
        w.block(format!("{code}{which}"));
    }),
    Statement::any("override.one", StatementKind::Override, 18, |w| {
        let code = *w.entropy.pick(&["m50", "m51", "m52", "m53"]);
        let state = *w.entropy.pick(&["", " p0", " p1"]);
        let which = if code == "m51" { w.spindle_word(8) } else { String::new() };
        w.block(format!("{code}{state}{which}"));
    }),
];

impl Writer<'_, '_> {
    /// Lets all spindles turn where none may do so yet: constant surface speed is refused while they stand, which is
    /// worth a few programs.
    fn turns_first(&mut self) {
        if !self.state.turning && self.entropy.chance(85) {
            self.block("m3 s800");
            self.state.turning = true;
        }
    }

    /// Starts the first spindle at a speed, in all but a few programs.
    pub(in super::super) fn starts_spindle(&mut self) {
        if self.entropy.chance(97) {
            self.block("g97 m3 s800");
            self.state.turning = true;
        }
    }

    /// A word that names a spindle, sometimes.
    fn spindle_word(&mut self, percent: u32) -> String {
        let last = self.state.spindles.saturating_sub(1);
        if last == 0 || !self.entropy.chance(percent) {
            return String::new();
        }
        if self.entropy.chance(3) {
            return " $-1".to_owned();
        }
        format!(" ${}", self.entropy.range(0, last))
    }
}
