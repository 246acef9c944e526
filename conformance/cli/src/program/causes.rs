//! Quirks of a controller, and other options of choices, that explain how it differs from the model on a program.

use std::collections::BTreeSet;

use gaugeblock_compare::Divergence;
use gaugeblock_suite::{Choice, ChoiceKind, Suite};
use gaugeblock_vocabulary::{BlockLocation, Options, Scenario};

/// Most blocks that the model executes to find causes: further differences stay without one.
const BLOCKS_MAX: usize = 2_000_000;

/// An option of a choice or quirk under which the model does what the controller does.
#[derive(Clone, Debug)]
pub(crate) struct Cause<'a> {
    /// The choice or quirk.
    pub(crate) choice: &'a Choice,
    /// Its option.
    pub(crate) option: &'a str,
    /// The block of the first difference that it explains.
    pub(crate) block: Option<BlockLocation>,
}

impl Cause<'_> {
    /// A quirk by its id, a choice with the option.
    pub(crate) fn name(&self) -> String {
        match self.choice.kind {
            ChoiceKind::Quirk => self.choice.id.clone(),
            ChoiceKind::Choice => format!("{} = {}", self.choice.id, self.option),
        }
    }
}

/// The search for causes: what it depends on.
pub(crate) struct Search<'a, 's, F> {
    /// The suite.
    pub(crate) suite: &'a Suite,
    /// The program with its options.
    pub(crate) scenario: &'s Scenario,
    /// The edition with the known quirks of the controller.
    pub(crate) observed_edition: Option<&'s str>,
    /// Blocks that the program executes.
    pub(crate) blocks: usize,
    /// The differences of the controller from the model under a scenario; none where the model has no answer.
    pub(crate) differences: F,
}

impl<'a, F: Fn(&Scenario) -> Option<Vec<Divergence>>> Search<'a, '_, F> {
    /// The causes of some of these differences, and the differences that are left under them.
    ///
    /// An option is a cause if the first difference without one disappears under it and no other one appears in its
    /// place. The known quirks of the controller are tried before all else.
    pub(crate) fn causes(&self, all: Vec<Divergence>) -> (Vec<Cause<'a>>, Vec<Divergence>) {
        let candidates = self.candidates();
        let (mut causes, mut left) = (Vec::new(), all);
        let mut runs_left = BLOCKS_MAX / self.blocks.max(1);
        let mut tried = BTreeSet::new();
        while let Some(first) = left.iter().find(|difference| !tried.contains(&kind(difference))) {
            let first = first.clone();
            let mut found = None;
            for &(choice, option) in &candidates {
                if causes.iter().any(|cause: &Cause<'_>| cause.choice.id == choice.id) {
                    continue;
                }
                if runs_left == 0 {
                    return (causes, left);
                }
                runs_left -= 1;
                let cause = Cause { choice, option, block: first.block.clone() };
                let under = self.under(&causes, &cause);
                if let Some(under) = under.filter(|under| explains(&first, &left, under)) {
                    found = Some((cause, under));
                    break;
                }
            }
            match found {
                Some((cause, under)) => {
                    causes.push(cause);
                    left = under;
                }
                None => {
                    tried.insert(kind(&first));
                }
            }
        }
        (causes, left)
    }

    fn under(&self, causes: &[Cause<'_>], further: &Cause<'_>) -> Option<Vec<Divergence>> {
        let mut scenario = self.scenario.clone();
        for cause in causes.iter().chain([further]) {
            scenario.options.0.insert(cause.choice.id.clone(), cause.option.to_owned());
        }
        (self.differences)(&scenario)
    }

    /// All options that are not selected: the controller's known ones, then all quirks of its kind, then choices.
    fn candidates(&self) -> Vec<(&'a Choice, &'a str)> {
        let language = self.scenario.program.language;
        let observed = self.observed_edition.and_then(|id| self.suite.edition(id));
        let observed =
            observed.map_or_else(Options::default, |edition| self.suite.options(edition));
        let choices = self.suite.choices.iter().filter(|choice| choice.language == language);
        let mut candidates: Vec<_> = choices
            .flat_map(|choice| {
                let others = choice.options.iter().map(|option| option.name.as_str());
                let in_force = self.scenario.options.get(&choice.id);
                let others = others.filter(move |option| in_force != Some(*option));
                others.map(move |option| (choice, option))
            })
            .filter(|(choice, option)| {
                choice.kind == ChoiceKind::Choice || observed.is(&choice.id, option)
            })
            .collect();
        candidates.sort_by_key(|(choice, option)| !observed.is(&choice.id, option));
        candidates
    }
}

/// Whether a difference disappears: it is not among those that are left, and fewer are, or the runs go on.
fn explains(first: &Divergence, before: &[Divergence], under: &[Divergence]) -> bool {
    let at_its_block = |list: &[Divergence]| {
        list.iter().filter(|other| other.block == first.block && other.field == first.field).count()
    };
    let is_later = |other: &Divergence| match (&other.block, &first.block) {
        (Some(other), Some(first)) => other.file == first.file && other.line > first.line,
        _ => false,
    };
    let mut ends = under.iter().filter(|other| other.field == "end");
    let goes_on = first.field == "end" && ends.all(is_later);
    at_its_block(under) < at_its_block(before) && (goes_on || under.len() < before.len())
}

/// Differences of one kind have one cause, or none.
fn kind(difference: &Divergence) -> String {
    let word = |text: &str| text.split([' ', '(']).next().unwrap_or_default().to_owned();
    let detail =
        if difference.field == "effect" { word(&difference.expected) } else { String::new() };
    format!("{} {detail}", difference.field)
}
