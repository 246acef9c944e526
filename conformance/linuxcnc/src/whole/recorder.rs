//! Servo samples of a program, recorded while the controller runs it at its own pace.
//!
//! Each recording has a controller of its own, which reads ahead as far as it likes and has the axes' limits in its
//! configuration. A sampler in its servo thread takes down where it commands the axes to be, the line that it says it
//! executes, and the outputs, cycle by cycle (`record.py` starts and ends it).

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write as _;
use std::time::Duration;

use gaugeblock_adapter::{HarnessError, NoSamples};
use gaugeblock_vocabulary::motion::{Column, MotionLimits, Samples};
use gaugeblock_vocabulary::scenario::AxisLimits;
use gaugeblock_vocabulary::{Axis, LengthUnit, Machine, Pin, Scenario};

use super::session::Session;
use super::setup::{self, Setup};
use crate::instrumentation::workspace;

/// How long a program may take.
const LONGEST: Duration = Duration::from_secs(600);

/// Samples that the sampler can hold before they are read.
const DEPTH: u32 = 400_000;

/// A sampler prints six decimals; positions go through it a thousand times as large.
const GAIN: f64 = 1000.0;
const RESOLUTION: f64 = 0.5e-9;

/// Outputs that are recorded, of either kind: the first few.
const OUTPUTS: u16 = 4;

/// Cycles at rest that are kept before and after the motion.
const REST: usize = 2;

/// Millimetres in an inch.
const INCH: f64 = 25.4;

/// Records the samples of a program.
///
/// # Errors
/// The controller cannot run it to its end within the time, says nothing that can be read, or loses samples; a servo
/// period that is not a whole number of nanoseconds.
pub(super) fn record(scenario: &Scenario, limits: &MotionLimits) -> Result<Samples, NoSamples> {
    let mut scenario = scenario.clone();
    scenario.machine.limits = limits_in_units(&scenario.machine, limits);
    let period = nanoseconds(limits.period)?;
    let columns = columns(&scenario.machine);
    let setup = Setup {
        ini: ini(&scenario, period),
        hal: hal(&scenario.machine, &columns),
        driver: "{}".to_owned(),
        programs: programs(&scenario),
    };
    let tools = workspace::tool_table(&scenario.machine);
    let parameters = workspace::parameter_file(&scenario.machine, &BTreeSet::new());
    let text = Session::record(&setup, &tools, &parameters, LONGEST)
        .map_err(|error| NoSamples::Failed(HarnessError::NotRun(error.to_string())))?;
    let unreadable =
        |why| NoSamples::Failed(HarnessError::Unreadable { what: "samples".to_owned(), line: why });
    let rows = rows(&text, columns.len() + 1).map_err(unreadable)?;
    let scale = unit(&scenario.machine);
    let rows = executed(&rows);
    let kept = without_idle_tail(&columns, rows, limits);
    samples(limits.period, &kept, rows, scale).map_err(unreadable)
}

/// Millimetres in the machine's unit of length.
fn unit(machine: &Machine) -> f64 {
    match machine.length_unit {
        LengthUnit::Millimetre => 1.0,
        LengthUnit::Inch => INCH,
    }
}

fn nanoseconds(period: f64) -> Result<u64, NoSamples> {
    let nanoseconds = (period * 1e9).round();
    if (nanoseconds - period * 1e9).abs() > 1e-3 || nanoseconds < 1.0 {
        let why = format!("a servo period of {period} s is not a whole number of nanoseconds");
        return Err(NoSamples::Unsupported(why));
    }
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "it has been checked"
    )]
    Ok(nanoseconds as u64)
}

/// What the axes of a machine can do, in its own units.
fn limits_in_units(machine: &Machine, limits: &MotionLimits) -> BTreeMap<String, AxisLimits> {
    let of = |axis: &Axis| {
        let scale = if setup::is_rotary(*axis) { 1.0 } else { unit(machine) };
        let given = limits.axes.get(axis).copied().unwrap_or_default();
        let own = machine.limits.get(axis.word()).copied().unwrap_or_default();
        let velocity = given.velocity.map(|velocity| velocity / scale);
        let acceleration = given.acceleration.map(|acceleration| acceleration / scale);
        (axis.word().to_owned(), AxisLimits { velocity, acceleration, ..own })
    };
    machine.axes.iter().map(of).collect()
}

