//! The controller's configuration: INI file, HAL file, user programs, and what the driver must know.
//!
//! Two scenarios with the same setup can run one after the other on one controller.

use std::fmt::Write as _;

use gaugeblock_vocabulary::scenario::{Action, AxisLimits, Folder, OrientAnswer, UserProgram};
use gaugeblock_vocabulary::{Axis, LengthUnit, Pin, Scenario};
use serde_json::{Value, json};

use crate::instrumentation::instrument::GATE;
use crate::instrumentation::source::Source;
use crate::instrumentation::workspace::{self, Sections};

/// Seconds of a servo cycle: how often pins are looked at.
pub(super) const SERVO_PERIOD: f64 = 0.001;

/// Pins that one sampler takes; the controller's own limit is 20.
const PINS_PER_SAMPLER: usize = 16;

/// Default limits of a machine, millimetres per second and per second squared: nothing is slower.
const FAST: (f64, f64) = (1.0e6, 1.0e9);

/// A configuration.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Setup {
    /// Text of the INI file.
    pub(super) ini: String,
    /// Text of the HAL file.
    pub(super) hal: String,
    /// What the driver must know, as JSON.
    pub(super) driver: String,
    /// User programs: path, text, whether executable, whether there from the start.
    pub(super) programs: Vec<(String, String, bool, bool)>,
}

impl Setup {
    /// The configuration that a scenario needs.
    pub(super) fn of(scenario: &Scenario) -> Self {
        let pins = pins(scenario);
        let programs = scenario.environment.user_programs.iter();
        Self {
            ini: ini(scenario),
            hal: hal(scenario, &pins),
            driver: driver(scenario, &pins).to_string(),
            programs: programs.map(user_program).collect(),
        }
    }
}

impl Setup {
    /// Equal for equal setups, and different for different ones.
    pub(super) fn key(&self) -> String {
        format!("{:?}", (&self.programs, &self.driver, &self.hal, &self.ini))
    }
}

/// Whether the environment acts on the speed of the machine, so that it must not be hurried. Where only an operator
/// acts, moves are hurried: they must not put off the dwells and waits in which the operator acts.
pub(super) fn has_own_pace(scenario: &Scenario) -> bool {
    !scenario.environment.inputs.is_empty()
}

/// Operators act on what is read ahead, and HAL pins that change meanwhile are read ahead too. Other scenarios read
/// ahead as little as possible, so that the blocks before a refused one have been executed.
pub(super) fn reads_ahead(scenario: &Scenario) -> bool {
    let interrupts = |action: &Action| {
        matches!(action, Action::Abort | Action::Pause | Action::FeedHold(_) | Action::Mode(_))
    };
    scenario.operator.iter().any(|event| interrupts(&event.action))
        || scenario.environment.inputs.iter().any(|change| change.time > 0.0)
            && reads_hal(&Source::new(&scenario.program))
}

/// Whether a program, or what it prints, names a HAL item.
fn reads_hal(source: &Source) -> bool {
    source.all().any(|(_, _, line)| line.to_lowercase().contains("_hal["))
}

/// A pin of ours, its name in HAL, and its type there.
type Wired = (Pin, String, char);

fn pins(scenario: &Scenario) -> Vec<Wired> {
    let machine = &scenario.machine;
    let mut pins = Vec::new();
    for output in 0..machine.digital_io {
        pins.push((Pin::DigitalOut(output), format!("motion.digital-out-{output:02}"), 'b'));
    }
    for output in 0..machine.analog_io {
        pins.push((Pin::AnalogOut(output), format!("motion.analog-out-{output:02}"), 'f'));
    }
    for spindle in 0..u16::from(machine.spindles) {
        let mut put =
            |pin, name: &str, kind| pins.push((pin, format!("spindle.{spindle}.{name}"), kind));
        put(Pin::SpindleOn(spindle), "on", 'b');
        put(Pin::SpindleForward(spindle), "forward", 'b');
        put(Pin::SpindleReverse(spindle), "reverse", 'b');
        put(Pin::SpindleSpeed(spindle), "speed-out", 'f');
        put(Pin::SpindleBrake(spindle), "brake", 'b');
        put(Pin::SpindleLocked(spindle), "locked", 'b');
        put(Pin::SpindleOrient(spindle), "orient", 'b');
        put(Pin::SpindleOrientAngle(spindle), "orient-angle", 'f');
        put(Pin::SpindleOrientMode(spindle), "orient-mode", 's');
    }
    pins.push((Pin::CoolantMist, "iocontrol.0.coolant-mist".to_owned(), 'b'));
    pins.push((Pin::CoolantFlood, "iocontrol.0.coolant-flood".to_owned(), 'b'));
    pins
}

