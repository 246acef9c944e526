//! How the documents are read in a run: the option of each choice, and what a dialect does differently.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, LazyLock};

use gaugeblock_vocabulary::Options;

use crate::dialects::{Deviations, unknown};
use crate::ids::{Choice, Page, Rule, choice, pages};

/// The number of each choice and its page, by its id.
static PLACES: LazyLock<BTreeMap<&str, (usize, &Page)>> =
    LazyLock::new(|| (0..).zip(pages()).map(|(place, page)| (page.id, (place, page))).collect());

/// The options in force for a run.
#[derive(Clone, Debug)]
pub struct Choices {
    /// The place of the option of each choice, in the order of the choices' numbers.
    options: [u8; choice::COUNT as usize],
    /// What a dialect does differently; nothing by the documents.
    pub(crate) deviations: Deviations,
    /// What the run consults; none if it is not recorded.
    pub(crate) consulted: Option<Arc<Consulted>>,
}

/// Two are equal if their options are. What a run has consulted is not compared.
impl PartialEq for Choices {
    fn eq(&self, other: &Self) -> bool {
        (self.options, self.deviations) == (other.options, other.deviations)
    }
}

impl Default for Choices {
    /// The first option of each choice, as the documents say.
    fn default() -> Self {
        Self {
            options: [0; choice::COUNT as usize],
            deviations: Deviations::default(),
            consulted: None,
        }
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
        self.consult(Rule::of_choice::<C>());
        C::OPTIONS[usize::from(self.options[usize::from(C::NUMBER)])]
    }

    /// Whether a choice has this option.
    #[inline]
    pub fn is<C: Choice>(&self, option: C) -> bool {
        self.consult(Rule::of_choice::<C>());
        self.options[usize::from(C::NUMBER)] == option.place()
    }

    /// Records that a run consults a choice, or a deviation of a dialect.
    #[inline]
    pub(crate) fn consult(&self, id: Rule) {
        if let Some(consulted) = &self.consulted {
            consulted.0[id.number()].store(true, Ordering::Relaxed);
        }
    }
}

/// The choices, and the deviations of a dialect, that a run has consulted. Another option of any other one does not
/// change the run.
#[derive(Debug)]
pub(crate) struct Consulted([AtomicBool; Rule::COUNT]);

impl Default for Consulted {
    fn default() -> Self {
        Self([const { AtomicBool::new(false) }; Rule::COUNT])
    }
}

impl Consulted {
    /// The ids of their pages.
    pub(crate) fn ids(&self) -> BTreeSet<&'static str> {
        let consulted = Rule::all().filter(|id| self.0[id.number()].load(Ordering::Relaxed));
        consulted.map(Rule::id).collect()
    }
}

/// Whether a choice belongs to another language, or to the laws of motion.
fn is_foreign(id: &str) -> bool {
    ["gpp.", "nct.", "trajectory."].iter().any(|chapter| id.starts_with(chapter))
}
