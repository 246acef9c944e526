//! `gaugeblock rs274`.

use gaugeblock_rs274::Failure;

use super::user_files;
use crate::error::CliError;

pub(crate) use gaugeblock_rs274::Arguments;

/// Runs the program. As in LinuxCNC's `rs274`, an error ends with exit status 1; a file that is missing and a block
/// that is too long end with 2, as in the other commands.
pub(crate) fn rs274(arguments: &Arguments) -> Result<u8, CliError> {
    let refused = |failure| match failure {
        Failure::Refused(message) => CliError {
            status: 1,
            message,
            hint: Some("`gaugeblock rs274 --help` lists the options".to_owned()),
        },
        Failure::BlockTooLong(message) => {
            CliError::usage(message, "lower its repeats (L), or use a larger peck or depth")
        }
    };
    for (path, role) in [
        (&arguments.program, "program"),
        (&arguments.ini, "INI file (-i)"),
        (&arguments.tools, "tool table (-t)"),
    ] {
        if let Some(path) = path {
            user_files::check_exists(path, role)?;
        }
    }
    let editions = gaugeblock_embedded_suite::page("editions.toml");
    let editions = editions.map_err(|message| refused(Failure::Refused(message)))?;
    gaugeblock_rs274::rs274(arguments, &editions).map_err(refused)
}
