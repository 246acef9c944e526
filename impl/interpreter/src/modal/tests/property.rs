//! Whatever words come in whatever order: no panic, and the sink is told all that is in force.

use gaugeblock_vocabulary::{Effect, FaultKind, Machine, Options, Settings};
use proptest::prelude::*;

use crate::canon::{Reply, Sink};
use crate::parameters::Numbered;
use crate::words::Words;

use super::super::{Flow, Modal, Refusal};
use super::{Recorder, machine, modal};

/// Codes that are, more often than codes that are not.
const G: &[u16] = &[
    0, 10, 20, 30, 40, 50, 51, 52, 53, 330, 331, 382, 383, 384, 385, 730, 740, 760, 810, 820, 830,
    840, 850, 860, 870, 880, 890, 70, 80, 100, 100, 170, 180, 190, 171, 200, 210, 280, 281, 300,
    301, 400, 410, 420, 411, 430, 431, 432, 490, 520, 530, 540, 550, 593, 610, 611, 640, 800, 900,
    910, 901, 911, 920, 921, 922, 923, 930, 940, 950, 960, 970, 980, 990, 999,
];
const M: &[u16] = &[
    0, 1, 3, 4, 5, 6, 7, 8, 9, 19, 48, 49, 50, 51, 52, 53, 60, 61, 62, 63, 64, 65, 66, 67, 68, 70,
    71, 72, 73, 100, 199, 200,
];

fn value() -> impl Strategy<Value = f64> {
    prop_oneof![
        4 => (-1_i8..12).prop_map(f64::from),
        1 => any::<f64>(),
        1 => Just(f64::MAX),
        1 => Just(0.5),
    ]
}

fn block() -> impl Strategy<Value = Words> {
    let letters = prop::collection::vec((0_u8..26, value()), 0..5);
    let g = prop::collection::vec(prop::sample::select(G), 0..4);
    let m = prop::collection::vec(prop::sample::select(M), 0..3);
    let sign = || prop::option::weighted(0.1, value());
    (letters, g, m, [sign(), sign(), sign()]).prop_map(|(letters, g, m, [dollar, at, caret])| {
        let mut words = Words::new();
        for (place, value) in letters {
            if !matches!(place, 6 | 12 | 13 | 14) {
                words.set(place, value);
            }
        }
        for code in g {
            words.push_g(code);
        }
        for code in m {
            words.push_m(code);
        }
        (words.dollar, words.at, words.caret) = (dollar, at, caret);
        words
    })
}

/// Second options of choices that open more ways.
fn options() -> impl Strategy<Value = Options> {
    let pairs = [
        ("modal-groups.io-members", "independent"),
        ("motion.without-axis-words", "move-in-place"),
        ("saved-state.places", "one"),
        ("spindle.minus-one", "all"),
        ("tool.selected-by", "slot"),
        ("tool.old-tool-place", "slot-of-the-new"),
        ("tool.change-without-selection", "accepted"),
        ("units-planes.diameter-offsets", "every-word"),
        ("arcs.small-tolerance", "millimetres"),
        ("arcs.without-axis-words", "refused"),
        ("feed.after-inverse-time", "zero"),
        ("motion.offset-words-after-cancel", "refused"),
        ("offsets.position-other-axes", "kept"),
        ("offsets.set-without-axes", "refused"),
        ("offsets.systems", "six"),
        ("order.feed-unit", "new"),
        ("pause.optional-stop", "ignored"),
        ("tool.length-off-with-motion", "refused"),
    ];
    prop::sample::subsequence(pairs.to_vec(), 0..=pairs.len()).prop_map(|chosen| {
        Options(chosen.iter().map(|(id, to)| ((*id).into(), (*to).into())).collect())
    })
}

proptest! {
    #[test]
    fn no_words_panic(blocks in prop::collection::vec((block(), 0_u8..6), 0..20), options in options(), random: bool) {
        let machine = Machine { random_tool_changer: random, ..machine() };
        let mut numbered = Numbered::new();
        let mut modal = modal(&machine, &options, &mut numbered).unwrap();
        let mut sink = Recorder { settings: modal.settings(), ..Recorder::default() };
        for (words, call) in blocks {
            match call {
                0 => modal.enter_call(),
                1 => modal.leave_call(&mut numbered, &mut sink, 1),
                _ => {}
            }
            let mut flow = modal.execute(&words, &mut numbered, &mut sink);
            for _ in 0..20 {
                if let Ok(Flow::Within { .. }) = flow {
                    flow = modal.resume_block(&mut numbered, &mut sink);
                }
            }
            if let Ok(Flow::Within { .. }) = flow {
                modal.begin();
            } else if flow.is_ok() {
                // Minus zero is zero: a change between them is no change.
                let text = |settings: Settings| {
                    alloc::format!("{:?}", settings.entries()).replace("(-0.0)", "(0.0)").replace(": -0.0", ": 0.0")
                };
                prop_assert_eq!(text(sink.settings.clone()), text(modal.settings()));
            }
        }
    }
}

/// All that a block can change.
fn state(modal: &Modal, numbered: &Numbered) -> alloc::string::String {
    let parameters: alloc::vec::Vec<_> = numbered.nonzero().collect();
    let text = alloc::format!(
        "{:?} {:?} {:?} {:?} {:?} {:?} {:?}",
        modal.settings(),
        modal.state(),
        modal.tools(),
        parameters,
        (modal.cutter, modal.feed_spindle, modal.surface_speed),
        modal.series,
        modal.saved,
    );
    // Notes of a block are no state.
    text.split("before: [").next().unwrap().into()
}

/// Refuses every so many effects.
struct Refusing(u32, u32);

impl Sink for Refusing {
    fn set(&mut self, _line: u32, _changed: &Settings) {}

    fn perform(&mut self, _line: u32, _effect: &Effect) -> Reply {
        self.0 += 1;
        if self.0.is_multiple_of(self.1) {
            Reply::Failed(FaultKind::BeyondLimit)
        } else {
            Reply::Done
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 1000, failure_persistence: None, ..ProptestConfig::default() })]

    /// After a refused block the state is that after the block before.
    #[test]
    fn refused_blocks_change_nothing(
        blocks in prop::collection::vec(block(), 1..12), options in options(), random: bool, every in 1_u32..5, level: bool,
    ) {
        let machine = Machine { random_tool_changer: random, ..machine() };
        let mut numbered = Numbered::new();
        let mut modal = modal(&machine, &options, &mut numbered).unwrap();
        let mut sink = Refusing(0, every);
        if level {
            modal.enter_call();
        }
        for words in blocks {
            let before = state(&modal, &numbered);
            let mut flow = modal.execute(&words, &mut numbered, &mut sink);
            while let Ok(Flow::Within { .. }) = flow {
                flow = modal.resume_block(&mut numbered, &mut sink);
            }
            // An unsuccessful probe has been made.
            if flow.is_err() && flow != Err(Refusal::Missed) {
                prop_assert_eq!(before, state(&modal, &numbered));
            }
        }
    }
}
