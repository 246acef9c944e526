//! Generators for outcomes: settings, states, effects, faults, ends, pins, samples.

use gaugeblock_vocabulary::{
    Bound, Channel, Compensation, ControllerMode, Distance, Effect, End, Event, Fault, FaultKind,
    FeedMode, GppState, Language, Lathe, LengthUnit, MacroValue, Motion, NctState, OrientDirection,
    Outcome, OutputTiming, PathControlMode, Pin, PinChange, Plane, Request, ReturnMode, Rs274State,
    Sample, Settings, SpindleLimit, SpindleMode, SpindleTurn, State, Step, Switch, Vacancy,
    WaitMode,
};
use proptest::collection::vec;
use proptest::option;
use proptest::prelude::*;

use super::numbers::{block, indexed, number, position, span, text, word};
use super::{recorded, variants, whole};

/// Any outcome, in any of the languages.
pub(crate) fn outcome() -> BoxedStrategy<Outcome> {
    word(Language::ALL).prop_flat_map(outcome_in).boxed()
}

fn outcome_in(language: Language) -> BoxedStrategy<Outcome> {
    whole!(Outcome {
        language: Just(language),
        start: settings(),
        steps: vec(step(language), 0..4),
        end: end(),
        parameters: option::of(prop_oneof![
            Just(gaugeblock_vocabulary::Indexed::default()),
            indexed(any::<u32>(), number()),
        ]),
        pins: vec(pin(), 0..3),
        samples: vec(sample(), 0..3),
    })
}

fn step(language: Language) -> BoxedStrategy<Step> {
    let set = settings().prop_map(|changed| Event::Set(changed.into()));
    let fields: Vec<String> = Settings::FIELDS.iter().map(|field| (*field).to_owned()).collect();
    let unknown = vec(proptest::sample::select(fields), 0..3).prop_map(Event::Unknown);
    let event = prop_oneof![set, effect().prop_map(Event::Do), unknown];
    whole!(Step { block: block(), events: vec(event, 0..4), state: option::of(state(language)) })
}

/// Any record of settings.
pub(crate) fn settings() -> BoxedStrategy<Settings> {
    recorded!(Settings {
        units: word(LengthUnit::ALL),
        plane: word(Plane::ALL),
        distance: word(Distance::ALL),
        arc_distance: word(Distance::ALL),
        feed_mode: word(FeedMode::ALL),
        feed_rate: number(),
        retract: word(ReturnMode::ALL),
        compensation: word(Compensation::ALL),
        tool_length: word(Switch::ALL),
        tool_offset: position(),
        work_offset: any::<u32>(),
        g5x_offset: position(),
        g92_offset: position(),
        rotation: number(),
        path: word(PathControlMode::ALL),
        blend_tolerance: number(),
        naive_cam_tolerance: number(),
        lathe: word(Lathe::ALL),
        spindle_speed: indexed(any::<u8>(), number()),
        spindle_mode: indexed(any::<u8>(), word(SpindleMode::ALL)),
        spindle_limit: indexed(any::<u8>(), spindle_limit()),
        spindle: indexed(any::<u8>(), word(SpindleTurn::ALL)),
        mist: word(Switch::ALL),
        flood: word(Switch::ALL),
        feed_override: word(Switch::ALL),
        speed_override: indexed(any::<u8>(), word(Switch::ALL)),
        adaptive_feed: word(Switch::ALL),
        feed_stop: word(Switch::ALL),
    })
}

fn spindle_limit() -> BoxedStrategy<SpindleLimit> {
    prop_oneof![Just(SpindleLimit::None), number().prop_map(SpindleLimit::Rpm)].boxed()
}

fn state(language: Language) -> BoxedStrategy<State> {
    match language {
        Language::Rs274 => rs274_state().prop_map(State::Rs274).boxed(),
        Language::Nct => nct_state().prop_map(State::Nct).boxed(),
        Language::Gpp => gpp_state().prop_map(State::Gpp).boxed(),
    }
}

fn rs274_state() -> BoxedStrategy<Rs274State> {
    recorded!(Rs274State {
        motion: word(Motion::ALL),
        position: position(),
        tool: any::<i32>(),
        prepared_tool: any::<i32>(),
        controller_mode: word(ControllerMode::ALL),
        call_level: any::<u32>(),
        parameter: indexed(text(), number()),
    })
}

fn nct_state() -> BoxedStrategy<NctState> {
    let value = || {
        prop_oneof![
            Just(MacroValue::Vacant(Vacancy::Vacant)),
            number().prop_map(MacroValue::Number),
        ]
    };
    recorded!(NctState {
        macro_level: any::<u32>(),
        local: indexed(text(), value()),
        common: indexed(any::<u32>(), value()),
        modal_call: indexed(any::<u32>(), any::<u32>()),
        motion: word(Motion::ALL),
        position: position(),
    })
}

