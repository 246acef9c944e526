//! Generators for scenarios: program, options, machine, environment, operator, budget.

use gaugeblock_vocabulary::scenario::{
    Action, AxisLimits, Budget, Environment, Folder, InputChange, OperatorEvent, OrientAnswer,
    ProbeContact, RunPoint, Start, ToolChange, UserProgram,
};
use gaugeblock_vocabulary::{
    Axis, ControllerMode, Language, LengthUnit, Machine, Options, Program, Scenario, Tool,
};
use proptest::collection::vec;
use proptest::option;
use proptest::prelude::*;

use super::numbers::{block, indexed, named, number, position, text, word};
use super::whole;

/// Any scenario; its program is any text.
pub(crate) fn scenario() -> BoxedStrategy<Scenario> {
    whole!(Scenario {
        program: program(),
        options: named(text()).prop_map(|options| Options(options.into())),
        machine: machine(),
        environment: environment(),
        operator: vec(operator_event(), 0..3),
        budget: budget(),
    })
}

fn program() -> BoxedStrategy<Program> {
    whole!(Program {
        language: word(Language::ALL),
        main: text(),
        files: named(text()),
        block_delete: any::<bool>(),
        start: prop_oneof![Just(Start::Program), Just(Start::Mdi)],
    })
}

fn machine() -> BoxedStrategy<Machine> {
    let first = (
        word(LengthUnit::ALL),
        vec(word(Axis::ALL), 0..4),
        named(axis_limits()),
        any::<u8>(),
        any::<u16>(),
        any::<u16>(),
        number(),
    );
    let second = (
        tool_change(),
        any::<bool>(),
        any::<bool>(),
        vec(tool(), 0..3),
        prop_oneof![
            Just(gaugeblock_vocabulary::Indexed::default()),
            indexed(any::<u32>(), number())
        ],
        named(number()),
    );
    (first, second)
        .prop_map(|(first, second)| {
            let (length_unit, axes, limits, spindles, digital_io, analog_io, orient_offset) = first;
            let (tool_change, random_tool_changer, fanuc_subs, tools, parameters, ini) = second;
            Machine {
                length_unit,
                axes,
                limits,
                spindles,
                digital_io,
                analog_io,
                orient_offset,
                tool_change,
                random_tool_changer,
                fanuc_subs,
                tools,
                parameters,
                ini,
            }
        })
        .boxed()
}

fn axis_limits() -> BoxedStrategy<AxisLimits> {
    whole!(AxisLimits {
        minimum: option::of(number()),
        maximum: option::of(number()),
        velocity: option::of(number()),
        acceleration: option::of(number()),
        jerk: option::of(number()),
    })
}

fn tool_change() -> BoxedStrategy<ToolChange> {
    whole!(ToolChange {
        at_g30: any::<bool>(),
        quill_up: any::<bool>(),
        with_spindle_on: any::<bool>(),
    })
}

fn tool() -> BoxedStrategy<Tool> {
    whole!(Tool {
        number: any::<u32>(),
        pocket: option::of(any::<u32>()),
        offset: position(),
        diameter: number(),
        front_angle: number(),
        back_angle: number(),
        orientation: any::<u8>(),
    })
}

fn environment() -> BoxedStrategy<Environment> {
    whole!(Environment {
        name: option::of(text()),
        wires: named(any::<u16>()),
        inputs: vec(input_change(), 0..3),
        orient: vec(orient_answer(), 0..3),
        probe: option::of(probe_contact()),
        tool_change_time: number(),
        manual_tool_change: any::<bool>(),
        user_programs: vec(user_program(), 0..3),
    })
}

fn input_change() -> BoxedStrategy<InputChange> {
    whole!(InputChange { time: number(), input: text(), value: number() })
}

fn orient_answer() -> BoxedStrategy<OrientAnswer> {
    let complete = |answer: &OrientAnswer| match answer {
        OrientAnswer::After(_) | OrientAnswer::Never | OrientAnswer::Fault(_) => {}
    };
    prop_oneof![
        number().prop_map(OrientAnswer::After),
        Just(OrientAnswer::Never),
        any::<i32>().prop_map(OrientAnswer::Fault),
    ]
    .prop_map(move |answer| {
        complete(&answer);
        answer
    })
    .boxed()
}

fn probe_contact() -> BoxedStrategy<ProbeContact> {
    let complete = |contact: &ProbeContact| match contact {
        ProbeContact::AtTarget | ProbeContact::At(_) | ProbeContact::Never => {}
    };
    prop_oneof![
        Just(ProbeContact::AtTarget),
        position().prop_map(ProbeContact::At),
        Just(ProbeContact::Never),
    ]
    .prop_map(move |contact| {
        complete(&contact);
        contact
    })
    .boxed()
}

fn user_program() -> BoxedStrategy<UserProgram> {
    whole!(UserProgram {
        file: text(),
        folder: prop_oneof![
            Just(Folder::ProgramPrefix),
            Just(Folder::SearchPath),
            Just(Folder::Elsewhere),
        ],
        executable: any::<bool>(),
        duration: number(),
        exit_status: any::<i32>(),
        at_start: any::<bool>(),
    })
}

fn operator_event() -> BoxedStrategy<OperatorEvent> {
    let when = whole!(RunPoint { block: block(), execution: any::<u32>(), offset: number() });
    whole!(OperatorEvent { when: when, action: action() })
}

fn action() -> BoxedStrategy<Action> {
    let complete = |action: &Action| match action {
        Action::CycleStart | Action::Pause | Action::Resume | Action::Abort => {}
        Action::Mode(_) | Action::Mdi(_) | Action::OptionalStop(_) | Action::FeedHold(_) => {}
        Action::FeedOverride(_) | Action::RapidOverride(_) | Action::SpindleOverride { .. } => {}
    };
    prop_oneof![
        proptest::sample::select(vec![
            Action::CycleStart,
            Action::Pause,
            Action::Resume,
            Action::Abort,
        ]),
        word(ControllerMode::ALL).prop_map(Action::Mode),
        text().prop_map(Action::Mdi),
        any::<bool>().prop_map(Action::OptionalStop),
        any::<bool>().prop_map(Action::FeedHold),
        number().prop_map(Action::FeedOverride),
        number().prop_map(Action::RapidOverride),
        (any::<u8>(), number())
            .prop_map(|(spindle, factor)| Action::SpindleOverride { spindle, factor }),
    ]
    .prop_map(move |action| {
        complete(&action);
        action
    })
    .boxed()
}

fn budget() -> BoxedStrategy<Budget> {
    whole!(Budget { steps: any::<u32>(), effects: any::<u32>(), time: number() })
}
