//! Tests of the modal side: programs of plain words, against a sink that writes down what it hears.

mod arcs;
mod arcs_property;
mod compensation;
mod compensation_property;
mod cycles;
mod ends;
mod grbl;
mod groups;
mod inputs_outputs;
mod motions_property;
mod moves;
mod names;
mod nist;
mod offsets;
mod polar;
mod probes;
mod property;
mod saved;
mod shifts_property;
mod spindles;
mod splines;
mod stored_positions;
mod threads;
mod tool_table;
mod tools;

use alloc::format;
use alloc::string::{String, ToString};
use alloc::vec::Vec;

use gaugeblock_vocabulary::{
    Effect, Entry, FaultKind, LengthUnit, Machine, Options, Position, Settings, Tool,
};

use crate::canon::{Reply, Sink, Waiting};
use crate::parameters::Numbered;
use crate::words::Words;

use super::{Flow, Modal, Refusal};

/// Writes down effects with their lines, and answers inputs with 0.5, probes with a contact at Z-1, user code 199 and
/// orientations beyond 9 s with no.
#[derive(Default)]
pub(super) struct Recorder {
    pub(super) effects: Vec<String>,
    pub(super) settings: Settings,
    pub(super) reported: usize,
    stop: bool,
}

impl Sink for Recorder {
    fn set(&mut self, _line: u32, changed: &Settings) {
        assert!(!changed.is_empty(), "an empty report");
        self.settings.overlay(changed);
        self.reported += 1;
    }

    fn hold(&mut self, _line: u32, waiting: Waiting<'_>) -> u64 {
        if let Waiting::Settings(changed) = waiting {
            self.settings.overlay(changed);
        }
        0
    }

    fn perform(&mut self, line: u32, effect: &Effect) -> Reply {
        let mut text = format!("{line} {}", effect.name());
        for (name, value) in effect.arguments() {
            text += &format!(" {name}={value}");
        }
        self.effects.push(text);
        if let Effect::WaitInput { .. } = effect {
            Reply::Input(0.5)
        } else if let Effect::StraightProbe { end, .. } = effect {
            Reply::Contact((end.z < -1.0).then_some(Position { z: -1.0, ..*end }))
        } else if let Effect::UserCode { code: 199, .. } = effect {
            Reply::Failed(FaultKind::UnknownCode)
        } else if let Effect::WaitOrient { timeout: 10.0.., .. } = effect {
            Reply::Failed(FaultKind::Orient)
        } else if let (Effect::Stop { .. }, true) = (effect, self.stop) {
            Reply::Stop
        } else {
            Reply::Done
        }
    }
}

/// A machine with two spindles that work in millimetres and three tools: 1 in pocket 2, 2 in pocket 1, 3.
pub(super) fn machine() -> Machine {
    let tool = |number, pocket, z, diameter| Tool {
        number,
        pocket,
        offset: Position { z, ..Position::default() },
        diameter,
        ..Tool::default()
    };
    Machine {
        spindles: 3,
        tools: [tool(1, Some(2), 10.0, 6.0), tool(2, Some(1), 20.0, 8.0), tool(3, None, 0.0, 0.0)]
            .into(),
        orient_offset: 0.0,
        ..Machine::default()
    }
}

/// The words of a line such as `g1 x1 f100 $0`.
pub(super) fn words(line: u32, text: &str) -> Words {
    let mut words = Words::new();
    words.clear(line);
    for word in text.split_whitespace() {
        let (letter, value) = word.split_at(1);
        let number = || value.parse().unwrap();
        let (whole, tenth) = value.split_once('.').unwrap_or((value, "0"));
        match letter {
            "g" => assert!(words.push_g(format!("{whole}{tenth}").parse().unwrap())),
            "m" => assert!(words.push_m(value.parse().unwrap())),
            "$" => words.dollar = Some(number()),
            "@" => words.at = Some(number()),
            "^" => words.caret = Some(number()),
            letter => words.set(letter.as_bytes()[0] - b'a', number()),
        }
    }
    words
}

/// The modes before a program.
pub(super) fn modal(
    machine: &Machine,
    options: &Options,
    numbered: &mut Numbered,
) -> Result<Modal, crate::Error> {
    Modal::new(machine, super::Choices::read(options)?, numbered)
}

/// A run of a program.
pub(super) struct Run {
    pub(super) modal: Modal,
    pub(super) numbered: Numbered,
    pub(super) sink: Recorder,
    /// What the last block came to, and its line.
    pub(super) last: (u32, Result<Flow, Refusal>),
}

