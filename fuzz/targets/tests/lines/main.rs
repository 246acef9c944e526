//! Programs of a few lines that have to do with each other, whole and broken, of few labels and names, under any options.
//!
//! Generated programs are right for the most part, and bytes are not: neither has a broken sub in a skipped condition in a loop.

mod gpp;
mod nct;
mod rs274;

use std::sync::LazyLock;

use gaugeblock::suite::{Choice, ChoiceKind, Suite, files};
use gaugeblock_fuzz::generate::{self, BUDGET, Recipe};
use gaugeblock_fuzz_targets::agree;
use gaugeblock_trace::{Language, Options, Program, Scenario};
use proptest::collection::vec;
use proptest::prelude::*;
use proptest::sample::Index;

static SUITE: LazyLock<Suite> = LazyLock::new(|| {
    Suite::read(&files::built_in()).expect("the suite that is built in can be read")
});

/// How many programs of each kind; the nightly run asks for more.
fn programs() -> u32 {
    let asked = std::env::var("GAUGEBLOCK_LINES").ok();
    asked.map_or(5_000, |count| count.parse().expect("GAUGEBLOCK_LINES is a number"))
}

/// Which option of which choice, of those of a language.
type Picked = Vec<(Index, Index)>;

/// None for half of the programs.
fn picked() -> impl Strategy<Value = Picked> {
    prop_oneof![Just(Picked::new()), vec((any::<Index>(), any::<Index>()), 1..6)]
}

/// The options of the language's first edition, and others instead of some.
fn options(language: Language, picked: &Picked) -> Options {
    let edition = SUITE.editions.iter().find(|edition| edition.language == language);
    let mut options = SUITE.options(edition.expect("each language has an edition"));
    let is_choice =
        |choice: &&Choice| choice.language == language && choice.kind == ChoiceKind::Choice;
    let choices: Vec<_> = SUITE.choices.iter().filter(is_choice).collect();
    for (choice, option) in picked {
        let choice = choice.get(&choices);
        options.0.insert(choice.id.clone(), option.get(&choice.options).name.clone());
    }
    options
}

fn scenario(program: Program, picked: &Picked) -> Scenario {
    let options = options(program.language, picked);
    Scenario { program, options, budget: BUDGET, ..Scenario::default() }
}

/// A program on a machine, a bench and under an operator that are generated: those of a number.
fn elsewhere(number: u32, program: Program, picked: &Picked) -> Scenario {
    let around = generate::from_seed(7, number.into(), &Recipe::default());
    let start = around.program.start;
    Scenario {
        machine: around.machine,
        bench: around.bench,
        operator: around.operator,
        ..scenario(Program { start, ..program }, picked)
    }
}

/// A line of a table's, one in six with something of another behind it.
fn line(
    lines: &'static [&'static str],
    broken: &'static [&'static str],
) -> impl Strategy<Value = String> {
    use proptest::sample::select;
    let behind = prop_oneof![5 => Just(""), 1 => select(broken)];
    (select(lines), behind).prop_map(|(line, behind)| format!("{line}{behind}"))
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, cases: programs(), ..ProptestConfig::default() })]

    /// Subs, conditions, loops and calls: model and production do the same with them.
    #[test]
    fn structures_do_the_same(lines in vec(rs274::structure(), 2..12), picked in picked()) {
        agree(&scenario(Program { main: lines.join("\n") + "\nm9\nm2\n", ..Program::default() }, &picked));
    }

    /// What stands in a sub's own file.
    #[test]
    fn files_do_the_same(
        main in vec(rs274::structure(), 1..5),
        file in vec(rs274::structure(), 1..8),
        picked in picked(),
    ) {
        let main = format!("{}\no<x> call\nm2\n", main.join("\n"));
        let files = [("x.ngc".to_owned(), file.join("\n") + "\n")].into();
        agree(&scenario(Program { main, files, ..Program::default() }, &picked));
    }

    /// Words, values, parameters and comments.
    #[test]
    fn blocks_do_the_same(
        blocks in vec(rs274::block(), 1..6),
        block_delete in any::<bool>(),
        picked in picked(),
    ) {
        let main = format!("f10\n{}\nm2\n", blocks.join("\n"));
        agree(&scenario(Program { main, block_delete, ..Program::default() }, &picked));
    }

    /// Tokens that make a line or none.
    #[test]
    fn tokens_do_the_same(tokens in rs274::tokens(), block_delete in any::<bool>(), picked in picked()) {
        let main = format!("{tokens}\nm9\nm2\n");
        agree(&scenario(Program { main, block_delete, ..Program::default() }, &picked));
    }

    /// Values that are computed.
    #[test]
    fn expressions_do_the_same(
        expressions in vec(rs274::expression(), 1..4),
        picked in picked(),
    ) {
        let main = format!("#1=2\n#<n>=-1\n#<_n>=0.5\n{}\nm2\n", expressions.join("\n"));
        agree(&scenario(Program { main, ..Program::default() }, &picked));
    }

    /// Blocks and structures, on any machine and under any operator.
    #[test]
    fn programs_do_the_same(
        lines in vec(prop_oneof![rs274::structure(), rs274::block()], 1..12),
        file in vec(prop_oneof![rs274::structure(), rs274::block()], 0..6),
        number in any::<u32>(),
        picked in picked(),
    ) {
        let main = format!("f10\n{}\nm2\n", lines.join("\n"));
        let file = format!("o<x> sub\n{}\no<x> endsub\nm2\n", file.join("\n"));
        let files = [("x.ngc".to_owned(), file)].into();
        agree(&elsewhere(number, Program { main, files, ..Program::default() }, &picked));
    }

    /// Macros, their calls, loops and jumps.
    #[test]
    fn macros_do_the_same(
        blocks in vec(nct::block(), 2..14),
        block_delete in any::<bool>(),
        picked in picked(),
    ) {
        let main = format!("O1\nF10\n{}\nM30\n", blocks.join("\n"));
        agree(&scenario(Program { language: Language::Nct, main, block_delete, ..Program::default() }, &picked));
    }

    /// Statements of a post-processor.
    #[test]
    fn statements_do_the_same(
        declared in vec(gpp::declaration(), 0..4),
        newline in vec(gpp::statement(), 0..3),
        first in vec(gpp::statement(), 0..8),
        then in vec(gpp::statement(), 0..8),
        picked in picked(),
    ) {
        agree(&scenario(gpp::program([&declared, &newline, &first, &then], &[]), &picked));
    }

    /// The toolpath of a program that prints what it says.
    #[test]
    fn toolpaths_do_the_same(
        declared in vec(gpp::declaration(), 0..2),
        toolpath in vec(gpp::toolpath_line(), 1..9),
        picked in picked(),
    ) {
        let prints = ["A = A / 3;", "B = -A;", "OUTPUT A B;", "OUTPUT C;"].map(str::to_owned).to_vec();
        let program = gpp::program([&declared, &Vec::new(), &prints, &prints], &toolpath);
        agree(&scenario(program, &picked));
    }
}
