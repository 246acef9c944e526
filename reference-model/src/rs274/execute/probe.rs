//! G38.2 to G38.5: straight probing.

use gaugeblock_vocabulary::{Compensation, Effect, FaultKind, FeedMode, Motion, Position};

use super::move_start::Speed;
use super::target::end_point;
use super::word;
use crate::ids::{Rule, choice, rule};
use crate::rs274::environment::{Wanted, stub};
use crate::rs274::evaluate::Words;
use crate::rs274::modes::converted;
use crate::rs274::order::has_axis_words;
use crate::rs274::refusal::{StepError, refuse};
use crate::rs274::state::State;
use crate::rs274::task::Record;

/// The parameters that hold where the probe changed, X to W.
const POINT: u32 = 5061;

/// The parameter that is 1 where it did, and 0 where it did not.
const SUCCEEDED: u32 = 5070;

/// Whether a motion mode is probing.
pub(crate) fn is_probing(motion: Motion) -> bool {
    use Motion as M;
    matches!(motion, M::ProbeTowardError | M::ProbeToward | M::ProbeAwayError | M::ProbeAway)
}

/// Whether a rule is one that a block breaks when its probe has moved: what it has done by then stays.
pub(crate) fn has_moved(rule: Rule) -> bool {
    rule == rule::probe::FAILURE
}

/// Whether a rule is one that a block breaks as the machine reaches it. Rule probe.same-point is not: the words of the
/// block decide it, as it is read ahead.
pub(crate) fn is_found_out_by_machine(rule: Rule) -> bool {
    [rule::probe::ALREADY_THERE, rule::probe::FAILURE].contains(&rule)
}

/// Moves toward a point until the probe changes.
///
/// Rule probe.toward. G38.2 and G38.3 stop where the probe begins to touch; rule probe.away: G38.4 and G38.5 where it
/// ceases. Rule probe.at-feed. It is a feed move. Rule probe.point. #5061 to #5069 are where the probe changed, and
/// #5070 is 1. Rule probe.point-without-contact. Where it did not change they are the programmed point, and #5070 is
/// 0.
///
/// # Errors
/// Those of `allowed`; rule probe.already-there: when the move begins the probe is not yet as it wants it; and rule
/// probe.failure: under G38.2 and G38.4 it must change.
pub(super) fn perform(
    motion: Motion,
    words: &Words,
    state: &mut State,
    record: &mut Record,
) -> Result<(), StepError> {
    let toward = matches!(motion, Motion::ProbeTowardError | Motion::ProbeToward);
    let wanted = if toward { Wanted::Touching } else { Wanted::Free };
    let end = allowed(motion, words, state)?;
    let on_machine = |point: Position, state: &State| {
        converted(state.modes.machine_point(point), state.modes.units, state.machine.length_unit)
    };
    let (from, to) = (on_machine(state.position, state), on_machine(end, state));
    if record.waits_to_move(Speed::Feed, state) {
        return Ok(());
    }
    let rule = rule::probe::ALREADY_THERE;
    if state.environment.probe_is(wanted, from) {
        let message = "the probe is as the move wants it before it moves";
        return Err(refuse(rule, FaultKind::Probe, message));
    }
    state.coverage.accepted(rule);
    let changed = state.environment.probe(from, to);
    let contact = changed.map(|point| {
        let point = converted(point, state.machine.length_unit, state.modes.units);
        if changed == Some(to) { end } else { state.modes.program_point(point) }
    });
    state.modes.motion = motion;
    record.effect(state, Effect::StraightProbe { end, contact });
    state.environment.has_probed(wanted, to, changed);
    let stops_at = contact.unwrap_or(end);
    for (number, value) in (POINT..).zip(stops_at.to_array()) {
        state.parameters.store(number, value);
    }
    let succeeded = contact.is_some() && state.environment.reports_contact();
    state.parameters.store(SUCCEEDED, if succeeded { 1.0 } else { 0.0 });
    state.position = stub::after_probing(end, stops_at, state)?;
    state.environment.synchronise();
    check_outcome(motion, contact.is_some(), state)
}