fn ini(scenario: &Scenario) -> String {
    let mut sections = machine_sections(scenario);
    let mut put = |section: &str, line: &str| {
        sections.entry(section.to_owned()).or_default().push(line.to_owned());
    };
    // Debugging output: each command as it is issued (0x10), each block as it is read and executed (0x100).
    put("EMC", "DEBUG=0x110");
    put("DISPLAY", "DISPLAY=./driver.py");
    put("EMCMOT", "SERVO_PERIOD=1000000");
    if !reads_ahead(scenario) {
        put("TASK", "INTERP_MAX_LEN=1");
    }
    workspace::ini_text(&sections)
}

/// The INI entries of every configuration of a machine.
pub(super) fn machine_sections(scenario: &Scenario) -> Sections {
    let machine = &scenario.machine;
    let mut sections: Sections = workspace::ini_sections(machine);
    // Files of subs stand beside the main program.
    if let Some(lines) = sections.get_mut("RS274NGC") {
        lines.retain(|line| !line.starts_with("SUBROUTINE_PATH"));
    }
    let mut put = |section: &str, lines: &[&str]| {
        let lines = lines.iter().map(|line| (*line).to_owned());
        sections.entry(section.to_owned()).or_default().extend(lines);
    };
    put("EMC", &["VERSION=1.1", "MACHINE=gaugeblock", "NML_FILE=channels.nml"]);
    put(
        "DISPLAY",
        &["PROGRAM_PREFIX=prefix", "MAX_FEED_OVERRIDE=10000", "MAX_SPINDLE_OVERRIDE=10"],
    );
    put(
        "RS274NGC",
        &["PARAMETER_FILE=memory/parameters.var", "SUBROUTINE_PATH=programs", "USER_M_PATH=user"],
    );
    put("EMCMOT", &["EMCMOT=motmod", "COMM_TIMEOUT=4", "BASE_PERIOD=0"]);
    put("TASK", &["TASK=milltask", "CYCLE_TIME=0.0002"]);
    put("HAL", &["HALFILE=machine.hal"]);
    put("EMCIO", &["EMCIO=io", "CYCLE_TIME=0.001", "TOOL_TABLE=tools.tbl"]);
    if machine.random_tool_changer {
        put("EMCIO", &["RANDOM_TOOLCHANGER=1"]);
    }
    let letters: Vec<_> = machine.axes.iter().map(|axis| axis.word().to_uppercase()).collect();
    let coordinates = format!("COORDINATES={}", letters.join(" "));
    let unit = match machine.length_unit {
        LengthUnit::Millimetre => "LINEAR_UNITS=mm",
        LengthUnit::Inch => "LINEAR_UNITS=inch",
    };
    put("TRAJ", &["NO_FORCE_HOMING=1", "ANGULAR_UNITS=degree", unit, &coordinates]);
    put("TRAJ", &["DEFAULT_LINEAR_VELOCITY=1e6", "MAX_LINEAR_VELOCITY=1e6"]);
    put("TRAJ", &["DEFAULT_LINEAR_ACCELERATION=1e9", "MAX_LINEAR_ACCELERATION=1e9"]);
    let kinematics = format!("KINEMATICS=trivkins coordinates={}", letters.concat().to_lowercase());
    put("KINS", &[&kinematics, &format!("JOINTS={}", letters.len())]);
    for (joint, axis) in machine.axes.iter().enumerate() {
        let limits = limits(machine.limits.get(axis.word()).copied().unwrap_or_default());
        let limits: Vec<&str> = limits.iter().map(String::as_str).collect();
        put(&format!("AXIS_{}", axis.word().to_uppercase()), &limits);
        let joint = format!("JOINT_{joint}");
        let kind = if is_rotary(*axis) { "TYPE=ANGULAR" } else { "TYPE=LINEAR" };
        put(&joint, &[kind, "HOME=0", "HOME_SEQUENCE=0", "FERROR=1e9", "MIN_FERROR=1e9"]);
        put(&joint, &limits);
    }
    sections
}

pub(super) fn is_rotary(axis: Axis) -> bool {
    matches!(axis, Axis::A | Axis::B | Axis::C)
}

