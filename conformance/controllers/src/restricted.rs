//! A controller that exposes, and runs, no more than another one does, so that both get their verdicts on the same
//! ground.

use std::num::NonZero;
use std::path::PathBuf;

use gaugeblock_adapter::{Adapter, Expected, HarnessError, MotionRequest, NoSamples};
use gaugeblock_compare::Capabilities;
use gaugeblock_vocabulary::motion::Samples;
use gaugeblock_vocabulary::{End, Options, Outcome, Scenario, Step};

/// A controller, narrowed to what another one declares.
#[derive(Debug)]
pub struct Restricted {
    controller: Box<dyn Adapter>,
    like: Box<dyn Adapter>,
    capabilities: Capabilities,
}

impl Restricted {
    /// This controller, as far as the other one goes.
    pub fn new(controller: Box<dyn Adapter>, like: Box<dyn Adapter>) -> Self {
        let capabilities = controller.capabilities().and(like.capabilities());
        Self { controller, like, capabilities }
    }
}

impl Adapter for Restricted {
    fn capabilities(&self) -> &Capabilities {
        &self.capabilities
    }

    fn observables(&self, scenario: &Scenario) -> Capabilities {
        self.controller.observables(scenario).and(&self.like.observables(scenario))
    }

    fn observables_vary(&self) -> bool {
        self.controller.observables_vary() || self.like.observables_vary()
    }

    fn accepts_options(&self, options: &Options) -> Result<(), String> {
        self.controller.accepts_options(options)
    }

    fn pending(&self, scenario: &Scenario) -> Option<String> {
        self.like.pending(scenario).or_else(|| self.controller.pending(scenario))
    }

    fn supports(&self, scenario: &Scenario) -> Result<(), String> {
        self.like.supports(scenario)?;
        self.controller.supports(scenario)
    }

    fn order_key(&self, scenario: &Scenario) -> String {
        self.controller.order_key(scenario)
    }

    fn best_jobs(&self) -> Option<NonZero<usize>> {
        self.controller.best_jobs()
    }

    fn check_observation(&mut self) {
        self.controller.check_observation();
    }

    fn notes(&self) -> Vec<String> {
        let like = self.like.capabilities();
        let mut notes = self.controller.notes();
        notes.push(format!("compared in no more than {} {} declares", like.name, like.version));
        notes
    }

    fn run(&self, scenario: &Scenario) -> Result<Outcome, HarnessError> {
        let observables = self.observables(scenario);
        Ok(restrict_outcome(self.controller.run(scenario)?, &observables))
    }

    fn files(&self) -> Vec<PathBuf> {
        self.controller.files()
    }

    fn is_in_process(&self) -> bool {
        self.controller.is_in_process()
    }

    fn is_out_of_process(&self) -> bool {
        self.controller.is_out_of_process()
    }

    fn run_expecting(
        &self,
        scenario: &Scenario,
        expected: &Expected<'_>,
    ) -> Result<Outcome, HarnessError> {
        let observables = self.observables(scenario);
        Ok(restrict_outcome(self.controller.run_expecting(scenario, expected)?, &observables))
    }

    fn prefetch(&self, scenario: &Scenario) {
        self.controller.prefetch(scenario);
    }

    fn options(&self) -> Options {
        self.controller.options()
    }

    fn own_edition(&self) -> Option<&str> {
        self.like.own_edition().or(self.controller.own_edition())
    }

    /// What is known of the controller explains nothing that the other one does not know of itself.
    fn observed_edition(&self) -> Option<&str> {
        self.like.observed_edition()
    }

    fn exported_from(&self) -> Option<(&str, &str)> {
        self.like.exported_from().or(self.controller.exported_from())
    }

    fn has_laws_of_motion(&self) -> bool {
        self.controller.has_laws_of_motion()
    }

    fn record_motion(&self, motion: &MotionRequest<'_>) -> Result<Samples, NoSamples> {
        self.like.record_motion(motion)?;
        self.controller.record_motion(motion)
    }

    fn run_fresh(&self, scenario: &Scenario) -> Option<Result<Outcome, HarnessError>> {
        let outcome = self.controller.run_fresh(scenario)?;
        Some(outcome.map(|outcome| restrict_outcome(outcome, &self.observables(scenario))))
    }
}