/// Rule probe.failure. Under G38.2 and G38.4 the probe must change.
/// Rule probe.without-failure. Under G38.3 and G38.5 the program goes on without a change, too.
fn check_outcome(motion: Motion, changed: bool, state: &mut State) -> Result<(), StepError> {
    let toward = matches!(motion, Motion::ProbeTowardError | Motion::ProbeToward);
    let must_change = matches!(motion, Motion::ProbeTowardError | Motion::ProbeAwayError);
    if !changed && must_change {
        let message = "the probe did not change on its way";
        return Err(refuse(rule::probe::FAILURE, FaultKind::Probe, message));
    }
    let rules = if changed {
        [
            if toward { rule::probe::TOWARD } else { rule::probe::AWAY },
            rule::probe::POINT,
            rule::probe::AT_FEED,
        ]
    } else {
        [rule::probe::WITHOUT_FAILURE, rule::probe::POINT_WITHOUT_CONTACT, rule::probe::AT_FEED]
    };
    for rule in rules {
        state.coverage.accepted(rule);
    }
    Ok(())
}

/// The rules of probing that a controller may follow differently.
pub(crate) trait ProbeRules {
    /// Rule probe.zero-feed. Probing needs a feed rate, under inverse time in its block.
    fn check_probe_feed(
        &self,
        motion: Motion,
        words: &Words,
        state: &State,
    ) -> Result<(), StepError> {
        let in_block = state.modes.feed_mode == FeedMode::InverseTime
            && state.dialect().takes_feed_rate(motion, state);
        if in_block && word(words, 'f').is_none() || state.modes.feed_rate == 0.0 {
            let message = "probing without a feed rate";
            return Err(refuse(rule::probe::ZERO_FEED, FaultKind::ZeroFeed, message));
        }
        Ok(())
    }

    /// Rule probe.same-point. Whether a probing move leads to where the controlled point is, which is refused.
    fn probes_in_place(&self, _motion: Motion, end: Position, state: &State) -> bool {
        end == state.position
    }
}

/// The end point of a probing move that is allowed.
///
/// Rule probe.axis-words-missing. It needs an axis word. Rule probe.under-compensation. It is refused while cutter
/// compensation is on. Rule probe.zero-feed. It needs a feed rate, under inverse time in its block.
/// Rule probe.same-point. The programmed point is another than the current one.
/// Choice probe.standing-spindle: whether probing is a feed move to the rule on constant surface speed.
fn allowed(motion: Motion, words: &Words, state: &mut State) -> Result<Position, StepError> {
    if !has_axis_words(words) {
        let message = "probing without an axis word";
        return Err(refuse(rule::probe::AXIS_WORDS_MISSING, FaultKind::MissingWord, message));
    }
    if state.modes.compensation != Compensation::Off {
        let message = "probing while cutter compensation is on";
        return Err(refuse(
            rule::probe::UNDER_COMPENSATION,
            FaultKind::CompensationActive,
            message,
        ));
    }
    state.dialect().check_probe_feed(motion, words, state)?;
    if state.choices.is(choice::probe::StandingSpindle::Refused)
        && state.dialect().surface_speed_stands(state)
    {
        let message = "probing under constant surface speed while the spindle is stopped";
        let rule = rule::spindle::SURFACE_SPEED_WHILE_STOPPED;
        return Err(refuse(rule, FaultKind::ZeroSpeed, message));
    }
    let end = end_point(words, state)?;
    if state.dialect().probes_in_place(motion, end, state) {
        let message = "probing to where the controlled point is";
        return Err(refuse(rule::probe::SAME_POINT, FaultKind::Probe, message));
    }
    for rule in [
        rule::probe::AXIS_WORDS_MISSING,
        rule::probe::UNDER_COMPENSATION,
        rule::probe::ZERO_FEED,
        rule::probe::SAME_POINT,
    ] {
        state.coverage.accepted(rule);
    }
    if state.modes.feed_mode == FeedMode::InverseTime {
        state.coverage.accepted(rule::probe::INVERSE_TIME);
    }
    Ok(end)
}
