//! How many instructions the planner executes for a servo cycle and for a segment, against `budgets.toml`.
//!
//! `cargo bench -p gaugeblock-benches --bench planner`
//!
//! It runs itself under callgrind for each program, and fails where one costs more than its budget allows. Counted
//! are the mean of all cycles, the largest cycle, and the mean of all segments queued. Beside it stands what a cycle
//! takes with the segments queued before it, on this machine and without callgrind. Without valgrind it says so and
//! measures nothing.
//!
//! `cargo bench -p gaugeblock-benches --bench planner -- search` looks for the largest cycle with three axes: it
//! draws programs and what the operator does, and changes those that cost most. The largest it has found are programs
//! of the bench.
#![expect(clippy::print_stdout, reason = "a measurement is printed")]

use std::env;
use std::fs;
use std::io::{Error, Result};
use std::process::{Command, ExitCode};
use std::time::Instant;

use gaugeblock_benches::budgets;
use gaugeblock_planner::Planner;
use gaugeblock_planner::{
    Axes, Dynamics, Feed, Hold, InputParameter, OutputParameter, Path, PathControl, Phase, Segment,
};

/// How far above its budget a program may be: compilers differ a little.
const TOLERANCE: f64 = 1.02;
/// The copying functions of the C library are chosen by processor; without these features they are the same on each.
const PLAIN_PROCESSOR: &str =
    "glibc.cpu.hwcaps=-AVX2_Usable,-AVX2,-AVX_Fast_Unaligned_Load,-AVX512VL,-ERMS,-FSRM";
/// Programs, and how many segments lie in the queue.
const PROGRAMS: [(&str, u32); 12] = [
    ("zig-zag", 200),
    ("stops", 200),
    ("arcs", 200),
    ("dense", 10),
    ("dense", 1000),
    ("dense", 10_000),
    ("crowded", 1000),
    ("rounded", 1000),
    ("nine axes", 1000),
    ("stops with jerk", 200),
    ("dense with jerk", 1000),
    (LARGEST, 1000),
];

/// What has the largest cycle that the search has found.
const LARGEST: &str = "wild:0.49497199784847257,0.9945354878424051,0.6739924628459831,0.5202623283304885,0.8318945690598093,0.4490745604152499,0.7876538344862997,0.40036151031971945,0.7886089173351901,0.46321001568883885";
/// Programs on a machine with limits of jerk, which end like this.
const WITH_JERK: &str = " with jerk";
const JERK: Axes = [1e5; 9];
/// What is drawn by the search, as a name: numbers follow.
const WILD: &str = "wild:";
const NUMBERS: usize = 10;
const TRIALS: u32 = 400;
const LONG_ENOUGH: u64 = 3000;

/// What the operator changes in a drawn program, again and again after so many cycles.
#[derive(Clone, Copy)]
struct Operator {
    period: u32,
    what: What,
}

#[derive(Clone, Copy)]
enum What {
    Nothing,
    FeedOverride,
    RapidOverride,
    Hold,
    /// Runs back and forth.
    AdaptiveFeed,
}

fn main() -> Result<ExitCode> {
    let arguments: Vec<String> = env::args().skip(1).collect();
    if let [run, name, queue] = arguments.as_slice()
        && run == "run"
    {
        let queue = queue.parse().map_err(Error::other)?;
        println!("{} cycles", executed(name, queue)?);
        return Ok(ExitCode::SUCCESS);
    }
    if arguments.first().is_some_and(|search| search == "search") {
        search()?;
        return Ok(ExitCode::SUCCESS);
    }
    let Some(budgets) = budgets()? else { return Ok(ExitCode::SUCCESS) };
    let mut kept = true;
    for (name, queue) in PROGRAMS {
        let told = if name == LARGEST { "the largest found" } else { name };
        let title = format!("{told}, queue {queue}");
        let budget = budgets.get(&title).and_then(toml::Value::as_array);
        let budget = budget.ok_or_else(|| Error::other(format!("no budget for {title}")))?;
        let counted = count(name, queue)?;
        print!("{title:27}");
        for ((number, unit), budget) in
            counted.into_iter().zip(["a cycle", "the largest", "a segment"]).zip(budget)
        {
            let budget = budget.as_integer().and_then(|budget| i32::try_from(budget).ok());
            let budget = f64::from(budget.unwrap_or(0));
            let within = number <= budget * TOLERANCE;
            kept &= within;
            let verdict = if within { "" } else { " TOO MANY" };
            print!("  {number:7.1} of {budget:5} {unit}{verdict}");
        }
        println!("  {:5.0} ns", nanoseconds(name, queue)?);
    }
    Ok(if kept { ExitCode::SUCCESS } else { ExitCode::FAILURE })
}

