//! `cargo run -p gaugeblock-laws -- graph`: pictures and lists of what uses what in this repository; `words`: house
//! words that are left in its text.

use std::io::{self, Write};
use std::process::ExitCode;

use gaugeblock_laws::prose::{self, Rules};
use gaugeblock_laws::{picture, report};

const HELP: &str = "\
Lists which crate and which file of this repository uses which, and house words in its text.

Usage: cargo run -p gaugeblock-laws -- graph [--text | --dot | --svg FILE] [CRATE]
       cargo run -p gaugeblock-laws -- words [PATH]

graph, without CRATE: the crates, and all circles of files. With CRATE: its files, from the bottom up, and its circles.

  --text      a list (default); edges marked * are a small set without which a circle is none
  --dot       a graph for Graphviz; an arrow that follows from longer ways is left out
  --svg FILE  the same as a picture

words: house words by kind of text, in files whose path begins with PATH; laws/words.toml has the plain words.
";

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let arguments: Vec<&str> = arguments.iter().map(String::as_str).collect();
    match answer(&arguments) {
        Ok(text) => {
            // A reader that closes the pipe has read enough.
            drop(io::stdout().lock().write_all(text.as_bytes()));
            ExitCode::SUCCESS
        }
        Err(message) => {
            drop(writeln!(io::stderr().lock(), "error: {message}"));
            ExitCode::from(2)
        }
    }
}

fn answer(arguments: &[&str]) -> Result<String, String> {
    match arguments {
        ["graph", "--dot", of @ ..] => Ok(report::dot(&report::graph(of)?)),
        ["graph", "--svg", file, of @ ..] => {
            let svg = picture::svg(&report::graph(of)?);
            std::fs::write(file, svg).map_err(|error| format!("cannot write {file}: {error}"))?;
            Ok(String::new())
        }
        ["graph", "--text", of @ ..] | ["graph", of @ ..] => report::text(of),
        ["words"] => Ok(words("")),
        ["words", path] => Ok(words(path)),
        ["--help" | "-h", ..] => Ok(HELP.to_owned()),
        _ => Err(format!("unknown arguments; expected as follows\n\n{HELP}")),
    }
}

/// House words in files whose path begins so, and how many there are of each kind of text.
fn words(path: &str) -> String {
    let mut words = prose::house_words(&Rules::read());
    words.retain(|(_, place)| place.starts_with(path));
    let mut text = String::new();
    for (kind, place) in &words {
        text.push_str(&format!("{kind}: {place}\n"));
    }
    for (kind, count) in prose::count(&words) {
        text.push_str(&format!("{kind} = {count}\n"));
    }
    text
}
