//! G76: a thread in several passes, each deeper than the one before.

use gaugeblock_vocabulary::{
    Axis, Compensation, Distance, Effect, FaultKind, Lathe, Plane, Position,
};

use super::{number, turning_spindle};
use crate::ids::{choice, rule};
use crate::rs274::evaluate::Words;
use crate::rs274::execute::{letter, whole, word};
use crate::rs274::refusal::{StepError, refuse};
use crate::rs274::state::State;
use crate::rs274::task::Record;

/// A thread, all its numbers found; lengths are radii, active length unit.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Thread {
    /// The controlled point before it: X is the drive line, Z where the thread begins.
    pub(crate) start: Position,
    /// Where the thread ends along Z.
    pub(crate) end: f64,
    /// Length unit per revolution.
    pitch: f64,
    /// From the drive line to the thread's crest.
    peak: f64,
    /// Depth of the first pass.
    first: f64,
    /// Full depth.
    pub(crate) full: f64,
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
    pub(crate) springs: i32,
    /// The spindle, as effects report it.
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
    state.dialect().cut_passes(&thread, state, record)?;
    if thread.springs > 0 {
        state.coverage.accepted(rule::threading::SPRING_PASSES);
    }
    state.dialect().leave_thread(&thread, words, state, record)?;
    state.coverage.accepted(rule::threading::THREAD);
    state.coverage.accepted(rule::threading::DEGRESSION);
    Ok(())
}

impl Thread {
    /// How far beyond the crest a pass is, counted from 1. One that is at K but for its rounding is the last one:
    /// three times 0.3 is 0.9.
    pub(crate) fn depth(&self, pass: f64) -> f64 {
        let deeper = if self.degression > 1.0 { crate::math::square_root(pass) } else { pass };
        let depth = self.first * deeper;
        let rounding = 8.0 * f64::EPSILON * self.full;
        if depth > self.full - rounding { self.full } else { depth }
    }
}

/// Rule threading.thread-slide. The slide angle Q moves a pass along the drive line, the deeper the further; how it
/// moves the pass's end is a choice.
fn ends(thread: &Thread, depth: f64, state: &State) -> [f64; 2] {
    let direction = state.dialect().thread_direction(thread.end - thread.start.z, state);
    let along = direction * crate::math::tangent_of_degrees(thread.slide);
    let both = state.choices.is(choice::threading::SlideEnd::WithDepth);
    let behind = if both { (thread.full - depth) * along } else { 0.0 };
    [thread.start.z + depth * along, thread.end - behind]
}

/// A pass of a thread, active length unit.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Pass {
    /// Where it begins on the drive line.
    line: Position,
    /// X at its depth.
    cut: f64,
    /// X where a taper begins or ends.
    out: f64,
    /// Z where it begins.
    from: f64,
    /// Z where it ends.
    to: f64,
    /// Length of a taper along Z.
    taper: f64,
}

impl Pass {
    fn at(&self, x: f64, z: f64) -> Position {
        Position { x, z, ..self.line }
    }
}

/// One pass: it traverses to its depth, feeds, and traverses out to the drive line. At an end with a taper it feeds
/// from the drive line instead.
pub(crate) fn pass(thread: &Thread, depth: f64, state: &mut State, record: &mut Record) {
    let dialect = state.dialect();
    let inward = thread.peak.signum();
    let clearance = dialect.clearance_of_pass(thread, depth, state);
    let [from, to] = ends(thread, depth, state);
    let taper = thread.taper * dialect.thread_direction(to - from, state);
    let line = Position { x: thread.start.x - inward * clearance, z: from, ..thread.start };
    let cut = thread.start.x + thread.peak + inward * depth;
    let out = cut - inward * thread.full;
    let pass = Pass { line, cut, out, from, to, taper };
    dialect.begin_pass(line, state, record);
    if !thread.tapers_in {
        traverse(pass.at(cut, from), state, record);
    }
    dialect.feed_pass(thread, &pass, state, record);
}

