//! Long programs, of some 200,000 executed blocks each, that are the same for every interpreter: text in a dialect
//! that all of them read.

use std::fmt::{Arguments, Write as _};

/// A program that runs long enough to be timed.
#[derive(Clone, Debug)]
pub struct LongProgram {
    /// Name in tables.
    pub name: String,
    /// Its text.
    pub text: String,
}

/// How every program begins.
const HEAD: &str = "G21 G90 G17 G94\nF1500\n";
/// Blocks that a program executes, about.
const BLOCKS: u32 = 200_000;

/// Names of all long programs, by what they stress.
pub const LONG_PROGRAMS: &[&str] = &[
    "feed moves",
    "compensated moves",
    "arcs",
    "expressions",
    "named parameters",
    "comments",
    "blocks in loops and subs",
    "a loop",
    "calls",
    "calls with M73",
];

/// The long program of a name; none where there is no such program.
pub fn long_program(name: &str) -> Option<LongProgram> {
    let text = match name {
        "feed moves" => program(1, "", feed_move),
        "compensated moves" => program(1, "G0 X-30 Y0\nG41.1 D0.1\n", compensated_move),
        "arcs" => arcs(),
        "expressions" => program(4, "#1=0\n#2=10.5\n#3=0\n", expressions),
        "named parameters" => program(4, "#<_ang>=0\n#<r>=10.5\n", named_parameters),
        "comments" => program(2, "", comments),
        "blocks in loops and subs" => LOOPS_AND_SUBS.into(),
        "a loop" => LOOP.into(),
        "calls" => CALLS.into(),
        "calls with M73" => CALLS_WITH_SAVED_STATE.into(),
        _ => return None,
    };
    Some(LongProgram { name: name.to_owned(), text })
}

/// A program of the same few blocks, each time with other numbers.
fn program(blocks: u32, head: &str, write: fn(&mut String, u32, &mut Noise)) -> String {
    let mut noise = Noise(7);
    let mut text = format!("{HEAD}{head}");
    for turn in 0..BLOCKS / blocks {
        write(&mut text, turn, &mut noise);
    }
    text.push_str("M2\n");
    text
}

/// Numbers without a pattern that are the same in every run.
struct Noise(u64);

impl Noise {
    /// Between 0 and 1.
    fn next(&mut self) -> f64 {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        f64::from(u32::try_from(self.0 >> 32).unwrap_or(0)) / f64::from(u32::MAX)
    }
}

/// Writing into a text cannot fail.
fn put(text: &mut String, arguments: Arguments<'_>) {
    let _done = text.write_fmt(arguments);
}

/// A contour as a CAM system writes it: short moves, four decimals, now and then a feed.
fn feed_move(text: &mut String, turn: u32, noise: &mut Noise) {
    let along = f64::from(turn % 2000) * 0.1;
    let (x, y) = (along - 100.0 + noise.next(), 90.0 - along * 0.7 + noise.next());
    let z = -5.0 * noise.next();
    put(text, format_args!("G1 X{x:.4} Y{y:.4} Z{z:.4}"));
    if turn.is_multiple_of(50) {
        put(text, format_args!(" F{}", 800 + turn / 50 % 4 * 400));
    }
    text.push('\n');
}

/// A zig-zag along which the cutter is compensated: inner and outer corners in turn.
fn compensated_move(text: &mut String, turn: u32, noise: &mut Noise) {
    let x = f64::from(turn % 2000) * 4.0 + noise.next();
    let y = f64::from(turn % 2) * 9.0 + noise.next();
    put(text, format_args!("G1 X{x:.4} Y{y:.4}\n"));
}

