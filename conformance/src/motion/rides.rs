//! Rides at random: every law holds for what the planner makes of them, and time is what it should be where the same ride is
//! elsewhere or has more allowed.
//!
//! Numbers under a seed are rides ([`ride`]); they can be judged in any order. The path is read by the model from what production says
//! the program does: that both read programs alike, other programs test.

use gaugeblock_fuzz::generate::Dice;
use gaugeblock_fuzz::motion::change::Change;
use gaugeblock_fuzz::motion::{Ride, Step, draw, shrink};
use gaugeblock_reference::motion::laws::{Verdict, judge};
use gaugeblock_reference::motion::path::programmed;
use gaugeblock_trace::motion::{MotionAction, MotionEvent};
use gaugeblock_trace::{End, Outcome};

use super::drive::{Circumstances, Planned, plan_under};

/// How many cycles a ride may take more where it should take as many, and which share where more is allowed.
const CYCLES: f64 = 2.0;
const SHARE: f64 = 1e-3;

/// Runs a ride's program and says what it does.
pub type Runs<'a> = &'a (dyn Fn(&Ride) -> Outcome + Sync);

/// What is broken: the law or the change under which time differs, and words for a person.
#[derive(Clone, Debug, PartialEq)]
pub struct Breach {
    /// The law's id, or the change in a word.
    pub what: String,
    /// What was seen.
    pub words: String,
}

/// What became of a ride.
#[derive(Clone, Debug, PartialEq)]
pub enum Came {
    /// All that can be judged holds; so many cycles were.
    Held(usize),
    /// Something is broken.
    Broken(Vec<Breach>),
    /// It could not be planned, and why.
    NotPlanned(String),
}

/// The ride of a number, and the change under which its time is looked at.
pub fn ride(seed: u64, number: u64) -> (Ride, Change) {
    let mut dice = Dice::of_seed(seed, number);
    let change = *dice.pick(&Change::ALL);
    (draw::ride(&mut dice), change)
}

/// Judges a ride: as it is, and changed without an operator.
pub fn judged((seed, number): (u64, u64), (ride, change): (&Ride, Change), runs: Runs<'_>) -> Came {
    let (outcome, planned) = match planned(ride, runs) {
        Ok(planned) => planned,
        Err(why) => return Came::NotPlanned(why),
    };
    let path = programmed(&outcome, ride.position());
    let judgement = judge(&planned.samples, &path, &ride.limits, &ride.script);
    let mut breaches = Vec::new();
    for (law, verdict) in &judgement.0 {
        if let Verdict::Broken(violations) = verdict {
            let first = violations.first().map_or(String::new(), ToString::to_string);
            let words = format!("{} times; {first}", violations.len());
            breaches.push(Breach { what: law.id().to_owned(), words });
        }
    }
    match timed(&mut Dice::of_seed(seed ^ 1, number), ride, change, runs) {
        Ok(breach) => breaches.extend(breach),
        Err(why) => return Came::NotPlanned(why),
    }
    if breaches.is_empty() { Came::Held(planned.samples.len()) } else { Came::Broken(breaches) }
}

/// The smallest ride that breaks the same.
pub fn shrunk(
    of: (u64, u64),
    (ride, change): (&Ride, Change),
    what: &str,
    (attempts, runs): (u32, Runs<'_>),
) -> Ride {
    shrink::shrunk(ride, attempts, &mut |smaller| {
        let came = judged(of, (smaller, change), runs);
        matches!(came, Came::Broken(breaches) if breaches.iter().any(|breach| breach.what == what))
    })
}

fn planned(ride: &Ride, runs: Runs<'_>) -> Result<(Outcome, Planned), String> {
    let outcome = runs(ride);
    if outcome.end != End::ProgramEnd {
        let why = if let End::Fault(fault) = &outcome.end { &fault.message } else { "" };
        return Err(format!("the program does not come to its end: {why}"));
    }
    let circumstances =
        Circumstances { start: ride.position(), every: ride.every, script: ride.script.clone() };
    match plan_under(&outcome, &ride.limits, &circumstances) {
        Ok(planned) => Ok((outcome, planned)),
        Err(stopped) => Err(stopped.why),
    }
}

/// Whether a changed ride takes the time that it should.
fn timed(
    dice: &mut Dice<'_>,
    ride: &Ride,
    change: Change,
    runs: Runs<'_>,
) -> Result<Option<Breach>, String> {
    let mut alone = Ride { every: None, ..ride.clone() };
    // The spindle goes on turning.
    let turns = |event: &MotionEvent| matches!(event.action, MotionAction::SpindleSpeed { .. });
    alone.script.events.retain(turns);
    // An output at once switches at the end of a cycle, so that each may cost one.
    alone.steps.retain(|step| !matches!(step, Step::Output { with_motion: false, .. }));
    let Some(changed) = change.of(&alone, dice) else { return Ok(None) };
    let cycles = |ride: &Ride| {
        let planned = planned(ride, runs)?.1;
        Ok::<f64, String>(f64::from(u32::try_from(planned.samples.len()).unwrap_or(u32::MAX)))
    };
    let (before, after) = (cycles(&alone)?, cycles(&changed)?);
    let allowed = if change.may_save() { CYCLES.max(SHARE * before) } else { CYCLES };
    let more = if change.may_save() { after - before } else { (after - before).abs() };
    Ok((more > allowed).then(|| Breach {
        what: format!("time.{}", change.name()),
        words: format!("{before} cycles, {after} where it is {}", change.name()),
    }))
}