/// Operations on threads that a dialect can replace.
pub(crate) trait ThreadRules {
    /// The passes of a thread, each deeper than the one before.
    ///
    /// Rule threading.spring-passes. H passes more are at full depth.
    fn cut_passes(
        &self,
        thread: &Thread,
        state: &mut State,
        record: &mut Record,
    ) -> Result<(), StepError> {
        let mut count = 1.0;
        let mut left = thread.springs;
        while left >= 0 {
            if record.is_full() {
                return Err(StepError::TooManyEffects);
            }
            let depth = thread.depth(count);
            count += 1.0;
            if depth >= thread.full {
                left -= 1;
            }
            pass(thread, depth, state, record);
        }
        Ok(())
    }

    /// After the last pass the controlled point stays where that ended.
    fn leave_thread(
        &self,
        _thread: &Thread,
        _words: &Words,
        _state: &mut State,
        _record: &mut Record,
    ) -> Result<(), StepError> {
        Ok(())
    }

    /// Which way along Z something of this length leads: the sign of a zero makes no difference.
    fn thread_direction(&self, way: f64, _state: &State) -> f64 {
        if way < 0.0 { -1.0 } else { 1.0 }
    }

    /// How far outside of the drive line a pass begins and ends: on it.
    fn clearance_of_pass(&self, _thread: &Thread, _depth: f64, _state: &State) -> f64 {
        0.0
    }

    /// A pass begins on the drive line, to which it traverses from elsewhere.
    fn begin_pass(&self, line: Position, state: &mut State, record: &mut Record) {
        if state.position != line {
            traverse(line, state, record);
        }
    }

    /// Feeds along a pass, and traverses out.
    ///
    /// Rule threading.thread-tapers. Along E, at the ends that L names, it feeds along a slope between its depth and K
    /// further out; at such an entry it feeds from the drive line, at others it traverses. Along Z it moves P for each
    /// revolution everywhere.
    fn feed_pass(&self, thread: &Thread, pass: &Pass, state: &mut State, record: &mut Record) {
        let Pass { line, cut, out, from, to, taper } = *pass;
        let longest = crate::math::hypotenuse(thread.full, thread.taper);
        let aslant = thread.pitch * longest / thread.taper;
        if thread.tapers_in {
            synchronise(thread, aslant, state, record);
            feed(pass.at(out, from), state, record);
            feed(pass.at(cut, from + taper), state, record);
        }
        synchronise(thread, thread.pitch, state, record);
        if thread.tapers_out {
            feed(pass.at(cut, to - taper), state, record);
            synchronise(thread, aslant, state, record);
            feed(pass.at(out, to), state, record);
        } else {
            feed(pass.at(cut, to), state, record);
        }
        record.effect(state, Effect::StopSpindleSynchronisation {});
        traverse(pass.at(line.x, to), state, record);
    }

    /// Rule threading.thread-taper. Whether a taper is too long for a thread: longer than half of it.
    fn is_long_taper(&self, taper: f64, way: f64, _state: &State) -> bool {
        taper > way.abs() / 2.0
    }

    /// Rule threading.thread-plane. G76 is in the ZX plane.
    fn check_thread_plane(&self, state: &State) -> Result<(), StepError> {
        if state.modes.plane != Plane::Zx {
            let message = "G76 in another plane than ZX";
            return Err(refuse(rule::threading::THREAD_PLANE, FaultKind::ModalConflict, message));
        }
        Ok(())
    }

    /// Rule threading.thread-axis-words. Whether an axis word or a polar word can be in the block: Z is its only one.
    fn takes_axis_word(&self, letter: char, _state: &State) -> bool {
        letter == 'z'
    }

    /// Rule threading.thread-negative. The words that are not negative.
    fn not_negative(&self, _state: &State) -> &'static str {
        "pjkh"
    }

    /// Rule threading.thread-degression. R is not less than 1.
    fn thread_degression(&self, programmed: f64, _state: &State) -> Result<f64, StepError> {
        if programmed < 1.0 {
            let message = "a degression of less than 1";
            let rule = rule::threading::THREAD_DEGRESSION;
            return Err(refuse(rule, FaultKind::WordOutOfRange, message));
        }
        Ok(programmed)
    }
}

