//! A device that answers as a transcript says.

use super::Device;

/// A transcript: `>` before what the adapter sends, `<` before what it receives, `#` before remarks.
///
/// `^X` is a soft reset. What the adapter sends has to be what is written next; anything else, and anything after the
/// end, closes the connection.
#[derive(Debug)]
pub(crate) struct Transcript {
    lines: Vec<String>,
    next: usize,
    line: String,
}

impl Transcript {
    pub(crate) fn new(text: &str) -> Self {
        let lines = text.lines().filter(|line| !line.trim().is_empty() && !line.starts_with('#'));
        Self { lines: lines.map(str::to_owned).collect(), next: 0, line: String::new() }
    }

    fn answer(&mut self, sent: &str) -> String {
        let expected = self.lines.get(self.next).map(String::as_str).unwrap_or("the end");
        let is_next = expected.strip_prefix('>').is_some_and(|line| line.trim_start() == sent);
        // The thread that serves the terminal ends, and the adapter finds the connection closed.
        assert!(is_next, "sent {sent:?}, but the transcript has {expected:?}");
        self.next += 1;
        let answers = self.lines[self.next..].iter().take_while(|line| line.starts_with('<'));
        let answers: Vec<String> =
            answers.map(|line| format!("{}\r\n", line[1..].trim_start())).collect();
        self.next += answers.len();
        answers.concat()
    }
}

impl Device for Transcript {
    fn connected(&mut self) -> Vec<u8> {
        Vec::new()
    }

    fn receive(&mut self, bytes: &[u8]) -> Vec<u8> {
        let mut text = String::new();
        for byte in bytes {
            match byte {
                0x18 => text.push_str(&self.answer("^X")),
                b'?' => text.push_str(&self.answer("?")),
                b'\n' => {
                    let line = std::mem::take(&mut self.line);
                    text.push_str(&self.answer(&line));
                }
                byte => self.line.push(char::from(*byte)),
            }
        }
        text.into_bytes()
    }
}
