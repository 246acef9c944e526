//! The plan of a fuzzing run: its controllers, and the scenario of each number.

use std::collections::BTreeSet;

use gaugeblock_adapter::Adapter;
use gaugeblock_adapter::protocol::DeclaredLanguage;
use gaugeblock_compare::Divergence;
use gaugeblock_fuzz::generate::readable::Readable;
use gaugeblock_fuzz::generate::splice::{self, Seeds};
use gaugeblock_fuzz::generate::{self, Entropy, GeneratorConfig, unreadable};
use gaugeblock_reference::RuleOutcome;
use gaugeblock_suite::{Choice, ChoiceKind};
use gaugeblock_vocabulary::scenario::Environment;
use gaugeblock_vocabulary::{Language, Options, Scenario};

use super::signature::reached_at;
use crate::language::check_program;

/// Consecutive programs that share their options. New options for each would add 6 % to the time of a program.
pub const ALIKE: u64 = 8;

/// Number of programs in the sample that decides whether statements are omitted.
const SAMPLE: u64 = 200;
/// Unsupported programs of the sample above which unreadable statements are omitted.
const UNSUPPORTED_MAX: usize = 100;

/// The controllers of a fuzzing run, and how its programs are generated.
#[derive(Debug)]
pub struct Plan<'a> {
    /// The controller under test.
    pub iut: &'a dyn Adapter,
    /// The controller that it is compared with.
    pub against: &'a dyn Adapter,
    /// Settings of the generator.
    pub config: GeneratorConfig,
    /// The seed of all random decisions.
    pub seed: u64,
    /// Percent of the programs that are spliced from parts of `seeds`.
    pub spliced: u32,
    /// The programs to splice: the suite's cases.
    pub seeds: Seeds,
    /// The options of the edition, without defaults: every run reads all listed options, so a shorter list is faster.
    pub options: Options,
    /// Choices whose options are selected at random; empty if the edition's options apply.
    pub random: Vec<Random<'a>>,
    /// The environment of scenarios that have none.
    pub environment: Option<String>,
    /// The language of the edition, if its documents have a part of RS-274 only.
    pub language: Option<DeclaredLanguage>,
    /// Rules that the documents of the edition do not have, by id. Where the model refuses a block by one of them, a
    /// controller of others that does not is not judged.
    pub void: BTreeSet<String>,
    /// Names of unreadable statements. If set, each written statement is also checked against the controllers.
    pub readable: Option<BTreeSet<&'static str>>,
}

/// A choice whose option is selected at random for each group of programs.
#[derive(Clone, Copy, Debug)]
pub struct Random<'a> {
    choice: &'a Choice,
    /// Whether the options of the plan list it.
    listed: bool,
}

impl<'a> Random<'a> {
    /// The choices among `choices`, without quirks.
    pub fn all(choices: impl IntoIterator<Item = &'a Choice>, options: &Options) -> Vec<Self> {
        let choices = choices.into_iter().filter(|choice| choice.kind == ChoiceKind::Choice);
        let listed = |choice: &Choice| options.get(&choice.id).is_some();
        choices.map(|choice| Self { choice, listed: listed(choice) }).collect()
    }
}

impl<'a> Plan<'a> {
    /// Compares two controllers on programs of the default settings, as these options read the documents.
    pub fn new(iut: &'a dyn Adapter, against: &'a dyn Adapter, options: Options) -> Self {
        Self {
            iut,
            against,
            config: GeneratorConfig::default(),
            seed: 0,
            spliced: 0,
            seeds: Seeds::default(),
            options,
            random: Vec::new(),
            environment: None,
            language: None,
            void: BTreeSet::new(),
            readable: None,
        }
    }
}

impl Plan<'_> {
    /// Omits unreadable statements if fewer than half of the sampled programs are in the language and supported.
    pub fn leave_out_unreadable(&mut self) {
        let numbers = 0..SAMPLE;
        let unsupported = numbers.filter(|number| !self.is_run(&self.generated(0, *number)));
        if self.config.language == Language::Rs274 && unsupported.count() > UNSUPPORTED_MAX {
            self.readable = Some(unreadable(&self.config, &|scenario| self.is_run(scenario)));
        }
    }

    /// The generated scenario of a number under a seed, without options.
    pub(super) fn generated(&self, seed: u64, number: u64) -> Scenario {
        let mut entropy = Entropy::from_seed(seed, number);
        let supports = |scenario: &Scenario| self.is_run(scenario);
        let readable =
            self.readable.as_ref().map(|unreadable| Readable { supports: &supports, unreadable });
        generate::scenario_within(&mut entropy, &self.config, readable)
    }

    /// The rule by which the model refuses a block that a controller accepts, or refuses otherwise, if the documents of
    /// the edition do not have it.
    ///
    /// Production implements all rules, and is judged by them.
    pub(super) fn void_refusal(
        &self,
        scenario: &Scenario,
        divergence: &Divergence,
    ) -> Option<&'static str> {
        if self.void.is_empty() || self.iut.is_in_process() || divergence.field != "end" {
            return None;
        }
        let mut reached = reached_at(scenario, divergence).into_iter();
        reached
            .find(|(rule, outcome)| *outcome == RuleOutcome::Refused && self.void.contains(*rule))
            .map(|(rule, _)| rule)
    }

    /// Whether a scenario is in the language of the edition, and both sides run it.
    pub(super) fn is_run(&self, scenario: &Scenario) -> bool {
        self.reason_not_run(scenario).is_none()
    }

    /// Why a scenario is not run: whose language or features it exceeds, and by what.
    pub(super) fn reason_not_run(&self, scenario: &Scenario) -> Option<(&str, String)> {
        let language = self.language.as_ref();
        let beyond = language.and_then(|language| check_program(language, scenario).err());
        let sides = || {
            [self.iut, self.against].into_iter().find_map(|side| {
                let why = side.supports(scenario).err()?;
                Some((side.capabilities().name.as_str(), why))
            })
        };
        beyond.map(|why| ("edition", why)).or_else(sides)
    }

    /// The scenario of a number.
    pub fn scenario(&self, number: u64) -> Scenario {
        self.scenario_under(number, self.options_of(number / ALIKE))
    }

    /// The scenario of a number, with the options of its group.
    pub(super) fn scenario_under(&self, number: u64, options: Options) -> Scenario {
        let mut scenario = match self.splice(number) {
            Some(splice) => {
                splice::spliced(&mut Entropy::from_seed(self.seed, number), &self.seeds, splice)
            }
            None => self.generated(self.seed, number),
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
