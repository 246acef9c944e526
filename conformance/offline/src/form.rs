//! Reads an answer sheet as a person has filled it in.

use std::collections::{BTreeMap, BTreeSet};

use gaugeblock_vocabulary::{
    Axis, BlockLocation, Channel, Position, Program, Rs274State, Settings,
};
use serde::Deserialize;

use super::ExportedProgram;
use super::sheet::{Answer, CHANNELS, ENDS, Sheet};

/// A field of a sheet: text, or a number without quotes.
#[derive(Debug, Deserialize)]
#[serde(untagged)]
enum Field {
    Whole(i64),
    Number(f64),
    Text(String),
}

impl Default for Field {
    fn default() -> Self {
        Self::Text(String::new())
    }
}

impl Field {
    fn text(&self) -> String {
        match self {
            Self::Whole(number) => number.to_string(),
            Self::Number(number) => number.to_string(),
            Self::Text(text) => text.trim().to_owned(),
        }
    }

    fn is_empty(&self) -> bool {
        self.text().is_empty()
    }

    fn number(&self, place: &str) -> Result<f64, String> {
        let text = self.text();
        text.parse().map_err(|_| {
            let hint = if text.contains(',') { " (write a point, not a comma)" } else { "" };
            format!("{place}: {text:?} is not a number{hint}")
        })
    }
}

#[derive(Debug, Deserialize)]
#[serde(untagged)]
enum Messages {
    Text(String),
    List(Vec<String>),
}

#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
struct Alarm {
    text: String,
    file: String,
    line: Field,
}

#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
struct Form {
    ended: String,
    not_possible: String,
    messages: Option<Messages>,
    alarm: Alarm,
    position: BTreeMap<String, Field>,
    variables: BTreeMap<String, Field>,
    modes: BTreeMap<String, Field>,
}

impl Answer {
    /// Reads a sheet.
    ///
    /// # Errors
    /// What cannot be read, with its place.
    pub fn read(text: &str, exported: &ExportedProgram) -> Result<Self, String> {
        let form: Form = toml::from_str(text).map_err(|error| {
            let line = error.span().map_or(0, |span| text[..span.start].lines().count().max(1));
            format!("line {line}: {}", error.message().lines().next().unwrap_or_default())
        })?;
        if !form.not_possible.trim().is_empty() {
            return Ok(Self::NotPossible(form.not_possible.trim().to_owned()));
        }
        let ended = form.ended.trim().to_lowercase();
        if ended.is_empty() {
            return if form.is_blank() {
                Ok(Self::Blank)
            } else {
                Err("`ended` is empty, but something else is filled in".to_owned())
            };
        }
        if !ENDS.iter().any(|(word, _)| *word == ended) {
            let known: Vec<_> = ENDS.iter().map(|(word, _)| *word).collect();
            return Err(format!("ended: {:?} is none of: {}", form.ended, known.join(", ")));
        }
        let mut sheet = Sheet {
            ended,
            alarm: form.alarm.text.trim().to_owned(),
            block: form.block()?,
            position: form.position(&exported.axes)?,
            variables: form.variables()?,
            messages: form.messages(),
            settings: Settings::default(),
            state: Rs274State::default(),
            modes: BTreeSet::new(),
        };
        for (mode, value) in form.modes.iter().filter(|(_, value)| !value.is_empty()) {
            sheet.mode(mode, &value.text())?;
        }
        Ok(Self::Ran(Box::new(sheet)))
    }
}

impl Form {
    fn is_blank(&self) -> bool {
        let fields =
            self.position.values().chain(self.variables.values()).chain(self.modes.values());
        self.alarm.text.trim().is_empty()
            && self.alarm.line.is_empty()
            && self.messages().is_none()
            && fields.into_iter().all(Field::is_empty)
    }

    fn block(&self) -> Result<Option<BlockLocation>, String> {
        if self.alarm.line.is_empty() {
            return Ok(None);
        }
        let text = self.alarm.line.text();
        let line = text.parse().ok().filter(|line: &u32| *line > 0);
        let line = line.ok_or_else(|| format!("[alarm] line: {text:?} is not a line number"))?;
        let file = self.alarm.file.trim();
        Ok(Some(BlockLocation::new(if file.is_empty() { Program::MAIN } else { file }, line)))
    }

    fn position(&self, axes: &[Axis]) -> Result<Option<Position>, String> {
        let known = |name: &String| axes.iter().find(|axis| axis.word() == name.to_lowercase());
        if let Some(other) = self.position.keys().find(|name| known(name).is_none()) {
            return Err(format!("[position] {other}: this program has no such axis"));
        }
        if self.position.values().all(Field::is_empty) {
            return Ok(None);
        }
        let mut position = Position::default();
        for axis in axes {
            let place = format!("[position] {}", axis.word());
            let field = self.position.iter().find(|(name, _)| known(name) == Some(axis));
            match field.filter(|(_, field)| !field.is_empty()) {
                Some((_, field)) => *position.get_mut(*axis) = field.number(&place)?,
                None => return Err(format!("{place} is empty, but other axes are filled in")),
            }
        }
        Ok(Some(position))
    }

