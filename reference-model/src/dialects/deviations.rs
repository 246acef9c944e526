//! Quirks, and which of them a run has.

use std::fmt;

use gaugeblock_vocabulary::Options;

use super::page::Quirk;
use super::quirk;
use crate::ids::Rule;

impl Quirk {
    /// The id of its page.
    pub fn id(self) -> &'static str {
        Rule::from(self).id()
    }

    /// The quirk with an id, if there is one.
    fn of(id: &str) -> Option<Self> {
        let rule = u16::try_from(Rule::of(id)?.number()).ok()?;
        rule.checked_sub(Rule::OF_DOCUMENTS).map(Self)
    }

    /// Its place in a set: the word, and the bit of the word.
    const fn place(self) -> (usize, u64) {
        (self.0 as usize / 64, 1 << (self.0 % 64))
    }
}

impl From<Quirk> for Rule {
    fn from(quirk: Quirk) -> Self {
        Self::numbered(u32::from(Self::OF_DOCUMENTS + quirk.0))
    }
}

impl fmt::Debug for Quirk {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.id())
    }
}

/// Words of a set of quirks.
const WORDS: usize = (quirk::COUNT as usize).div_ceil(64);

/// The quirks that are observed in a run, a bit for each.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Deviations([u64; WORDS]);

impl Deviations {
    /// Sets whether a quirk is observed, by the id of its page.
    ///
    /// # Errors
    /// An id without a page, or an option other than documented and observed, as a sentence.
    pub(crate) fn set(&mut self, id: &str, option: &str) -> Result<(), String> {
        let quirk = Quirk::of(id).ok_or_else(|| unknown(id))?;
        match option {
            "documented" => {}
            "observed" => {
                let (word, bit) = quirk.place();
                self.0[word] |= bit;
            }
            _ => return Err(format!("the quirk {id} is documented or observed, not {option}")),
        }
        Ok(())
    }

    /// Whether any quirk is observed.
    #[inline]
    pub(super) fn any(&self) -> bool {
        self.0 != [0; WORDS]
    }

    /// Whether a quirk is observed.
    #[inline]
    pub(super) fn has(&self, quirk: Quirk) -> bool {
        let (word, bit) = quirk.place();
        self.0[word] & bit != 0
    }
}

/// An id without a page.
pub(crate) fn unknown(id: &str) -> String {
    format!("there is no choice or quirk {id}")
}

/// Whether this build has what options require: it has every quirk.
///
/// # Errors
/// None.
#[expect(clippy::unnecessary_wraps, reason = "a build without dialects refuses quirks")]
pub(crate) fn accepts_options(_options: &Options) -> Result<(), String> {
    Ok(())
}
