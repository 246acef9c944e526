//! Program text: the main program, and subroutine files from the folders that may be looked into.

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::path::PathBuf;
use std::rc::Rc;

use gaugeblock_interpreter::{Source, SourceError};
use gaugeblock_vocabulary::Program;

/// A file's text and where its lines begin.
#[derive(Debug, Default)]
struct Text {
    bytes: Vec<u8>,
    starts: Vec<usize>,
}

impl Text {
    fn new(bytes: Vec<u8>) -> Self {
        let mut starts = vec![0];
        for (at, byte) in bytes.iter().enumerate() {
            // A carriage return before a line feed belongs to it.
            if *byte == b'\n' || *byte == b'\r' && bytes.get(at + 1) != Some(&b'\n') {
                starts.push(at + 1);
            }
        }
        Self { bytes, starts }
    }

    fn line(&self, number: u32) -> &[u8] {
        let place = usize::try_from(number).unwrap_or(usize::MAX);
        let start = place.checked_sub(1).and_then(|place| self.starts.get(place)).copied();
        let Some(start) = start else { return &[] };
        let end = self.starts.get(place).copied().unwrap_or(self.bytes.len());
        let line = self.bytes.get(start..end).unwrap_or(&[]);
        let end = line.iter().rposition(|byte| !matches!(byte, b'\n' | b'\r'));
        line.get(..end.map_or(0, |end| end + 1)).unwrap_or(&[])
    }
}

/// The texts of all files that were read, to print lines of them.
#[derive(Clone, Debug, Default)]
pub(super) struct Texts(Rc<RefCell<Loaded>>);

#[derive(Debug, Default)]
struct Loaded {
    main: Text,
    others: BTreeMap<String, Text>,
}

impl Texts {
    /// Hands the text of a line, without its end, to `see`.
    pub(super) fn line<T>(&self, file: &str, line: u32, see: impl FnOnce(&[u8]) -> T) -> T {
        let loaded = self.0.borrow();
        let text = if file == Program::MAIN { Some(&loaded.main) } else { loaded.others.get(file) };
        see(text.map_or(&[], |text| text.line(line)))
    }

    /// Whether the main program begins with a percent line.
    pub(super) fn begins_with_percent(&self) -> bool {
        let loaded = self.0.borrow();
        loaded.main.bytes.trim_ascii_start().starts_with(b"%")
    }

    /// Whether a second percent line ends the main program, with text after it or not.
    pub(super) fn has_second_percent(&self) -> bool {
        let loaded = self.0.borrow();
        let lines = u32::try_from(loaded.main.starts.len()).unwrap_or(u32::MAX);
        let is_percent = |line: &u32| loaded.main.line(*line).trim_ascii() == b"%";
        (1..=lines).filter(is_percent).count() > 1
    }

    /// The line of the main program with a code in its words, where there is only one.
    pub(super) fn only_line_with(&self, code: &[u8]) -> Option<Vec<u8>> {
        let loaded = self.0.borrow();
        let lines = u32::try_from(loaded.main.starts.len()).unwrap_or(u32::MAX);
        let has = |line: &[u8]| {
            let words = line.split(|byte| matches!(byte, b'(' | b';')).next().unwrap_or_default();
            let letters = words.iter().filter(|byte| !byte.is_ascii_whitespace());
            let text: Vec<u8> = letters.map(u8::to_ascii_lowercase).collect();
            text.windows(code.len()).any(|part| part == code)
        };
        let mut found = (1..=lines).map(|line| loaded.main.line(line)).filter(|line| has(line));
        let only = found.next().map(<[u8]>::to_vec);
        only.filter(|_| found.next().is_none())
    }

    /// The text of the last line of the main program that holds anything.
    pub(super) fn last_line(&self) -> Vec<u8> {
        let loaded = self.0.borrow();
        let lines = u32::try_from(loaded.main.starts.len()).unwrap_or(u32::MAX);
        let mut held = (1..=lines).rev().map(|line| loaded.main.line(line));
        held.find(|line| !line.is_empty()).unwrap_or(&[]).to_vec()
    }
}

/// Reads the main program from memory and subroutine files when they are called.
#[derive(Debug)]
pub(super) struct Files {
    texts: Texts,
    folders: Vec<PathBuf>,
    /// The position of the reader in the main file.
    at: usize,
    /// The open subroutine files, innermost last, and the position of the reader in each.
    open: Vec<(Rc<[u8]>, usize)>,
    main: Rc<[u8]>,
}

impl Files {
    /// A program, and where its subroutine files may lie.
    pub(super) fn new(main: Vec<u8>, folders: Vec<PathBuf>, texts: Texts) -> Self {
        let shared = Rc::from(main.as_slice());
        texts.0.borrow_mut().main = Text::new(main);
        Self { texts, folders, at: 0, open: Vec::new(), main: shared }
    }

