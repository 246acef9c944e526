//! Writing the text form.

use alloc::borrow::ToOwned as _;
use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;
use core::fmt::Write as _;

use super::value::{name_text, quoted};
use crate::fault::Fault;
use crate::field::Entry;
use crate::outcome::{End, Event, Outcome};
use crate::pin::PinChange;

impl Outcome {
    /// The text form. It ends with a line break.
    ///
    /// ```
    /// use gaugeblock_vocabulary::Outcome;
    ///
    /// let text = "\
    /// gaugeblock outcome 0
    /// language rs274
    /// start units=mm
    /// block main.ngc:1
    ///   do straight_traverse end=(x1)
    /// end program_end
    /// ";
    /// let outcome = Outcome::from_text(text)?;
    /// assert_eq!(outcome.to_text(), text);
    /// # Ok::<(), gaugeblock_vocabulary::TextError>(())
    /// ```
    pub fn to_text(&self) -> String {
        text_of(self)
    }
}

fn text_of(outcome: &Outcome) -> String {
    let mut text = format!("gaugeblock outcome 0\nlanguage {}\n", outcome.language);
    record(&mut text, "start", &outcome.start.entries());
    for step in &outcome.steps {
        line(&mut text, &format!("block {}:{}", name_text(&step.block.file), step.block.line));
        for event in &step.events {
            match event {
                Event::Set(settings) => record(&mut text, "  set", &settings.entries()),
                Event::Unknown(fields) => {
                    line(&mut text, format!("  unknown {}", fields.join(" ")).trim_end());
                }
                Event::Do(effect) => {
                    let mut words = format!("  do {}", effect.name());
                    for (name, value) in effect.arguments() {
                        put(&mut words, &format!(" {name}={value}"));
                    }
                    line(&mut text, &words);
                }
            }
        }
        if let Some(state) = &step.state {
            record(&mut text, "  state", &state.entries());
        }
    }
    line(&mut text, &end(&outcome.end));
    if let Some(parameters) = &outcome.parameters {
        let pairs: Vec<_> =
            parameters.0.iter().map(|(number, value)| format!(" {number}={value}")).collect();
        line(&mut text, &format!("parameters{}", pairs.concat()));
    }
    for change in &outcome.pins {
        let PinChange { time, pin, value } = change;
        line(&mut text, &format!("pin {pin} time={time} value={value}"));
    }
    for sample in &outcome.samples {
        line(&mut text, &format!("sample time={} position={}", sample.time, sample.position));
    }
    text
}

fn put(text: &mut String, words: &str) {
    text.push_str(words);
}

fn line(text: &mut String, words: &str) {
    text.push_str(words);
    text.push('\n');
}

fn record(text: &mut String, name: &str, entries: &[Entry]) {
    let mut words = name.to_owned();
    for entry in entries {
        let _infallible = write!(words, " {}={}", entry.name(), entry.value);
    }
    line(text, &words);
}

fn end(end: &End) -> String {
    let name = end.name();
    match end {
        End::ProgramEnd
        | End::PercentEnd
        | End::StreamEnd
        | End::Endless
        | End::Paused
        | End::Aborted => {
            format!("end {name}")
        }
        End::Fault(Fault { kind, block, span, message }) => {
            let kind = kind.map_or_else(String::new, |kind| format!(" kind={kind}"));
            let block = block
                .as_ref()
                .map_or_else(String::new, |b| format!(" file={} line={}", quoted(&b.file), b.line));
            let span = span
                .map_or_else(String::new, |span| format!(" from={} to={}", span.start, span.end));
            format!("end {name}{kind}{block}{span} message={}", quoted(message))
        }
        End::BudgetExhausted { bound } => format!("end {name} bound={bound}"),
        End::Unsupported { block, what } => {
            let (file, what) = (quoted(&block.file), quoted(what));
            format!("end {name} file={file} line={} what={what}", block.line)
        }
        End::Unspecified { block, why } => {
            let (file, why) = (quoted(&block.file), quoted(why));
            format!("end {name} file={file} line={} why={why}", block.line)
        }
    }
}
