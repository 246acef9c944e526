//! The readings of the documents that apply to custom macros, taken from the options once.

use gaugeblock_vocabulary::Options;

use crate::error::Error;

/// The readings that apply. Every flag is false under the first option of its page.
#[derive(Clone, Copy, Debug)]
#[expect(clippy::struct_excessive_bools, reason = "each is a choice of the documents")]
pub(super) struct Choices {
    /// Angles are radians.
    pub(super) radians: bool,
    /// G, L and P of a block that is taken as arguments are #10, #12 and #16.
    pub(super) own_numbers: bool,
    /// G67 without a modal call is refused.
    pub(super) cancel_refused: bool,
    /// Five macro levels and fifteen calls instead of four and eight.
    pub(super) deeper: bool,
    /// P of G4 is milliseconds.
    pub(super) milliseconds: bool,
    /// FIX rounds down and FUP up.
    pub(super) floor_and_ceiling: bool,
    /// COS and NOT are the only functions, and MOD is not an operator.
    pub(super) documented_functions: bool,
    /// WHILE, DO and END are refused.
    pub(super) no_loops: bool,
    /// M99 in the main program is refused.
    pub(super) main_return_refused: bool,
    /// A repeated call has its arguments again.
    pub(super) reloaded: bool,
    /// A letter that the set in progress has opens the next one.
    pub(super) by_set: bool,
    /// The 32 bits have no sign.
    pub(super) unsigned: bool,
}

impl Choices {
    /// Reads the options.
    ///
    /// # Errors
    /// A choice has an option that its page does not name.
    pub(super) fn of(options: &Options) -> Result<Self, Error> {
        let second = |id, first: &str, second: &str| match options.get(id) {
            None => Ok(false),
            Some(option) if option == first => Ok(false),
            Some(option) if option == second => Ok(true),
            Some(_) => Err(Error::Configuration("no such option of a choice of NCT")),
        };
        Ok(Self {
            radians: second("nct.angles", "degrees", "radians")?,
            own_numbers: second("nct.block-arguments", "left-out", "own-numbers")?,
            cancel_refused: second("nct.cancel-without-call", "no-effect", "refused")?,
            deeper: second("nct.depth", "four", "five")?,
            milliseconds: second("nct.dwell", "seconds", "milliseconds")?,
            floor_and_ceiling: second("nct.fix-fup", "by-magnitude", "floor-and-ceiling")?,
            documented_functions: second("nct.functions", "usual", "documented")?,
            no_loops: second("nct.loops", "accepted", "refused")?,
            main_return_refused: second("nct.main-return", "begins-again", "refused")?,
            reloaded: second("nct.repeated-locals", "kept", "reloaded")?,
            by_set: second("nct.set-advance", "by-letter", "by-set")?,
            unsigned: second("nct.thirty-two-bits", "signed", "unsigned")?,
        })
    }
}
