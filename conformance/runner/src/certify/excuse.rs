//! Departures that somebody knows of, or answers for, by their names.

use super::verdict::{Run, Verdict};
use crate::expectations::ExpectationMismatch;
use crate::waivers::Waived;

/// Who knows of a departure where the expectations list it.
pub const EXPECTATIONS: &str = "listed in the expectations";
/// Who knows of a departure where an earlier report has it.
pub const BASELINE: &str = "as in the baseline";

impl Run<'_> {
    /// Names what is known, or waived, of what the run was held against; what is in `troubles` is neither. A
    /// departure that is charged to other rules stays so: it is known, or not, there.
    pub fn excuse(
        &mut self,
        troubles: &[ExpectationMismatch],
        waived: &[Waived],
        who: Option<&str>,
    ) {
        for result in &mut self.cases {
            let Verdict::Diverges(departure) = &result.verdict else { continue };
            let place = (result.rule.id.as_str(), result.name);
            let waiver = waived.iter().find(|waived| waived.place() == place);
            if let Some(waiver) = waiver {
                result.verdict = Verdict::Waived(departure.clone(), waiver.why.clone());
            } else if let Some(who) = who
                && !troubles.iter().any(|trouble| trouble.place() == place)
            {
                result.verdict = Verdict::Known(departure.clone(), who.to_owned());
            }
        }
    }
}
