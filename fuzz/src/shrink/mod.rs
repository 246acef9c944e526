//! The smallest scenario that still has a property.
//!
//! Whole files and parts are removed first, then structures, then words; then numbers are simplified, and at last
//! machine, environment, operator and options. The caller tests each attempt. Of the language, the search only knows
//! where a word begins and ends.

mod lines;
mod search;
mod setup;
mod words;

use gaugeblock_vocabulary::{Options, Scenario};

pub use words::shape;

use search::Search;

/// The result of shrinking.
#[derive(Clone, Debug)]
pub struct Shrunk {
    /// The smallest scenario that was found.
    pub scenario: Scenario,
    /// How many scenarios were tested.
    pub attempts: u32,
    /// Whether no smaller scenario was left to test.
    pub finished: bool,
}

/// Shrinks a scenario of which something holds, with at most so many attempts. Options go back to `options`.
pub fn shrink(
    scenario: &Scenario,
    options: &Options,
    most: u32,
    holds: &mut dyn FnMut(&Scenario) -> bool,
) -> Shrunk {
    let mut search = Search { best: scenario.clone(), holds, attempts: 0, most };
    loop {
        let before = search.best.clone();
        setup::files(&mut search);
        for file in search.files() {
            let file = file.as_deref();
            lines::pieces(&mut search, file);
            lines::structures(&mut search, file);
            lines::pieces(&mut search, file);
            words::tidy(&mut search, file);
            words::remove(&mut search, file);
            words::simplify(&mut search, file);
        }
        setup::setup(&mut search, options);
        if search.best == before || search.attempts >= search.most {
            break;
        }
    }
    let finished = search.attempts < search.most;
    Shrunk { scenario: search.best, attempts: search.attempts, finished }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn check(program: &str, holds: impl Fn(&str) -> bool, expect: &str) {
        let scenario = Scenario::of(program);
        let mut asks = |smaller: &Scenario| holds(&smaller.program.main.to_lowercase());
        let shrunk = shrink(&scenario, &Options::default(), 10_000, &mut asks);
        assert_eq!(shrunk.scenario.program.main, expect);
        assert!(shrunk.finished);
    }

    #[test]
    fn pieces_and_words_go() {
        check(
            "g21\nf100\no1 if [#1 gt 2]\nN10 G1 X12.3456 Y[3 + sin[#2]] (go)\no1 endif\nm2\n",
            |text| text.contains("g1") && text.contains('x'),
            "g1 x0\n",
        );
    }

    #[test]
    fn a_structure_is_unwrapped() {
        check("o1 repeat [4]\nm8\no1 endrepeat\n", |text| text.contains("m8"), "m8\n");
        check(
            "o1 repeat [4]\nm8\no1 endrepeat\n",
            |text| text.contains("repeat [") && text.contains("endrepeat"),
            "o1 repeat [0]\no1 endrepeat\n",
        );
    }

    #[test]
    fn numbers_become_round() {
        check("g4 p[2.75 * 3]\n", |text| text.contains("g4 p"), "g4 p0\n");
        check("#31 = [#2 + 17.25]\n", |text| text.contains("#31 = [#"), "#31 = [#2]\n");
    }

    #[test]
    fn everything_else_goes_back_to_its_default() {
        let mut scenario = Scenario::of("m2\n");
        scenario.machine.spindles = 3;
        scenario.program.block_delete = true;
        scenario.program.files.insert("cave.ngc".to_owned(), "m2\n".to_owned());
        scenario.options.0.insert("a".to_owned(), "b".to_owned());
        let shrunk = shrink(&scenario, &Options::default(), 1000, &mut |_| true);
        assert_eq!(shrunk.scenario, Scenario::of(""));
    }
}
