//! The readings of the documents that apply to a post-processor, taken from the options once.

use gaugeblock_vocabulary::Options;

use crate::error::Error;

/// When an assignment turns on a variable that has a value already.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum AssignedAgain {
    IfChanged,
    Always,
    FirstOnly,
}

/// The readings that apply. Every flag is false under the first option of its page.
#[derive(Clone, Copy, Debug)]
pub(super) struct Choices {
    /// A printed member of a modal array stays on.
    pub(super) members_stay: bool,
    pub(super) assigned_again: AssignedAgain,
    /// Variables that nothing declares have the modality of their format.
    pub(super) modal_by_format: bool,
    /// The newline procedure waits for something that is printed.
    pub(super) newline_lazy: bool,
    /// A modal variable that is off is left out.
    pub(super) off_left_out: bool,
    /// RESET, `ALL_VAR`, `NON_MODAL` and conditions in `IF_SET` are understood.
    pub(super) old_words: bool,
    /// A tie is rounded to the even digit.
    pub(super) tie_even: bool,
    /// A variable without a value is zero, or the empty text.
    pub(super) absent_zero: bool,
}

impl Choices {
    /// Reads the options.
    ///
    /// # Errors
    /// A choice has an option that its page does not name.
    pub(super) fn of(options: &Options) -> Result<Self, Error> {
        let assigned_again = match options.get("gpp.assigned-again") {
            None | Some("if-changed") => AssignedAgain::IfChanged,
            Some("always") => AssignedAgain::Always,
            Some("first-only") => AssignedAgain::FirstOnly,
            Some(_) => return Err(Error::Configuration("no such option of gpp.assigned-again")),
        };
        let second = |id, first: &str, second: &str| match options.get(id) {
            None => Ok(false),
            Some(option) if option == first => Ok(false),
            Some(option) if option == second => Ok(true),
            Some(_) => Err(Error::Configuration("no such option of a choice of GPP")),
        };
        Ok(Self {
            members_stay: second("gpp.array-members", "go-off", "stay-on")?,
            assigned_again,
            modal_by_format: second("gpp.default-modality", "non-modal", "by-format")?,
            newline_lazy: second("gpp.newline", "each", "lazy")?,
            off_left_out: second("gpp.off-modal", "printed", "left-out")?,
            old_words: second("gpp.old-words", "refused", "accepted")?,
            tie_even: second("gpp.tie", "away", "even")?,
            absent_zero: second("gpp.without-value", "refused", "zero")?,
        })
    }
}
