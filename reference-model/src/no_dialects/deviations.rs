//! What a dialect does differently: nothing.

use gaugeblock_vocabulary::Options;

/// The option under which a controller does what was observed, and not what the documents say.
const OBSERVED: &str = "observed";

/// What a dialect does differently in a run: nothing.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Deviations {}

impl Deviations {
    /// Takes over an option that no choice of the documents has: it may only say that they hold.
    ///
    /// # Errors
    /// It says something else.
    pub(crate) fn set(&mut self, id: &str, option: &str) -> Result<(), String> {
        match option {
            "documented" => Ok(()),
            OBSERVED => Err(needs_dialects(id)),
            _ => Err(unknown(id)),
        }
    }
}

/// An id without a page.
pub(crate) fn unknown(id: &str) -> String {
    format!("there is no choice {id}")
}

/// Whether this build has what options require: it has no behaviour that was observed.
///
/// # Errors
/// An option that requires such behaviour.
pub(crate) fn accepts_options(options: &Options) -> Result<(), String> {
    let observed = options.0.iter().find(|(_, option)| *option == OBSERVED);
    observed.map_or(Ok(()), |(id, _)| Err(needs_dialects(id)))
}

fn needs_dialects(id: &str) -> String {
    format!("{id} = {OBSERVED} needs the feature `dialects`")
}
