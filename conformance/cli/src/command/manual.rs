//! `gaugeblock completions`, `gaugeblock man`: what a shell and `man` know of the command.

use std::path::{Path, PathBuf};

use clap::{Args, Command};
use clap_complete::Shell;

use super::user_files;
use crate::error::CliError;
use crate::streams::write_out;

const COMPLETIONS_EXAMPLES: &str = "Examples:
  gaugeblock completions bash > ~/.local/share/bash-completion/completions/gaugeblock
  gaugeblock completions fish > ~/.config/fish/completions/gaugeblock.fish
  gaugeblock completions zsh > ~/.zfunc/_gaugeblock

Exit status: 0 printed; 2 wrong call or input.";

const MAN_EXAMPLES: &str = "Examples:
  gaugeblock man ~/.local/share/man/man1
      write gaugeblock.1, gaugeblock-certify.1 and so on; then `man gaugeblock-certify`

Exit status: 0 written; 2 wrong call, or a file that cannot be written.";

/// For which shell.
#[derive(Debug, Args)]
#[command(after_help = COMPLETIONS_EXAMPLES)]
pub(crate) struct Completions {
    /// The shell
    #[arg(value_enum)]
    shell: Shell,
}

/// Where the pages are written.
#[derive(Debug, Args)]
#[command(after_help = MAN_EXAMPLES)]
pub(crate) struct Manual {
    /// Folder for the pages; created if absent
    #[arg(value_name = "DIR")]
    folder: PathBuf,
}

/// Prints the script with which a shell completes calls of `command`.
pub(crate) fn completions(arguments: &Completions, mut command: Command) -> u8 {
    let name = command.get_name().to_owned();
    let mut script = Vec::new();
    clap_complete::generate(arguments.shell, &mut command, name, &mut script);
    write_out(&String::from_utf8_lossy(&script));
    0
}

/// Writes a page for `command` and for each of its subcommands.
pub(crate) fn manual(arguments: &Manual, mut command: Command) -> Result<u8, CliError> {
    user_files::create_folder(&arguments.folder)?;
    command.build();
    let name = command.get_name().to_owned();
    let pages = pages(&arguments.folder, &name, &command)?;
    write_out(&format!("{pages} pages written to {}\n", arguments.folder.display()));
    Ok(0)
}

/// Writes the page of a command, and those of its subcommands; how many.
fn pages(folder: &Path, name: &str, command: &Command) -> Result<usize, CliError> {
    let mut page = Vec::new();
    let manual = clap_mangen::Man::new(command.clone()).title(name);
    manual.render(&mut page).map_err(|error| {
        CliError::failure(error.to_string(), "this is a bug in gaugeblock; please report it")
    })?;
    user_files::write_whole(&folder.join(format!("{name}.1")), &page)?;
    let mut count = 1;
    for subcommand in command.get_subcommands().filter(|it| it.get_name() != "help") {
        count += pages(folder, &format!("{name}-{}", subcommand.get_name()), subcommand)?;
    }
    Ok(count)
}
