//! Which scenarios the controller can run.

use gaugeblock_vocabulary::scenario::{Action, Environment, OperatorEvent, OrientAnswer, Start};
use gaugeblock_vocabulary::{Axis, Language, Machine, Program, Scenario};

use super::setup::input_pin;
use crate::instrumentation::host::{is_ini_name, reaches_host};
use crate::instrumentation::source::{LAST_PARAMETER, Source, is_sub_file};

/// Most digital and most analog inputs and outputs.
const MOST_SIGNALS: u16 = 64;

/// Latest change of an input or answer, seconds: environments run in real time.
const LATEST: f64 = 30.0;

/// The environment that is built around this controller.
const OWN_ENVIRONMENT: &str = "whole controller";

/// Whether the controller can run a scenario.
///
/// # Errors
/// The reason why not.
pub(super) fn supports(scenario: &Scenario) -> Result<(), String> {
    program(&scenario.program)?;
    machine(&scenario.machine)?;
    if has_message_beyond_ascii(&scenario.program) {
        return Err("it reports a part of each character beyond ASCII in messages".to_owned());
    }
    environment(&scenario.environment)?;
    if let Some(event) = scenario.operator.iter().find(|event| event.when.offset > LATEST) {
        return Err(format!("an operator's event after a delay of {} s", event.when.offset));
    }
    let starts_something = |event: &OperatorEvent| {
        matches!(event.action, Action::CycleStart | Action::Mode(_) | Action::Mdi(_))
    };
    if scenario.program.start == Start::Mdi && scenario.operator.iter().any(starts_something) {
        return Err(
            "operator events that start a program while blocks are entered by hand".to_owned()
        );
    }
    let reaches = |event: &OperatorEvent| matches!(&event.action, Action::Mdi(text) if text.lines().any(reaches_host));
    if scenario.operator.iter().any(reaches) {
        return Err("a block by hand that reaches beyond the program's files".to_owned());
    }
    mdi(scenario)?;
    simultaneous_events(scenario)
}

/// What it does not report of MDI blocks.
fn mdi(scenario: &Scenario) -> Result<(), String> {
    let program = &scenario.program;
    let lines = program.language.lines(&program.main).filter(|_| program.start == Start::Mdi);
    let entered: Vec<&str> = lines
        .chain(scenario.operator.iter().filter_map(|event| match &event.action {
            Action::Mdi(text) => Some(text.as_str()),
            Action::CycleStart
            | Action::Pause
            | Action::Resume
            | Action::Abort
            | Action::Mode(_)
            | Action::OptionalStop(_)
            | Action::FeedHold(_)
            | Action::FeedOverride(_)
            | Action::RapidOverride(_)
            | Action::SpindleOverride { .. } => None,
        }))
        .collect();
    let calls = |text: &str| text.trim_start().starts_with(['o', 'O']) && text.contains("call");
    if !program.files.is_empty() && entered.iter().copied().any(calls) {
        return Err("it does not report what a file does that is called by hand".to_owned());
    }
    let mut from_end = entered.iter().skip_while(|text| !matches!(text.trim(), "m2" | "m30"));
    if program.start == Start::Mdi && from_end.next().is_some() && from_end.next().is_some() {
        return Err("it enters nothing after a block by hand that ends a program".to_owned());
    }
    Ok(())
}

/// Its clock is that of the wall, and blocks that do nothing go by unseen: what happens there, or when something else
/// does, happens in some order.
fn simultaneous_events(scenario: &Scenario) -> Result<(), String> {
    let events = &scenario.operator;
    let text = |event: &OperatorEvent| {
        let text = scenario.program.line(&event.when.block);
        text.filter(|_| event.when.block.file == Program::MAIN).unwrap_or_default()
    };
    let does_nothing = |event: &OperatorEvent| {
        let text = text(event);
        text.starts_with('o') && (text.contains(" else") || text.contains(" endif"))
    };
    if events.iter().any(does_nothing) {
        return Err("it does not report the start of a line that does nothing".to_owned());
    }
    let ends = |event: &OperatorEvent| {
        let at = |duration: f64| (duration - event.when.offset).abs() < 0.05;
        let oriented =
            |answer: &OrientAnswer| matches!(answer, OrientAnswer::After(seconds) if at(*seconds));
        scenario.environment.user_programs.iter().any(|program| at(program.duration))
            || scenario.environment.orient.iter().any(oriented)
    };
    // A block that only sets parameters is over before anybody can act.
    let begins = |event: &OperatorEvent| {
        event.action == Action::Abort && event.when.offset <= 0.0 && text(event).starts_with('#')
    };
    let twice = events.iter().enumerate().any(|(place, event)| {
        events.iter().take(place).any(|other| {
            other.when == event.when && matches!(event.action, Action::Abort | Action::Mdi(_))
        })
    });
    let inputs = &scenario.environment.inputs;
    let changes_twice = inputs.iter().enumerate().any(|(place, change)| {
        let mut earlier = inputs.iter().take(place);
        earlier.any(|other| other.input == change.input && (other.time - change.time).abs() < 1e-6)
    });
    if twice || changes_twice || events.iter().any(|event| ends(event) || begins(event)) {
        return Err("its clock is that of the wall: nothing happens at one time".to_owned());
    }
    let pauses = events.iter().rposition(|event| event.action == Action::Pause);
    let goes_on =
        |event: &OperatorEvent| matches!(event.action, Action::Resume | Action::CycleStart);
    let stays = pauses.is_some_and(|place| !events.iter().skip(place).any(goes_on));
    if stays && Source::new(&scenario.program).has_code(&["g4"]) {
        return Err("it does not report the end of a dwell before it resumes".to_owned());
    }
    Ok(())
}

