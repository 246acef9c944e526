//! Spindles, coolant, overrides.

use super::super::table::{Kind, Row};
use super::super::writer::Writer;

pub(in super::super) const ROWS: &[Row] = &[
    Row::any("spindle.speed", Kind::Spindle, 12, |w| {
        let (speed, which) = (w.within(1, 5000), w.spindle_word(40));
        w.block(format!("s{speed}{which}"));
    }),
    Row::any("spindle.turn", Kind::Spindle, 14, |w| {
        let (code, which) = (*w.dice.pick(&["m3", "m4", "m5"]), w.spindle_word(30));
        w.block(format!("{code}{which}"));
    }),
    Row::any("spindle.turn-at", Kind::Spindle, 10, |w| {
        let (code, speed, which) =
            (*w.dice.pick(&["m3", "m4"]), w.within(1, 9000), w.spindle_word(30));
        w.block(format!("{code} s{speed}{which}"));
        w.state.turning = true;
    }),
    Row::any("spindle.surface-speed", Kind::Spindle, 4, |w| {
        w.turns_first();
        let (limit, speed, which) = (w.within(100, 3000), w.within(10, 300), w.spindle_word(20));
        w.block(format!("g96 d{limit} s{speed}{which}"));
    }),
    Row::any("spindle.surface-speed-unlimited", Kind::Spindle, 3, |w| {
        w.turns_first();
        let (speed, which) = (w.within(10, 300), w.spindle_word(20));
        w.block(format!("g96 s{speed}{which}"));
    }),
    Row::any("spindle.rpm", Kind::Spindle, 6, |w| {
        let which = w.spindle_word(20);
        w.block(format!("g97{which}"));
    }),
    Row::any("spindle.orient", Kind::Spindle, 4, |w| {
        let (angle, which) = (w.within(0, 359), w.spindle_word(20));
        let more = if w.dice.below(200) == 0 {
            " q0"
        } else {
            *w.dice.pick(&[" q1", " p0 q1", " p1 q2", " p2 q0.5"])
        };
        w.block(format!("m19 r{angle}{more}{which}"));
    }),
    Row::any("coolant", Kind::Coolant, 20, |w| {
        let both = w.dice.below(1000) == 0;
        let code = if both { "m7 m8" } else { *w.dice.pick(&["m7", "m8", "m9", "m9"]) };
        w.block(code);
    }),
    Row::any("override.both", Kind::Override, 10, |w| {
        let (code, which) = (*w.dice.pick(&["m48", "m49"]), w.spindle_word(4));
        w.block(format!("{code}{which}"));
    }),
    Row::any("override.one", Kind::Override, 18, |w| {
        let code = *w.dice.pick(&["m50", "m51", "m52", "m53"]);
        let state = *w.dice.pick(&["", " p0", " p1"]);
        let which = if code == "m51" { w.spindle_word(8) } else { String::new() };
        w.block(format!("{code}{state}{which}"));
    }),
];

impl Writer<'_, '_> {
    /// Lets all spindles turn where none may do so yet: constant surface speed is refused while they stand, which is
    /// worth a few programs.
    fn turns_first(&mut self) {
        if !self.state.turning && self.dice.chance(85) {
            self.block("m3 s800");
            self.state.turning = true;
        }
    }

    /// A word that names a spindle, sometimes.
    fn spindle_word(&mut self, percent: u32) -> String {
        let last = self.state.spindles.saturating_sub(1);
        if last == 0 || !self.dice.chance(percent) {
            return String::new();
        }
        if self.dice.chance(3) {
            return " $-1".to_owned();
        }
        format!(" ${}", self.dice.range(0, last))
    }
}