/// Instructions for a cycle in the mean, for the largest cycle, and for a segment.
fn count(name: &str, queue: u32) -> Result<[f64; 3]> {
    let cycles = dumps(name, queue, "planner::cycle")?;
    let queued = dumps(name, queue, "planner::queued")?;
    let mean = |counts: &[f64], number: usize| {
        counts.iter().sum::<f64>() / f64::from(u32::try_from(number).unwrap_or(u32::MAX))
    };
    let largest = cycles.iter().copied().fold(0.0, f64::max);
    // Calls that find the queue full are paid by the segments.
    Ok([mean(&cycles, cycles.len()), largest, mean(&queued, program(name).len())])
}

/// What each call of a function costs.
fn dumps(name: &str, queue: u32, function: &str) -> Result<Vec<f64>> {
    let kept = std::path::Path::new(env!("CARGO_TARGET_TMPDIR"))
        .join(format!("planner-{}", std::process::id()));
    let output = Command::new("valgrind")
        .args(["--tool=callgrind", "--combine-dumps=yes"])
        .arg(format!("--callgrind-out-file={}", kept.display()))
        .arg(format!("--toggle-collect={function}"))
        .arg(format!("--dump-after={function}"))
        .arg(env::current_exe()?)
        .args(["run", name, &queue.to_string()])
        .env("GLIBC_TUNABLES", PLAIN_PROCESSOR)
        .output()?;
    let told = fs::read_to_string(&kept)?;
    fs::remove_file(&kept)?;
    let totals = told.lines().filter_map(|line| line.strip_prefix("totals: "));
    let counts: Vec<f64> = totals
        .filter_map(|number| number.trim().parse().ok())
        .filter(|count| *count > 0.0)
        .collect();
    if counts.is_empty() {
        let told = String::from_utf8_lossy(&output.stderr);
        return Err(Error::other(format!("callgrind did not count {name}: {told}")));
    }
    Ok(counts)
}

/// What a cycle takes, with the segments that are queued before it; the least of five runs.
#[expect(clippy::disallowed_methods, reason = "a measurement reads the clock")]
fn nanoseconds(name: &str, queue: u32) -> Result<f64> {
    let mut least = f64::INFINITY;
    for _ in 0..5 {
        let begun = Instant::now();
        let cycles = executed(name, queue)?;
        let cycles = f64::from(u32::try_from(cycles).unwrap_or(u32::MAX));
        least = least.min(begun.elapsed().as_secs_f64() * 1e9 / cycles);
    }
    Ok(least)
}

/// Looks for the largest cycle: first at random, then in the neighbourhood of the largest one found.
fn search() -> Result<()> {
    let mut state = 0x9e37_79b9_7f4a_7c15_u64;
    let mut dice = || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        f64::from(u32::try_from(state >> 32).unwrap_or(0)) / f64::from(u32::MAX)
    };
    let (mut most, mut best) = (0.0, [0.5; NUMBERS]);
    for trial in 0..TRIALS {
        let mut numbers = best;
        if trial < TRIALS / 4 {
            numbers = std::array::from_fn(|_| dice());
        } else {
            for number in &mut numbers {
                if dice() < 0.4 {
                    *number = (*number + 0.2 * (dice() - 0.5)).clamp(0.0, 1.0);
                }
            }
        }
        let text: Vec<String> = numbers.iter().map(f64::to_string).collect();
        let name = format!("{WILD}{}", text.join(","));
        let queue = if numbers[0] < 0.4 { 10 } else { 1000 };
        let cycles = dumps(&name, queue, "planner::cycle")?;
        let largest = cycles.iter().copied().fold(0.0, f64::max);
        if largest > most {
            (most, best) = (largest, numbers);
            println!("{trial:4}  {largest:6.0}  {name}");
        }
    }
    println!("the largest of {TRIALS} programs: {most:.0} instructions");
    Ok(())
}

