//! Reading the text form.

use super::{Arguments, TextError};
use crate::effect::Effect;
use crate::fault::{Block, Fault, Span};
use crate::field::{Field, Indexed, Scalar};
use crate::outcome::{End, Event, Outcome, PinChange, Sample, Step};
use crate::settings::{Language, Settings, State};

pub(super) fn outcome(text: &str) -> Result<Outcome, TextError> {
    let mut reader = Reader::default();
    for (place, line) in text.lines().enumerate() {
        reader.line(line).map_err(|error| error.at(place + 1))?;
    }
    reader.finish()
}

#[derive(Default)]
struct Reader {
    header: bool,
    language: Option<Language>,
    start: Option<Settings>,
    steps: Vec<Step>,
    end: Option<End>,
    parameters: Option<Indexed<u32, f64>>,
    pins: Vec<PinChange>,
    samples: Vec<Sample>,
}

impl Reader {
    fn line(&mut self, line: &str) -> Result<(), TextError> {
        let line = line.trim();
        if line.is_empty() {
            return Ok(());
        }
        let (word, rest) = line.split_once(' ').unwrap_or((line, ""));
        if !self.header {
            self.header = line == "gaugeblock outcome 0";
            let wrong = || TextError::new("the first line must be: gaugeblock outcome 0");
            return self.header.then_some(()).ok_or_else(wrong);
        }
        match word {
            "language" => self.language = Some(Language::from_text(rest)?),
            "start" => self.start = Some(settings(rest)?),
            "block" => {
                self.steps.push(Step { block: block(rest)?, events: Vec::new(), state: None });
            }
            "set" => self.step()?.events.push(Event::Set(settings(rest)?)),
            "do" => {
                let (name, rest) = rest.split_once(' ').unwrap_or((rest, ""));
                let effect = Effect::read(name, Arguments::parse(rest)?)?;
                self.step()?.events.push(Event::Do(effect));
            }
            "state" => {
                let language = self.language.ok_or_else(|| TextError::new("language is missing"))?;
                let mut state = State::empty(language);
                for (field, index, value) in Arguments::parse(rest)?.pairs() {
                    state.read(field, index, value)?;
                }
                self.step()?.state = Some(state);
            }
            "end" => self.end = Some(end(rest)?),
            "parameters" => self.parameters = Some(parameters(rest)?),
            "pin" => self.pins.push(pin(rest)?),
            "sample" => self.samples.push(sample(rest)?),
            _ => return Err(TextError::new(format!("no line begins with {word}"))),
        }
        Ok(())
    }

    fn step(&mut self) -> Result<&mut Step, TextError> {
        self.steps.last_mut().ok_or_else(|| TextError::new("this belongs below a block line"))
    }

    fn finish(self) -> Result<Outcome, TextError> {
        let missing = |name: &str| TextError::new(format!("the {name} line is missing"));
        Ok(Outcome {
            language: self.language.ok_or_else(|| missing("language"))?,
            start: self.start.ok_or_else(|| missing("start"))?,
            steps: self.steps,
            end: self.end.ok_or_else(|| missing("end"))?,
            parameters: self.parameters,
            pins: self.pins,
            samples: self.samples,
        })
    }
}

fn settings(text: &str) -> Result<Settings, TextError> {
    let mut settings = Settings::default();
    for (field, index, value) in Arguments::parse(text)?.pairs() {
        settings.read(field, index, value)?;
    }
    Ok(settings)
}

fn block(text: &str) -> Result<Block, TextError> {
    let wrong = || TextError::new(format!("not a block like main.ngc:3: {text}"));
    let (file, line) = text.rsplit_once(':').ok_or_else(wrong)?;
    Ok(Block::new(file, line.parse().map_err(|_| wrong())?))
}

fn end(text: &str) -> Result<End, TextError> {
    let (name, rest) = text.split_once(' ').unwrap_or((text, ""));
    let mut arguments = Arguments::parse(rest)?;
    let end = match name {
        "program_end" => End::ProgramEnd,
        "percent_end" => End::PercentEnd,
        "endless" => End::Endless,
        "paused" => End::Paused,
        "aborted" => End::Aborted,
        "fault" => End::Fault(fault(&mut arguments)?),
        "budget_exhausted" => End::BudgetExhausted { bound: arguments.take("bound")? },
        "unsupported" => {
            End::Unsupported { block: block_of(&mut arguments)?, what: arguments.take("what")? }
        }
        "unspecified" => {
            End::Unspecified { block: block_of(&mut arguments)?, why: arguments.take("why")? }
        }
        _ => return Err(TextError::new(format!("no run ends as {name}"))),
    };
    arguments.finish()?;
    Ok(end)
}

fn block_of(arguments: &mut Arguments) -> Result<Block, TextError> {
    Ok(Block { file: arguments.take("file")?, line: arguments.take("line")? })
}

fn fault(arguments: &mut Arguments) -> Result<Fault, TextError> {
    let kind = arguments.take("kind")?;
    let file: Option<String> = arguments.take("file")?;
    let line: Option<u32> = arguments.take("line")?;
    let start: Option<u32> = arguments.take("from")?;
    let end: Option<u32> = arguments.take("to")?;
    Ok(Fault {
        kind,
        block: file.zip(line).map(|(file, line)| Block { file, line }),
        span: start.zip(end).map(|(start, end)| Span { start, end }),
        message: arguments.take("message")?,
    })
}

fn parameters(text: &str) -> Result<Indexed<u32, f64>, TextError> {
    let mut found = Some(Indexed::default());
    for (number, _, value) in Arguments::parse(text)?.pairs() {
        Indexed::read(&mut found, Some(number), value)?;
    }
    Ok(found.unwrap_or_default())
}

fn pin(text: &str) -> Result<PinChange, TextError> {
    let (pin, rest) = text.rsplit_once(" time=").ok_or_else(|| TextError::new("time is missing"))?;
    let mut arguments = Arguments::parse(&format!("time={rest}"))?;
    let pin = if pin.starts_with('"') { String::from_text(pin)? } else { pin.to_owned() };
    let change = PinChange { time: arguments.take("time")?, pin, value: arguments.take("value")? };
    arguments.finish()?;
    Ok(change)
}

fn sample(text: &str) -> Result<Sample, TextError> {
    let mut arguments = Arguments::parse(text)?;
    let sample = Sample { time: arguments.take("time")?, position: arguments.take("position")? };
    arguments.finish()?;
    Ok(sample)
}
