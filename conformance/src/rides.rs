//! Rides at random: every law holds for what the planner makes of them, and time is what it should be where the same
//! ride is elsewhere or has more allowed.
//!
//! Numbers under a seed are rides ([`ride`]); they can be judged in any order. The path is read by the model from
//! what production says the program does: that both read programs alike, other programs test.

use gaugeblock_fuzz::generate::Dice;
use gaugeblock_fuzz::motion::change::Change;
use gaugeblock_fuzz::motion::{Ride, Step, draw, shrink};
use gaugeblock_reference::motion::laws::{Law, Verdict, judge};
use gaugeblock_reference::motion::path::programmed;
use gaugeblock_vocabulary::motion::{MotionAction, MotionEvent, MotionScript};
use gaugeblock_vocabulary::{End, Outcome};

use crate::drive::{Circumstances, Planned, Stopped, plan_under};

/// How many cycles a ride may take more where it should take as many, and which share where more is allowed.
const CYCLES: f64 = 2.0;
const SHARE: f64 = 1e-3;
/// What is broken where a ride that nothing holds comes to no end.
const ENDLESS: &str = "no-end";

/// Runs a ride's program and says what it does.
pub type Runs<'a> = &'a (dyn Fn(&Ride) -> Outcome + Sync);

/// What is broken: the law or the change under which time differs, and words for a person.
#[derive(Clone, Debug, PartialEq)]
pub struct Breach {
    /// The law's id, the change in a word, or `no-end`.
    pub what: String,
    /// What was seen.
    pub words: String,
}

/// What became of a ride.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Came {
    /// Servo cycles; none where it was not planned.
    pub cycles: usize,
    /// What is broken.
    pub broken: Vec<Breach>,
    /// What could not be planned, and why.
    pub not_planned: Option<String>,
    /// What could not be judged, and why.
    pub not_judged: Vec<(Law, String)>,
}

impl Came {
    /// Takes up that a ride was not planned: a breach where the planner comes to no end though nothing holds it.
    fn unplanned(&mut self, ride: &Ride, stopped: Stopped) {
        if stopped.endless && goes_on(&ride.script) {
            self.broken.push(Breach { what: ENDLESS.to_owned(), words: stopped.why });
        } else {
            self.not_planned = Some(stopped.why);
        }
    }
}

/// The ride of a number, and the change under which its time is looked at where one is enough.
pub fn ride(seed: u64, number: u64) -> (Ride, Change) {
    let mut dice = Dice::of_seed(seed, number);
    let change = *dice.pick(&Change::ALL);
    (draw::ride(&mut dice), change)
}

/// Judges a ride: as it is, and changed without an operator.
pub fn judged(of: (u64, u64), (ride, changes): (&Ride, &[Change]), runs: Runs<'_>) -> Came {
    let mut came = Came::default();
    match planned(ride, runs) {
        Ok((outcome, planned)) => {
            came.cycles = planned.samples.len();
            let path = programmed(&outcome, ride.position());
            for (law, verdict) in judge(&planned.samples, &path, &ride.limits, &ride.script).0 {
                match verdict {
                    Verdict::Violated(violations) => {
                        let first = violations.first().map_or(String::new(), ToString::to_string);
                        let words = format!("{} times; {first}", violations.len());
                        came.broken.push(Breach { what: law.id().to_owned(), words });
                    }
                    Verdict::NotJudged(why) => came.not_judged.push((law, why)),
                    Verdict::Satisfied { .. } | Verdict::NotApplicable => {}
                }
            }
        }
        Err(stopped) => came.unplanned(ride, stopped),
    }
    for change in changes {
        match timed(of, ride, *change, runs) {
            Ok(breach) => came.broken.extend(breach),
            Err((ride, stopped)) => came.unplanned(&ride, stopped),
        }
    }
    came
}

/// What is broken where time differs under a change.
pub fn broken_by(change: Change) -> String {
    format!("time.{}", change.name())
}

