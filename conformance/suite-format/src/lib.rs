//! The suite: rules with their cases, choices, quirks, editions. Data, read and checked before anything runs.

pub mod assertion;
pub mod files;
mod grid;
pub mod ids;
pub mod ledger;
mod motion;
mod needs;
mod page;
mod profile;
mod scenario;
mod selector;

use std::collections::{BTreeMap, BTreeSet};

use gaugeblock_vocabulary::Options;

pub use assertion::Assertion;
pub use files::Files;
pub use motion::{MotionAssertion, MotionCase, Piece, SampleDefect};
pub use page::{
    Case, Choice, ChoiceKind, ChoiceOption, Edition, Grid, GridItem, GridList, GridLists,
    MotionChoice, MotionChoiceOption, Profile, Rule, RuleOutcome, Setup, Source, sections,
};
pub use scenario::{applies, options_of, scenario_of};
pub use selector::{Selection, Selector, only_case};

/// The suite as it is read.
#[derive(Clone, Debug)]
pub struct Suite {
    /// Rules, ordered by id.
    pub rules: Vec<Rule>,
    /// Choices and quirks, ordered by id.
    pub choices: Vec<Choice>,
    /// Choices of motion, ordered by id. No interpreter knows them.
    pub motion_choices: Vec<MotionChoice>,
    /// Editions in the order of their file.
    pub editions: Vec<Edition>,
    /// Profiles in the order of their file.
    pub profiles: Vec<Profile>,
    /// Lists that grids name.
    pub lists: GridLists,
    /// Path of each rule's page within the suite.
    pub paths: BTreeMap<String, String>,
    /// Digest of all its pages, in hexadecimal.
    pub digest: String,
    /// The whole SHA-256 that the digest is the beginning of.
    pub sha256: String,
}

/// The edition that applies where none is named.
pub const DEFAULT_EDITION: &str = "linuxcnc-2.8";

impl Suite {
    /// Reads all pages.
    ///
    /// # Errors
    /// Every page that is not in the form, each with path, place and reason.
    pub fn read(files: &Files) -> Result<Self, Vec<String>> {
        let mut suite = Self {
            rules: Vec::new(),
            choices: Vec::new(),
            motion_choices: Vec::new(),
            editions: Vec::new(),
            profiles: Vec::new(),
            lists: GridLists::new(),
            paths: BTreeMap::new(),
            digest: files::digest(files),
            sha256: files::sha256(files),
        };
        let mut errors = Vec::new();
        for (path, text) in files {
            if let Err(error) = suite.add(path, text) {
                errors.push(format!("{path}: {error}"));
            }
        }
        suite.rules.sort_by(|a, b| a.id.cmp(&b.id));
        suite.choices.sort_by(|a, b| a.id.cmp(&b.id));
        suite.motion_choices.sort_by(|a, b| a.id.cmp(&b.id));
        suite.hand_down_languages();
        suite.expand_grids(&mut errors);
        suite.resolve_needs(&mut errors);
        suite.leave_out_undocumented();
        suite.check(&mut errors);
        if errors.is_empty() { Ok(suite) } else { Err(errors) }
    }

    fn add(&mut self, path: &str, text: &str) -> Result<(), String> {
        let parsed = |error: toml::de::Error| error.to_string().trim_end().to_owned();
        let (folder, name) = path.rsplit_once('/').unwrap_or(("", path));
        match folder {
            "" if name == "editions.toml" => {
                #[derive(serde::Deserialize)]
                #[serde(deny_unknown_fields)]
                struct Page {
                    edition: Vec<Edition>,
                }
                self.editions = toml::from_str::<Page>(text).map_err(parsed)?.edition;
            }
            "" if name == "profiles.toml" => {
                #[derive(serde::Deserialize)]
                #[serde(deny_unknown_fields)]
                struct Page {
                    profile: Vec<Profile>,
                }
                self.profiles = toml::from_str::<Page>(text).map_err(parsed)?.profile;
            }
            "" if name == "lists.toml" => {
                self.lists = toml::from_str(text).map_err(parsed)?;
            }
            "" | "documents" => {}
            "choices" | "quirks" => {
                let choice: Choice = toml::from_str(text).map_err(parsed)?;
                expect_id(&choice.id, name.trim_end_matches(".toml"))?;
                for option in &choice.options {
                    assertions(&option.assertions)?;
                }
                self.choices.push(choice);
            }
            "motion-choices" => {
                let choice: MotionChoice = toml::from_str(text).map_err(parsed)?;
                expect_id(&choice.id, name.trim_end_matches(".toml"))?;
                choice.motion.check_form()?;
                for option in &choice.options {
                    motion::check_assertions(&option.assertions)?;
                }
                self.motion_choices.push(choice);
            }
            chapter => {
                let mut rule: Rule = toml::from_str(text).map_err(parsed)?;
                motion::complete(&mut rule.motion)?;
                expect_id(&rule.id, &format!("{chapter}.{}", name.trim_end_matches(".toml")))?;
                self.paths.insert(rule.id.clone(), path.to_owned());
                self.rules.push(rule);
            }
        }
        Ok(())
    }

