//! A motion whose samples do not fit into memory is judged like one whose samples do.

use gaugeblock_adapter::Adapter;
use gaugeblock_controllers::Production;
use gaugeblock_controllers::simulate::{
    PlannedCycle, RunConditions, plan_cycles, plan_with, sample_header,
};
use gaugeblock_filesystem::ScratchFile;
use gaugeblock_motion::Summary;
use gaugeblock_reference::motion::path::programmed;
use gaugeblock_reference::motion::recording::{PageStore, Recording};
use gaugeblock_vocabulary::motion::{MotionLimits, MotionScript, ProgrammedPath};
use gaugeblock_vocabulary::{Outcome, Position, Scenario};

struct Pages(ScratchFile);

impl Pages {
    fn boxed() -> Option<Box<dyn PageStore>> {
        Some(Box::new(Self(ScratchFile::new("test").expect("a scratch file"))))
    }
}

impl PageStore for Pages {
    fn append(&mut self, bytes: &[u8]) -> Result<u64, String> {
        self.0.append(bytes).map_err(|error| error.to_string())
    }

    fn replace(&mut self, place: u64, bytes: &[u8]) -> Result<(), String> {
        self.0.replace(place, bytes).map_err(|error| error.to_string())
    }

    fn read(&mut self, place: u64, bytes: &mut [u8]) -> Result<(), String> {
        self.0.read(place, bytes).map_err(|error| error.to_string())
    }
}

fn limits(period: f64) -> MotionLimits {
    let axes = "x = { velocity = 250, acceleration = 2000 }\ny = { velocity = 250, acceleration = 2000 }\n";
    let text = format!("period = {period}\n[axes]\n{axes}");
    MotionLimits::from_text(&text).expect("limits")
}

/// A program's outcome, and its path as the model reads it.
fn run(program: &str) -> (Outcome, ProgrammedPath) {
    let mut scenario = Scenario::default();
    program.clone_into(&mut scenario.program.main);
    let outcome = Production::default().run(&scenario).expect("a run");
    let (by_model, _) = gaugeblock_reference::run(&scenario);
    let path = programmed(&by_model, Position::default());
    (outcome, path)
}

/// Plans a program into a recording with a store, and judges that.
fn judged(
    (outcome, path): &(Outcome, ProgrammedPath),
    limits: &MotionLimits,
    script: &MotionScript,
) -> (Recording, Summary) {
    let header = sample_header(outcome, limits).expect("columns");
    let mut recording = Recording::new(&header, Position::default(), Pages::boxed());
    let circumstances = RunConditions { script: script.clone(), ..RunConditions::default() };
    let record =
        &mut |cycle: PlannedCycle<'_>| recording.push(cycle.row).map_err(|error| error.to_string());
    plan_cycles(outcome, limits, &circumstances, record).expect("a motion");
    let summary = Summary::of(&recording, path, limits, script).expect("a scratch file");
    (recording, summary)
}

/// Arcs of a millimetre per second, of about 6.3 s each.
fn arcs(count: usize, mode: &str) -> String {
    format!("g21 g90 g17 g64 {mode} f60\n{}m2\n", "g2 x0 y0 i1 j0\n".repeat(count))
}

#[test]
fn a_long_motion_has_no_more_samples_in_memory_than_a_short_one() {
    for mode in ["p0.01", ""] {
        let at_once = |count: usize| {
            let (limits, script) = (limits(0.001), MotionScript::default());
            let (recording, summary) = judged(&run(&arcs(count, mode)), &limits, &script);
            assert!(summary.holds(), "{summary}");
            (recording.len(), recording.most_in_memory())
        };
        let (short, long) = (at_once(3), at_once(7));
        assert!(long.0 > 2 * short.0 && short.0 > 18_000, "{short:?} {long:?}");
        assert_eq!(short.1, long.1, "{short:?} {long:?}");
    }
}

#[test]
fn samples_in_a_store_are_judged_like_those_in_memory() {
    let program = "g21 g90 g17 f6000\nm52 p1\ng64 p0.05\ng1 x10 y0\nm62 p0\nx20 y10\ng3 x10 y20 i-10 j0\n\
        g4 p0.05\nm65 p0\ng64\ng1 x0 y0\ng2 x10 y0 i5 j0\ng61\ng1 x10 y10\nx20\ng61.1 x0 y0\nm2\n";
    let script = "events = [
  { cycle = 2000, action = { feed_override = 1.5 } },
  { cycle = 3000, action = { adaptive_feed = -1.0 } },
  { cycle = 4000, action = { adaptive_feed = 0.3 } },
  { cycle = 6000, action = { hold = true } },
  { cycle = 9000, action = { hold = false } },
  { cycle = 9500, action = { feed_override = 0.5 } },
]\n";
    let run = run(program);
    // Slower axes than those that the motion was planned for: some laws are broken.
    let (limits, mut slower) = (limits(0.000_05), limits(0.000_05));
    for axis in slower.axes.values_mut() {
        axis.acceleration = Some(1500.0);
    }
    for script in ["", script].map(|text| MotionScript::from_text(text).expect("a script")) {
        let circumstances = RunConditions { script: script.clone(), ..RunConditions::default() };
        let samples = plan_with(&run.0, &limits, &circumstances).expect("a motion").samples;
        let (stored, summary) = judged(&run, &limits, &script);
        assert!(stored.len() > 20_000, "{}", stored.len());
        let in_memory = Recording::of(&samples, Position::default());
        let of = |recording: &Recording, limits: &MotionLimits| {
            let summary = Summary::of(recording, &run.1, limits, &script).expect("a scratch file");
            (summary.to_string(), summary.judgement)
        };
        assert!(summary.holds(), "{summary}");
        assert_eq!(of(&stored, &limits), of(&in_memory, &limits));
        let broken = of(&stored, &slower);
        assert!(broken.0.contains("broken      trajectory.acceleration"), "{}", broken.0);
        assert_eq!(broken, of(&in_memory, &slower));
    }
}