/// The smallest ride that breaks the same.
pub fn shrunk(
    of: (u64, u64),
    (ride, changes): (&Ride, &[Change]),
    what: &str,
    (attempts, runs): (u32, Runs<'_>),
) -> Ride {
    let breaks = |ride: &Ride, changes: &[Change]| {
        judged(of, (ride, changes), runs).broken.iter().any(|breach| breach.what == what)
    };
    // One of them is enough, or none.
    let alone = changes.iter().copied().find(|change| what == broken_by(*change));
    let changes = match &alone {
        Some(change) => std::slice::from_ref(change),
        None if breaks(ride, &[]) => &[],
        None => changes,
    };
    shrink::shrunk(ride, attempts, &mut |smaller| breaks(smaller, changes))
}

/// Whether nothing holds the motion in the end.
fn goes_on(script: &MotionScript) -> bool {
    let (mut feed, mut rapid, mut adaptive, mut stop, mut hold) = (1.0, 1.0, 1.0, false, false);
    for event in &script.events {
        match event.action {
            MotionAction::FeedOverride(factor) => feed = factor,
            MotionAction::RapidOverride(factor) => rapid = factor,
            MotionAction::AdaptiveFeed(factor) => adaptive = factor,
            MotionAction::FeedStop(on) => stop = on,
            MotionAction::Hold(on) => hold = on,
            MotionAction::Abort => return true,
            MotionAction::SpindleSpeed { turns, .. } if turns.abs() > 0.0 => {}
            MotionAction::SpindleSpeed { .. } => return false,
        }
    }
    feed > 0.0 && rapid > 0.0 && adaptive > 0.0 && !stop && !hold
}

fn planned(ride: &Ride, runs: Runs<'_>) -> Result<(Outcome, Planned), Stopped> {
    let outcome = runs(ride);
    if outcome.end != End::ProgramEnd {
        let why = if let End::Fault(fault) = &outcome.end { &fault.message } else { "" };
        let why = format!("the program does not come to its end: {why}");
        return Err(Stopped { block: None, why, endless: false });
    }
    let circumstances =
        Circumstances { start: ride.position(), every: ride.every, script: ride.script.clone() };
    let planned = plan_under(&outcome, &ride.limits, &circumstances)?;
    Ok((outcome, planned))
}

/// The two rides whose times are compared: one as fast as it can be fed, without an operator, and the same one
/// changed. None where there is nothing to change.
pub fn compared((seed, number): (u64, u64), ride: &Ride, change: Change) -> Option<(Ride, Ride)> {
    let mut alone = Ride { every: None, ..ride.clone() };
    // The spindle goes on turning.
    let turns = |event: &MotionEvent| matches!(event.action, MotionAction::SpindleSpeed { .. });
    alone.script.events.retain(turns);
    // An output at once switches at the end of a cycle, so that each may cost one.
    alone.steps.retain(|step| !matches!(step, Step::Output { with_motion: false, .. }));
    let changed = change.of(&alone, &mut Dice::of_seed(seed ^ 1, number))?;
    Some((alone, changed))
}

/// Whether a changed ride takes the time that it should; which ride was not planned, if one is not.
fn timed(
    of: (u64, u64),
    ride: &Ride,
    change: Change,
    runs: Runs<'_>,
) -> Result<Option<Breach>, (Box<Ride>, Stopped)> {
    let Some((alone, changed)) = compared(of, ride, change) else { return Ok(None) };
    let cycles = |ride: &Ride| {
        let (_, planned) =
            planned(ride, runs).map_err(|stopped| (Box::new(ride.clone()), stopped))?;
        Ok::<f64, (Box<Ride>, Stopped)>(f64::from(
            u32::try_from(planned.samples.len()).unwrap_or(u32::MAX),
        ))
    };
    let (before, after) = (cycles(&alone)?, cycles(&changed)?);
    let allowed = if change.may_save() { CYCLES.max(SHARE * before) } else { CYCLES };
    let more = if change.may_save() { after - before } else { (after - before).abs() };
    Ok((more > allowed).then(|| Breach {
        what: broken_by(change),
        words: format!("{before} cycles, {after} where it is {}", change.name()),
    }))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn came(script: Vec<MotionAction>, endless: bool) -> Came {
        let (mut ride, _) = ride(1, 0);
        let event = |action| MotionEvent { cycle: 1, action };
        ride.script.events = script.into_iter().map(event).collect();
        let mut came = Came::default();
        came.unplanned(&ride, Stopped { block: None, why: "it rests".to_owned(), endless });
        came
    }

    #[test]
    fn a_motion_that_nothing_holds_and_that_never_ends_is_a_breach() {
        let released = [MotionAction::Hold(true), MotionAction::Hold(false)];
        for script in [vec![], released.to_vec(), vec![MotionAction::Abort]] {
            let came = came(script, true);
            assert_eq!(came.not_planned, None);
            assert_eq!(came.broken[0].what, ENDLESS);
        }
    }

    #[test]
    fn rides_whose_times_are_compared_differ_in_their_change_alone() {
        for number in 0..50 {
            let (ride, _) = ride(1, number);
            let (alone, changed) = compared((1, number), &ride, Change::Livelier).unwrap();
            let acceleration = |ride: &Ride| {
                ride.limits.axes.values().map(|limit| limit.acceleration).collect::<Vec<_>>()
            };
            let pairs = acceleration(&alone).into_iter().zip(acceleration(&changed));
            let raised: Vec<_> = pairs.filter(|(before, after)| before != after).collect();
            assert_eq!(raised.len(), 1, "program {number}");
            assert!(raised[0].0 < raised[0].1, "program {number}: {raised:?}");
            assert_eq!(alone.text(), changed.text());
            assert_eq!((alone.every, &alone.script), (None, &changed.script));
        }
    }

    #[test]
    fn one_that_is_held_to_the_end_is_not_planned() {
        let holds = [
            MotionAction::Hold(true),
            MotionAction::FeedStop(true),
            MotionAction::FeedOverride(0.0),
            MotionAction::RapidOverride(0.0),
            MotionAction::AdaptiveFeed(-1.0),
            MotionAction::SpindleSpeed { spindle: 0, turns: 0.0 },
        ];
        for hold in holds {
            assert!(came(vec![hold], true).broken.is_empty(), "{hold:?}");
        }
        assert!(came(vec![], false).broken.is_empty());
    }
}
