//! `gaugeblock adapter`.

use std::path::PathBuf;

use clap::{Args, Subcommand, ValueEnum};
use gaugeblock_adapter::protocol;
use gaugeblock_adapter::templates::{C, CPP, PYTHON, RUST};
use gaugeblock_suite::Suite;

use super::{check, user_files};
use crate::error::CliError;
use crate::streams::write_out;

const EXAMPLES: &str = "Examples:
  gaugeblock adapter new --lang python > adapter.py
      write a working adapter of a toy controller (G0 and G1); replace the controller by yours
  gaugeblock adapter check \"python3 adapter.py\"
      find errors of the adapter before you certify
  gaugeblock certify --controller \"exec:python3 adapter.py\" --only modal-groups
      certify its controller on one chapter
  gaugeblock adapter protocol
      print the protocol description";

/// Write an adapter for a controller: template, self-check, protocol
#[derive(Debug, Subcommand)]
#[command(after_help = EXAMPLES)]
pub(crate) enum Adapter {
    /// Print a template of an adapter
    New(New),
    /// Find errors of an adapter
    Check(check::Arguments),
    /// Print the protocol description
    #[command(after_help = "Example:
  gaugeblock adapter protocol

Exit status: 0 printed; 2 wrong call or input.")]
    Protocol,
    /// Print the words that an adapter may declare, and what they mean
    #[command(after_help = "Example:
  gaugeblock adapter vocabulary

Exit status: 0 printed; 2 wrong call or input.")]
    Vocabulary,
    /// Print the JSON schema of requests or answers
    Schema(Schema),
}

#[derive(Debug, Args)]
#[command(after_help = "Examples:
  gaugeblock adapter new > adapter.py
  gaugeblock adapter new --lang c adapter.c
  gaugeblock adapter new --lang c++ adapter.cpp

Exit status: 0 printed; 2 wrong call or input.")]
pub(crate) struct New {
    /// Programming language
    #[arg(long, value_enum, default_value_t = Lang::Python)]
    lang: Lang,
    /// Write it to this new file instead of standard output
    #[arg(value_name = "FILE")]
    file: Option<PathBuf>,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum Lang {
    /// Python 3.8 or later, no packages
    Python,
    /// C99 with POSIX
    C,
    /// C++17, for an interpreter in a library that calls canonical functions
    #[value(name = "c++", alias = "cpp")]
    Cpp,
    /// Rust with `serde_json`, for an interpreter that writes its canonical calls to a file
    Rust,
}

#[derive(Debug, Args)]
#[command(after_help = "Example:
  gaugeblock adapter schema request > request.schema.json

Exit status: 0 printed; 2 wrong call or input.")]
pub(crate) struct Schema {
    /// The message
    #[arg(value_enum)]
    what: What,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum What {
    /// Requests of the referee
    Request,
    /// Answers of the adapter
    Answer,
}

pub(crate) fn adapter(
    command: &Adapter,
    suite: impl FnOnce() -> Result<Suite, CliError>,
) -> Result<u8, CliError> {
    match command {
        Adapter::New(arguments) => new(arguments),
        Adapter::Check(arguments) => check::check(arguments, &suite()?),
        Adapter::Protocol => {
            write_out(protocol::PAGE);
            Ok(0)
        }
        Adapter::Vocabulary => {
            write_out(&vocabulary());
            Ok(0)
        }
        Adapter::Schema(arguments) => {
            let schema = match arguments.what {
                What::Request => protocol::request_schema(),
                What::Answer => protocol::answer_schema(),
            };
            write_out(&format!("{:#}\n", schema.as_value()));
            Ok(0)
        }
    }
}

fn new(arguments: &New) -> Result<u8, CliError> {
    let template = match arguments.lang {
        Lang::Python => PYTHON,
        Lang::C => C,
        Lang::Cpp => CPP,
        Lang::Rust => RUST,
    };
    match &arguments.file {
        None => write_out(template),
        Some(file) if file.exists() => {
            return Err(CliError::usage(
                format!("{}: the file exists", file.display()),
                "choose another file; existing files are never overwritten",
            ));
        }
        Some(file) => user_files::write_whole(file, template)?,
    }
    Ok(0)
}

fn vocabulary() -> String {
    let mut text = String::new();
    for (place, words) in protocol::vocabulary() {
        text.push_str(&format!("{place}\n"));
        for word in words {
            let means = protocol::FEATURES.iter().find(|(name, _)| *name == word);
            let means = match place {
                "features" => means.map(|(_, means)| *means),
                "offers" => {
                    let offer = protocol::EXTENSIONS.iter().find(|(_, name, _)| *name == word);
                    offer.map(|(.., means)| *means)
                }
                _ => None,
            };
            match means {
                Some(means) => text.push_str(&format!("  {word:22} {means}\n")),
                None => text.push_str(&format!("  {word}\n")),
            }
        }
    }
    text
}
