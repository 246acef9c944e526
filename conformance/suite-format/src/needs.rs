//! Selects the editions of rules and cases: by documents, by options, by the language.

use gaugeblock_vocabulary::{Language, LanguageCheck, Options};

use crate::{Edition, Rule, Suite, scenario_of};

/// An edition with all its options.
type WithOptions<'a> = (&'a Edition, Options);

impl Suite {
    /// Gives each edition the part of the language that its base has, unless it names its own.
    pub(crate) fn hand_down_languages(&mut self) {
        for place in 0..self.editions.len() {
            let base = self.editions[place].base.clone();
            let Some(base) = base.and_then(|id| self.edition(&id).cloned()) else { continue };
            let edition = &mut self.editions[place];
            edition.documented_only |= base.documented_only;
            if edition.has.is_none() {
                edition.has = base.has;
            }
        }
    }

    /// Limits each case that needs an option to the editions of its language with that option.
    pub(crate) fn resolve_needs(&mut self, errors: &mut Vec<String>) {
        let mut rules = std::mem::take(&mut self.rules);
        let editions = self.editions.iter();
        let editions: Vec<_> = editions.map(|edition| (edition, self.options(edition))).collect();
        for rule in &mut rules {
            if let Err(error) = resolve_needs_of(rule, &editions) {
                errors.push(format!("{}: {error}", self.paths[&rule.id]));
            }
        }
        self.rules = rules;
    }

    /// Makes each rule void in the editions that have documented rules alone, if none of their documents is a source.
    pub(crate) fn leave_out_undocumented(&mut self) {
        for edition in self.editions.iter().filter(|edition| edition.documented_only) {
            let of_language = self.rules.iter_mut().filter(|it| it.language == edition.language);
            for rule in of_language.filter(|rule| !edition.cites(&rule.sources)) {
                let why = "its documents do not say so".to_owned();
                rule.void.entry(edition.id.clone()).or_insert(why);
            }
        }
    }

    /// Leaves out each case in the editions whose language has less than its program needs.
    pub fn limit_to_languages(&mut self, check: LanguageCheck) {
        for edition in self.editions.iter().filter(|it| it.language == Language::Rs274) {
            let Some(language) = &edition.has else { continue };
            let options = self.options(edition);
            for rule in self.rules.iter_mut().filter(|rule| rule.exists_in(edition)) {
                for case in rule.cases.iter_mut().filter(|case| case.runs_in(edition)) {
                    if check(language, &scenario_of(case, &options, edition)).is_err() {
                        case.beyond.push(edition.id.clone());
                    }
                }
            }
        }
    }
}

fn resolve_needs_of(rule: &mut Rule, editions: &[WithOptions<'_>]) -> Result<(), String> {
    for case in &mut rule.cases {
        let Some(needs) = &case.needs else { continue };
        let (id, option) = needs.split_once(" = ").ok_or_else(|| {
            format!("case `{}`: invalid `needs`: {needs}; expected `choice = option`", case.name)
        })?;
        let has = |(edition, options): &&WithOptions<'_>| {
            edition.language == rule.language && options.get(id) == Some(option)
        };
        let with_option = editions.iter().filter(has).map(|(edition, _)| edition.id.clone());
        let given = &case.editions;
        let left: Vec<String> =
            with_option.filter(|id| given.is_empty() || given.contains(id)).collect();
        if left.is_empty() {
            return Err(format!(
                "case `{}`: no edition has the option that it needs: {needs}",
                case.name
            ));
        }
        case.editions = left;
    }
    Ok(())
}
