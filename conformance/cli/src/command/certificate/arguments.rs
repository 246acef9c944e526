//! The arguments of `gaugeblock verify-certificate`.

use std::path::PathBuf;
use std::str::FromStr;

use clap::Args;

use crate::arguments::Format;
use crate::command::controller;

const EXAMPLES: &str = "Examples:
  gaugeblock verify-certificate mill.json --public-key minisign.pub
      check the signature, that every case of the suite has one verdict, and what follows from them
  gaugeblock verify-certificate mill.json --public-key minisign.pub --profile rs274-core
      require this profile, too: claimed and passed
  gaugeblock verify-certificate mill.json --public-key minisign.pub --subject ./mill
      require that this file is the certified one
  gaugeblock verify-certificate mill.json --public-key RWQf6LRC… --rerun 5% --controller exec:./mill
      run a random twentieth of the cases again, and compare the verdicts
  gaugeblock verify-certificate shard-*.json --public-key minisign.pub
      check the certificates of all shards of one run

The signature of FILE is FILE.minisig; `minisign -Vm FILE -p minisign.pub` checks it without
Gaugeblock. docs/certificate.md says what a certificate proves and what it does not.

Exit status: 0 verified, and the run passes; 1 not verified, or it fails; 2 wrong call or input;
3 verified, and the run could not be finished, or the controller cannot run again.";

#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Arguments {
    /// Certificates: one, or those of all shards of one run
    #[arg(value_name = "FILE", required = true)]
    pub(super) files: Vec<PathBuf>,
    /// Public key of minisign: its file, or the line that encodes it
    #[arg(long, short, value_name = "KEY")]
    pub(super) public_key: String,
    /// Accept a certificate of a selection of the cases (`certify --only`)
    #[arg(long)]
    pub(super) partial: bool,
    /// Require that this profile is claimed and passed; may be repeated
    #[arg(long, value_name = "PROFILE")]
    pub(super) profile: Vec<String>,
    /// Require that this file is one of the controller, such as its binary; may be repeated
    #[arg(long, value_name = "FILE")]
    pub(super) subject: Vec<PathBuf>,
    /// Run this share of the cases again on --controller, and compare the verdicts
    #[arg(long, value_name = "PERCENT", requires = "controller")]
    pub(super) rerun: Option<Percent>,
    /// The controller that runs them
    #[arg(long, short, value_name = "CONTROLLER", requires = "rerun", long_help = controller::NAMES)]
    pub(super) controller: Option<String>,
    /// Seed that chooses the cases [default: random; it is printed]
    #[arg(long, value_name = "SEED", requires = "rerun")]
    pub(super) seed: Option<u64>,
    /// Time limit of an adapter's answer, seconds
    #[arg(long, value_name = "SECONDS", default_value_t = 10, value_parser = clap::value_parser!(u64).range(1..))]
    pub(super) time_limit: u64,
    /// Output format
    #[arg(long, value_enum, default_value_t = Format::Text)]
    pub(super) format: Format,
}

/// A share of all cases, in percent.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Percent(pub(super) usize);

impl FromStr for Percent {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let number = text.strip_suffix('%').unwrap_or(text).trim_end().parse();
        let is_share = |percent: &usize| (1..=100).contains(percent);
        let percent = number.ok().filter(is_share);
        percent.map(Self).ok_or_else(|| "expected a share from 1% to 100%, such as 5%".to_owned())
    }
}