fn limits(limits: AxisLimits) -> [String; 4] {
    let (velocity, acceleration) = FAST;
    [
        format!("MIN_LIMIT={}", limits.minimum.unwrap_or(-1e9)),
        format!("MAX_LIMIT={}", limits.maximum.unwrap_or(1e9)),
        format!("MAX_VELOCITY={}", limits.velocity.unwrap_or(velocity)),
        format!("MAX_ACCELERATION={}", limits.acceleration.unwrap_or(acceleration)),
    ]
}

fn hal(scenario: &Scenario, pins: &[Wired]) -> String {
    let (machine, environment) = (&scenario.machine, &scenario.environment);
    let mut text = String::new();
    // Writing to a string cannot fail.
    let mut put = |line: String| {
        let _never = writeln!(text, "{line}");
    };
    put("loadrt [KINS]KINEMATICS".to_owned());
    let (digital, analog) = (machine.digital_io.max(1), machine.analog_io.max(1));
    put(format!(
        "loadrt [EMCMOT]EMCMOT base_period_nsec=[EMCMOT]BASE_PERIOD servo_period_nsec=[EMCMOT]SERVO_PERIOD \
         num_joints=[KINS]JOINTS num_dio={digital} num_aio={analog} num_spindles={}",
        machine.spindles
    ));
    let samplers: Vec<_> = samplers(pins);
    let depths: Vec<_> = samplers.iter().map(|_| "16000").collect();
    put(format!("loadrt sampler depth={} cfg={}", depths.join(","), samplers.join(",")));
    let names: Vec<_> = (0..machine.spindles).map(|number| format!("oriented.{number}")).collect();
    put(format!("loadrt and2 names={}", names.join(",")));
    put("addf motion-command-handler servo-thread".to_owned());
    put("addf motion-controller servo-thread".to_owned());
    for (number, group) in pins.chunks(PINS_PER_SAMPLER).enumerate() {
        put(format!("addf sampler.{number} servo-thread"));
        for (place, (pin, name, _)) in group.iter().enumerate() {
            let signal = name.replace('.', "-");
            put(format!("net {signal} {name} => sampler.{number}.pin.{place}"));
            if let Some(input) = wired(environment, *pin) {
                put(format!("net {signal} => motion.digital-in-{input:02}"));
            }
        }
    }
    put("net stop iocontrol.0.user-enable-out iocontrol.0.emc-enable-in".to_owned());
    put("net prepare iocontrol.0.tool-prepare iocontrol.0.tool-prepared".to_owned());
    if environment.tool_change_time <= 0.0 {
        put("net change iocontrol.0.tool-change iocontrol.0.tool-changed".to_owned());
    }
    for spindle in 0..machine.spindles {
        if environment.orient.get(usize::from(spindle)).is_none() {
            // Not wired to itself: an answer within the same cycle would not be seen.
            put(format!("addf oriented.{spindle} servo-thread"));
            put(format!("net spindle-{spindle}-orient => oriented.{spindle}.in0"));
            put(format!("setp oriented.{spindle}.in1 1"));
            let pins = format!("oriented.{spindle}.out => spindle.{spindle}.is-oriented");
            put(format!("net oriented-{spindle} {pins}"));
        }
        // Feed per revolution waits for a spindle that turns; its encoder always tells a thousand turns a second.
        put(format!("setp spindle.{spindle}.speed-in 1000"));
    }
    for joint in 0..machine.axes.len() {
        put(format!("net joint-{joint} joint.{joint}.motor-pos-cmd joint.{joint}.motor-pos-fb"));
    }
    put("setp motion.adaptive-feed 1".to_owned());
    for number in 0..samplers.len() {
        put(format!("setp sampler.{number}.enable 1"));
    }
    text
}

/// The inputs that a digital output is wired to.
fn wired(environment: &gaugeblock_vocabulary::scenario::Environment, pin: Pin) -> Option<u16> {
    let Pin::DigitalOut(output) = pin else { return None };
    environment.wires.get(&output.to_string()).copied()
}

fn samplers(pins: &[Wired]) -> Vec<String> {
    let types = |group: &[Wired]| group.iter().map(|(_, _, kind)| *kind).collect();
    pins.chunks(PINS_PER_SAMPLER).map(types).collect()
}

