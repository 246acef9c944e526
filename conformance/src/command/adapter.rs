//! `gaugeblock adapter`.

use std::path::PathBuf;

use clap::{Args, Subcommand, ValueEnum};
use gaugeblock_adapter::protocol;
use gaugeblock_adapter::templates::{C, PYTHON};
use gaugeblock_suite::Suite;

use super::{Refused, check, place, write_out};

const EXAMPLES: &str = "Examples:
  gaugeblock adapter new --lang python > adapter.py
      an adapter that works, of a controller that knows G0 and G1: put yours in its place
  gaugeblock adapter check \"python3 adapter.py\"
      what is wrong with it, before anything is certified
  gaugeblock certify \"exec:python3 adapter.py\" --only modal-groups
      what the controller behind it does
  gaugeblock adapter protocol
      the page that tells how it is spoken";

/// Connect a controller
#[derive(Debug, Subcommand)]
#[command(after_help = EXAMPLES)]
pub(super) enum Adapter {
    /// Print an adapter to begin with
    New(New),
    /// Tell what is wrong with an adapter, before anything is certified
    Check(check::Arguments),
    /// Print the page that tells the protocol
    Protocol,
    /// Print the words that a declaration can have, place by place
    Vocabulary,
    /// Print the JSON schema of what is asked or answered
    Schema(Schema),
}

#[derive(Debug, Args)]
pub(super) struct New {
    /// Its language
    #[arg(long, value_enum, default_value_t = Lang::Python)]
    lang: Lang,
    /// Write it into this file, which is not there yet, instead of standard output
    #[arg(value_name = "FILE")]
    file: Option<PathBuf>,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum Lang {
    /// Python 3.8 or later, nothing else
    Python,
    /// C99 with POSIX, nothing else
    C,
}

#[derive(Debug, Args)]
pub(super) struct Schema {
    /// Of what
    #[arg(value_enum)]
    what: What,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum What {
    /// What the referee asks
    Request,
    /// What the adapter answers
    Answer,
}

pub(super) fn adapter(
    command: &Adapter,
    suite: impl FnOnce() -> Result<Suite, Refused>,
) -> Result<u8, Refused> {
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

fn new(arguments: &New) -> Result<u8, Refused> {
    let template = match arguments.lang {
        Lang::Python => PYTHON,
        Lang::C => C,
    };
    match &arguments.file {
        None => write_out(template),
        Some(file) if file.exists() => {
            return Err(Refused::wrong(
                format!("{}: it is there already, and is not overwritten", file.display()),
                "name another file",
            ));
        }
        Some(file) => place::write_whole(file, template)?,
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
                    let offer = protocol::OFFERS.iter().find(|(_, name, _)| *name == word);
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
