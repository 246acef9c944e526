//! Metamorphic pairs: two scenarios with equal effects, an oracle that needs no second controller.

use gaugeblock_vocabulary::Scenario;

use super::{Entropy, GeneratorConfig, Setups};

/// What must be equal in a pair.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Same {
    /// Effects and end; the lines at which they are do not count.
    Effects,
    /// The same, but a line that lacks something at its end may be refused for the comment that follows.
    Commented,
    /// The path in machine coordinates: where each straight move ends, moves along one line taken together.
    Path,
}

/// Two scenarios with equal effects.
#[derive(Clone, Debug)]
pub struct Pair {
    /// What was changed.
    pub name: &'static str,
    /// As it was.
    pub one: Scenario,
    /// With the change.
    pub other: Scenario,
    /// What must be equal.
    pub same: Same,
}

/// A change of the text that has no effect.
struct TextChange {
    name: &'static str,
    /// Whether line numbers change, and with them `#<_line>`.
    moves_lines: bool,
    line: fn(&str) -> String,
}

/// The change that appends a comment to each line.
const COMMENTS: &str = "comments";

/// Modal codes that change nothing when they are repeated in the next block. Those of coordinate systems are not
/// among them: what selects a system computes anew where the point is, and a program may do anything with how that is
/// rounded.
const REPEATABLE: &[&str] = &[
    "g17", "g18", "g19", "g20", "g21", "g90", "g91", "g90.1", "g91.1", "g98", "g99", "g61",
    "g61.1", "g7", "g8", "m7", "m8", "m9", "m48", "m49",
];

/// The most characters of a line.
const LONGEST: usize = 255;

const CHANGES: &[TextChange] = &[
    TextChange {
        name: COMMENTS,
        moves_lines: false,
        line: |line| {
            let whole = is_plain(line) && ends_whole(line);
            if whole { format!("{line} (so)") } else { line.to_owned() }
        },
    },
    TextChange {
        name: "upper case",
        moves_lines: false,
        line: |line| if is_plain(line) { line.to_ascii_uppercase() } else { line.to_owned() },
    },
    TextChange {
        name: "blanks",
        moves_lines: false,
        line: |line| if is_plain(line) { line.replace(' ', " \t ") } else { line.to_owned() },
    },
    TextChange {
        name: "CRLF",
        moves_lines: false,
        line: |line| format!("{}\r", line.trim_end_matches('\r')),
    },
    TextChange {
        name: "line numbers",
        moves_lines: false,
        line: |line| {
            let begins_with_word = line.starts_with(['g', 'm', 'x', 'f', 's', 't', '#']);
            if is_plain(line) && begins_with_word && !begins_with_operator(line) {
                format!("n7 {line}")
            } else {
                line.to_owned()
            }
        },
    },
    TextChange {
        name: "blank lines",
        moves_lines: true,
        line: |line| if is_plain(line) { format!("\n{line}\n") } else { line.to_owned() },
    },
    TextChange {
        name: "repeated modal words",
        moves_lines: true,
        line: |line| {
            if REPEATABLE.contains(&line) { format!("{line}\n{line}") } else { line.to_owned() }
        },
    },
];

/// Binary operators whose names are letters.
const OPERATORS: &[&str] = &["mod", "and", "or", "xor", "eq", "ne", "gt", "ge", "lt", "le"];

/// Whether a program reads the number of a line, in any case and with any blanks.
fn names_line(text: &str) -> bool {
    without_blanks(text).contains("_line")
}

/// Whether a line begins with letters that are an operator where a number stands before them: a word without its
/// value is refused by another rule there.
fn begins_with_operator(line: &str) -> bool {
    let letters = without_blanks(line);
    OPERATORS.iter().any(|operator| letters.starts_with(operator))
}

/// A text as it is read: blanks and capitals mean nothing.
fn without_blanks(text: &str) -> String {
    let letters = text.chars().filter(|c| !c.is_whitespace());
    letters.map(|c| c.to_ascii_lowercase()).collect()
}

/// Whether a line is neither a comment nor about the file.
fn is_plain(line: &str) -> bool {
    !line.trim().is_empty() && !line.contains(['(', ';', '%', '\r'])
}

/// Whether a comment may follow: a word without its value, or an expression or a name without its end, is refused by
/// another rule where a comment stands in the place of what is missing.
fn ends_whole(line: &str) -> bool {
    let (mut depth, mut in_name) = (0_i32, false);
    for c in line.chars() {
        match c {
            '<' => in_name = true,
            '>' => in_name = false,
            // In a name a bracket is a letter like any other.
            '[' if !in_name => depth += 1,
            ']' if !in_name => depth -= 1,
            _ => {}
        }
    }
    depth == 0
        && !in_name
        && (line.starts_with('o')
            || line.trim_end().ends_with(|c: char| c.is_ascii_digit() || ".]>".contains(c)))
}

/// A generated scenario and one with a change that has no effect.
pub fn pair(entropy: &mut Entropy<'_>) -> Pair {
    match entropy.below(9) {
        0 => inlined_call(entropy),
        1 => unrolled_loop(entropy),
        2 => deleted_blocks(entropy),
        3 => path(entropy, "inch and millimetre", |points| {
            (moves(points, "g21", 1.0), moves(points, "g20", 25.4))
        }),
        4 => path(entropy, "absolute and incremental", |points| {
            (moves(points, "g21 g90", 1.0), steps(points))
        }),
        5 => path(entropy, "shifted and turned work offsets", |points| {
            (moves(points, "g21", 1.0), shifted(points))
        }),
        6 => path(entropy, "split moves", |points| (moves(points, "g21", 1.0), halves(points))),
        _ => changed(entropy),
    }
}