fn gpp_state() -> BoxedStrategy<GppState> {
    recorded!(GppState {
        variable: indexed(text(), text()),
        set: indexed(text(), word(Switch::ALL)),
        modal: indexed(text(), any::<bool>()),
    })
}

/// Any effect.
pub(crate) fn effect() -> BoxedStrategy<Effect> {
    variants!(Effect {
        StraightTraverse { end: position(), }
        StraightFeed { end: position(), }
        ArcFeed {
            end: position(),
            first_centre: number(),
            second_centre: number(),
            turns: any::<i32>(),
        }
        NurbsFeed { points: any::<u32>(), end: position(), }
        StraightProbe { end: position(), contact: option::of(position()), }
        RigidTap { end: position(), }
        StartSpindleSynchronisation { spindle: any::<u32>(), pitch: number(), }
        StopSpindleSynchronisation {}
        Dwell { seconds: number(), }
        PrepareTool { tool: any::<i32>(), }
        PromptTool { tool: any::<i32>(), }
        ChangeTool { tool: any::<i32>(), }
        SetToolNumber { tool: any::<i32>(), }
        SetToolEntry {
            tool: any::<i32>(),
            offset: position(),
            diameter: number(),
            front_angle: number(),
            back_angle: number(),
            orientation: any::<i32>(),
        }
        OrientSpindle { spindle: any::<u32>(), angle: number(), direction: word(OrientDirection::ALL), }
        WaitOrient { spindle: any::<u32>(), timeout: number(), }
        SetDigitalOutput { output: any::<i32>(), on: any::<bool>(), timing: word(OutputTiming::ALL), }
        SetAnalogOutput { output: any::<i32>(), to: number(), timing: word(OutputTiming::ALL), }
        WaitInput {
            digital: option::of(any::<i32>()),
            analog: option::of(any::<i32>()),
            mode: word(WaitMode::ALL),
            timeout: option::of(number()),
            read: number(),
        }
        UserCode { code: any::<u32>(), p: text(), q: text(), }
        Stop { optional: any::<bool>(), }
        PalletShuttle {}
        Message { channel: word(Channel::ALL), text: text(), }
        LogOpen { file: text(), append: any::<bool>(), }
        LogClose {}
        ProbeLogOpen { file: text(), }
        ProbeLogClose {}
        ChangeControllerMode { mode: word(ControllerMode::ALL), }
        RequestRefused { request: word(Request::ALL), }
        ProgramEnd {}
    })
}

fn fault() -> BoxedStrategy<Fault> {
    whole!(Fault {
        kind: option::of(word(FaultKind::ALL)),
        block: option::of(block()),
        span: option::of(span()),
        message: text(),
    })
}

fn end() -> BoxedStrategy<End> {
    let complete = |end: &End| match end {
        End::ProgramEnd | End::PercentEnd | End::StreamEnd => {}
        End::Endless | End::Paused | End::Aborted => {}
        End::Fault(_) | End::BudgetExhausted { .. } => {}
        End::Unsupported { .. } | End::Unspecified { .. } => {}
    };
    prop_oneof![
        proptest::sample::select(vec![
            End::ProgramEnd,
            End::PercentEnd,
            End::StreamEnd,
            End::Endless,
            End::Paused,
            End::Aborted,
        ]),
        fault().prop_map(End::Fault),
        word(Bound::ALL).prop_map(|bound| End::BudgetExhausted { bound }),
        (block(), text()).prop_map(|(block, what)| End::Unsupported { block, what }),
        (block(), text()).prop_map(|(block, why)| End::Unspecified { block, why }),
    ]
    .prop_map(move |end| {
        complete(&end);
        end
    })
    .boxed()
}

fn pin() -> BoxedStrategy<PinChange> {
    let indexed = proptest::sample::select(Pin::INDEXED_NAMES);
    let single = proptest::sample::select(Pin::SINGLE_NAMES);
    let name = prop_oneof![
        (indexed, any::<u16>()).prop_map(|(name, index)| format!("{name}[{index}]")),
        single.prop_map(str::to_owned),
    ];
    let pin = name.prop_map(|name| name.parse::<Pin>().expect("every name is one of a pin"));
    whole!(PinChange { time: number(), pin: pin, value: number() })
}

fn sample() -> BoxedStrategy<Sample> {
    whole!(Sample { time: number(), position: position() })
}
