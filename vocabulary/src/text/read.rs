//! Reading the text form.

use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;

use super::line::{Arguments, name_and_rest};
use super::value::{FromText as _, ReadField as _};
use crate::block::{BlockLocation, Span};
use crate::effect::Effect;
use crate::error::TextError;
use crate::fault::Fault;
use crate::indexed::Indexed;
use crate::language::Language;
use crate::outcome::{End, Event, Outcome, Sample, Step};
use crate::pin::PinChange;
use crate::settings::{Settings, State};

impl Outcome {
    /// Reads the text form; what [`Outcome::to_text`] wrote comes back equal.
    ///
    /// # Errors
    /// The first line that is not in the form, with its number.
    pub fn from_text(text: &str) -> Result<Self, TextError> {
        read(text)
    }
}

fn read(text: &str) -> Result<Outcome, TextError> {
    let mut reader = Reader::default();
    let mut last = 1;
    for (place, line) in text.lines().enumerate() {
        last = place + 1;
        reader.line(line).map_err(|error| error.at(last))?;
    }
    reader.finish().map_err(|error| error.at(last))
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
            "language" => once(&mut self.language, word, Language::from_text(rest)?)?,
            "start" => once(&mut self.start, word, settings(rest)?)?,
            "block" => {
                if self.end.is_some() {
                    return Err(TextError::new("a block after the end"));
                }
                self.steps.push(Step { block: block(rest)?, events: Vec::new(), state: None });
            }
            "set" => self.event(Event::Set(settings(rest)?.into()))?,
            "do" => {
                let (name, rest) = rest.split_once(' ').unwrap_or((rest, ""));
                self.event(Event::Do(Effect::read(name, Arguments::parse(rest)?)?))?;
            }
            "unknown" => {
                let fields = rest.split_whitespace().map(String::from).collect();
                self.event(Event::Unknown(fields))?;
            }
            "state" => {
                let language = self
                    .language
                    .ok_or_else(|| TextError::new("the language line must come first"))?;
                let mut state = State::empty(language);
                for (field, index, value) in Arguments::parse(rest)?.pairs() {
                    state.read(field, index, value)?;
                }
                once(&mut self.step()?.state, word, state)?;
            }
            "end" => once(&mut self.end, word, end(rest)?)?,
            "parameters" => once(&mut self.parameters, word, parameters(rest)?)?,
            "pin" => self.pins.push(pin(rest)?),
            "sample" => self.samples.push(sample(rest)?),
            _ => return Err(TextError::new(format!("no line begins with {word}"))),
        }
        Ok(())
    }

    fn event(&mut self, event: Event) -> Result<(), TextError> {
        let step = self.step()?;
        if step.state.is_some() {
            return Err(TextError::new("the state is the last line below a block line"));
        }
        step.events.push(event);
        Ok(())
    }

    fn step(&mut self) -> Result<&mut Step, TextError> {
        let place = if self.end.is_some() { None } else { self.steps.last_mut() };
        place.ok_or_else(|| TextError::new("this belongs below a block line"))
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

/// Fills a place that one line alone may fill.
fn once<T>(place: &mut Option<T>, word: &str, value: T) -> Result<(), TextError> {
    match place.replace(value) {
        Some(_) => Err(TextError::new(format!("a second {word} line"))),
        None => Ok(()),
    }
}

fn settings(text: &str) -> Result<Settings, TextError> {
    let mut settings = Settings::default();
    for (field, index, value) in Arguments::parse(text)?.pairs() {
        settings.read(field, index, value)?;
    }
    Ok(settings)
}

fn block(text: &str) -> Result<BlockLocation, TextError> {
    let wrong = || TextError::new(format!("not a block like main.ngc:3: {text}"));
    let (file, rest) = name_and_rest(text, |text| text.rfind(':'))?;
    let line = rest.strip_prefix(':').and_then(|line| line.parse().ok());
    Ok(BlockLocation::new(file, line.ok_or_else(wrong)?))
}

fn end(text: &str) -> Result<End, TextError> {
    let (name, rest) = text.split_once(' ').unwrap_or((text, ""));
    let mut arguments = Arguments::parse(rest)?;
    let end = match name {
        "program_end" => End::ProgramEnd,
        "percent_end" => End::PercentEnd,
        "stream_end" => End::StreamEnd,
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

fn block_of(arguments: &mut Arguments) -> Result<BlockLocation, TextError> {
    let file: String = arguments.take("file")?;
    Ok(BlockLocation::new(file, arguments.take("line")?))
}

fn fault(arguments: &mut Arguments) -> Result<Fault, TextError> {
    let kind = arguments.take("kind")?;
    let file: Option<String> = arguments.take("file")?;
    let block = both(file, arguments.take("line")?, "file and line")?;
    let span = both(arguments.take("from")?, arguments.take("to")?, "from and to")?;
    Ok(Fault {
        kind,
        block: block.map(|(file, line)| BlockLocation::new(file, line)),
        span: span.map(|(start, end)| Span { start, end }),
        message: arguments.take("message")?,
    })
}

fn both<A, B>(a: Option<A>, b: Option<B>, names: &str) -> Result<Option<(A, B)>, TextError> {
    match (a, b) {
        (Some(a), Some(b)) => Ok(Some((a, b))),
        (None, None) => Ok(None),
        (Some(_), None) | (None, Some(_)) => {
            Err(TextError::new(format!("one without the other: {names}")))
        }
    }
}

fn parameters(text: &str) -> Result<Indexed<u32, f64>, TextError> {
    let mut found = Some(Indexed::default());
    for (number, index, value) in Arguments::parse(text)?.pairs() {
        if let Some(index) = index {
            return Err(TextError::new(format!("no index belongs here: [{index}]")));
        }
        Indexed::read(&mut found, Some(number), value)?;
    }
    Ok(found.unwrap_or_default())
}

fn pin(text: &str) -> Result<PinChange, TextError> {
    let (pin, rest) = text.split_once(' ').unwrap_or((text, ""));
    let mut arguments = Arguments::parse(rest)?;
    let (time, value) = (arguments.take("time")?, arguments.take("value")?);
    let change = PinChange { time, pin: pin.parse()?, value };
    arguments.finish()?;
    Ok(change)
}

fn sample(text: &str) -> Result<Sample, TextError> {
    let mut arguments = Arguments::parse(text)?;
    let sample = Sample { time: arguments.take("time")?, position: arguments.take("position")? };
    arguments.finish()?;
    Ok(sample)
}
