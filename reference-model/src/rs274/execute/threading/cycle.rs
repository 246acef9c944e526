//! G76: a thread in several passes, each deeper than the one before.

use gaugeblock_vocabulary::{
    Axis, Compensation, Distance, Effect, FaultKind, Lathe, Plane, Position, Switch,
};

use super::{number, selected_spindle, turning_spindle};
use crate::ids::{choice, quirk, rule};
use crate::rs274::evaluate::Words;
use crate::rs274::execute::{letter, whole, word};
use crate::rs274::quirks::threading as quirks;
use crate::rs274::refusal::{StepError, refuse};
use crate::rs274::state::State;
use crate::rs274::task::Record;

/// A thread, all its numbers found; lengths are radii, active length unit.
#[derive(Clone, Copy, Debug)]
struct Thread {
    /// The controlled point before it: X is the drive line, Z where the thread begins.
    start: Position,
    /// Where the thread ends along Z.
    end: f64,
    /// Length unit per revolution.
    pitch: f64,
    /// From the drive line to the thread's crest.
    peak: f64,
    /// Depth of the first pass.
    first: f64,
    /// Full depth.
    full: f64,
    /// 1 for passes of constant depth, 2 for those of constant area.
    degression: f64,
    /// Degrees by which a pass moves along the drive line with its depth.
    slide: f64,
    /// Length of a taper along the drive line.
    taper: f64,
    /// Whether a pass begins with a taper.
    tapers_in: bool,
    /// Whether it ends with one.
    tapers_out: bool,
    /// Passes at full depth after the last.
    springs: i32,
    /// The spindle, as effects tell it.
    spindle: usize,
}

/// Cuts a thread.
///
/// Rule threading.thread. Each pass traverses to its depth, feeds along Z synchronised with the spindle, traverses
/// out to the drive line and back; the last one stays at the end of the drive line. Rule threading.degression. The
/// first pass is J beyond the crest, the last one K; those between are of constant depth under R1 and of constant
/// area under R2. Rule threading.spring-passes. H passes more are at full depth.
///
/// # Errors
/// Those of `find`.
pub(in crate::rs274::execute) fn perform(
    words: &Words,
    state: &mut State,
    record: &mut Record,
) -> Result<(), StepError> {
    let thread = find(words, state)?;
    state.modes.motion = gaugeblock_vocabulary::Motion::Thread76;
    let mut count = 1.0;
    let mut left = thread.springs;
    while left >= 0 || thread.springs < 0 {
        if record.is_full() {
            return Err(StepError::TooManyEffects);
        }
        let depth = thread.depth(count);
        count += 1.0;
        if depth >= thread.full {
            left -= 1;
        }
        if depth >= thread.full && thread.springs < 0 {
            // Quirk rs274.thread-negative-springs: the last pass is left out.
            break;
        }
        pass(&thread, depth, state, record);
    }
    if thread.springs > 0 {
        state.coverage.accepted(rule::threading::SPRING_PASSES);
    }
    if let Some(end) = quirks::after_thread(words, thread.start, thread.end, state)? {
        traverse(end, state, record);
    }
    state.coverage.accepted(rule::threading::THREAD);
    state.coverage.accepted(rule::threading::DEGRESSION);
    Ok(())
}

impl Thread {
    /// How far beyond the crest a pass is, counted from 1. One that is at K but for its rounding is the last one:
    /// three times 0.3 is 0.9.
    fn depth(&self, pass: f64) -> f64 {
        let deeper = if self.degression > 1.0 { crate::math::square_root(pass) } else { pass };
        let depth = self.first * deeper;
        let rounding = 8.0 * f64::EPSILON * self.full;
        if depth > self.full - rounding { self.full } else { depth }
    }
}

/// Rule threading.thread-slide. The slide angle Q moves a pass along the drive line, the deeper the further; how it
/// moves the pass's end is a choice.
fn ends(thread: &Thread, depth: f64, state: &State) -> [f64; 2] {
    let direction = quirks::direction(thread.end - thread.start.z, state);
    let along = direction * crate::math::tangent_of_degrees(thread.slide);
    let both = state.choices.is(choice::threading::SlideEnd::WithDepth);
    let behind = if both { (thread.full - depth) * along } else { 0.0 };
    [thread.start.z + depth * along, thread.end - behind]
}

