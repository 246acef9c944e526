//! What the text of a block may do to the machine. The controller decides what a block means; this only finds what must
//! not be sent, and what cannot be observed.

use gaugeblock_vocabulary::FeedMode;

/// Characters that a controller picks out of the stream, also in comments, and obeys at once.
const REAL_TIME: [char; 3] = ['?', '!', '~'];

/// The modal groups of motion, non-modal codes and tool length: at most one code of each in a block. In tenths.
const GROUPS: [&[i32]; 3] = [
    &[0, 10, 20, 30, 382, 383, 384, 385, 800],
    &[40, 100, 280, 281, 300, 301, 530, 920, 921],
    &[431, 490],
];

/// From here on a controller that calculates in single precision leaves digits out.
const SINGLE_EXACT: f64 = 16_777_216.0;

/// Largest difference, in tenths, of a number that a controller may round to a code.
const CODE_TOLERANCE: f64 = 0.1;

/// The words of a block.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Words {
    /// Letters in upper case with their numbers, in order.
    words: Vec<(char, f64)>,
    /// Whether something else is in the block: a parameter, an expression, a bad number.
    pub(crate) has_more: bool,
    /// Whether the number of a G word is something else, or too long to be exact: the block can be any code.
    pub(crate) has_computed_code: bool,
}

impl Words {
    /// Reads a block without its comments.
    pub(crate) fn of(line: &str) -> Self {
        let text = condense(line);
        let mut rest = text.strip_prefix('/').unwrap_or(&text);
        let mut read = Self::default();
        while let Some(letter) = rest.chars().next() {
            rest = &rest[letter.len_utf8()..];
            let end = rest
                .find(|c: char| !(c.is_ascii_digit() || "+-.".contains(c)))
                .unwrap_or(rest.len());
            match rest[..end].parse::<f64>() {
                Ok(number) if letter.is_ascii_uppercase() => {
                    read.has_computed_code |= letter == 'G' && number.abs() >= SINGLE_EXACT;
                    read.words.push((letter, number));
                }
                _ => {
                    read.has_more = true;
                    read.has_computed_code |= letter == 'G';
                }
            }
            rest = &rest[end..];
        }
        read
    }

    /// Whether the line has only comments and blanks, so that it is not a block.
    pub(crate) fn is_empty(&self) -> bool {
        self.words.is_empty() && !self.has_more
    }

    /// The numbers of a letter.
    pub(crate) fn numbers(&self, letter: char) -> impl Iterator<Item = f64> {
        self.words.iter().filter(move |(word, _)| *word == letter).map(|(_, number)| *number)
    }

    /// Whether the block has one of these codes of a letter, in tenths: 281 for G28.1.
    pub(crate) fn has(&self, letter: char, codes: &[i32]) -> bool {
        self.numbers(letter).any(|number| {
            let tenths = number * 10.0;
            codes.iter().any(|code| (tenths - f64::from(*code)).abs() < CODE_TOLERANCE)
        })
    }

    /// Whether it writes a coordinate system into the EEPROM (G10), by the interface document. A controller may keep
    /// eight bits of a number: G65546 is G10 then.
    pub(crate) fn writes_coordinate_system(&self) -> bool {
        self.has_folded('G', &[100])
    }

    /// Whether it writes a reference point into the EEPROM (G28.1, G30.1), by the interface document.
    pub(crate) fn writes_reference_point(&self) -> bool {
        self.has_folded('G', &[281, 301])
    }

    /// Whether it sets or cancels the G92 offset, which some controllers store.
    pub(crate) fn changes_local_offset(&self) -> bool {
        self.has_folded('G', &[920, 921, 922, 923])
    }

    /// Whether it sets or cancels the tool length offset, which some controllers keep over a reset.
    pub(crate) fn changes_tool_offset(&self) -> bool {
        self.has_folded('G', &[430, 431, 432, 490])
    }

    /// Whether it can pause the program: M0, M60, or an M number too long to be exact.
    pub(crate) fn may_pause(&self) -> bool {
        let is_inexact = |number: f64| number.abs() >= SINGLE_EXACT;
        self.has_folded('M', &[0, 600]) || self.numbers('M').any(is_inexact)
    }

    /// Whether it has one of these codes of a letter, in tenths, in the last eight bits of a number.
    fn has_folded(&self, letter: char, codes: &[i32]) -> bool {
        let folded = self.numbers(letter).map(|number| (letter, number % 256.0));
        let folded = Self { words: folded.collect(), ..Self::default() };
        folded.has(letter, codes)
    }

    /// Whether it can change an offset, or the unit in which offsets are known.
    pub(crate) fn may_change_offsets(&self) -> bool {
        const CODES: [i32; 26] = [
            70, 80, 100, 200, 210, 280, 281, 300, 301, 430, 431, 432, 490, 540, 550, 560, 570, 580,
            590, 591, 592, 593, 920, 921, 922, 923,
        ];
        self.has_more || self.has('G', &CODES) || self.has('M', &[20, 60, 300, 610])
    }

    /// Whether a letter other than G and M comes twice.
    pub(crate) fn repeats_a_letter(&self) -> bool {
        let letters = self.words.iter().map(|(letter, _)| *letter);
        let mut letters: Vec<char> = letters.filter(|letter| !"GM".contains(*letter)).collect();
        letters.sort_unstable();
        letters.windows(2).any(|two| two[0] == two[1])
    }

