//! What is run on what: the scenario of each number.

use gaugeblock_adapter::Adapter;
use gaugeblock_fuzz::generate::splice::{self, Seeds};
use gaugeblock_fuzz::generate::{self, Entropy, GeneratorConfig};
use gaugeblock_suite::{Choice, ChoiceKind};
use gaugeblock_vocabulary::scenario::Environment;
use gaugeblock_vocabulary::{Options, Scenario};

/// So many programs on end have the same options: to choose others for each would cost 6 % of a program.
pub const ALIKE: u64 = 8;

/// What is run on what.
#[derive(Debug)]
pub struct Plan<'a> {
    /// The controller under test.
    pub iut: &'a dyn Adapter,
    /// The controller that it is compared with.
    pub against: &'a dyn Adapter,
    /// What is generated.
    pub config: GeneratorConfig,
    /// What all choices follow from.
    pub seed: u64,
    /// How many of a hundred programs are parts of other ones.
    pub spliced: u32,
    /// Those other ones: the suite's cases.
    pub seeds: Seeds,
    /// The options of the edition that applies, without those that are the default of their choice: each run reads
    /// what is listed.
    pub options: Options,
    /// Choices of which each program takes some at random; none where the edition's options stand.
    pub random: Vec<Random<'a>>,
    /// The environment that answers where a scenario has none.
    pub environment: Option<String>,
}

/// A choice of which programs take an option at random.
#[derive(Clone, Copy, Debug)]
pub struct Random<'a> {
    choice: &'a Choice,
    /// Whether the options of the plan list it.
    listed: bool,
}

impl<'a> Random<'a> {
    /// The choices among some; a quirk is none.
    pub fn all(choices: impl IntoIterator<Item = &'a Choice>, options: &Options) -> Vec<Self> {
        let choices = choices.into_iter().filter(|choice| choice.kind == ChoiceKind::Choice);
        let listed = |choice: &Choice| options.get(&choice.id).is_some();
        choices.map(|choice| Self { choice, listed: listed(choice) }).collect()
    }
}

impl Plan<'_> {
    /// The scenario of a number.
    pub fn scenario(&self, number: u64) -> Scenario {
        self.scenario_under(number, self.options_of(number / ALIKE))
    }

    /// The same; the options are those of its group.
    pub(super) fn scenario_under(&self, number: u64, options: Options) -> Scenario {
        let mut entropy = Entropy::from_seed(self.seed, number);
        let mut scenario = match self.splice(number) {
            Some(splice) => splice::spliced(&mut entropy, &self.seeds, splice),
            None => generate::scenario(&mut entropy, &self.config),
        };
        scenario.options = options;
        if scenario.environment == Environment::default() {
            scenario.environment.name.clone_from(&self.environment);
        }
        scenario
    }

    /// The options of a group of programs: the edition's, some of them chosen at random.
    pub(super) fn options_of(&self, group: u64) -> Options {
        let mut options = self.options.clone();
        let mut entropy = Entropy::from_seed(!self.seed, group);
        for Random { choice, listed } in &self.random {
            if !entropy.chance(25) {
                continue;
            }
            let option = &entropy.pick(&choice.options).name;
            if *listed || !choice.is_default(option) {
                options.0.insert(choice.id.clone(), option.clone());
            }
        }
        options
    }

    /// Where a number is that of a splice: which one it is. The first of each hundred are.
    pub(super) fn splice(&self, number: u64) -> Option<u64> {
        let share = u64::from(self.spliced);
        let (hundred, place) = (number / 100, number % 100);
        (place < share && !self.seeds.all.is_empty()).then_some(hundred * share + place)
    }
}
