//! Reads lines of a source: in place where the source's text holds the whole line, else joined from its parts.

use alloc::vec::Vec;

use crate::source::{Source, SourceError};
use crate::syntax::LinePlace;

/// Most bytes that are kept of a line. A line has at most 256 characters; 257 characters of up to four bytes are enough
/// to refuse a longer one.
const KEPT_BYTES_MAX: usize = 4 * 257;

/// Reads lines and tracks its place in the file.
#[derive(Clone, Debug)]
pub(crate) struct Reader {
    /// Where the next line begins.
    place: LinePlace,
    /// The last line ended with a carriage return, at the end of the source's text. If the text continues with a line
    /// feed, it belongs to the end of that line.
    after_carriage_return: bool,
    /// A line that is joined from parts of the source's text.
    line: Vec<u8>,
}

impl Reader {
    /// At the beginning of a file.
    pub(crate) fn new() -> Self {
        Self {
            place: LinePlace { line: 1, offset: 0 },
            after_carriage_return: false,
            line: Vec::with_capacity(KEPT_BYTES_MAX),
        }
    }

    /// The next line has this number.
    pub(crate) fn begin_at(&mut self, line: u32) {
        self.place.line = line;
    }

    /// Where the next line begins, for [`Self::rewind`].
    ///
    /// After a carriage return whose line feed may still follow, this is the place of the carriage return. Read from
    /// there, carriage return and line feed are the end of one blank line, and the next line keeps its number.
    pub(crate) fn place(&self) -> LinePlace {
        let before = u32::from(self.after_carriage_return);
        LinePlace {
            line: self.place.line.saturating_sub(before),
            offset: self.place.offset.saturating_sub(u64::from(before)),
        }
    }

    /// The number of the next line.
    #[inline]
    pub(crate) fn line(&self) -> u32 {
        self.place.line
    }

    /// Whether the source's text begins with the next line, and not perhaps with a line feed of the last one.
    #[inline]
    pub(crate) fn is_aligned(&self) -> bool {
        !self.after_carriage_return
    }

    /// Moves past a line that was read from the source's text, its end included.
    #[inline]
    pub(crate) fn consume_line<S: Source>(&mut self, source: &mut S, bytes: usize) {
        self.consume(source, bytes);
        self.place.line = self.place.line.saturating_add(1);
    }

    /// Goes back to where a line began; false where the source cannot.
    pub(crate) fn rewind<S: Source>(
        &mut self,
        source: &mut S,
        place: LinePlace,
    ) -> Result<bool, SourceError> {
        let done = source.rewind(place.offset)?;
        if done {
            self.place = place;
            self.after_carriage_return = false;
        }
        Ok(done)
    }

    /// Passes the next line, without its end, to `take`; `None` at the end of the file.
    #[inline]
    pub(crate) fn next<S: Source, T>(
        &mut self,
        source: &mut S,
        take: impl FnOnce(&[u8], LinePlace) -> T,
    ) -> Result<Option<T>, SourceError> {
        if self.after_carriage_return {
            self.finish_line_end(source)?;
        }
        let text = source.text()?;
        let Some(length) = line_end(text) else { return self.read_split_line(source, take) };
        let line = text.get(..length).unwrap_or(text);
        let bytes = length.wrapping_add(match text.get(length..) {
            Some([b'\r', b'\n', ..]) => 2,
            Some([b'\r']) => {
                self.after_carriage_return = true;
                1
            }
            _ => 1,
        });
        let result = take(line, self.place);
        self.consume(source, bytes);
        self.place.line = self.place.line.saturating_add(1);
        Ok(Some(result))
    }

    /// Steps over a line feed that belongs to the carriage return before it.
    #[cold]
    fn finish_line_end<S: Source>(&mut self, source: &mut S) -> Result<(), SourceError> {
        self.after_carriage_return = false;
        if source.text()?.first() == Some(&b'\n') {
            self.consume(source, 1);
        }
        Ok(())
    }

    #[inline]
    fn consume<S: Source>(&mut self, source: &mut S, bytes: usize) {
        source.consume(bytes);
        self.place.offset = self.place.offset.saturating_add(u64::try_from(bytes).unwrap_or(0));
    }

    /// Reads a line whose end is not in the source's text yet. Of a line it keeps [`KEPT_BYTES_MAX`] bytes.
    #[cold]
    fn read_split_line<S: Source, T>(
        &mut self,
        source: &mut S,
        take: impl FnOnce(&[u8], LinePlace) -> T,
    ) -> Result<Option<T>, SourceError> {
        let began = self.place;
        self.line.clear();
        let mut any = false;
        loop {
            let text = source.text()?;
            if text.is_empty() {
                break;
            }
            any = true;
            let end = line_end(text);
            let length = end.unwrap_or(text.len());
            let room = KEPT_BYTES_MAX.saturating_sub(self.line.len()).min(length);
            self.line.extend_from_slice(text.get(..room).unwrap_or(&[]));
            let returned = text.get(length) == Some(&b'\r');
            self.consume(source, length.saturating_add(usize::from(end.is_some())));
            if end.is_some() {
                self.after_carriage_return = returned;
                break;
            }
        }
        if !any {
            return Ok(None);
        }
        let result = take(&self.line, began);
        self.place.line = self.place.line.saturating_add(1);
        Ok(Some(result))
    }
}

/// The place of the first carriage return or line feed.
#[inline]
fn line_end(text: &[u8]) -> Option<usize> {
    first_of([b'\n', b'\r'], text)
}

/// The place in a text of the first byte that is one of `bytes`. It compares eight bytes at a time: XOR makes a match a
/// zero byte, and `zero` sets the high bit of the first zero byte.
#[inline]
pub(super) fn first_of<const N: usize>(bytes: [u8; N], text: &[u8]) -> Option<usize> {
    const ONES: u64 = 0x0101_0101_0101_0101;
    const HIGHS: u64 = 0x8080_8080_8080_8080;
    let zero = |word: u64| word.wrapping_sub(ONES) & !word & HIGHS;
    let mut passed = 0_usize;
    let (eights, rest) = text.as_chunks::<8>();
    for eight in eights {
        let word = u64::from_le_bytes(*eight);
        let mut found = 0;
        for byte in bytes {
            found |= zero(word ^ ONES.wrapping_mul(u64::from(byte)));
        }
        if found != 0 {
            let byte = usize::try_from(found.trailing_zeros() >> 3).unwrap_or(0);
            return Some(passed.wrapping_add(byte));
        }
        passed = passed.wrapping_add(8);
    }
    let place = rest.iter().position(|byte| bytes.contains(byte))?;
    Some(passed.wrapping_add(place))
}
