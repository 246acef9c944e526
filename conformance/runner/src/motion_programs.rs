//! Random motion programs: the samples of the planner satisfy every law of motion, and the machining time changes as
//! expected when the program is transformed.
//!
//! A seed and a number give one motion program ([`motion_program`]); programs can be judged in any order. The laws take
//! the programmed path from production's outcome: other tests compare how model and production read programs.

use gaugeblock_controllers::simulate::{Planned, RunConditions, Stopped, plan_with};
use gaugeblock_fuzz::generate::Entropy;
use gaugeblock_fuzz::motion::transformation::Transformation;
use gaugeblock_fuzz::motion::{MotionProgram, Step, draw, shrink};
use gaugeblock_reference::motion::laws::{Law, Verdict, judge};
use gaugeblock_reference::motion::path::programmed;
use gaugeblock_vocabulary::motion::{MotionAction, MotionEvent, MotionScript};
use gaugeblock_vocabulary::{End, Outcome};

/// How many more cycles a program may take than expected, and by what share where a share is allowed.
const CYCLES: f64 = 2.0;
const SHARE: f64 = 1e-3;
/// The id of a breach: planning never ends although nothing holds the motion.
const ENDLESS: &str = "no-end";

/// Interprets a motion program.
pub type Interpret<'a> = &'a (dyn Fn(&MotionProgram) -> Outcome + Sync);

/// A breach of a law, or of the time that a transformation allows, with a description.
#[derive(Clone, Debug, PartialEq)]
pub struct Breach {
    /// The law's id, the transformation, or `no-end`.
    pub what: String,
    /// What was found.
    pub words: String,
}

/// The result of one motion program.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MotionResult {
    /// Servo cycles; 0 if it was not planned.
    pub cycles: usize,
    /// Breaches.
    pub broken: Vec<Breach>,
    /// What could not be planned, and why.
    pub not_planned: Option<String>,
    /// What could not be judged, and why.
    pub not_judged: Vec<(Law, String)>,
}

impl MotionResult {
    /// Records why a program was not planned. Endless planning is a breach if nothing holds the motion.
    fn record_unplanned(&mut self, program: &MotionProgram, stopped: Stopped) {
        if stopped.endless && motion_continues(&program.script) {
            self.broken.push(Breach { what: ENDLESS.to_owned(), words: stopped.why });
        } else {
            self.not_planned = Some(stopped.why);
        }
    }
}

/// The motion program of a number, and the transformation for a run that checks only one.
pub fn motion_program(seed: u64, number: u64) -> (MotionProgram, Transformation) {
    let mut entropy = Entropy::from_seed(seed, number);
    let change = *entropy.pick(&Transformation::ALL);
    (draw::motion_program(&mut entropy), change)
}

/// Judges a program as it is, and its time under each transformation.
pub fn judge_program(
    of: (u64, u64),
    (program, changes): (&MotionProgram, &[Transformation]),
    runs: Interpret<'_>,
) -> MotionResult {
    let mut result = MotionResult::default();
    match plan_program(program, runs) {
        Ok((outcome, planned)) => {
            result.cycles = planned.samples.len();
            let path = programmed(&outcome, program.position());
            for (law, verdict) in judge(&planned.samples, &path, &program.limits, &program.script).0
            {
                match verdict {
                    Verdict::Violated(violations) => {
                        let first = violations.first().map_or(String::new(), ToString::to_string);
                        let words = format!("{} times; {first}", violations.len());
                        result.broken.push(Breach { what: law.id().to_owned(), words });
                    }
                    Verdict::NotJudged(why) => result.not_judged.push((law, why)),
                    Verdict::Satisfied { .. } | Verdict::NotApplicable => {}
                }
            }
        }
        Err(stopped) => result.record_unplanned(program, stopped),
    }
    for change in changes {
        match check_time(of, program, *change, runs) {
            Ok(breach) => result.broken.extend(breach),
            Err((program, stopped)) => result.record_unplanned(&program, stopped),
        }
    }
    result
}

/// The id of a breach of time under a transformation.
pub fn time_breach_id(change: Transformation) -> String {
    format!("time.{}", change.name())
}

