//! `gaugeblock adapter check`.

use clap::Args;
use gaugeblock_adapter::exec::Limits;
use gaugeblock_suite::Suite;

use super::{Refused, controller, write_out};
use crate::check::{Came, checks};

#[derive(Debug, Args)]
#[command(after_help = "Examples:
  gaugeblock adapter check \"python3 adapter.py\"
  gaugeblock adapter check ./adapter
  gaugeblock adapter check tcp:127.0.0.1:4100

Exit status: 0 nothing is wrong, 1 something is, 3 it cannot be asked at all.")]
pub(super) struct Arguments {
    /// The adapter, as a command of the shell, or tcp:HOST:PORT where it listens
    #[arg(value_name = "COMMAND")]
    command: String,
}

pub(super) fn check(arguments: &Arguments, suite: &Suite) -> Result<u8, Refused> {
    let named = &arguments.command;
    let named = match named.split_once(':') {
        Some(("exec" | "tcp", _)) => named.clone(),
        _ => format!("exec:{named}"),
    };
    let adapter = controller::behind(&named, Limits::default())
        .unwrap_or_else(|| controller::exec(&named, Limits::default()))?;
    let begun = gaugeblock_adapter::clock::now();
    let found = checks(&adapter, suite, &|| begun.elapsed().as_secs_f64());
    let mut wrong = 0;
    let mut text = String::new();
    for check in &found {
        let (mark, says) = match &check.came {
            Came::Fine(says) => ("fine", says),
            Came::Wrong(says) => {
                wrong += 1;
                ("WRONG", says)
            }
            Came::LeftOut(says) => ("left out", says),
        };
        let mut lines = says.lines();
        let first = lines.next().unwrap_or_default();
        text.push_str(&format!("{mark:8}  {:19}  {first}\n", check.what));
        lines.for_each(|line| text.push_str(&format!("{:31}{line}\n", "")));
    }
    text.push_str(&match wrong {
        0 => format!("\nnothing is wrong with it: gaugeblock certify {named:?}\n"),
        _ => format!(
            "\n{wrong} to be mended; `gaugeblock adapter protocol` tells how it should be\n"
        ),
    });
    write_out(&text);
    Ok(u8::from(wrong > 0))
}
