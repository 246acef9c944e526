//! `gaugeblock adapter check`.

use clap::Args;

use super::{Refused, controller, write_out};
use crate::adapters::exec::Limits;
use crate::protocol::check::{Came, checks};

#[derive(Debug, Args)]
#[command(after_help = "Examples:
  gaugeblock adapter check \"python3 adapter.py\"
  gaugeblock adapter check ./adapter

Exit status: 0 nothing is wrong, 1 something is, 3 it cannot be asked at all.")]
pub(super) struct Arguments {
    /// The adapter, as a command of the shell
    #[arg(value_name = "COMMAND")]
    command: String,
}

pub(super) fn check(arguments: &Arguments) -> Result<u8, Refused> {
    let command = arguments.command.strip_prefix("exec:").unwrap_or(&arguments.command);
    let adapter = controller::exec(command, Limits::default())?;
    let begun = crate::adapters::exec::now();
    let found = checks(&adapter, &|| begun.elapsed().as_secs_f64());
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
        text.push_str(&format!("{mark:8}  {:17}  {says}\n", check.what));
    }
    text.push_str(&match wrong {
        0 => format!(
            "\nnothing is wrong with it: gaugeblock certify {:?}\n",
            format!("exec:{command}")
        ),
        _ => format!(
            "\n{wrong} to be mended; `gaugeblock adapter protocol` tells how it should be\n"
        ),
    });
    write_out(&text);
    Ok(u8::from(wrong > 0))
}
