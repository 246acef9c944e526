//! The machine of a run from LinuxCNC's own files: tool table, stored parameters, INI file.

use std::path::{Path, PathBuf};

use clap::Args;
use gaugeblock_adapter::Adapter;
use gaugeblock_linuxcnc::in_inches;
use gaugeblock_rs274::{read_machine, read_parameter_file, read_tool_table};
use gaugeblock_vocabulary::{Machine, Scenario};

use super::own_name;
use crate::command::user_files;
use crate::error::CliError;
use crate::streams::write_error;

/// Files that describe a machine, in the formats of LinuxCNC.
#[derive(Debug, Args)]
pub(crate) struct MachineFiles {
    /// Tool table in LinuxCNC's format, in the unit of the machine
    #[arg(long, short, value_name = "FILE")]
    tools: Option<PathBuf>,
    /// Stored parameters in the format of LinuxCNC's .var file, in the unit of the machine
    #[arg(long, value_name = "FILE")]
    parameters: Option<PathBuf>,
    /// LinuxCNC's INI file: unit and axes ([TRAJ]), spindles, tool changes, and what `#<_ini[section]name>` reads
    #[arg(long, value_name = "FILE")]
    ini: Option<PathBuf>,
}

impl MachineFiles {
    /// The files that are read.
    pub(crate) fn paths(&self) -> impl Iterator<Item = PathBuf> {
        [&self.tools, &self.parameters, &self.ini].into_iter().flatten().cloned()
    }

    /// Reads the files over what a machine has.
    pub(crate) fn apply(&self, machine: &mut Machine) -> Result<(), CliError> {
        if let Some(path) = &self.ini {
            let hint = "for example `[TRAJ]`, `LINEAR_UNITS = mm` and `COORDINATES = X Y Z`";
            let read = |text: &str| read_machine(text, std::mem::take(machine));
            *machine = user_files::read_form(path, "INI file (--ini)", hint, read)?;
        }
        if let Some(path) = &self.tools {
            let hint = "for example `T1 P1 Z25.4 D6 ; end mill`, a tool a line";
            machine.tools =
                user_files::read_form(path, "tool table (--tools)", hint, read_tool_table)?;
        }
        if let Some(path) = &self.parameters {
            let hint = "a number and a value a line, the numbers in ascending order, for example `5221 12.5`";
            let role = "parameter file (--parameters)";
            let read = user_files::read_form(path, role, hint, read_parameter_file)?;
            machine.parameters.0.extend(read);
        }
        Ok(())
    }
}

/// Converts the machine for a controller that stores lengths in inches only, with a note; both sides of a comparison
/// then have the same machine.
pub(crate) fn fit_to(
    scenario: Scenario,
    file: &Path,
    controllers: &[&dyn Adapter],
) -> Result<Scenario, CliError> {
    if !controllers.iter().any(|controller| controller.capabilities().name == "rs274") {
        return Ok(scenario);
    }
    match in_inches(&scenario) {
        Ok(None) => Ok(scenario),
        Ok(Some(converted)) => {
            write_error(
                "note: rs274 stores inches and has the axes X Y Z A B C: the machine is converted",
            );
            Ok(converted)
        }
        Err(why) => Err(CliError::failure(
            format!(
                "{}: the machine cannot be converted to inches for rs274: {}",
                user_files::program_name(file),
                own_name::in_text(&why, file)
            ),
            "use a machine in inches, or another controller such as linuxcnc",
        )),
    }
}
