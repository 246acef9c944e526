//! The options of the command, with the letters that `rs274` has.

use std::path::PathBuf;

use clap::Args;

const EXAMPLES: &str = "Examples:
  gaugeblock rs274 -g part.ngc
  gaugeblock rs274 -g -t tools.tbl -v mill.var -i mill.ini part.ngc calls.txt
  printf 'g20\\ng0 x1\\nquit\\n' | gaugeblock rs274 -g

The production interpreter prints canonical calls in the form of LinuxCNC's `rs274`.
It finds subroutine files in the program's folder, and in SUBROUTINE_PATH and PROGRAM_PREFIX of the
INI file. It reads no other file of the host, and user-defined M codes run nothing.

Exit status: 0 the program ended; 1 a block was refused; 2 wrong call, a file is missing,
or a block has more than a million effects.";

/// What the command is called with.
#[derive(Clone, Debug, Default, Args)]
#[command(after_help = EXAMPLES)]
pub struct Arguments {
    /// The program; without one, blocks are read from standard input up to `quit`
    #[arg(value_name = "PROGRAM")]
    pub program: Option<PathBuf>,
    /// File for the canonical calls [default: standard output]
    #[arg(value_name = "OUTPUT")]
    pub output: Option<PathBuf>,
    /// Start at once; accepted for compatibility, since there is no menu
    #[arg(short = 'g')]
    pub go: bool,
    /// After a refused block: 0 continues with the next block, 1 and 2 stop
    #[arg(short = 'n', value_name = "MODE", default_value_t = 2, value_parser = clap::value_parser!(u8).range(0..=2))]
    pub next: u8,
    /// The tool table
    #[arg(short = 't', value_name = "FILE")]
    pub tools: Option<PathBuf>,
    /// The parameter file; it is read at the start and written at the end
    #[arg(short = 'v', value_name = "FILE")]
    pub parameters: Option<PathBuf>,
    /// The INI file
    #[arg(short = 'i', value_name = "FILE")]
    pub ini: Option<PathBuf>,
    /// Skip blocks that begin with a slash
    #[arg(short = 'b')]
    pub block_delete: bool,
    /// Accepted for compatibility; has no effect
    #[arg(short = 's')]
    pub stack: bool,
    /// Another interpreter; refused, since no interpreter can be loaded
    #[arg(short = 'p', value_name = "MODULE")]
    pub plug: Option<PathBuf>,
    /// Accepted for compatibility; has no effect
    #[arg(short = 'T')]
    pub task: bool,
    /// Accepted for compatibility; has no effect
    #[arg(short = 'l', value_name = "LEVEL", allow_negative_numbers = true)]
    pub log_level: Option<i32>,
}