/// What the operator does with a program.
fn operator(name: &str) -> Operator {
    let nothing = Operator { period: 1, what: What::Nothing };
    name.strip_prefix(WILD).map_or(nothing, |wild| drawn(wild).1)
}

/// A program of 300 chords and arcs, and what the operator does with it, from numbers between 0 and 1.
fn drawn(numbers: &str) -> (Vec<Segment>, Operator) {
    let mut numbers = numbers.split(',').filter_map(|number| number.parse::<f64>().ok());
    let mut next = || numbers.next().unwrap_or(0.5);
    let mut between = |low: f64, high: f64| low * libm::pow(high / low, next());
    let _queue = between(1.0, 2.0);
    let (chord, turn, tolerance) = (between(0.005, 3.0), between(0.001, 1.0), between(1e-4, 0.3));
    let (feed, period, sharp) = (between(5.0, 250.0), between(2.0, 400.0), between(1.0, 60.0));
    let (uneven, arcs) = (between(1.0, 20.0), between(1.0, 40.0));
    let what = match between(1.0, 2.0) {
        1.0..1.2 => What::Hold,
        1.2..1.3 => What::AdaptiveFeed,
        1.8.. => What::RapidOverride,
        _ => What::FeedOverride,
    };
    let (mut heading, mut end, mut program) = (0.0, [0.0; 9], Vec::new());
    for place in 0..300_u32 {
        let every = |times: f64| f64::from(place) % times.round().max(1.0) < 1.0;
        heading += if every(sharp) { 1.0 } else { turn * libm::sin(f64::from(place)) };
        let length = if every(2.0) { chord } else { chord / uneven };
        let (start, (sine, cosine)) = (end, libm::sincos(heading));
        end[0] += length * cosine;
        end[1] += length * sine;
        end[2] += 0.1 * length * sine;
        let path = if every(arcs) && arcs > 1.5 {
            let centre = [0, 1].map(|axis| 0.5 * (start[axis] + end[axis]));
            let centre = [centre[0], centre[1], start[2]];
            Path::Arc { end, centre, normal: [0.0, 0.0, 1.0], angle: std::f64::consts::PI }
        } else {
            Path::Straight { end }
        };
        let mut next = segment(path, PathControl::Within(tolerance));
        let rapid = matches!(what, What::RapidOverride) && every(3.0);
        next.feed = if rapid { Feed::Rapid } else { Feed::PerSecond(feed) };
        program.push(next);
    }
    let cycles = (2..400_u32).find(|cycles| f64::from(*cycles) >= period);
    (program, Operator { period: cycles.unwrap_or(400), what })
}

/// Keeps the queue full until the program is over, or a drawn one has been long enough; how many cycles there were.
fn executed(name: &str, queue: u32) -> Result<u64> {
    let (program, operator) = (program(name), operator(name));
    let dynamics = Dynamics {
        velocity: [250.0; 9],
        acceleration: [2000.0; 9],
        jerk: name.ends_with(WITH_JERK).then_some(JERK),
        cycle: 0.001,
        queue,
    };
    let mut planner = Planner::new(dynamics, [0.0; 9]).map_err(Error::other)?;
    let (mut input, mut output) = (InputParameter::default(), OutputParameter::default());
    let (mut cycles, mut next) = (0, 0);
    let mut overrides = [1.0, 0.3, 2.0, 0.0, 0.7].into_iter().cycle();
    loop {
        while next < program.len() && queued(&mut planner, &program[next]) {
            next += 1;
        }
        if cycles % u64::from(operator.period) == 0 {
            let share = overrides.next().unwrap_or(1.0);
            match operator.what {
                What::Nothing => {}
                What::FeedOverride => input.feed_override = share,
                What::RapidOverride => {
                    (input.feed_override, input.rapid_override) = (share, share.min(1.0));
                }
                What::Hold => input.hold = if share < 0.5 { Hold::Hold } else { Hold::Run },
                What::AdaptiveFeed => input.adaptive_feed = if share < 0.5 { -1.0 } else { 1.0 },
            }
        }
        cycles += 1;
        let idle = cycle(&mut planner, &input, &mut output) == Phase::Idle;
        let enough = !matches!(operator.what, What::Nothing) && cycles >= LONG_ENOUGH;
        if idle && next == program.len() || enough {
            return Ok(cycles);
        }
    }
}