/// Whether a comment shows a message that is not all ASCII.
fn has_message_beyond_ascii(program: &Program) -> bool {
    let is_message = |line: &str| {
        let compact: String = line.chars().filter(|character| !character.is_whitespace()).collect();
        let compact = compact.to_ascii_lowercase();
        compact.contains("(msg") || compact.contains("(debug,")
    };
    Source::new(program).all().any(|(_, _, line)| !line.is_ascii() && is_message(line))
}

fn program(program: &Program) -> Result<(), String> {
    if program.language != Language::Rs274 {
        return Err(format!("the language {} is not supported", program.language));
    }
    for name in program.files.keys() {
        if !is_sub_file(name) || name == Program::MAIN {
            return Err(format!("{name:?} is not a valid file name of a sub"));
        }
    }
    let source = Source::new(program);
    if source.has_code(&["g38.2", "g38.3", "g38.4", "g38.5"]) {
        return Err("its environment has no probe".to_owned());
    }
    if source.has_code(&["g33", "g33.1", "g76"]) {
        return Err("its spindles have no encoder".to_owned());
    }
    if source.has_code(&["g5", "g5.1", "g5.2", "g5.3"]) {
        return Err("it reports a spline as the arcs that it is divided into".to_owned());
    }
    if source.leaves_block_order() {
        return Err("it would be on its way for longer than anybody waits".to_owned());
    }
    if source.names_line() {
        return Err(
            "inserted lines would change the line numbers that the program reads".to_owned()
        );
    }
    match source.reaches_host() {
        Some(block) => Err(format!(
            "{block} would reach beyond the program's files: a log, a sub or Python of the host"
        )),
        None => Ok(()),
    }
}

fn machine(machine: &Machine) -> Result<(), String> {
    let is_cartesian = [Axis::X, Axis::Y, Axis::Z].iter().all(|axis| machine.axes.contains(axis));
    let in_order = machine.axes.is_sorted_by_key(|axis| axis.place());
    if !is_cartesian || !in_order || machine.axes.len() > 9 {
        return Err("its axes are X Y Z and others, in order".to_owned());
    }
    if !(1..=8).contains(&machine.spindles) {
        return Err("no other number of spindles than 1 to 8".to_owned());
    }
    if machine.digital_io > MOST_SIGNALS || machine.analog_io > MOST_SIGNALS {
        return Err(format!("at most {MOST_SIGNALS} inputs and outputs of each kind"));
    }
    if machine.random_tool_changer && machine.tools.iter().any(|tool| tool.pocket == Some(0)) {
        return Err("it is given a tool table while it runs, which puts no tool into the spindle"
            .to_owned());
    }
    let cannot_be_stored = |number: &&u32| !(1..=LAST_PARAMETER).contains(*number);
    if let Some(number) = machine.parameters.0.keys().find(cannot_be_stored) {
        return Err(format!("#{number} cannot be stored"));
    }
    match machine.ini.keys().find(|name| !is_ini_name(name)) {
        Some(name) => Err(format!("{name:?} is not of the form [SECTION]NAME")),
        None => Ok(()),
    }
}

fn environment(environment: &Environment) -> Result<(), String> {
    if let Some(name) = environment.name.as_ref().filter(|name| *name != OWN_ENVIRONMENT) {
        return Err(format!("the environment {name:?} is another controller's"));
    }
    for change in &environment.inputs {
        if input_pin(&change.input).is_none() || change.time > LATEST {
            return Err(format!("no input {} at {} s", change.input, change.time));
        }
    }
    let is_user_program = |name: &str| {
        let digits = name.strip_prefix(['M', 'm']).unwrap_or_default();
        digits.chars().all(|c| c.is_ascii_alphanumeric() || c == '.') && !digits.is_empty()
    };
    match environment.user_programs.iter().find(|program| !is_user_program(&program.file)) {
        Some(program) => {
            Err(format!("{:?} is not a valid file name of a user program", program.file))
        }
        None => Ok(()),
    }
}