/// Runs lines up to the first that is refused or ends; `call`, `back` and `abort` stand for what control does.
pub(super) fn run(machine: &Machine, options: &[(&str, &str)], program: &str) -> Run {
    let options = options.iter().map(|(id, option)| (id.to_string(), option.to_string()));
    let mut numbered = Numbered::new();
    let modal = modal(machine, &Options(options.collect()), &mut numbered).unwrap();
    let sink = Recorder { settings: modal.settings(), ..Recorder::default() };
    let mut run = Run { modal, numbered, sink, last: (0, Ok(Flow::More)) };
    for (line, text) in (1..).zip(program.trim().split(';').map(str::trim)) {
        match text {
            "call" => run.modal.enter_call(),
            "back" => run.modal.leave_call(&mut run.numbered, &mut run.sink, line),
            "begin" => run.modal.begin(),
            "abort" => run.modal.abort(&mut run.sink, line),
            _ => {
                let words = words(line, text);
                let mut result = run.modal.execute(&words, &mut run.numbered, &mut run.sink);
                while let Ok(Flow::Within { .. }) = result {
                    result = run.modal.resume_block(&mut run.numbered, &mut run.sink);
                }
                let goes_on = matches!(result, Ok(Flow::More | Flow::Stopped));
                run.last = (line, result);
                if !goes_on {
                    break;
                }
            }
        }
    }
    run
}

impl Run {
    /// A setting or a value of the state, as `feed_rate`, or a parameter, as `#5220`.
    pub(super) fn value(&self, name: &str) -> String {
        if let Some(number) = name.strip_prefix('#') {
            let number = number.parse().unwrap();
            return self.modal.numbered(number).unwrap_or(self.numbered.get(number)).to_string();
        }
        let state = self.modal.state().entries();
        let entries: Vec<Entry> =
            self.modal.settings().entries().into_iter().chain(state).collect();
        let entry = entries.iter().find(|entry| entry.name() == name);
        entry.unwrap_or_else(|| panic!("no such value: {name}")).value.to_string()
    }
}

/// What is expected of a program.
#[derive(Clone, Copy, Debug)]
pub(super) enum Expect {
    /// It is accepted, and afterwards these hold: `feed_rate = 5, tool = 1`.
    After(&'static str),
    /// It is accepted and has exactly these effects, parted by `; `.
    Effects(&'static str),
    /// Its last line is refused.
    Refused(FaultKind),
    /// The probe of its last line finds nothing.
    Missed,
    /// The documents leave open what its last line does.
    Unspecified,
}

/// Choices that differ from the first ones.
pub(super) type Chosen = &'static [(&'static str, &'static str)];

/// The one helper: runs a program and compares.
pub(super) fn check_on(machine: &Machine, chosen: Chosen, program: &str, expect: Expect) {
    let run = run(machine, chosen, program);
    let lines = u32::try_from(program.split(';').count()).unwrap();
    let place = format!("{program} {chosen:?}");
    match expect {
        Expect::Refused(kind) => {
            let refused = matches!(&run.last.1, Err(Refusal::Fault(found, _)) if *found == kind);
            assert!(refused && run.last.0 == lines, "{place}: {:?}", run.last);
            return;
        }
        Expect::Missed => {
            assert_eq!(run.last, (lines, Err(Refusal::Missed)), "{place}");
            return;
        }
        Expect::Unspecified => {
            assert!(matches!(run.last.1, Err(Refusal::Unspecified(_))), "{place}: {:?}", run.last);
            return;
        }
        Expect::Effects(effects) => {
            assert!(run.last.1.is_ok(), "{place}: {:?}", run.last);
            assert_eq!(run.sink.effects.join("; "), effects, "{place}");
        }
        Expect::After(values) => {
            assert!(run.last.1.is_ok(), "{place}: {:?}", run.last);
            for pair in values.split(", ") {
                let (name, value) = pair.split_once(" = ").unwrap();
                assert_eq!(run.value(name), value, "{place}: {name}");
            }
        }
    }
    assert_eq!(run.sink.settings, run.modal.settings(), "{place}: the sink was not told");
}

pub(super) fn check(program: &str, expect: Expect) {
    check_on(&machine(), &[], program, expect);
}

#[test]
fn a_sink_can_stop_after_a_block() {
    let mut numbered = Numbered::new();
    let mut modal = modal(&machine(), &Options::default(), &mut numbered).unwrap();
    let mut sink = Recorder { stop: true, ..Recorder::default() };
    let flow = modal.execute(&words(1, "m7 m0"), &mut numbered, &mut sink);
    assert_eq!(flow, Ok(Flow::Stopped));
    assert_eq!(modal.execute(&words(2, "m9"), &mut numbered, &mut sink), Ok(Flow::More));
}

#[test]
fn invalid_configuration_is_refused() {
    let refused = |machine: &Machine, id: &str, option: &str| {
        let options = Options([(id.into(), option.into())].into());
        assert!(modal(machine, &options, &mut Numbered::new()).is_err(), "{id} {option}");
    };
    refused(&machine(), "saved-state.places", "three");
    refused(&machine(), "modal-groups.initial-motion", "arc");
    refused(&Machine { spindles: 0, ..machine() }, "saved-state.places", "one");
    refused(&Machine { spindles: 9, ..machine() }, "saved-state.places", "one");
}

/// A machine that works in inches.
pub(super) fn inch_machine() -> Machine {
    Machine { length_unit: LengthUnit::Inch, ..machine() }
}