    /// Adds the cases of each grid to those of its rule, and checks the assertions of all.
    fn expand_grids(&mut self, errors: &mut Vec<String>) {
        for rule in &mut self.rules {
            let path = &self.paths[&rule.id];
            for (place, grid) in rule.grids.iter().enumerate() {
                match grid.cases(&self.lists) {
                    Ok(cases) => {
                        let cell = |case| Case { grid: Some(place), ..case };
                        rule.cases.extend(cases.into_iter().map(cell));
                    }
                    Err(error) => errors.push(format!("{path}: grid `{}`: {error}", grid.name)),
                }
            }
            for case in &rule.cases {
                if let Err(error) = assertions(&case.assertions) {
                    errors.push(format!("{path}: case `{}`: {error}", case.name));
                }
            }
        }
    }

    fn check(&self, errors: &mut Vec<String>) {
        let options: BTreeMap<&str, BTreeSet<&str>> = self
            .choices
            .iter()
            .map(|choice| {
                (choice.id.as_str(), choice.options.iter().map(|o| o.name.as_str()).collect())
            })
            .chain(self.motion_choices.iter().map(|choice| {
                (choice.id.as_str(), choice.options.iter().map(|o| o.name.as_str()).collect())
            }))
            .collect();
        let known = |id: &str, option: &str| match options.get(id) {
            None => Err(format!("there is no choice or quirk `{id}`")),
            Some(names) if !names.contains(option) => {
                Err(format!("`{id}` has no option `{option}`"))
            }
            Some(_) => Ok(()),
        };
        for choice in &self.choices {
            for (id, option) in &choice.under {
                if let Err(error) = known(id, option) {
                    errors.push(format!("{}: {error}", choice.id));
                }
            }
            let is_source = |it: &&String| choice.sources.iter().any(|by| by.document == **it);
            for document in choice.decided_by.iter().filter(|it| !is_source(it)) {
                errors.push(format!(
                    "{}: `{document}` decides it and is none of its sources",
                    choice.id
                ));
            }
        }
        for edition in &self.editions {
            for (id, option) in &edition.options {
                if let Err(error) = known(id, option) {
                    errors.push(format!("editions.toml: edition {}: {error}", edition.id));
                }
            }
            if edition.base.as_ref().is_some_and(|base| self.edition(base).is_none()) {
                errors.push(format!(
                    "editions.toml: edition {}: its base does not exist",
                    edition.id
                ));
            }
        }
        errors.extend(self.problems_of_profiles());
        for rule in &self.rules {
            let path = &self.paths[&rule.id];
            for problem in self.problems_of(rule, &known) {
                errors.push(format!("{path}: {problem}"));
            }
        }
    }

    fn problems_of(
        &self,
        rule: &Rule,
        known: &dyn Fn(&str, &str) -> Result<(), String>,
    ) -> Vec<String> {
        let mut problems = Vec::new();
        if rule.sources.is_empty() || rule.cases.is_empty() && rule.motion.is_empty() {
            problems.push("a rule has sources and cases".to_owned());
        }
        if rule.outcomes.is_empty() != rule.cases.is_empty() {
            problems.push("a rule has outcomes where it has cases that reach them".to_owned());
        }
        let editions = rule.void.keys().chain(rule.cases.iter().flat_map(|case| &case.editions));
        for edition in editions.filter(|id| self.edition(id).is_none()) {
            problems.push(format!("unknown edition `{edition}`"));
        }
        let mut names = BTreeSet::new();
        for name in rule.case_names() {
            if !names.insert(name) {
                problems.push(format!("two cases are named `{name}`"));
            }
        }
        for case in &rule.cases {
            let guarded = case.assertions.iter().filter(|text| text.starts_with("when "));
            let guarded = guarded.filter_map(|text| text.parse::<Assertion>().ok());
            for (id, option) in guarded.flat_map(|assertion| assertion.guards) {
                let fits = match id.as_str() {
                    "edition" => {
                        self.edition(&option).map(|_| ()).ok_or(format!("no edition `{option}`"))
                    }
                    _ => known(&id, &option),
                };
                if let Err(error) = fits {
                    problems.push(format!("case `{}`: {error}", case.name));
                }
            }
        }
        if self.profile(&rule.profile).is_none() {
            problems.push(format!("unknown profile `{}`", rule.profile));
        }
        for id in &rule.options {
            let of_motion = self.motion_choices.iter().any(|choice| choice.id == *id);
            if !of_motion && !self.choices.iter().any(|choice| choice.id == *id) {
                problems.push(format!("there is no choice or quirk `{id}`"));
            }
        }
        problems
    }

