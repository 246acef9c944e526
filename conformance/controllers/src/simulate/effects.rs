//! What a program requires of a planner in addition to moves, read from its effects and settings.

use std::collections::BTreeSet;

use gaugeblock_vocabulary::{
    Effect, Event, FeedMode, Outcome, OutputTiming, Pin, Settings, SpindleTurn,
};

/// Whether an effect is an element of the path: a move, or something for which the motion rests.
pub(super) fn is_element(effect: &Effect) -> bool {
    match effect {
        Effect::StraightTraverse { .. }
        | Effect::StraightFeed { .. }
        | Effect::ArcFeed { .. }
        | Effect::NurbsFeed { .. }
        | Effect::StraightProbe { .. }
        | Effect::RigidTap { .. }
        | Effect::Dwell { .. }
        | Effect::PromptTool { .. }
        | Effect::ChangeTool { .. }
        | Effect::WaitOrient { .. }
        | Effect::WaitInput { .. }
        | Effect::UserCode { .. }
        | Effect::Stop { .. }
        | Effect::PalletShuttle {}
        | Effect::ProgramEnd {} => true,
        Effect::SetDigitalOutput { timing, .. } | Effect::SetAnalogOutput { timing, .. } => {
            *timing == OutputTiming::AtOnce
        }
        Effect::StartSpindleSynchronisation { .. }
        | Effect::StopSpindleSynchronisation {}
        | Effect::PrepareTool { .. }
        | Effect::SetToolNumber { .. }
        | Effect::SetToolEntry { .. }
        | Effect::OrientSpindle { .. }
        | Effect::Message { .. }
        | Effect::LogOpen { .. }
        | Effect::LogClose {}
        | Effect::ProbeLogOpen { .. }
        | Effect::ProbeLogClose {}
        | Effect::ChangeControllerMode { .. }
        | Effect::RequestRefused { .. } => false,
    }
}

/// Turns per second of the first spindle.
pub(super) fn spindle(settings: &Settings) -> f64 {
    let turn = settings.spindle.as_ref().and_then(|spindles| spindles.0.get(&0));
    let speed = settings.spindle_speed.as_ref().and_then(|speeds| speeds.0.get(&0));
    let turns = matches!(turn, Some(SpindleTurn::Clockwise | SpindleTurn::Counterclockwise));
    if turns { speed.copied().unwrap_or(0.0).abs() / 60.0 } else { 0.0 }
}

/// Whether any feed of a program is one per revolution.
pub(super) fn follows_spindle(outcome: &Outcome) -> bool {
    let follows = |settings: &Settings| settings.feed_mode == Some(FeedMode::PerRevolution);
    let mut events = outcome.steps.iter().flat_map(|step| &step.events);
    follows(&outcome.start)
        || events.any(|event| matches!(event, Event::Set(change) if follows(change)))
}

/// The outputs that a program switches.
pub(super) fn pins(outcome: &Outcome) -> BTreeSet<Pin> {
    let events = outcome.steps.iter().flat_map(|step| &step.events);
    let effects =
        events.filter_map(|event| if let Event::Do(effect) = event { Some(effect) } else { None });
    effects.filter_map(switching).map(|(pin, ..)| pin).collect()
}

/// Which output an effect switches, to what, and when.
#[expect(clippy::wildcard_enum_match_arm, reason = "the other effects switch no output")]
pub(super) fn switching(effect: &Effect) -> Option<(Pin, f64, OutputTiming)> {
    let (pin, output, value, timing): (fn(u16) -> Pin, _, _, _) = match effect {
        Effect::SetDigitalOutput { output, on, timing } => {
            (Pin::DigitalOut, *output, f64::from(u8::from(*on)), *timing)
        }
        Effect::SetAnalogOutput { output, to, timing } => (Pin::AnalogOut, *output, *to, *timing),
        _ => return None,
    };
    Some((pin(u16::try_from(output).ok()?), value, timing))
}