/// Removes what a fault reports beyond the observables. Everything else that is not judged stays: it is masked.
fn restrict_outcome(mut outcome: Outcome, observables: &Capabilities) -> Outcome {
    let End::Fault(fault) = &mut outcome.end else { return outcome };
    if !observables.faults_have_kinds {
        fault.kind = None;
    }
    if let Some(block) = fault.block.take_if(|_| !observables.faults_have_blocks) {
        // What a refused block did before is open, and without its place nobody would know that.
        let is_refused = |step: &mut Step| step.block == block && step.state.is_none();
        outcome.steps.pop_if(is_refused);
    }
    outcome
}

#[cfg(test)]
mod tests {
    use gaugeblock_vocabulary::{BlockLocation, Effect, Event, Position, Rs274State, State};

    use super::*;
    use crate::reference::Reference;
    use gaugeblock_compare::observe::Observed;
    use gaugeblock_compare::{Comparison, compare};

    /// What a controller shows that tells no blocks.
    fn blockless() -> Capabilities {
        Capabilities {
            blocks: false,
            faults_have_blocks: false,
            faults_have_kinds: false,
            effects: ["straight_traverse".to_owned()].into(),
            reports_all_fields: false,
            ..Capabilities::everything("a control", "1")
        }
    }

    /// An outcome with moves along X in one step, and the point at the end.
    fn reported_outcome(moves: &[f64], at: f64, end: End) -> Outcome {
        let point = |x| Position { x, ..Position::default() };
        let step = Step {
            block: BlockLocation::new("", 0),
            events: moves
                .iter()
                .map(|x| Event::Do(Effect::StraightTraverse { end: point(*x) }))
                .collect(),
            state: Some(State::Rs274(Rs274State {
                position: Some(point(at)),
                ..Rs274State::default()
            })),
        };
        Outcome {
            steps: vec![step],
            end,
            parameters: None,
            ..gaugeblock_reference::run(&Scenario::of("m2\n")).0
        }
    }

    fn compared(program: &str, found: &Outcome) -> Comparison {
        let expected = gaugeblock_reference::run(&Scenario::of(program)).0;
        compare(&Observed::of(&expected), &Observed::of(found), &blockless())
    }

    fn fault(program: &str) -> End {
        gaugeblock_reference::run(&Scenario::of(program)).0.end
    }

    #[test]
    fn without_blocks_effects_and_the_end_are_compared() {
        let program = "g0 x1\nx2\nm2\n";
        let right = compared(program, &reported_outcome(&[1.0, 2.0], 2.0, End::ProgramEnd));
        assert_eq!(right.divergence, None);
        assert!(right.masked.contains("blocks"), "{:?}", right.masked);
        let field = |found: &Outcome| compared(program, found).divergence.map(|found| found.field);
        assert_eq!(
            field(&reported_outcome(&[1.0, 2.0], 3.0, End::ProgramEnd)).as_deref(),
            Some("position")
        );
        assert_eq!(
            field(&reported_outcome(&[1.0], 2.0, End::ProgramEnd)).as_deref(),
            Some("effect")
        );
    }

    #[test]
    fn without_blocks_only_effects_of_a_refused_block_are_open() {
        let program = "g0 x1\nx2 x3\nm2\n";
        let more = compared(program, &reported_outcome(&[1.0, 2.0], 2.0, fault(program)));
        assert_eq!(more.divergence, None);
        assert!(more.masked.contains("effects of a refused block"), "{:?}", more.masked);
        assert!(
            compared(program, &reported_outcome(&[], 0.0, fault(program))).divergence.is_some()
        );
        assert!(
            compared(program, &reported_outcome(&[1.0, 2.0], 2.0, End::ProgramEnd))
                .divergence
                .is_some()
        );
    }

    #[test]
    fn fault_drops_what_the_other_does_not_report() {
        let scenario = Scenario::of("g0 x1\nx2 x3\nm2\n");
        let of = |observables: &Capabilities| {
            restrict_outcome(gaugeblock_reference::run(&scenario).0, observables).end
        };
        let End::Fault(bare) = of(&blockless()) else { panic!("accepted") };
        assert_eq!((bare.kind, bare.block), (None, None));
        let End::Fault(whole) = of(&Capabilities::everything("a", "1")) else { panic!("accepted") };
        assert!(whole.kind.is_some() && whole.block == Some(BlockLocation::new("main.ngc", 2)));
    }

    #[test]
    fn restricted_controller_exposes_what_both_expose() {
        let boxed = || Box::new(Reference::default()) as Box<dyn Adapter>;
        let both = Restricted::new(boxed(), boxed());
        let scenario = Scenario::of("g0 x1\nm2\n");
        assert_eq!(both.observables(&scenario).fields, Reference::default().capabilities().fields);
        assert_eq!(both.run(&scenario), Reference::default().run(&scenario));
    }
}