/// One pass.
///
/// Rule threading.thread-tapers. Along E, at the ends that L names, it feeds aslant between its depth and K further
/// out; at such an entry it feeds from the drive line, at others it traverses. Along Z it moves P for each revolution
/// everywhere.
fn pass(thread: &Thread, depth: f64, state: &mut State, record: &mut Record) {
    let inward = thread.peak.signum();
    let clearance = quirks::clearance(thread.full - depth, state);
    let [from, to] = ends(thread, depth, state);
    let taper = thread.taper * quirks::direction(to - from, state);
    let line = Position { x: thread.start.x - inward * clearance, z: from, ..thread.start };
    let cut = thread.start.x + thread.peak + inward * depth;
    let out = cut - inward * thread.full;
    let at = |x: f64, z: f64| Position { x, z, ..line };
    if state.position != line || state.choices.quirk(quirk::rs274::THREAD_CLEARANCE) {
        traverse(line, state, record);
    }
    if !thread.tapers_in {
        traverse(at(cut, from), state, record);
    }
    let feed_override = state.modes.feed_override;
    if state.choices.quirk(quirk::rs274::THREAD_FEED_OVERRIDE) {
        state.modes.feed_override = Switch::Off;
    }
    let aslant = thread.pitch * crate::math::hypotenuse(thread.full, thread.taper) / thread.taper;
    if thread.tapers_in {
        synchronise(thread, aslant, state, record);
        feed(at(out, from), state, record);
        feed(at(cut, from + taper), state, record);
    }
    synchronise(thread, thread.pitch, state, record);
    if thread.tapers_out {
        feed(at(cut, to - taper), state, record);
        synchronise(thread, aslant, state, record);
        feed(at(out, to), state, record);
    } else {
        feed(at(cut, to), state, record);
    }
    record.effect(state, Effect::StopSpindleSynchronisation {});
    traverse(at(line.x, to), state, record);
    state.modes.feed_override = quirks::feed_override_after(feed_override, state);
}

fn synchronise(thread: &Thread, pitch: f64, state: &mut State, record: &mut Record) {
    let spindle = number(thread.spindle);
    record.effect(state, Effect::StartSpindleSynchronisation { spindle, pitch });
}

fn feed(end: Position, state: &mut State, record: &mut Record) {
    state.position = end;
    record.effect(state, Effect::StraightFeed { end });
}

fn traverse(end: Position, state: &mut State, record: &mut Record) {
    state.position = end;
    record.effect(state, Effect::StraightTraverse { end });
}

/// The numbers of a thread.
///
/// Rule threading.thread-plane. G76 is in the ZX plane. Rule threading.thread-axis-words. Z is its only axis word.
/// Rule threading.thread-words. P, Z, I, J and K must be there. Rule threading.thread-negative. P, J, K and H are not
/// negative. Rule threading.thread-degression. R is not less than 1.
/// Rule threading.thread-taper. E is not more than half the drive line.
/// Rule threading.thread-diameter. In diameter mode I, J and K are diameters.
fn find(words: &Words, state: &mut State) -> Result<Thread, StepError> {
    refused_words(words, state)?;
    let spindle = if state.choices.is(choice::threading::CycleSpindle::Turning) {
        turning_spindle(words, state)?
    } else {
        selected_spindle(words, state)?
    };
    let value = |letter| word(words, letter).unwrap_or(0.0);
    let diameter = state.modes.lathe == Lathe::Diameter;
    let radius = |letter| if diameter { value(letter) / 2.0 } else { value(letter) };
    let start = state.position;
    let incremental = state.modes.distance == Distance::Incremental;
    let end = if incremental { start.z + value('z') } else { value('z') };
    let any_taper = state.choices.quirk(quirk::rs274::THREAD_LONG_TAPER);
    if value('e') > (end - start.z).abs() / 2.0 && !any_taper {
        let message = "a taper of more than half the thread";
        return Err(refuse(rule::threading::THREAD_TAPER, FaultKind::WordOutOfRange, message));
    }
    if diameter {
        state.coverage.accepted(rule::threading::THREAD_DIAMETER);
    }
    let degression = word(words, 'r').unwrap_or_else(|| {
        let areas = state.choices.is(choice::threading::WithoutDegression::ConstantArea);
        if areas { 2.0 } else { 1.0 }
    });
    let springs = word(words, 'h').map_or(Some(0), whole);
    let tapers = word(words, 'l').map_or(Some(0), whole).filter(|ends| (0..=3).contains(ends));
    let Some(_) = tapers else {
        return Err(StepError::Unspecified("an L of G76 that is none of 0 to 3".to_owned()));
    };
    let thread = Thread {
        start,
        end,
        pitch: value('p'),
        peak: radius('i'),
        first: radius('j'),
        full: radius('k'),
        degression: degression.max(1.0),
        slide: value('q'),
        taper: value('e'),
        tapers_in: matches!(tapers, Some(1 | 3)),
        tapers_out: matches!(tapers, Some(2 | 3)),
        springs: springs.unwrap_or(-2),
        spindle: quirks::reported_spindle(spindle, words, state),
    };
    open(&thread, state)?;
    Ok(thread)
}