fn ini(scenario: &Scenario, period: u64) -> String {
    let mut sections = setup::machine_sections(scenario);
    let mut put =
        |section: &str, line: String| sections.entry(section.to_owned()).or_default().push(line);
    put("EMC", "DEBUG=0".to_owned());
    put("DISPLAY", "DISPLAY=./record.py".to_owned());
    put("EMCMOT", format!("SERVO_PERIOD={period}"));
    workspace::ini_text(&sections)
}

/// What is recorded, in the order of the sampler's pins.
fn columns(machine: &Machine) -> Vec<Column> {
    let axes = machine.axes.iter().map(|axis| Column::Position(*axis));
    let digital = (0..machine.digital_io.min(OUTPUTS)).map(Pin::DigitalOut);
    let analog = (0..machine.analog_io.min(OUTPUTS)).map(Pin::AnalogOut);
    axes.chain([Column::Line]).chain(digital.chain(analog).map(Column::Output)).collect()
}

fn hal(machine: &Machine, columns: &[Column]) -> String {
    let mut text = String::new();
    // Writing to a string cannot fail.
    let mut put = |line: String| {
        let _never = writeln!(text, "{line}");
    };
    let scales: Vec<_> = (0..machine.axes.len()).map(|joint| format!("scale-{joint}")).collect();
    // The last pin is on while the program runs.
    let kinds: String = columns.iter().map(|column| kind(*column)).chain(['b']).collect();
    put("loadrt [KINS]KINEMATICS".to_owned());
    put(format!(
        "loadrt [EMCMOT]EMCMOT base_period_nsec=0 servo_period_nsec=[EMCMOT]SERVO_PERIOD num_joints=[KINS]JOINTS num_dio={} \
         num_aio={} num_spindles={}",
        machine.digital_io.max(1),
        machine.analog_io.max(1),
        machine.spindles
    ));
    put(format!("loadrt scale names={}", scales.join(",")));
    put(format!("loadrt sampler depth={DEPTH} cfg={kinds}"));
    put("addf motion-command-handler servo-thread".to_owned());
    put("addf motion-controller servo-thread".to_owned());
    for scale in &scales {
        put(format!("setp {scale}.gain {GAIN}"));
        put(format!("addf {scale} servo-thread"));
    }
    put("addf sampler.0 servo-thread".to_owned());
    for (pin, column) in columns.iter().enumerate() {
        let sampled = format!("sampler.0.pin.{pin}");
        if let Column::Position(_) = column {
            let joint = format!("joint.{pin}");
            put(format!("net at-{pin} {joint}.motor-pos-cmd {joint}.motor-pos-fb scale-{pin}.in"));
            put(format!("net large-{pin} scale-{pin}.out {sampled}"));
        } else if let Column::Output(Pin::DigitalOut(output)) = column {
            put(format!("net digital-{output} motion.digital-out-{output:02} {sampled}"));
        } else if let Column::Output(Pin::AnalogOut(output)) = column {
            put(format!("net analog-{output} motion.analog-out-{output:02} {sampled}"));
        } else {
            put(format!("net line motion.program-line {sampled}"));
        }
    }
    put(format!("net running sampler.0.pin.{}", columns.len()));
    put("net stop iocontrol.0.user-enable-out iocontrol.0.emc-enable-in".to_owned());
    put("net prepare iocontrol.0.tool-prepare iocontrol.0.tool-prepared".to_owned());
    put("net change iocontrol.0.tool-change iocontrol.0.tool-changed".to_owned());
    put("setp motion.adaptive-feed 1".to_owned());
    put("setp sampler.0.enable 1".to_owned());
    text
}

/// The type of a sampler's pin.
fn kind(column: Column) -> char {
    if matches!(column, Column::Output(Pin::DigitalOut(_))) {
        'b'
    } else if column == Column::Line {
        's'
    } else {
        'f'
    }
}

/// The program and its files: path, text, not executable, there from the start.
fn programs(scenario: &Scenario) -> Vec<(String, String, bool, bool)> {
    let main = (&"main.ngc".to_owned(), &scenario.program.main);
    let file =
        |(name, text): (&String, &String)| (format!("programs/{name}"), text.clone(), false, true);
    scenario.program.files.iter().chain([main]).map(file).collect()
}

