//! How the documents are read in a run: the option of each choice, and what a dialect does differently.

use std::collections::BTreeMap;
use std::sync::LazyLock;

use gaugeblock_vocabulary::Options;

use crate::dialects::{Deviations, unknown};
use crate::ids::{Choice, Page, choice, pages};

/// The number of each choice and its page, by its id.
static PLACES: LazyLock<BTreeMap<&str, (usize, &Page)>> =
    LazyLock::new(|| (0..).zip(pages()).map(|(place, page)| (page.id, (place, page))).collect());

/// The options in force for a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Choices {
    /// The place of the option of each choice, in the order of the choices' numbers.
    options: [u8; choice::COUNT as usize],
    /// What a dialect does differently; nothing by the documents.
    pub(crate) deviations: Deviations,
}

impl Default for Choices {
    /// The first option of each choice, as the documents say.
    fn default() -> Self {
        Self { options: [0; choice::COUNT as usize], deviations: Deviations::default() }
    }
}

impl Choices {
    /// Takes over the options of RS-274; what is not listed has its default.
    ///
    /// # Errors
    /// An id that is not one of this language, or an option that its page does not have, as a sentence.
    pub fn new(options: &Options) -> Result<Self, String> {
        let mut choices = Self::default();
        for (id, option) in &options.0 {
            if is_foreign(id) {
                return Err(unknown(id));
            }
            choices.set(id, option)?;
        }
        Ok(choices)
    }

    /// Takes over the options of another language; what the model does not know is left out.
    pub fn known(options: &Options) -> Self {
        let mut choices = Self::default();
        for (id, option) in &options.0 {
            // What has no page keeps the default.
            let _unknown = choices.set(id, option);
        }
        choices
    }

    /// Takes over options of the laws of motion by the ids of their choices; what is not listed has its default.
    ///
    /// # Errors
    /// An id that is not one of the laws, or an option that its page does not have, as a sentence.
    pub fn of_motion<'a>(
        options: impl IntoIterator<Item = (&'a str, &'a str)>,
    ) -> Result<Self, String> {
        let mut choices = Self::default();
        for (id, option) in options {
            let is_set = id.starts_with("trajectory.") && choices.set(id, option).is_ok();
            if !is_set {
                return Err(format!("no law depends on {id} = {option}"));
            }
        }
        Ok(choices)
    }

    /// Sets an option by the id of its page.
    ///
    /// # Errors
    /// An id or option without a page, as a sentence.
    fn set(&mut self, id: &str, option: &str) -> Result<(), String> {
        if let Some((place, page)) = PLACES.get(id) {
            let chosen = &mut self.options[*place];
            let option = (0..).zip(page.options).find(|(_, known)| **known == option);
            *chosen = option.map(|(place, _)| place).ok_or_else(|| {
                format!("the choice {id} has the options {}", page.options.join(", "))
            })?;
            return Ok(());
        }
        self.deviations.set(id, option)
    }

    /// The option of a choice.
    #[inline]
    pub fn get<C: Choice>(&self) -> C {
        C::OPTIONS[usize::from(self.options[usize::from(C::NUMBER)])]
    }

    /// Whether a choice has this option.
    #[inline]
    pub fn is<C: Choice>(&self, option: C) -> bool {
        self.options[usize::from(C::NUMBER)] == option.place()
    }
}

/// Whether a choice belongs to another language, or to the laws of motion.
fn is_foreign(id: &str) -> bool {
    ["gpp.", "nct.", "trajectory."].iter().any(|chapter| id.starts_with(chapter))
}
