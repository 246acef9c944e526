//! The command `gaugeblock`.

use std::process::ExitCode;

fn main() -> ExitCode {
    gaugeblock::command::main()
}