/// The rows of a sampler, of which each has its number.
fn rows(text: &str, width: usize) -> Result<Vec<Vec<f64>>, String> {
    let mut rows = Vec::new();
    let mut before: Option<u64> = None;
    for line in text.lines() {
        let mut words = line.split_whitespace();
        let number = words.next().and_then(|word| word.parse().ok());
        let Some(number) = number else { return Err(format!("the sampler says: {line}")) };
        if before.is_some_and(|before| before + 1 != number) {
            return Err(format!("samples before number {number} were lost"));
        }
        before = Some(number);
        let values: Option<Vec<f64>> = words.map(|word| word.parse().ok()).collect();
        // The last line may be cut short where the sampler is ended.
        match values {
            Some(values) if values.len() == width => rows.push(values),
            _ => break,
        }
    }
    if rows.is_empty() { Err("no sample was recorded".to_owned()) } else { Ok(rows) }
}

/// The rows from the beginning of the program to its end, with the dwells there, and a few at rest on either side. The
/// last column is 1 while the program runs.
fn executed(rows: &[Vec<f64>]) -> &[Vec<f64>] {
    let runs = |row: &[f64]| row.last().is_some_and(|running| *running > 0.0);
    let matters = |pair: &[Vec<f64>]| {
        let [before, after] = pair else { return false };
        runs(after)
            || before.split_last().map(|(_, rest)| rest) != after.split_last().map(|(_, rest)| rest)
    };
    let first = rows.windows(2).position(matters).unwrap_or(0);
    let last = rows.windows(2).rposition(matters).map_or(0, |pair| pair + 1);
    &rows[first.saturating_sub(REST)..last.saturating_add(REST + 1).min(rows.len())]
}

/// Columns to keep, each with its place: axes without limits that never move are left out.
fn without_idle_tail(
    columns: &[Column],
    rows: &[Vec<f64>],
    limits: &MotionLimits,
) -> Vec<(usize, Column)> {
    let matters = |(place, column): &(usize, Column)| {
        let Column::Position(axis) = column else { return true };
        limits.axes.contains_key(axis) || rows.iter().any(|row| row[*place].abs() > 0.0)
    };
    columns.iter().copied().enumerate().filter(matters).collect()
}

fn samples(
    period: f64,
    columns: &[(usize, Column)],
    rows: &[Vec<f64>],
    scale: f64,
) -> Result<Samples, String> {
    let wrong = |error: gaugeblock_vocabulary::motion::SamplesError| error.to_string();
    let resolution = RESOLUTION * scale;
    let names = columns.iter().map(|(_, column)| *column).collect();
    let mut samples = Samples::new(period, resolution, names).map_err(wrong)?;
    let in_millimetres = |column: &Column, value: f64| {
        let Column::Position(axis) = column else { return value };
        value / GAIN * if setup::is_rotary(*axis) { 1.0 } else { scale }
    };
    for row in rows {
        let of = |(place, column): &(usize, Column)| in_millimetres(column, row[*place]);
        let row: Vec<f64> = columns.iter().map(of).collect();
        samples.push(&row).map_err(wrong)?;
    }
    Ok(samples)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_are_those_of_the_program() {
        let kept = |running: std::ops::Range<u32>| -> Vec<f64> {
            let row = |n: u32| {
                format!("{n} {} {}\n", if n < 8 { 0 } else { 7 }, u8::from(running.contains(&n)))
            };
            let text: String = (3..13).map(row).collect();
            let rows = rows(&text, 2).unwrap();
            assert_eq!(rows.len(), 10);
            executed(&rows).iter().map(|row| row[0]).collect()
        };
        assert_eq!(kept(8..8), [0.0, 0.0, 0.0, 7.0, 7.0, 7.0], "the change alone");
        assert_eq!(kept(6..8), [0.0, 0.0, 0.0, 0.0, 0.0, 7.0, 7.0, 7.0], "rest before it");
        assert_eq!(kept(8..11), [0.0, 0.0, 0.0, 7.0, 7.0, 7.0, 7.0, 7.0], "rest after it");
    }

    #[test]
    fn lost_samples_make_no_recording() {
        assert_eq!(rows("0 1\n2 1\n", 1), Err("samples before number 2 were lost".to_owned()));
        assert_eq!(rows("overrun\n", 1), Err("the sampler says: overrun".to_owned()));
        assert!(rows("", 1).is_err());
    }

    #[test]
    fn a_machine_in_inches_has_limits_in_inches() {
        let mut machine = Machine { length_unit: LengthUnit::Inch, ..Machine::default() };
        machine.axes = vec![Axis::X, Axis::A];
        let text = "period = 0.001\naxes = { x = { velocity = 254 }, a = { velocity = 90 } }";
        let limits = limits_in_units(&machine, &MotionLimits::from_text(text).unwrap());
        assert_eq!(limits["x"].velocity, Some(10.0));
        assert_eq!(limits["a"].velocity, Some(90.0));
    }
}