/// The smallest program with the same breach.
pub fn shrunk(
    of: (u64, u64),
    (program, changes): (&MotionProgram, &[Transformation]),
    what: &str,
    (attempts, runs): (u32, Interpret<'_>),
) -> MotionProgram {
    let breaks = |program: &MotionProgram, changes: &[Transformation]| {
        judge_program(of, (program, changes), runs).broken.iter().any(|breach| breach.what == what)
    };
    // One transformation is enough, or none.
    let alone = changes.iter().copied().find(|change| what == time_breach_id(*change));
    let changes = match &alone {
        Some(change) => std::slice::from_ref(change),
        None if breaks(program, &[]) => &[],
        None => changes,
    };
    shrink::shrunk(program, attempts, &mut |smaller| breaks(smaller, changes))
}

/// Whether the motion continues at the end of the script.
fn motion_continues(script: &MotionScript) -> bool {
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

fn plan_program(
    program: &MotionProgram,
    runs: Interpret<'_>,
) -> Result<(Outcome, Planned), Stopped> {
    let outcome = runs(program);
    if outcome.end != End::ProgramEnd {
        let why = if let End::Fault(fault) = &outcome.end { &fault.message } else { "" };
        let why = format!("the program does not reach its end: {why}");
        return Err(Stopped { block: None, why, endless: false, too_long: false, unlimited: None });
    }
    let circumstances = RunConditions {
        start: program.position(),
        every: program.every,
        script: program.script.clone(),
    };
    let planned = plan_with(&outcome, &program.limits, &circumstances)?;
    Ok((outcome, planned))
}

/// The two motion programs whose times are compared: one without an operator and fed as fast as possible, and the same
/// one transformed. `None` if the transformation does not apply.
pub fn compared(
    (seed, number): (u64, u64),
    program: &MotionProgram,
    change: Transformation,
) -> Option<(MotionProgram, MotionProgram)> {
    let mut alone = MotionProgram { every: None, ..program.clone() };
    // The spindle keeps turning.
    let turns = |event: &MotionEvent| matches!(event.action, MotionAction::SpindleSpeed { .. });
    alone.script.events.retain(turns);
    // An immediate output switches at the end of a cycle, so each may cost one.
    alone.steps.retain(|step| !matches!(step, Step::Output { with_motion: false, .. }));
    let changed = change.of(&alone, &mut Entropy::from_seed(seed ^ 1, number))?;
    Some((alone, changed))
}

/// Checks the time of a transformed program. An error names the program that could not be planned.
fn check_time(
    of: (u64, u64),
    program: &MotionProgram,
    change: Transformation,
    runs: Interpret<'_>,
) -> Result<Option<Breach>, (Box<MotionProgram>, Stopped)> {
    let Some((alone, changed)) = compared(of, program, change) else { return Ok(None) };
    let cycles = |program: &MotionProgram| {
        let (_, planned) =
            plan_program(program, runs).map_err(|stopped| (Box::new(program.clone()), stopped))?;
        Ok::<f64, (Box<MotionProgram>, Stopped)>(f64::from(
            u32::try_from(planned.samples.len()).unwrap_or(u32::MAX),
        ))
    };
    let (before, after) = (cycles(&alone)?, cycles(&changed)?);
    let allowed = if change.may_save() { CYCLES.max(SHARE * before) } else { CYCLES };
    let more = if change.may_save() { after - before } else { (after - before).abs() };
    Ok((more > allowed).then(|| Breach {
        what: time_breach_id(change),
        words: format!("{before} cycles, {after} where it is {}", change.name()),
    }))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn result(script: Vec<MotionAction>, endless: bool) -> MotionResult {
        let (mut program, _) = motion_program(1, 0);
        let event = |action| MotionEvent { cycle: 1, action };
        program.script.events = script.into_iter().map(event).collect();
        let mut result = MotionResult::default();
        result.record_unplanned(
            &program,
            Stopped {
                block: None,
                why: "it rests".to_owned(),
                endless,
                too_long: false,
                unlimited: None,
            },
        );
        result
    }

    #[test]
    fn endless_motion_without_hold_is_a_breach() {
        let released = [MotionAction::Hold(true), MotionAction::Hold(false)];
        for script in [vec![], released.to_vec(), vec![MotionAction::Abort]] {
            let result = result(script, true);
            assert_eq!(result.not_planned, None);
            assert_eq!(result.broken[0].what, ENDLESS);
        }
    }

    #[test]
    fn timed_programs_differ_only_by_their_transformation() {
        let mut with_jerk = 0;
        for number in 0..50 {
            let (program, _) = motion_program(1, number);
            let change = Transformation::HigherAcceleration;
            let Some((alone, changed)) = compared((1, number), &program, change) else {
                // More acceleration can take longer where jerk is limited.
                assert!(program.limits.axes.values().any(|limit| limit.jerk.is_some()));
                with_jerk += 1;
                continue;
            };
            let acceleration = |program: &MotionProgram| {
                program.limits.axes.values().map(|limit| limit.acceleration).collect::<Vec<_>>()
            };
            let pairs = acceleration(&alone).into_iter().zip(acceleration(&changed));
            let raised: Vec<_> = pairs.filter(|(before, after)| before != after).collect();
            assert_eq!(raised.len(), 1, "program {number}");
            assert!(raised[0].0 < raised[0].1, "program {number}: {raised:?}");
            assert_eq!(alone.text(), changed.text());
            assert_eq!((alone.every, &alone.script), (None, &changed.script));
        }
        assert!((5..25).contains(&with_jerk), "{with_jerk} of 50 have limits of jerk");
    }

    #[test]
    fn program_held_to_the_end_is_not_planned() {
        let holds = [
            MotionAction::Hold(true),
            MotionAction::FeedStop(true),
            MotionAction::FeedOverride(0.0),
            MotionAction::RapidOverride(0.0),
            MotionAction::AdaptiveFeed(-1.0),
            MotionAction::SpindleSpeed { spindle: 0, turns: 0.0 },
        ];
        for hold in holds {
            assert!(result(vec![hold], true).broken.is_empty(), "{hold:?}");
        }
        assert!(result(vec![], false).broken.is_empty());
    }
}