/// Callgrind counts within this function.
#[inline(never)]
fn cycle(planner: &mut Planner, input: &InputParameter, output: &mut OutputParameter) -> Phase {
    planner.update(input, output)
}

/// Callgrind counts within this function.
#[inline(never)]
fn queued(planner: &mut Planner, segment: &Segment) -> bool {
    planner.queue(segment).is_ok()
}

fn program(name: &str) -> Vec<Segment> {
    match name.trim_end_matches(WITH_JERK) {
        "zig-zag" => zig_zag(PathControl::Within(0.1)),
        "stops" => zig_zag(PathControl::ExactStop),
        "arcs" => arcs(),
        "crowded" => curve(0.03, 3),
        "rounded" => rounded(),
        "nine axes" => curve(0.1, 9),
        wild if wild.starts_with(WILD) => drawn(wild.trim_start_matches(WILD)).0,
        _ => curve(0.1, 3),
    }
}

fn segment(path: Path, blend: PathControl) -> Segment {
    Segment { number: 0, path, feed: Feed::PerSecond(100.0), path_control: blend, probing: false }
}

fn zig_zag(blend: PathControl) -> Vec<Segment> {
    let corner = |i: u32| {
        let mut end: Axes = [0.0; 9];
        (end[0], end[1]) = (0.5 * f64::from(i), 0.5 * f64::from(i % 2));
        segment(Path::Straight { end }, blend)
    };
    (1..=200).map(corner).collect()
}

/// Half circles of 2 mm that meet smoothly.
fn arcs() -> Vec<Segment> {
    let half = |i: u32| {
        let mut end: Axes = [0.0; 9];
        end[0] = 4.0 * f64::from(i + 1);
        let sense = if i.is_multiple_of(2) { 1.0 } else { -1.0 };
        let path = Path::Arc {
            end,
            centre: [end[0] - 2.0, 0.0, 0.0],
            normal: [0.0, 0.0, 1.0],
            angle: sense * std::f64::consts::PI,
        };
        segment(path, PathControl::Within(0.01))
    };
    (0..20).map(half).collect()
}

/// Chords of 0.053 mm whose ends are rounded to 0.01 mm.
fn rounded() -> Vec<Segment> {
    let mut program = curve(0.053, 3);
    for segment in &mut program {
        if let Path::Straight { end } = &mut segment.path {
            *end = end.map(|value| libm::round(value * 100.0) / 100.0);
        }
    }
    program
}

/// About two metres of a curve in chords, of as many axes.
fn curve(chord: f64, axes: u32) -> Vec<Segment> {
    let mut t = 0.0;
    let mut program = Vec::new();
    while program.len() < 3000 {
        let speed = |axis: u32| 20.0 * libm::cos(f64::from(axis + 2) * t);
        let sum: f64 = (0..axes).map(|axis| speed(axis) * speed(axis)).sum();
        t += chord / libm::sqrt(sum).max(1.0);
        let mut end: Axes = [0.0; 9];
        for (place, axis) in end.iter_mut().zip(0..axes) {
            let turns = f64::from(axis + 2);
            *place = 20.0 / turns * libm::sin(turns * t);
        }
        program.push(segment(Path::Straight { end }, PathControl::Within(0.01)));
    }
    program
}