fn refused_words(words: &Words, state: &mut State) -> Result<(), StepError> {
    if state.modes.plane != Plane::Zx && !state.choices.quirk(quirk::rs274::THREAD_ANY_PLANE) {
        let message = "G76 in another plane than ZX";
        return Err(refuse(rule::threading::THREAD_PLANE, FaultKind::ModalConflict, message));
    }
    let x_and_y = state.choices.quirk(quirk::rs274::THREAD_OTHER_AXES);
    let other = |axis: &Axis| {
        let allowed = *axis == Axis::Z || x_and_y && matches!(axis, Axis::X | Axis::Y);
        !allowed && word(words, letter(*axis)).is_some()
    };
    let polar = ['@', '^'].iter().any(|polar| word(words, *polar).is_some());
    if Axis::ALL.iter().any(other) || polar && !x_and_y {
        let message = "G76 with another axis word than Z";
        return Err(refuse(rule::threading::THREAD_AXIS_WORDS, FaultKind::AxisWords, message));
    }
    if let Some(missing) = "pzijk".chars().find(|letter| word(words, *letter).is_none()) {
        let message = format!("G76 needs {}", missing.to_ascii_uppercase());
        return Err(refuse(rule::threading::THREAD_WORDS, FaultKind::MissingWord, message));
    }
    let below = |letter: char, least: f64| word(words, letter).is_some_and(|value| value < least);
    let any_springs = state.choices.quirk(quirk::rs274::THREAD_NEGATIVE_SPRINGS);
    let not_negative = if any_springs { "pjk" } else { "pjkh" };
    if let Some(negative) = not_negative.chars().find(|letter| below(*letter, 0.0)) {
        let message = format!("a negative {} of G76", negative.to_ascii_uppercase());
        return Err(refuse(rule::threading::THREAD_NEGATIVE, FaultKind::WordOutOfRange, message));
    }
    if below('r', 1.0) && !state.choices.quirk(quirk::rs274::THREAD_LOW_DEGRESSION) {
        let message = "a degression of less than 1";
        return Err(refuse(rule::threading::THREAD_DEGRESSION, FaultKind::WordOutOfRange, message));
    }
    Ok(())
}

/// What the manual leaves open: how deep passes are under another degression than 1 and 2, and what numbers mean that
/// make no thread.
fn open(thread: &Thread, state: &mut State) -> Result<(), StepError> {
    let is_degression = |value: f64| (thread.degression - value).abs() == 0.0;
    let other_degression = !is_degression(1.0) && !is_degression(2.0);
    let tapers = thread.tapers_in || thread.tapers_out;
    let no_thread = thread.peak == 0.0
        || thread.pitch == 0.0
        || thread.first == 0.0
        || thread.first >= thread.full
        || thread.slide.abs() >= 90.0
        || tapers && thread.taper <= 0.0
        || thread.springs < -1;
    if other_degression || no_thread {
        let what = "a thread of another degression than 1 and 2, or one without a depth or a taper";
        return Err(StepError::Unspecified(what.to_owned()));
    }
    if state.modes.compensation != Compensation::Off {
        return Err(StepError::Unsupported("a thread under cutter compensation".to_owned()));
    }
    if thread.slide.abs() > 0.0 {
        state.coverage.accepted(rule::threading::THREAD_SLIDE);
    }
    if tapers {
        state.coverage.accepted(rule::threading::THREAD_TAPERS);
        state.coverage.accepted(rule::threading::THREAD_TAPER);
    }
    Ok(())
}