    /// The edition of an id.
    pub fn edition(&self, id: &str) -> Option<&Edition> {
        self.editions.iter().find(|edition| edition.id == id)
    }

    /// All options of an edition that an interpreter reads: its own, its base's, and each default of a choice in its
    /// language.
    pub fn options(&self, edition: &Edition) -> Options {
        let defaults = self.choices.iter().filter(|choice| choice.language == edition.language);
        let mut options: BTreeMap<String, String> = defaults
            .filter_map(|choice| Some((choice.id.clone(), choice.options.first()?.name.clone())))
            .collect();
        let of_motion = |id: &str| self.motion_choices.iter().any(|choice| choice.id == id);
        let named = self.named(edition).into_iter();
        options.extend(named.filter(|(id, _)| !of_motion(id)));
        Options(options.into())
    }

    /// The option of each choice and quirk that a scenario has where it lists none.
    pub fn defaults(&self) -> Options {
        let first = self
            .choices
            .iter()
            .filter_map(|choice| Some((choice.id.clone(), choice.options.first()?.name.clone())));
        Options(first.collect())
    }

    /// Whether the documents of an edition leave a choice open: none of the editions of documents reads it in another
    /// way than the rest, and its page names none of its documents as one that decides it.
    ///
    /// An edition of documented rules counts for itself only. It leaves a choice open if one of its rules depends on it
    /// and none of its documents is a source of it.
    pub fn is_open(&self, choice: &Choice, edition: &Edition) -> bool {
        let is_decided = choice.decided_by.iter().any(|it| edition.documents.contains(it));
        if choice.kind != ChoiceKind::Choice || is_decided {
            return false;
        }
        if edition.documented_only {
            let depends =
                |rule: &Rule| rule.exists_in(edition) && rule.options.contains(&choice.id);
            return !edition.cites(&choice.sources) && self.rules.iter().any(depends);
        }
        let is_of_documents = |it: &&Edition| !it.documented_only && !self.is_observed(it);
        let of_documents = self
            .editions
            .iter()
            .filter(|edition| edition.language == choice.language)
            .filter(is_of_documents);
        let options: BTreeSet<Option<String>> = of_documents
            .map(|edition| self.options(edition).get(&choice.id).map(str::to_owned))
            .collect();
        options.len() <= 1
    }

    /// Whether an edition describes what a controller really does: it has quirks.
    fn is_observed(&self, edition: &Edition) -> bool {
        let quirk = |id: &String| {
            self.choices.iter().any(|it| it.kind == ChoiceKind::Quirk && it.id == *id)
        };
        edition.options.keys().any(quirk)
    }

    /// All options of an edition that the laws of motion read.
    pub fn motion_options(&self, edition: &Edition) -> BTreeMap<String, String> {
        let named = self.named(edition);
        let option = |choice: &MotionChoice| {
            let default = choice.options.first().map(|option| &option.name);
            Some((choice.id.clone(), named.get(&choice.id).or(default)?.clone()))
        };
        self.motion_choices.iter().filter_map(option).collect()
    }

    /// The options that an edition and its bases name.
    fn named(&self, edition: &Edition) -> BTreeMap<String, String> {
        let mut options = BTreeMap::new();
        let mut chain = vec![edition];
        while let Some(base) = chain.last().and_then(|last| self.edition(last.base.as_deref()?)) {
            if chain.len() > self.editions.len() {
                break;
            }
            chain.push(base);
        }
        for edition in chain.into_iter().rev() {
            options.extend(edition.options.clone());
        }
        options
    }

    /// The rule of an id.
    pub fn rule(&self, id: &str) -> Option<&Rule> {
        self.rules.iter().find(|rule| rule.id == id)
    }
}

impl Case {
    /// Its assertions, which were checked when the page was read.
    pub fn parsed(&self) -> Vec<Assertion> {
        self.assertions.iter().filter_map(|text| text.parse().ok()).collect()
    }
}

impl Choice {
    /// Whether an option holds where none is listed: the first one does.
    pub fn is_default(&self, option: &str) -> bool {
        self.options.first().is_some_and(|first| first.name == option)
    }
}

impl ChoiceOption {
    /// Its assertions, which were checked when the page was read.
    pub fn parsed(&self) -> Vec<Assertion> {
        self.assertions.iter().filter_map(|text| text.parse().ok()).collect()
    }
}

fn expect_id(id: &str, expected: &str) -> Result<(), String> {
    if id == expected {
        Ok(())
    } else {
        Err(format!("its id is `{id}`, its place says `{expected}`"))
    }
}

fn assertions(texts: &[String]) -> Result<(), String> {
    if texts.is_empty() {
        return Err("it asserts nothing".to_owned());
    }
    for text in texts {
        text.parse::<Assertion>().map_err(|error| format!("assertion `{text}`: {error}"))?;
    }
    Ok(())
}
