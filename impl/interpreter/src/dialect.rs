//! The dialect: what each part of the interpreter takes from the options, read once.

use gaugeblock_vocabulary::Options;

use crate::error::Error;
use crate::{modal, syntax, task};

/// The choices that hold under some options.
#[derive(Clone, Debug)]
pub(crate) struct Dialect {
    options: Options,
    pub(crate) text: syntax::Choices,
    pub(crate) modes: modal::Choices,
    pub(crate) task: task::Choices,
}

impl Dialect {
    /// Reads the options.
    ///
    /// # Errors
    /// A choice has an option that its page does not name.
    pub(crate) fn of(options: Options) -> Result<Self, Error> {
        let text = syntax::Choices::of(&options)?;
        let modes = modal::Choices::read(&options)?;
        let task = task::Choices::read(&options)?;
        Ok(Self { options, text, modes, task })
    }

    /// The options from which they were read.
    pub(crate) fn options(&self) -> &Options {
        &self.options
    }
}