    /// Whether two of its codes are of one group, or one is repeated.
    pub(crate) fn has_two_of_a_group(&self) -> bool {
        let of = |group: &[i32]| {
            let is_one = |number: &f64| {
                group.iter().any(|code| (number * 10.0 - f64::from(*code)).abs() < CODE_TOLERANCE)
            };
            self.numbers('G').filter(is_one).count()
        };
        GROUPS.iter().any(|group| of(group) > 1)
    }

    /// Whether a G or M word has a number with a fraction.
    pub(crate) fn has_code_with_decimals(&self) -> bool {
        let mut codes = self.numbers('G').chain(self.numbers('M'));
        codes.any(|number| number.fract().abs() > 0.0)
    }

    /// Whether it runs in inverse time: by its own code, or by the mode before it.
    pub(crate) fn is_in_inverse_time(&self, before: Option<FeedMode>) -> bool {
        let own = [(930, true), (940, false)].into_iter().find(|(code, _)| self.has('G', &[*code]));
        own.map_or(before == Some(FeedMode::InverseTime), |(_, is_inverse)| is_inverse)
    }

    /// Seconds for which the block may wait: P of G4.
    pub(crate) fn dwell_seconds(&self) -> f64 {
        if self.has('G', &[40]) { self.numbers('P').fold(0.0, f64::max) } else { 0.0 }
    }
}

/// The block without comments and blanks, in upper case, as a controller of the family reads it.
fn condense(line: &str) -> String {
    let mut text = String::new();
    let mut in_comment = false;
    for c in line.chars() {
        match c {
            '(' => in_comment = true,
            ')' => in_comment = false,
            ';' if !in_comment => break,
            _ if in_comment || c.is_whitespace() => {}
            _ => text.push(c.to_ascii_uppercase()),
        }
    }
    text
}

/// Whether a line is blank.
pub(crate) fn is_blank(line: &str) -> bool {
    line.trim().is_empty()
}

/// Why a line must not be sent.
///
/// # Errors
/// It has a real-time command, or is a system command.
pub(crate) fn check_sendable(line: &str) -> Result<(), String> {
    let is_text = |c: char| c == '\t' || c.is_ascii() && !c.is_ascii_control();
    if let Some(c) = line.chars().find(|c| !is_text(*c)) {
        return Err(format!(
            "the character {} is or contains a real-time command",
            c.escape_unicode()
        ));
    }
    if let Some(c) = line.chars().find(|c| REAL_TIME.contains(c)) {
        return Err(format!("the character `{c}` is a real-time command"));
    }
    // A system command may follow what a controller leaves out.
    let rest = condense(line);
    if rest.trim_start_matches(['/', '%']).starts_with('$') {
        return Err("a line that begins with `$` is a system command".to_owned());
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_are_read_without_comments_and_blanks() {
        let words = Words::of("/ n5 g1 (f9) x1 . 5 f-20.25 ; s3");
        assert_eq!(words.words, [('N', 5.0), ('G', 1.0), ('X', 1.5), ('F', -20.25)]);
        assert!(!words.has_more);
        assert!(Words::of("g1 x#5").has_more && Words::of("g1 x[5]").has_more);
        assert_eq!(Words::of("(x)"), Words::default());
    }

    #[test]
    fn blocks_that_write_the_eeprom_are_found() {
        assert!(Words::of("G10L2P1X0").writes_coordinate_system());
        assert!(Words::of("g1 0 l20 p1 x0").writes_coordinate_system());
        assert!(!Words::of("g1 x10").writes_coordinate_system());
        for line in ["g28.1", "g 30 .1", "g28.104"] {
            assert!(Words::of(line).writes_reference_point(), "{line}");
        }
        assert!(!Words::of("g28").writes_reference_point());
        assert!(Words::of("g[10] l2 p1 x0").has_computed_code);
        assert!(Words::of("g65546 l2 p1 x0").writes_coordinate_system());
        assert!(Words::of("g266 l2 p1 x0").writes_coordinate_system());
        assert!(Words::of("g16412.1").writes_reference_point());
        assert!(Words::of("g4294967306 l2 p1 x0").has_computed_code);
        assert!(!Words::of("g0 x[10]").has_computed_code);
    }

    #[test]
    fn codes_of_the_tool_offset_are_found() {
        for line in ["g43.1 z1", "g43 h1", "g0 x1 g49", "g305"] {
            assert!(Words::of(line).changes_tool_offset(), "{line}");
        }
        assert!(!Words::of("g4 p0").changes_tool_offset());
    }

    #[test]
    fn codes_that_can_pause_are_found() {
        for line in ["m0", "g1 x1 m60", "m256", "m4294967298"] {
            assert!(Words::of(line).may_pause(), "{line}");
        }
        assert!(!Words::of("m1 m3").may_pause() && !Words::of("m30").may_pause());
    }

    #[test]
    fn wait_of_a_dwell_is_found() {
        assert!((Words::of("g4 p2.5").dwell_seconds() - 2.5).abs() < 1e-12);
        assert!(Words::of("g10 l2 p2").dwell_seconds() < 1e-12);
    }

    #[test]
    fn nothing_is_sent_that_acts_besides_the_program() {
        for line in [
            "g0 x1 (really?)",
            "(stop!)",
            "~",
            "\u{18}",
            "g0\u{84}",
            "(µ)",
            "$H",
            " $ H",
            "(x)$h",
            "/$H",
            "%$H",
            "$J=x1",
        ] {
            assert!(check_sendable(line).is_err(), "{line:?}");
        }
        for line in ["g0 x1 (a comment, $1)", "m3 $0", "%", "", "\tg0"] {
            assert_eq!(check_sendable(line), Ok(()), "{line:?}");
        }
    }
}
