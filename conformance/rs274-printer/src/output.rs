//! Numbered lines of output, gathered and written in large pieces.

use std::io::{self, Write};

use super::late::Late;

/// How much is gathered before it is written.
const PIECE: usize = 1 << 16;

/// Where calls are written.
pub(super) struct Output {
    sink: Box<dyn Write>,
    buffer: Vec<u8>,
    /// Number of the last line.
    line: u64,
    /// The text between the number and the call: the block's number.
    label: Vec<u8>,
    /// Calls that wait for the end of a compensated move.
    late: Late,
    /// The first error of writing; nothing is written after it.
    failed: Option<io::Error>,
}

impl std::fmt::Debug for Output {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Output").field("line", &self.line).finish_non_exhaustive()
    }
}

impl Output {
    /// Nothing is written yet.
    pub(super) fn new(sink: Box<dyn Write>) -> Self {
        let buffer = Vec::with_capacity(2 * PIECE);
        let mut output =
            Self { sink, buffer, line: 0, label: Vec::new(), late: Late::default(), failed: None };
        output.label(None);
        output
    }

    /// The number of the block whose calls come next.
    pub(super) fn label(&mut self, number: Option<&[u8]>) {
        self.label.clear();
        self.label.push(b'N');
        self.label.extend_from_slice(number.unwrap_or(b"....."));
        while self.label.len() < 7 {
            self.label.push(b' ');
        }
    }

    /// What waits.
    pub(super) fn late(&mut self) -> &mut Late {
        &mut self.late
    }

    /// Prints the calls that have waited for a move, up to the next one that still waits. The move itself comes first:
    /// `print` prints it.
    pub(super) fn put_out(&mut self, place: u64, print: impl FnOnce(&mut Self)) {
        let waits = std::mem::take(&mut self.late.waits);
        self.late.pass(place);
        print(self);
        while let Some(call) = self.late.next_call() {
            self.begin("").bytes(&call).end();
        }
        self.late.waits = waits;
    }

    /// Begins a line: its number, the block's number, and the name of the call.
    pub(super) fn begin(&mut self, name: &str) -> &mut Self {
        if self.late.takes() {
            return self.text(name);
        }
        if self.buffer.len() >= PIECE {
            self.write_buffer();
        }
        self.line += 1;
        let mut digits = [b' '; 20];
        let mut at = digits.len();
        let mut rest = self.line;
        while rest > 0 {
            at -= 1;
            digits[at] = b'0' + u8::try_from(rest % 10).unwrap_or(0);
            rest /= 10;
        }
        self.buffer.extend_from_slice(&digits[at.min(digits.len() - 5)..]);
        self.buffer.push(b' ');
        self.buffer.extend_from_slice(&self.label);
        self.buffer.extend_from_slice(name.as_bytes());
        self
    }

    /// Adds characters.
    pub(super) fn text(&mut self, text: &str) -> &mut Self {
        self.bytes(text.as_bytes())
    }

    /// Adds bytes as they are.
    pub(super) fn bytes(&mut self, bytes: &[u8]) -> &mut Self {
        self.target().extend_from_slice(bytes);
        self
    }

    /// Where characters go.
    fn target(&mut self) -> &mut Vec<u8> {
        if self.late.takes() { self.late.call() } else { &mut self.buffer }
    }

    /// Adds an integer.
    pub(super) fn integer(&mut self, number: i64) -> &mut Self {
        // Writing into memory cannot fail.
        let _done = write!(self.target(), "{number}");
        self
    }

    /// Adds a number with four decimals.
    pub(super) fn number(&mut self, value: f64) -> &mut Self {
        let target = self.target();
        if !fixed(target, value) {
            let _done = write!(target, "{value:.4}");
        }
        self
    }

    /// Adds a number with six decimals.
    pub(super) fn six(&mut self, value: f64) -> &mut Self {
        let _done = write!(self.target(), "{value:.6}");
        self
    }

    /// Adds numbers with something between them.
    pub(super) fn numbers(&mut self, values: &[f64], between: &str) -> &mut Self {
        for (place, value) in values.iter().enumerate() {
            if place > 0 {
                self.text(between);
            }
            self.number(*value);
        }
        self
    }

    /// Ends a line.
    pub(super) fn end(&mut self) {
        if self.late.takes() {
            self.late.end_call();
            return;
        }
        self.buffer.push(b'\n');
    }

    /// Writes what was gathered.
    pub(super) fn flush(&mut self) {
        self.write_buffer();
        let flushed = self.sink.flush();
        self.keep(flushed);
    }

    /// Why not all was written, if so; a closed reader is not an error.
    pub(super) fn failure(&mut self) -> Option<io::Error> {
        self.failed.take().filter(|error| error.kind() != io::ErrorKind::BrokenPipe)
    }

    fn write_buffer(&mut self) {
        if self.failed.is_none() {
            let written = self.sink.write_all(&self.buffer);
            self.keep(written);
        }
        self.buffer.clear();
    }

    fn keep(&mut self, done: io::Result<()>) {
        if let Err(error) = done {
            self.failed.get_or_insert(error);
        }
    }
}

/// Writes a number with four decimals where that is simple: it is not large, and does not lie near the middle between
/// two.
fn fixed(buffer: &mut Vec<u8>, value: f64) -> bool {
    let scaled = value.abs() * 10_000.0;
    if scaled.is_nan() || scaled >= 1.0e12 {
        return false;
    }
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "below 1e12 and not negative"
    )]
    let mut whole = scaled as u64;
    #[expect(clippy::cast_precision_loss, reason = "below 1e12")]
    let rest = scaled - whole as f64;
    // The product is exact to less than 1e-3 here.
    if (rest - 0.5).abs() < 1.0e-2 {
        return false;
    }
    if rest > 0.5 {
        whole += 1;
    }
    let mut digits = [0_u8; 24];
    let mut at = digits.len();
    for place in 0.. {
        if place == 4 {
            at -= 1;
            digits[at] = b'.';
        }
        if place > 4 && whole == 0 {
            break;
        }
        at -= 1;
        digits[at] = b'0' + u8::try_from(whole % 10).unwrap_or(0);
        whole /= 10;
    }
    if value.is_sign_negative() {
        at -= 1;
        digits[at] = b'-';
    }
    buffer.extend_from_slice(&digits[at..]);
    true
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_short_way_writes_what_the_long_one_does() {
        let mut seed = 1_u64;
        for step in 0..200_000_u32 {
            seed = seed
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            #[expect(clippy::cast_precision_loss, reason = "any number will do")]
            let value = (seed >> 33) as f64 / f64::from(1 << (step % 31)) - 1000.0;
            let mut short = Vec::new();
            if fixed(&mut short, value) {
                assert_eq!(String::from_utf8_lossy(&short), format!("{value:.4}"));
            }
        }
        for value in [0.0, -0.0, 0.00005, -0.00004, 1.0, 9999.99995, 0.125, 1e11, f64::NAN, 1e30] {
            let mut short = Vec::new();
            if fixed(&mut short, value) {
                assert_eq!(String::from_utf8_lossy(&short), format!("{value:.4}"));
            }
        }
    }
}