    fn open_text(&mut self, name: &str, bytes: Vec<u8>) {
        self.open.push((Rc::from(bytes.as_slice()), 0));
        self.texts.0.borrow_mut().others.insert(name.to_owned(), Text::new(bytes));
    }
}

/// Most characters of a line.
const LONGEST: usize = 252;

/// The first line that is not blank, where it is too long: `rs274` reads up to it when it opens a file, and does not
/// begin.
pub(super) fn overlong_beginning(text: &[u8]) -> Option<&[u8]> {
    let first = text.split(|byte| *byte == b'\n').find(|line| !line.trim_ascii().is_empty())?;
    (first.trim_ascii_end().len() > LONGEST).then_some(first)
}

/// Whether a program begins with a percent line and has no second one.
pub(super) fn is_unclosed(main: &[u8]) -> bool {
    let lines = main.split(|byte| matches!(byte, b'\n' | b'\r')).map(<[u8]>::trim_ascii);
    main.trim_ascii_start().starts_with(b"%") && lines.filter(|line| *line == b"%").count() == 1
}

/// The text of a sub that the main program defines, with empty lines before it so that its lines keep their numbers;
/// none where there is none.
///
/// `rs274` finds a sub that is defined after its call. The interpreter does not, but looks for a file of its name.
fn defined_later(main: &[u8], name: &str) -> Option<Vec<u8>> {
    let name = name.strip_suffix(".ngc")?.as_bytes();
    let mut text = Vec::new();
    let mut within = false;
    let mut percents = 0;
    for line in main.split_inclusive(|byte| *byte == b'\n') {
        percents += u8::from(line.trim_ascii() == b"%");
        if percents == 2 {
            break;
        }
        let keyword = keyword(line, name);
        within |= keyword == Some(&b"sub"[..]);
        if within && line.trim_ascii() != b"%" {
            text.extend_from_slice(line);
        } else {
            text.push(b'\n');
        }
        if within && keyword == Some(&b"endsub"[..]) {
            return Some(text);
        }
    }
    // One that ends in the other style is refused where it does.
    within.then(|| {
        text.extend_from_slice(b"\no<");
        text.extend_from_slice(name);
        text.extend_from_slice(b"> endsub\n");
        text
    })
}

/// The keyword of a line that begins with this label, `sub` or `endsub`.
fn keyword(line: &[u8], label: &[u8]) -> Option<&'static [u8]> {
    let mut bare: Vec<u8> = line
        .iter()
        .filter(|byte| !byte.is_ascii_whitespace())
        .map(u8::to_ascii_lowercase)
        .collect();
    if bare.first() == Some(&b'n') {
        let digits =
            bare.iter().skip(1).take_while(|byte| byte.is_ascii_digit() || **byte == b'.').count();
        bare.drain(..=digits);
    }
    let rest = bare.strip_prefix(b"o")?;
    let rest = match rest.strip_prefix(b"<") {
        Some(rest) => rest.strip_prefix(label)?.strip_prefix(b">")?,
        None => rest.strip_prefix(label)?,
    };
    let keywords: [&[u8]; 2] = [b"sub", b"endsub"];
    keywords.into_iter().find(|keyword| rest.starts_with(keyword))
}

impl Source for Files {
    fn text(&mut self) -> Result<&[u8], SourceError> {
        let (text, at) = match self.open.last() {
            Some((text, at)) => (text, *at),
            None => (&self.main, self.at),
        };
        Ok(text.get(at..).unwrap_or(&[]))
    }

    fn consume(&mut self, bytes: usize) {
        match self.open.last_mut() {
            Some((_, at)) => *at += bytes,
            None => self.at += bytes,
        }
    }

    fn rewind(&mut self, offset: u64) -> Result<bool, SourceError> {
        let at = usize::try_from(offset).unwrap_or(usize::MAX);
        match self.open.last_mut() {
            Some((_, place)) => *place = at,
            None => self.at = at,
        }
        Ok(true)
    }

    fn open(&mut self, name: &str) -> Result<bool, SourceError> {
        if let Some(bytes) = defined_later(&self.main, name) {
            self.open_text(name, bytes);
            return Ok(true);
        }
        for folder in &self.folders {
            let path = folder.join(name);
            if !path.is_file() {
                continue;
            }
            let bytes = std::fs::read(&path).map_err(|error| SourceError {
                file: name.to_owned(),
                message: error.to_string(),
            })?;
            self.open_text(name, bytes);
            return Ok(true);
        }
        Ok(false)
    }

    fn close(&mut self) {
        self.open.pop();
    }
}