/// Arcs with centres, of 0.3 to 3 radians and 1 to 8 millimetres, in each plane for a thousand blocks, around the
/// point where they began.
fn arcs() -> String {
    let mut noise = Noise(7);
    let mut text = format!("{HEAD}G0 X0 Y0 Z0\n");
    let mut place = [0.0; 3];
    for turn in 0..BLOCKS / 2 {
        let (plane, [first, second], [letter, other], [offset, other_offset]) =
            match turn / 1000 % 3 {
                0 => ("G17", [0, 1], ['X', 'Y'], ['I', 'J']),
                1 => ("G18", [2, 0], ['Z', 'X'], ['K', 'I']),
                _ => ("G19", [1, 2], ['Y', 'Z'], ['J', 'K']),
            };
        if turn.is_multiple_of(1000) {
            put(&mut text, format_args!("{plane}\n"));
        }
        // The centre lies toward the origin, so that the path stays near it.
        let inwards = libm::atan2(-place[second], -place[first]) + noise.next() - 0.5;
        let radius = 1.0 + 7.0 * noise.next();
        let centre = [rounded(radius * libm::cos(inwards)), rounded(radius * libm::sin(inwards))];
        let (sign, code) = if noise.next() < 0.5 { (-1.0, 2) } else { (1.0, 3) };
        let angle = libm::atan2(-centre[1], -centre[0]) + sign * (0.3 + 2.7 * noise.next());
        let radius = libm::hypot(centre[0], centre[1]);
        place[first] = rounded(place[first] + centre[0] + radius * libm::cos(angle));
        place[second] = rounded(place[second] + centre[1] + radius * libm::sin(angle));
        let [along, across] = [place[first], place[second]];
        put(&mut text, format_args!("G{code} {letter}{along:.4} {other}{across:.4}"));
        put(&mut text, format_args!(" {offset}{:.4} {other_offset}{:.4}\n", centre[0], centre[1]));
    }
    text.push_str("M2\n");
    text
}

/// As it is written, with four decimals.
fn rounded(value: f64) -> f64 {
    (value * 1e4).round() / 1e4
}

fn expressions(text: &mut String, turn: u32, noise: &mut Noise) {
    put(text, format_args!("#1=[#1+0.{}]\n#3=[SIN[#1]*#2]\n", 100 + turn % 900));
    put(text, format_args!("G1 X[#3] Y[COS[#1]*#2+{:.3}]\n", noise.next()));
    put(text, format_args!("G1 X[#3*2-#2/4] Z-{:.3} F[800+#2*10]\n", noise.next() * 2.0));
}

fn named_parameters(text: &mut String, turn: u32, noise: &mut Noise) {
    put(text, format_args!("#<_ang>=[#<_ang>+0.{}]\n#<t>=[SIN[#<_ang>]*#<r>]\n", 100 + turn % 900));
    put(text, format_args!("G1 X[#<t>] Y[COS[#<_ang>]*#<r>+{:.3}]\n", noise.next()));
    put(text, format_args!("G1 X[#<t>*2-#<r>/4] Z-{:.3} F[800+#<r>*10]\n", noise.next() * 2.0));
}

fn comments(text: &mut String, turn: u32, noise: &mut Noise) {
    put(text, format_args!("(contour {turn}, finishing pass)\n"));
    put(text, format_args!("G1 X{:.4} (a corner) ; and its end\n", noise.next() * 90.0));
}

const LOOPS_AND_SUBS: &str = "\
G21 G90 G17 G94
G1 F1500
o100 sub
#5=[#1*2+#2]
G1 X[#5] Y[#1]
o110 if [#5 GT 30]
G1 Z-1
o110 else
G1 Z1
o110 endif
o100 endsub
#100=0
o200 while [#100 LT 22000]
o100 call [#100/1000] [1.5]
#100=[#100+1]
o200 endwhile
M2
";

const LOOP: &str = "\
G21 G90 G17 G94
G1 F1500
#100=0
o200 while [#100 LT 40000]
#101=[#100*0.01]
G1 X[#101] Y2.5
#100=[#100+1]
o200 endwhile
M2
";

const CALLS: &str = "\
G21 G90 G17 G94
o100 sub
o100 endsub
o200 repeat [65000]
o100 call [1] [2.5]
o200 endrepeat
M2
";

const CALLS_WITH_SAVED_STATE: &str = "\
G21 G90 G17 G94
o100 sub
M73
G91 F5
o100 endsub
o200 repeat [40000]
o100 call
o200 endrepeat
M2
";
