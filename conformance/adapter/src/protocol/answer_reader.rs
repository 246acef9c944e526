//! Fast reading of answers to runs. The start settings are half of an answer and rarely change; they are parsed when
//! they do. Steps are parsed only if they differ from the expected ones.

use std::io::{ErrorKind, Result, Write};

use gaugeblock_vocabulary::{End, Indexed, Language, Outcome, PinChange, Sample, Settings, Step};
use serde::Deserialize;
use serde_json::value::RawValue;

use super::number_literals::with_texts;
use super::{Answer, Reply};

/// An answer with an outcome and nothing else.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Form<'a> {
    id: u64,
    #[serde(borrow)]
    outcome: PartialOutcome<'a>,
}

/// An [`Outcome`] whose start settings are not parsed yet.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct PartialOutcome<'a> {
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

impl PartialOutcome<'_> {
    /// The outcome with start settings that were parsed before, and with these steps.
    fn with(self, start: &Settings, steps: Vec<Step>) -> Outcome {
        let Self { language, start: _, steps: _, end, parameters, pins, samples } = self;
        Outcome { language, start: start.clone(), steps, end, parameters, pins, samples }
    }
}

/// Reads the answers of one session.
#[derive(Debug, Default)]
pub(crate) struct AnswerReader {
    /// The last start settings: their text and their value.
    start: (Box<str>, Settings),
}

impl AnswerReader {
    /// Reads an answer to a run. `expected` is the id and the specified outcome, if known.
    ///
    /// # Errors
    /// The answer is not valid; the message has the place in the line.
    pub(crate) fn read(
        &mut self,
        line: &[u8],
        expected: Option<(u64, &Outcome)>,
    ) -> serde_json::Result<Answer> {
        if let Some(answer) = expected.and_then(|(id, outcome)| self.as_expected(line, id, outcome))
        {
            return Ok(answer);
        }
        // Any other answer, and any error, is found by the general reader.
        self.outcome(line).or_else(|_| match with_texts(line) {
            Some(line) => self.outcome(&line).or_else(|_| serde_json::from_slice(&line)),
            None => serde_json::from_slice(line),
        })
    }

    /// Fast path of [`Self::outcome`]: an answer with the last start settings and the expected steps, in the form that
    /// this project writes, needs no parsing of either.
    fn as_expected(&self, line: &[u8], id: u64, expected: &Outcome) -> Option<Answer> {
        let (language, start) = (expected.language, self.start.0.as_bytes());
        if start.is_empty() {
            return None;
        }
        let before = format!("{{\"id\":{id},\"outcome\":{{\"language\":\"{language}\",\"start\":");
        let text = line.strip_prefix(before.as_bytes())?.strip_suffix(b"}")?;
        let text = text.strip_prefix(start)?.strip_prefix(b",\"steps\":")?;
        let mut rest = ExpectedPrefix(text);
        serde_json::to_writer(&mut rest, &expected.steps).ok()?;
        // What has been compared is left out of what is parsed.
        let before = format!("{{\"language\":\"{language}\",\"start\":{{}},\"steps\":[]");
        let short = [before.as_bytes(), rest.0].concat();
        let partial: PartialOutcome<'_> = serde_json::from_slice(&short).ok()?;
        let outcome = partial.with(&self.start.1, expected.steps.clone());
        Some(Answer { id, reply: Reply::Outcome(Box::new(outcome)) })
    }

    fn outcome(&mut self, line: &[u8]) -> serde_json::Result<Answer> {
        let Form { id, outcome: mut partial } = serde_json::from_slice(line)?;
        let start = partial.start.get();
        if *self.start.0 != *start {
            self.start = (start.into(), serde_json::from_str(start)?);
        }
        let steps = std::mem::take(&mut partial.steps);
        let outcome = partial.with(&self.start.1, steps);
        Ok(Answer { id, reply: Reply::Outcome(Box::new(outcome)) })
    }
}

/// A writer that fails at the first byte that differs from this text.
struct ExpectedPrefix<'a>(&'a [u8]);

impl Write for ExpectedPrefix<'_> {
    fn write(&mut self, written: &[u8]) -> Result<usize> {
        self.0 = self.0.strip_prefix(written).ok_or(ErrorKind::InvalidData)?;
        Ok(written.len())
    }

    fn flush(&mut self) -> Result<()> {
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use gaugeblock_vocabulary::Scenario;

    use super::*;

    #[test]
    fn only_steps_that_are_written_as_expected_are_not_read() {
        let outcome = |program: &str| gaugeblock_reference::run(&Scenario::of(program)).0;
        let line = |id: u64, outcome: &Outcome| {
            let reply = Reply::Outcome(Box::new(outcome.clone()));
            serde_json::to_vec(&Answer { id, reply }).unwrap()
        };
        let text = |read: serde_json::Result<Answer>| read.map_err(|error| error.to_string());
        for program in ["g21 f100\n(msg, now)\ng1 x1.5 y-2\nm2\n", "#31=5\ng999\n", "?"] {
            let expected = outcome(program);
            let whole = line(7, &expected);
            let mut reader = AnswerReader::default();
            assert_eq!(reader.as_expected(&whole, 7, &expected), None, "the start is not known");
            let no_start = String::from_utf8(whole.clone()).unwrap();
            let (before, behind) = no_start.split_once("{\"units").unwrap();
            let (_, behind) = behind.split_once(",\"steps").unwrap();
            let no_start = format!("{before},\"steps{behind}");
            assert!(reader.read(no_start.as_bytes(), Some((7, &expected))).is_err(), "{no_start}");
            reader.read(&whole, None).unwrap();
            let read = reader.as_expected(&whole, 7, &expected);
            assert_eq!(read, serde_json::from_slice(&whole).ok(), "{program}");
            assert_eq!(reader.as_expected(&line(8, &expected), 7, &expected), None);
            assert_eq!(reader.as_expected(&line(7, &outcome("m2")), 7, &expected), None);
            for place in 0..whole.len() {
                let mut other = whole.clone();
                other[place] = if other[place] == b'1' { b'2' } else { b'1' };
                for other in [&other, &whole[..place]] {
                    let read = text(reader.read(other, Some((7, &expected))));
                    assert_eq!(read, text(serde_json::from_slice(other)), "{program}: {place}");
                    reader.read(&whole, None).unwrap();
                }
            }
        }
    }

    #[test]
    fn an_answer_is_read_as_any_other() {
        let end = r#""steps":[],"end":{"end":"program_end"}"#;
        let outcome = |start: &str| {
            format!(r#"{{"id":7,"outcome":{{"language":"rs274","start":{start},{end}}}}}"#)
        };
        let mut reader = AnswerReader::default();
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
            assert_eq!(text(reader.read(line.as_bytes(), None)), plain, "{line}");
        }
    }
}
