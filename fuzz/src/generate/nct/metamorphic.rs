//! Programs of which something is known without an interpreter.

use std::fmt::Write as _;

use gaugeblock_vocabulary::scenario::Budget;
use gaugeblock_vocabulary::{
    Effect, End, Event, Indexed, Language, MacroValue, Outcome, Program, Scenario, State,
};

use super::super::{BUDGET, Entropy};
use super::statements::{Place, Writer};

/// A program of which the number of interpolations has a closed form.
#[derive(Clone, Debug)]
pub struct Counted {
    /// The program.
    pub scenario: Scenario,
    /// How many interpolations it makes.
    pub interpolations: u64,
}

/// Modal calls within each other. With n of them in force, of which the last calls a macro of m motions L times, a
/// motion of the main program is F(n) = 1 + L m F(n - 1) interpolations, and F(0) = 1: each motion of that macro
/// reaches the n - 1 before.
pub fn count(entropy: &mut Entropy<'_>) -> Counted {
    let calls = entropy.range(0, 4);
    let mut main = String::from("O1\nG1 F100\n");
    let mut macros = String::new();
    let (mut each, mut all) = (vec![1_u64], 0);
    for call in 1..=calls {
        let (motions, repeats) = (entropy.below(4), entropy.range(1, 2));
        let _infallible = writeln!(main, "G66 P{} L{repeats} A{call}", call + 1);
        let _infallible = writeln!(macros, "O{}", call + 1);
        for motion in 0..motions {
            for _ in 0..entropy.below(2) {
                macros += *entropy.pick::<&str>(&["#2 = #1\n", "G90\n", "G4 P0\n", "N5\n", "M8\n"]);
            }
            let _infallible = writeln!(macros, "X[#1 * 10 + {motion}]");
        }
        macros += "M99\n";
        let before = each.last().copied().unwrap_or(1);
        each.push(1 + u64::from(motions * repeats) * before);
        if entropy.chance(40) {
            let _infallible = writeln!(main, "Y{call}");
            all += each.last().copied().unwrap_or(1);
        }
    }
    while let Some(now) = each.pop() {
        for motion in 0..entropy.below(3) {
            let _infallible = writeln!(main, "Z{motion}");
            all += now;
        }
        if !each.is_empty() {
            main += "G67\n";
        }
    }
    let main = format!("{main}M30\n{macros}");
    Counted { scenario: plain(main), interpolations: all }
}

impl Counted {
    /// How many interpolations a run has made.
    pub fn made(outcome: &Outcome) -> u64 {
        let events = outcome.steps.iter().flat_map(|step| &step.events);
        let is_one = |event: &&Event| matches!(event, Event::Do(Effect::StraightFeed { .. }));
        u64::try_from(events.filter(is_one).count()).unwrap_or(u64::MAX)
    }
}

/// Two programs, the other one with a call.
#[derive(Clone, Debug)]
pub struct Pair {
    /// Without it.
    pub one: Scenario,
    /// With it.
    pub other: Scenario,
}

/// A pair that must leave the main program the same local variables, whatever the macro does.
pub fn locals(entropy: &mut Entropy<'_>) -> Pair {
    let mut own = String::new();
    for number in 1..=33 {
        if entropy.chance(50) {
            let value = *entropy.pick(&["0", "1 / 3", "-2.5", "#0", "1000000000", "SIN[10]"]);
            let _infallible = writeln!(own, "#{number} = {value}");
        }
    }
    let call = *entropy.pick(&[
        "G65 P2 A1 B#1 I1 I2 I3 Z#33",
        "G65 P2 L3",
        "G66 P2 C5\nG1 X#1\nG67",
        "G66.1 P2\nX#1 I5 J6\nG67",
        "M98 P9",
    ]);
    let mut body = |called: &[u32]| {
        let mut writer = Writer::new(entropy, Place::Called, called);
        writer.body();
        writer.blocks.join("\n")
    };
    let (body, inner) = (body(&[3]), body(&[]));
    let macros = format!("O2\n{body}\nM99\nO3\n{inner}\nM99\nO9\nG65 P2 A5\nM99\n");
    let program = |call: &str| plain(format!("O1\nG1 F100\n{own}{call}\nM30\n{macros}"));
    Pair { one: program(""), other: program(call) }
}

impl Pair {
    /// Whether a run of this program has ended in its main program: a macro may end it, or be refused.
    pub fn returns(scenario: &Scenario, outcome: &Outcome) -> bool {
        let line = scenario.program.main.lines().position(|line| line == "M30");
        let last = outcome.steps.last().and_then(|step| usize::try_from(step.block.line).ok());
        outcome.end == End::ProgramEnd && last == line.map(|line| line + 1)
    }

    /// The local variables of the main program at the end.
    pub fn left(outcome: &Outcome) -> Vec<(String, MacroValue)> {
        let mut left = std::collections::BTreeMap::new();
        for step in &outcome.steps {
            let Some(State::Nct(state)) = &step.state else { continue };
            let Some(Indexed(locals)) = &state.local else { continue };
            for (name, value) in locals.iter().filter(|(name, _)| name.starts_with("0.")) {
                left.insert(name.clone(), *value);
            }
        }
        left.into_iter().collect()
    }
}

fn plain(main: String) -> Scenario {
    let program = Program { language: Language::Nct, main, ..Program::default() };
    let budget = Budget { steps: 40_000, effects: 40_000, ..BUDGET };
    Scenario { program, budget, ..Scenario::default() }
}