/// An input of the environment under its name in HAL; none for what the controller does not have.
pub(super) fn input_pin(name: &str) -> Option<String> {
    let index = |kind: &str| -> Option<u16> {
        name.strip_prefix(kind)?.strip_prefix('[')?.strip_suffix(']')?.parse().ok()
    };
    match name {
        "adaptive_feed" => Some("motion.adaptive-feed".to_owned()),
        "feed_hold" => Some("motion.feed-hold".to_owned()),
        _ => index("digital_in")
            .map(|input| format!("motion.digital-in-{input:02}"))
            .or_else(|| index("analog_in").map(|input| format!("motion.analog-in-{input:02}"))),
    }
}

fn driver(scenario: &Scenario, pins: &[Wired]) -> Value {
    let (machine, environment) = (&scenario.machine, &scenario.environment);
    let wired: Vec<u16> = environment.wires.values().copied().collect();
    let mut resting =
        vec![("motion.adaptive-feed".to_owned(), "1"), ("motion.feed-hold".to_owned(), "0")];
    let free = (0..machine.digital_io).filter(|input| !wired.contains(input));
    resting.extend(free.map(|input| (format!("motion.digital-in-{input:02}"), "0")));
    resting
        .extend((0..machine.analog_io).map(|input| (format!("motion.analog-in-{input:02}"), "0")));
    // What is asked, what answers, its value, after how many seconds, and its value at rest.
    let mut answers: Vec<(String, String, i32, Option<f64>, i32)> = Vec::new();
    if environment.tool_change_time > 0.0 {
        let [asked, answer] =
            ["iocontrol.0.tool-change", "iocontrol.0.tool-changed"].map(str::to_owned);
        answers.push((asked, answer, 1, Some(environment.tool_change_time), 0));
    }
    for (spindle, answer) in
        environment.orient.iter().enumerate().take(usize::from(machine.spindles))
    {
        let asked = format!("spindle.{spindle}.orient");
        let pin = |name: &str| format!("spindle.{spindle}.{name}");
        answers.push(match answer {
            OrientAnswer::After(seconds) => (asked, pin("is-oriented"), 1, Some(*seconds), 0),
            OrientAnswer::Never => (asked, pin("is-oriented"), 0, None, 0),
            OrientAnswer::Fault(code) => (asked, pin("orient-fault"), *code, Some(0.0), 0),
        });
    }
    json!({
        "period": SERVO_PERIOD,
        "samplers": samplers(pins),
        "pins": pins.iter().map(|(pin, _, _)| pin.to_string()).collect::<Vec<_>>(),
        "resting": resting,
        "answers": answers,
        "marker": "@",
    })
}

/// The program of the gates: it ends when the driver writes a line.
pub(super) fn gate() -> (String, String) {
    (format!("user/{GATE}"), "#!/bin/sh\nread -r _ < /tmp/gate\n".to_owned())
}

/// A user program as a script that takes its time and exits.
fn user_program(program: &UserProgram) -> (String, String, bool, bool) {
    let text = format!("#!/bin/sh\nsleep {}\nexit {}\n", program.duration, program.exit_status);
    let folder = match program.folder {
        Folder::ProgramPrefix => "prefix",
        Folder::SearchPath => "user",
        Folder::Elsewhere => "elsewhere",
    };
    (format!("{folder}/{}", program.file), text, program.executable, program.at_start)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_scenario_becomes_a_configuration() {
        let mut scenario = Scenario::of("m2\n");
        scenario.machine.spindles = 2;
        scenario.environment.wires.insert("1".to_owned(), 3);
        scenario.environment.orient = vec![OrientAnswer::After(0.5)];
        let setup = Setup::of(&scenario);
        for line in ["COORDINATES=X Y Z A B C", "SPINDLES=2", "INTERP_MAX_LEN=1", "JOINTS=6"] {
            assert!(setup.ini.contains(line), "{line} is not in\n{}", setup.ini);
        }
        for line in ["net motion-digital-out-01 => motion.digital-in-03", "num_spindles=2"] {
            assert!(setup.hal.contains(line), "{line} is not in\n{}", setup.hal);
        }
        assert!(setup.driver.contains(r#"["spindle.0.orient","spindle.0.is-oriented",1,0.5,0]"#));
    }

    #[test]
    fn inputs_have_names_in_hal() {
        assert_eq!(input_pin("digital_in[3]").as_deref(), Some("motion.digital-in-03"));
        assert_eq!(input_pin("analog_in[0]").as_deref(), Some("motion.analog-in-00"));
        assert_eq!(input_pin("digital_in"), None);
        assert_eq!(input_pin("door"), None);
    }
}