fn changed(entropy: &mut Entropy<'_>) -> Pair {
    let config = GeneratorConfig {
        setups: Setups::Plain,
        mutated_programs: 5,
        rare_programs: 0,
        ..GeneratorConfig::default()
    };
    let one = super::scenario(entropy, &config);
    let change = entropy.pick(CHANGES);
    let mut other = one.clone();
    if !change.moves_lines || !names_line(&one.program.main) {
        // A line that would be too long stays as it is.
        let lines = one.program.main.lines().map(|line| {
            let changed = (change.line)(line);
            let fits = changed.lines().all(|line| line.len() <= LONGEST);
            if fits { changed } else { line.to_owned() }
        });
        other.program.main = lines.map(|line| line + "\n").collect();
    }
    let same = if change.name == COMMENTS { Same::Commented } else { Same::Effects };
    Pair { name: change.name, one, other, same }
}

/// Simple blocks that do the same at every call level and on every line.
fn blocks(entropy: &mut Entropy<'_>) -> String {
    let names = [
        "motion.traverse",
        "mode.",
        "offset.select",
        "coolant",
        "spindle.turn",
        "spindle.speed",
        "dwell",
    ];
    let only = names.map(str::to_owned).to_vec();
    let config = GeneratorConfig {
        blocks: (2, 8),
        mutated_programs: 0,
        only,
        setups: Setups::Plain,
        ..GeneratorConfig::default()
    };
    let text = super::scenario(entropy, &config).program.main.to_lowercase();
    // What a call changes: its own #1 to #30, the level, the line.
    let differs = |line: &str| line.contains('#') || line.contains('%');
    text.lines()
        .filter(|line| !differs(line) && line.trim() != "m2" && line.trim() != "m30")
        .fold(String::new(), |text, line| text + line + "\n")
}

fn inlined_call(entropy: &mut Entropy<'_>) -> Pair {
    let body = blocks(entropy);
    let called = format!("o1 sub\n{body}o1 endsub\nf100\no1 call\no1 call\nm2\n");
    let inlined = format!("f100\n{body}{body}m2\n");
    both("inlined call", &called, &inlined, Same::Effects)
}

fn unrolled_loop(entropy: &mut Entropy<'_>) -> Pair {
    let body = blocks(entropy);
    let times = usize::try_from(entropy.range(0, 3)).unwrap_or_default();
    let looped = format!("f100\no1 repeat [{times}]\n{body}o1 endrepeat\nm2\n");
    both("unrolled loop", &looped, &format!("f100\n{}m2\n", body.repeat(times)), Same::Effects)
}

fn deleted_blocks(entropy: &mut Entropy<'_>) -> Pair {
    let body = blocks(entropy);
    let with: String = body.lines().map(|line| format!("{line}\n/g0 x99\n/ #31 = 5\n")).collect();
    let mut pair =
        both("block delete", &format!("{body}m2\n"), &format!("{with}m2\n"), Same::Effects);
    // Of both: the blocks may have some to delete, too.
    pair.one.program.block_delete = true;
    pair.other.program.block_delete = true;
    pair
}

type Point = (i32, i32, i32);

fn path(
    entropy: &mut Entropy<'_>,
    name: &'static str,
    write: fn(&[Point]) -> (String, String),
) -> Pair {
    let mut coordinate = || i32::try_from(entropy.below(80)).unwrap_or_default() - 40;
    let points: Vec<Point> = (0..8).map(|_| (coordinate(), coordinate(), coordinate())).collect();
    let (one, other) = write(&points);
    both(name, &one, &other, Same::Path)
}

fn both(name: &'static str, one: &str, other: &str, same: Same) -> Pair {
    let of = |text: &str| Scenario { budget: super::BUDGET, ..Scenario::of(text) };
    Pair { name, one: of(one), other: of(other), same }
}

fn moves(points: &[Point], modes: &str, unit: f64) -> String {
    let point = |(x, y, z): &Point| format!("g1 x[{x} / {unit}] y[{y} / {unit}] z[{z} / {unit}]\n");
    format!("{modes} f100\n{}m2\n", points.iter().map(point).collect::<String>())
}

fn steps(points: &[Point]) -> String {
    let (mut text, mut at) = ("g21 g91 f100\n".to_owned(), (0, 0, 0));
    for (x, y, z) in points {
        text.push_str(&format!("g1 x{} y{} z{}\n", x - at.0, y - at.1, z - at.2));
        at = (*x, *y, *z);
    }
    text + "m2\n"
}

/// Every other point in a system that is shifted, the rest in one that is turned, too. Each is selected twice, which
/// changes nothing.
fn shifted(points: &[Point]) -> String {
    let mut text = "g21 f100\ng10 l2 p2 x7 y-3 z2\ng10 l2 p3 x-4 y5 z1 r90\n".to_owned();
    for (number, (x, y, z)) in points.iter().enumerate() {
        let (system, (x, y, z)) = if number % 2 == 0 {
            ("g55", (x - 7, y + 3, z - 2))
        } else {
            ("g56", (y - 5, -4 - x, z - 1))
        };
        text.push_str(&format!("{system}\n{system}\ng1 x{x} y{y} z{z}\n"));
    }
    text + "m2\n"
}

fn halves(points: &[Point]) -> String {
    let (mut text, mut at) = ("g21 f100\n".to_owned(), (0, 0, 0));
    for (x, y, z) in points {
        let middle = format!("x[{} / 2] y[{} / 2] z[{} / 2]", at.0 + x, at.1 + y, at.2 + z);
        text.push_str(&format!("g1 {middle}\nx{x} y{y} z{z}\n"));
        at = (*x, *y, *z);
    }
    text + "m2\n"
}