    fn variables(&self) -> Result<BTreeMap<u32, f64>, String> {
        let filled = self.variables.iter().filter(|(_, field)| !field.is_empty());
        let read = |(name, field): (&String, &Field)| {
            let place = format!("[variables] {name:?}");
            let number = name.trim().trim_start_matches('#').parse().ok();
            let number =
                number.ok_or_else(|| format!("{place} is not the number of a variable"))?;
            Ok((number, field.number(&place)?))
        };
        filled.map(read).collect()
    }

    fn messages(&self) -> Option<Vec<(Channel, String)>> {
        let texts = match self.messages.as_ref()? {
            Messages::Text(text) if text.trim().is_empty() => return None,
            Messages::Text(text) => std::slice::from_ref(text),
            Messages::List(texts) => texts.as_slice(),
        };
        let read = |text: &String| {
            let known = CHANNELS.iter().find_map(|(label, channel)| {
                Some((*channel, text.strip_prefix(label)?.to_owned()))
            });
            known.unwrap_or_else(|| (Channel::Display, text.clone()))
        };
        Some(texts.iter().map(read).collect())
    }
}

#[cfg(test)]
mod tests {
    use super::super::blocks::{blocks_text, read_blocks};
    use super::super::sheet::{Values, text};
    use super::*;

    fn exported() -> ExportedProgram {
        ExportedProgram {
            folder: "0001".to_owned(),
            scenario: String::new(),
            chapter: "feed".to_owned(),
            cases: 1,
            axes: vec![Axis::X, Axis::Z, Axis::C],
            variables: vec![31, 5220],
            messages: true,
            samples: false,
        }
    }

    #[test]
    fn a_sheet_that_is_written_is_read_as_it_was() {
        let messages = ["a \"b\" \\ c", "print: really on the display", "two\nlines", "ü"];
        let mut all: Vec<_> =
            messages.iter().map(|text| (Channel::Display, (*text).to_owned())).collect();
        all.extend([(Channel::Print, " a".to_owned()), (Channel::Log, String::new())]);
        let position = Position { x: 0.1 + 0.2, z: -1e-7, c: 1e17, ..Position::default() };
        let values = Values {
            ended: "alarm".to_owned(),
            alarm: "\"what\" = 5 # now".to_owned(),
            block: Some(BlockLocation::new("o's.ngc", 12)),
            position: Some(position),
            variables: BTreeMap::from([(31, 1.0 / 3.0)]),
            messages: Some(all.clone()),
            modes: BTreeMap::from([("distance".to_owned(), "incremental".to_owned())]),
            ..Values::default()
        };
        let written = text(&exported(), &values);
        let Ok(Answer::Ran(sheet)) = Answer::read(&written, &exported()) else {
            panic!("{:?}\n{written}", Answer::read(&written, &exported()))
        };
        assert_eq!((sheet.alarm, sheet.block), (values.alarm, values.block));
        assert_eq!((sheet.position, sheet.messages), (Some(position), Some(all)));
        assert_eq!((sheet.variables, sheet.modes.len()), (values.variables, 1));
    }

    #[test]
    fn an_empty_sheet_is_blank_and_zero_is_something() {
        let blank = text(&exported(), &Values::default());
        assert_eq!(Answer::read(&blank, &exported()), Ok(Answer::Blank));
        assert_eq!(Answer::read("", &exported()), Ok(Answer::Blank));
        let zero = blank.replacen("x = \"\"", "x = 0", 1);
        assert!(Answer::read(&zero, &exported()).is_err());
    }

    #[test]
    fn blocks_are_read_as_they_were_written() {
        let axes = [Axis::X, Axis::B];
        let at = Position { x: 1.5, b: -90.0, ..Position::default() };
        let blocks = vec![
            (BlockLocation::new("main.ngc", 1), None),
            (BlockLocation::new("a.ngc", 2), Some(at)),
        ];
        assert_eq!(read_blocks(&blocks_text(&axes, &blocks), &axes), Ok(Some(blocks)));
        assert_eq!(read_blocks(&blocks_text(&axes, &Vec::new()), &axes), Ok(None));
        assert_eq!(read_blocks("", &axes), Ok(None));
        for (row, words) in [
            ("main.ngc", "line 2: it has no file and line"),
            ("main.ngc,x", "\"x\" is not a line number"),
            ("main.ngc,1,5", "expected the positions of 2 axes, not of 1"),
            ("main.ngc,1,5,", "\"\" is not a number"),
        ] {
            let error = read_blocks(&format!("file,line,x,b\n{row}\n"), &axes).unwrap_err();
            assert!(error.contains(words), "{error}");
        }
    }
}
