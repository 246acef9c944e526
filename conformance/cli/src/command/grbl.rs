//! Opens a controller of the Grbl family, and requires a confirmation before its machine moves.

use std::io::{IsTerminal as _, stdin};

use gaugeblock_adapter::ControllerError;
use gaugeblock_grbl::{Grbl, Limits, Motion, Setup};
use gaugeblock_runner::language::check_program;

use crate::error::CliError;
use crate::streams::write_error;

/// What follows `grbl:`, as an example.
const EXAMPLES: &str =
    "for example grbl:/dev/ttyUSB0, grbl:192.168.1.20:23, grbl:/dev/ttyUSB0?motion=real";

/// The controller at a device or a socket, with the options after a question mark.
pub(super) fn open(name: &str) -> Result<Grbl, CliError> {
    let setup = Setup::read(name).map_err(|why| {
        CliError::usage(format!("invalid controller `grbl:{name}`: {why}"), EXAMPLES)
    })?;
    if setup.motion == Motion::Real && !setup.confirmed {
        confirm_motion(name)?;
    }
    let failure = |error: ControllerError| {
        let hint = match &error {
            ControllerError::WrongVersion { .. } => "the protocol of other versions differs",
            ControllerError::Missing { .. } | ControllerError::Broken(_) => {
                "check cable, port and the rights of the device, and that no other program uses it; see docs/grbl.md"
            }
        };
        CliError::failure(format!("grbl:{name}: {error}"), hint)
    };
    let grbl = Grbl::open(setup, Limits::default()).map_err(failure)?;
    Ok(grbl.check_language_by(check_program))
}

/// Lets a person at the terminal confirm that the machine may move.
fn confirm_motion(name: &str) -> Result<(), CliError> {
    let input = stdin();
    if !input.is_terminal() {
        return Err(CliError::usage(
            format!("grbl:{name}: motion is not confirmed, and standard input is not a terminal"),
            "in a script, confirm it in the name of the controller: motion=real&yes",
        ));
    }
    write_error(
        "Programs of the suite will move the axes, turn the spindle and switch the coolant of this machine.\n\
         Remove tool and workpiece, and keep the emergency stop within reach.\n\
         Type `yes` to go on:",
    );
    let mut answer = String::new();
    let read = input.read_line(&mut answer);
    if read.is_ok() && answer.trim() == "yes" {
        return Ok(());
    }
    Err(CliError::usage(
        format!("grbl:{name}: motion is not confirmed"),
        "without `motion=real` programs run in check mode, and nothing moves",
    ))
}
