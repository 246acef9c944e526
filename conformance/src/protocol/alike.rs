//! Answers to runs, which mostly begin alike: what is in force before the first block is half of what such an answer says, and is read when it changes.

use gaugeblock_trace::{End, Indexed, Language, Outcome, PinChange, Sample, Settings, Step};
use serde::Deserialize;
use serde_json::value::RawValue;

use super::{Answer, Reply};

/// An answer with an outcome and nothing else.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Form<'a> {
    id: u64,
    #[serde(borrow)]
    outcome: Told<'a>,
}

/// An [`Outcome`] whose start is not read yet.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Told<'a> {
    language: Language,
    #[serde(borrow)]
    start: &'a RawValue,
    steps: Vec<Step>,
    end: End,
    #[serde(default)]
    parameters: Option<Indexed<u32, f64>>,
    #[serde(default)]
    pins: Vec<PinChange>,
    #[serde(default)]
    samples: Vec<Sample>,
}

/// Reads answers of one session.
#[derive(Debug, Default)]
pub(crate) struct Alike {
    /// The last start, as it was written and as it was read.
    start: (Box<str>, Settings),
}

impl Alike {
    /// An answer to a run.
    ///
    /// # Errors
    /// It is none; with the place in the line.
    pub(crate) fn read(&mut self, line: &[u8]) -> serde_json::Result<Answer> {
        // Whatever else it says, and whatever is wrong with it, is found in the way of any other answer.
        self.outcome(line).or_else(|_| serde_json::from_slice(line))
    }

    fn outcome(&mut self, line: &[u8]) -> serde_json::Result<Answer> {
        let Form { id, outcome } = serde_json::from_slice(line)?;
        let Told { language, start, steps, end, parameters, pins, samples } = outcome;
        if *self.start.0 != *start.get() {
            self.start = (start.get().into(), serde_json::from_str(start.get())?);
        }
        let start = self.start.1.clone();
        let outcome = Outcome { language, start, steps, end, parameters, pins, samples };
        Ok(Answer { id, reply: Reply::Outcome(Box::new(outcome)) })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_answer_is_read_as_any_other() {
        let end = r#""steps":[],"end":{"end":"program_end"}"#;
        let outcome = |start: &str| {
            format!(r#"{{"id":7,"outcome":{{"language":"rs274","start":{start},{end}}}}}"#)
        };
        let mut alike = Alike::default();
        for line in [
            outcome(r#"{"units":"mm"}"#),
            outcome(r#"{"units":"mm"}"#),
            outcome(r#"{"units":"inch","feed_rate":0.1}"#),
            outcome("{}"),
            outcome(r#"{"units":"mm","feed_rate":1}"#),
            outcome(r#"{"units":"furlong"}"#),
            outcome(r#"{"units":"mm"}"#).replace("\"steps\":[],", ""),
            outcome(r#"{"units":"mm"}"#).replace("{\"id\"", "{\"new\":1,\"id\""),
            r#"{"id":7,"unsupported":"it has no spindle"}"#.to_owned(),
            r#"{"id":7,"outcome":3}"#.to_owned(),
            "{".to_owned(),
        ] {
            let text = |read: serde_json::Result<Answer>| read.map_err(|error| error.to_string());
            let plain = text(serde_json::from_str(&line));
            assert_eq!(text(alike.read(line.as_bytes())), plain, "{line}");
        }
    }
}
