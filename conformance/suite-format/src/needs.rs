//! Selects the editions of cases that need an option.

use crate::{Edition, Rule, Suite};

impl Suite {
    /// Limits each case that needs an option to the editions of its language with that option.
    pub(crate) fn resolve_needs(&mut self, errors: &mut Vec<String>) {
        let mut rules = std::mem::take(&mut self.rules);
        for rule in &mut rules {
            if let Err(error) = self.resolve_needs_of(rule) {
                errors.push(format!("{}: {error}", self.paths[&rule.id]));
            }
        }
        self.rules = rules;
    }

    fn resolve_needs_of(&self, rule: &mut Rule) -> Result<(), String> {
        for case in &mut rule.cases {
            let Some(needs) = &case.needs else { continue };
            let (id, option) = needs.split_once(" = ").ok_or_else(|| {
                format!(
                    "case `{}`: invalid `needs`: {needs}; expected `choice = option`",
                    case.name
                )
            })?;
            let has = |edition: &&Edition| {
                edition.language == rule.language && self.options(edition).get(id) == Some(option)
            };
            let with_option = self.editions.iter().filter(has).map(|edition| edition.id.clone());
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
}
