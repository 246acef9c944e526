//! Why a command ends without a result.

/// Why a command ends without a result: message, hint and exit status.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct CliError {
    /// [`CliError::WRONG_CALL`], or 3: the command could not finish.
    pub(crate) status: u8,
    /// What is wrong, with its place.
    pub(crate) message: String,
    /// What to do.
    pub(crate) hint: Option<String>,
}

impl CliError {
    /// Exit status after a wrong call or wrong input.
    pub(crate) const WRONG_CALL: u8 = 2;

    /// The call or its input is wrong.
    pub(crate) fn usage(message: impl Into<String>, hint: impl Into<String>) -> Self {
        Self { status: Self::WRONG_CALL, message: message.into(), hint: Some(hint.into()) }
    }

    /// It could not finish.
    pub(crate) fn failure(message: impl Into<String>, hint: impl Into<String>) -> Self {
        Self { status: 3, message: message.into(), hint: Some(hint.into()) }
    }
}
