//! Straight moves, dwells, path control.

use super::super::kind::StatementKind;
use super::super::writer::{Statement, Writer};

/// Room for most axis words of a block.
const MOST_WORDS: usize = 64;

pub(in super::super) const STATEMENTS: &[Statement] = &[
    Statement::any("motion.traverse", StatementKind::Motion, 30, |w| {
        let axes = w.axes(3);
        w.block(["g0", axes.as_str()].concat());
        w.moves(true);
    }),
    Statement::when(
        "motion.feed",
        StatementKind::Motion,
        40,
        |s| s.feed && s.per_minute,
        |w| {
            let axes = w.axes(3);
            w.block(["g1", axes.as_str()].concat());
            w.moves(false);
        },
    ),
    Statement::when(
        "motion.feed-with-f",
        StatementKind::Motion,
        25,
        |s| s.per_minute,
        |w| {
            let (axes, feed) = (w.axes(3), w.within(1, 2000));
            w.block(["g1", axes.as_str(), " f", feed.as_str()].concat());
            w.state.feed = true;
            w.moves(false);
        },
    ),
    Statement::any("motion.inverse-time", StatementKind::Feed, 10, |w| {
        w.block("g93");
        for _ in 0..w.entropy.range(1, 3) {
            let (axes, feed) = (w.axes(2), w.within(1, 60));
            w.block(["g1", axes.as_str(), " f", feed.as_str()].concat());
        }
        let feed = w.within(1, 500);
        w.block(format!("g94 f{feed}"));
        w.state.feed = true;
        w.state.per_minute = true;
        w.moves(false);
    }),
    Statement::any("motion.axes-alone", StatementKind::Motion, 20, |w| {
        let can = w.state.moving && (w.state.rapid || (w.state.feed && w.state.per_minute));
        let axes = w.axes(3);
        if can {
            w.block(axes.trim_start());
        } else {
            w.block(["g0", axes.as_str()].concat());
            w.moves(true);
        }
    }),
    Statement::any("motion.code-alone", StatementKind::Motion, 3, |w| {
        let code = *w.entropy.pick(&["g0", "g80"]);
        w.block(code);
        w.state.moving = code == "g0";
        w.state.rapid = code == "g0";
    }),
    Statement::any("motion.machine", StatementKind::Motion, 5, |w| {
        let axes = w.axes(2);
        w.block(["g53 g0", axes.as_str()].concat());
        w.moves(true);
    }),
    Statement::when(
        "motion.machine-feed",
        StatementKind::Motion,
        3,
        |s| s.feed && s.per_minute,
        |w| {
            let axes = w.axes(2);
            w.block(["g53 g1", axes.as_str()].concat());
            w.moves(false);
        },
    ),
    Statement::any("dwell", StatementKind::Path, 10, |w| {
        let seconds = *w.entropy.pick(&["0", "0.1", "1", "2.5", "[1/4]", "#500"]);
        let seconds = if seconds == "#500" { "[abs[#500] mod 5]" } else { seconds };
        w.block(format!("g4 p{seconds}"));
    }),
    Statement::any("path", StatementKind::Path, 12, |w| {
        let code = *w.entropy.pick(&["g61", "g61.1", "g64", "g64"]);
        let words = match (code, w.entropy.below(4)) {
            ("g64", 1 | 2) => format!(" p{}", w.entropy.pick(&["0.1", "0.01", "1", "0", "[1/8]"])),
            ("g64", 3) => {
                format!(
                    " p{} q{}",
                    w.entropy.pick(&["0.1", "0.5"]),
                    w.entropy.pick(&["0.05", "0.2"])
                )
            }
            _ => String::new(),
        };
        w.block(format!("{code}{words}"));
    }),
];

impl Writer<'_, '_> {
    /// One to `most` axis words, each preceded by a blank.
    pub(in super::super) fn axes(&mut self, most: u32) -> String {
        let (mut text, mut used) = (String::with_capacity(MOST_WORDS), Vec::with_capacity(4));
        for _ in 0..self.entropy.range(1, most) {
            let all = &self.state.axes;
            let main = all.len().min(3);
            let few = if self.entropy.chance(75) { &all[..main] } else { &all[..] };
            if few.is_empty() {
                break;
            }
            let axis = *self.entropy.pick(few);
            if !used.contains(&axis) {
                used.push(axis);
                text.push(' ');
                text.push_str(axis);
                self.write_coordinate(&mut text);
            }
        }
        text
    }

    /// Records in the state that a straight move was written.
    pub(in super::super) fn moves(&mut self, rapid: bool) {
        self.state.moving = true;
        self.state.rapid = rapid;
    }
}