fn synchronise(thread: &Thread, pitch: f64, state: &mut State, record: &mut Record) {
    let spindle = number(thread.spindle);
    record.effect(state, Effect::StartSpindleSynchronisation { spindle, pitch });
}

fn feed(end: Position, state: &mut State, record: &mut Record) {
    state.position = end;
    record.effect(state, Effect::StraightFeed { end });
}

pub(crate) fn traverse(end: Position, state: &mut State, record: &mut Record) {
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
    let degression = check_words(words, state)?;
    if state.modes.compensation != Compensation::Off {
        return Err(StepError::Unspecified("a thread under cutter compensation".to_owned()));
    }
    let spindle = if state.choices.is(choice::threading::CycleSpindle::Turning) {
        turning_spindle(words, state)?
    } else {
        state.dialect().selected_spindle(words, state)?
    };
    let value = |letter| word(words, letter).unwrap_or(0.0);
    let diameter = state.modes.lathe == Lathe::Diameter;
    let radius = |letter| if diameter { value(letter) / 2.0 } else { value(letter) };
    let start = state.position;
    let incremental = state.modes.distance == Distance::Incremental;
    let end = if incremental { start.z + value('z') } else { value('z') };
    if state.dialect().is_long_taper(value('e'), end - start.z, state) {
        let message = "a taper of more than half the thread";
        return Err(refuse(rule::threading::THREAD_TAPER, FaultKind::WordOutOfRange, message));
    }
    if diameter {
        state.coverage.accepted(rule::threading::THREAD_DIAMETER);
    }
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
        degression,
        slide: value('q'),
        taper: value('e'),
        tapers_in: matches!(tapers, Some(1 | 3)),
        tapers_out: matches!(tapers, Some(2 | 3)),
        springs: springs.unwrap_or(-2),
        spindle: state.dialect().reported_spindle(spindle, words, state),
    };
    open(&thread, state)?;
    Ok(thread)
}

/// The words are those of a thread; its degression.
fn check_words(words: &Words, state: &mut State) -> Result<f64, StepError> {
    let dialect = state.dialect();
    dialect.check_thread_plane(state)?;
    let axes = Axis::ALL.iter().map(|axis| letter(*axis)).chain(['@', '^']);
    let mut others = axes.filter(|letter| !dialect.takes_axis_word(*letter, state));
    if others.any(|letter| word(words, letter).is_some()) {
        let message = "G76 with another axis word than Z";
        return Err(refuse(rule::threading::THREAD_AXIS_WORDS, FaultKind::AxisWords, message));
    }
    if let Some(missing) = "pzijk".chars().find(|letter| word(words, *letter).is_none()) {
        let message = format!("G76 needs {}", missing.to_ascii_uppercase());
        return Err(refuse(rule::threading::THREAD_WORDS, FaultKind::MissingWord, message));
    }
    let below_zero = |letter: &char| word(words, *letter).is_some_and(|value| value < 0.0);
    if let Some(negative) = dialect.not_negative(state).chars().find(below_zero) {
        let message = format!("a negative {} of G76", negative.to_ascii_uppercase());
        let rule = rule::threading::THREAD_NEGATIVE;
        return Err(refuse(rule, FaultKind::WordOutOfRange, message));
    }
    if let Some(programmed) = word(words, 'r') {
        return dialect.thread_degression(programmed, state);
    }
    let areas = state.choices.is(choice::threading::WithoutDegression::ConstantArea);
    Ok(if areas { 2.0 } else { 1.0 })
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
    if thread.slide.abs() > 0.0 {
        state.coverage.accepted(rule::threading::THREAD_SLIDE);
    }
    if tapers {
        state.coverage.accepted(rule::threading::THREAD_TAPERS);
        state.coverage.accepted(rule::threading::THREAD_TAPER);
    }
    Ok(())
}
