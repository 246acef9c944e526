//! The little that the adapter must know of a program's text: which lines can jump, end, or reach the host, and which
//! parameters are named.

use std::collections::BTreeSet;
use std::path::{Component, Path};

use gaugeblock_vocabulary::{BlockLocation, Program};

use super::host::{compact, reaches_host};

/// Highest parameter number that a parameter file may list.
pub(crate) const LAST_PARAMETER: u32 = 5601;

/// Switch that silences (DEBUG,…); on from the start.
pub(crate) const DEBUG_SWITCH: u32 = 5599;

/// A program as the controller gets it: file names and lines, the main program first.
#[derive(Clone, Debug)]
pub(crate) struct Source {
    files: Vec<(String, Vec<String>)>,
}

/// What kind of block a line holds, as far as it matters for observing it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Form {
    /// Only blanks and comments.
    Empty,
    /// A percent sign.
    Percent,
    /// An O-word, or M98: a call.
    Call,
    /// Any other O-word.
    Control,
    /// M99.
    Return,
    /// M2 or M30.
    End,
    /// Anything else.
    Other,
}

/// Whether a file of subs can have this name: a plain one, perhaps in the folder `elsewhere`, which is not looked into.
pub(crate) fn is_sub_file(name: &str) -> bool {
    let name = name.strip_prefix("elsewhere/").unwrap_or(name);
    let mut parts = Path::new(name).components();
    let plain = matches!((parts.next(), parts.next()), (Some(Component::Normal(_)), None));
    plain && !name.starts_with('.')
}

impl Source {
    /// The lines of all files.
    pub(crate) fn new(program: &Program) -> Self {
        let main = std::iter::once((Program::MAIN, &program.main));
        let subs = program.files.iter().map(|(name, text)| (name.as_str(), text));
        let files = main.chain(subs).map(|(name, text)| (name.to_owned(), lines(text))).collect();
        Self { files }
    }

    /// Names and lines of all files, the main program first.
    pub(crate) fn files(&self) -> &[(String, Vec<String>)] {
        &self.files
    }

    /// The text of a line, from 1; empty where there is none.
    pub(crate) fn line(&self, file: usize, line: u32) -> &str {
        let index = usize::try_from(line).ok().and_then(|line| line.checked_sub(1));
        let lines = self.files.get(file).map(|(_, lines)| lines);
        index.zip(lines).and_then(|(index, lines)| lines.get(index)).map_or("", String::as_str)
    }

    /// The block at a line.
    pub(crate) fn block(&self, file: usize, line: u32) -> BlockLocation {
        BlockLocation::new(self.files.get(file).map_or("", |(name, _)| name.as_str()), line)
    }

    /// The only line with this text, blanks at its ends aside.
    pub(crate) fn only_line(&self, text: &str) -> Option<(usize, u32)> {
        let mut found = self.all().filter(|(_, _, line)| line.trim() == text.trim());
        let first = found.next()?;
        found.next().is_none().then_some((first.0, first.1))
    }

    /// All lines with file and number.
    pub(crate) fn all(&self) -> impl Iterator<Item = (usize, u32, &str)> {
        self.files.iter().enumerate().flat_map(|(file, (_, lines))| {
            (1_u32..).zip(lines).map(move |(number, line)| (file, number, line.as_str()))
        })
    }

    /// Which parameters the text names.
    pub(crate) fn parameters(&self) -> Parameters {
        let mut parameters = Parameters::default();
        for (_, _, line) in self.all() {
            parameters.scan(&compact(line));
        }
        parameters
    }

    /// The first block that names one of these parameters, or one whose number is computed, and which.
    pub(crate) fn names_parameter(
        &self,
        wanted: impl Fn(u32) -> bool,
    ) -> Option<(BlockLocation, String)> {
        self.all().find_map(|(file, number, line)| {
            let mut named = Parameters::default();
            named.scan(&compact(line));
            let what = match named.numbered.iter().find(|number| wanted(**number)) {
                Some(wanted) => format!("#{wanted}"),
                None if named.indirect => "a computed number of a parameter".to_owned(),
                None => return None,
            };
            Some((self.block(file, number), what))
        })
    }

    /// The parameters that the parameter file must list to be seen at the end: all, where numbers are computed.
    pub(crate) fn listed(&self) -> BTreeSet<u32> {
        let parameters = self.parameters();
        if parameters.indirect {
            return (1..=LAST_PARAMETER).collect();
        }
        let named = parameters.numbered.into_iter();
        (1..=30)
            .chain([DEBUG_SWITCH])
            .chain(named.filter(|number| (1..=LAST_PARAMETER).contains(number)))
            .collect()
    }

    /// Whether the program reads line numbers, which checkpoints change.
    pub(crate) fn names_line(&self) -> bool {
        self.all().any(|(_, _, line)| compact(line).contains("#<_line>"))
    }

    /// The first block that moves and ends the program, where a compensated move may wait. The error that stops the
    /// program before it puts out what waits.
    pub(crate) fn end_of_compensated_path(&self) -> Option<BlockLocation> {
        let has = |line: &str, words: &[&str]| {
            let code = without_names(&code(line));
            words.iter().any(|word| code.contains(word))
        };
        let compensates = self.all().any(|(_, _, line)| has(line, &["g41", "g42"]));
        let mut ends = self.all().filter(|(_, _, line)| compensates && form(line) == Form::End);
        ends.find(|(_, _, line)| has(line, &["x", "y", "z"]))
            .map(|(file, number, _)| self.block(file, number))
    }

    /// The first block with M0 or M60, which would stop until someone resumes, and the number of the code; not a
    /// block that is refused for two such codes.
    pub(crate) fn pause(&self) -> Option<(BlockLocation, u32)> {
        self.all().find_map(|(file, number, line)| {
            let code = without_names(&code(line));
            let stops = m_codes(&code).filter(|code| [0, 1, 2, 30, 60].contains(code));
            match stops.collect::<Vec<_>>()[..] {
                [code @ (0 | 60)] => Some((self.block(file, number), code)),
                _ => None,
            }
        })
    }

    /// Whether a line has one of these codes, written plainly, such as `g38.2` or `m0`.
    pub(crate) fn has_code(&self, codes: &[&str]) -> bool {
        self.all().any(|(_, _, line)| has_code(line, codes))
    }

    /// Whether an axis word has a number of seven digits or more before its point.
    pub(crate) fn leaves_block_order(&self) -> bool {
        self.all().any(|(_, _, line)| {
            let code = without_names(&code(line));
            let far = |rest: &str| {
                let digits = rest.trim_start_matches(['+', '-', '0']);
                digits.chars().take_while(char::is_ascii_digit).count() >= 7
            };
            "xyzabcuvw".chars().any(|axis| code.split(axis).skip(1).any(far))
        })
    }

    /// Whether the value of a letter is computed somewhere: no plain number follows it.
    pub(crate) fn computes_word(&self, letter: char) -> bool {
        self.all().any(|(_, _, line)| {
            let code = without_names(&code(line));
            let computed = |rest: &str| {
                rest.trim_start_matches(['+', '-'])
                    .starts_with(['#', '[', 'a', 'c', 'e', 'r', 's', 't'])
            };
            !code.starts_with('o') && code.split(letter).skip(1).any(computed)
        })
    }

    /// Whether a block may switch cutter compensation on: one has its code, or a code that is computed.
    pub(crate) fn may_compensate(&self) -> bool {
        let compensates = |rest: &str| {
            let number = rest.trim_start_matches(['+', '0']);
            ["41", "42"].iter().any(|code| number.starts_with(code))
        };
        let has_code = |line: &str| without_names(&code(line)).split('g').skip(1).any(compensates);
        self.all().any(|(_, _, line)| has_code(line)) || self.computes_word('g')
    }

    /// Whether a HAL item is named, or the switch in the INI file for naming them, spelled in any way.
    pub(crate) fn names_hal(&self) -> bool {
        let names = |line: &str| ["_hal[", "hal_pin_vars"].iter().any(|name| line.contains(name));
        self.all().any(|(_, _, line)| line.contains(['h', 'H']) && names(&compact(line)))
    }

    /// A line with a message that ends within the name of a parameter: it prints whatever is in memory.
    pub(crate) fn shows_open_name(&self) -> Option<BlockLocation> {
        self.all()
            .find(|(_, _, line)| shows_open_name(line))
            .map(|(file, number, _)| self.block(file, number))
    }

    /// A line that would reach beyond the program's files: see [`reaches_host`].
    pub(crate) fn reaches_host(&self) -> Option<BlockLocation> {
        self.all()
            .find(|(_, _, line)| reaches_host(line))
            .map(|(file, number, _)| self.block(file, number))
    }
}

/// Whether a message ends within the name of a parameter: `(print,a#)`, `(debug,#<x)`.
fn shows_open_name(line: &str) -> bool {
    let Some((keyword, text)) = last_comment(line).and_then(|text| text.split_once(',')) else {
        return false;
    };
    let shows = ["debug", "print", "log", "abort"].contains(&compact(keyword).as_str());
    let open = text.rsplit_once("#<").is_some_and(|(_, name)| !name.contains('>'));
    shows && (open || text.ends_with('#'))
}

/// Whether a line has one of these codes, written plainly, such as `g38.2` or `m0`.
pub(crate) fn has_code(line: &str, codes: &[&str]) -> bool {
    let code = code(line);
    codes.iter().any(|wanted| {
        let behind = code.match_indices(wanted).map(|(at, _)| &code[at + wanted.len()..]);
        let ends = |rest: &str| !rest.starts_with(|c: char| c.is_ascii_digit() || c == '.');
        behind.into_iter().any(ends)
    })
}

/// Lines without their ends; text after the last line break counts if there is any.
fn lines(text: &str) -> Vec<String> {
    text.split_terminator('\n').map(|line| line.trim_end_matches('\r').to_owned()).collect()
}

/// A line without comments and blanks, in lower case.
pub(crate) fn code(line: &str) -> String {
    let mut code = String::new();
    let mut in_comment = false;
    for c in line.chars() {
        match c {
            ')' if in_comment => in_comment = false,
            _ if in_comment => {}
            '(' => in_comment = true,
            ';' => break,
            c if c.is_whitespace() => {}
            c => code.push(c.to_ascii_lowercase()),
        }
    }
    code
}

/// The text of the last comment in parentheses, if only blanks or a semicolon comment follow it.
pub(crate) fn last_comment(line: &str) -> Option<&str> {
    let start = line.rfind('(')?;
    let rest = &line[start + 1..];
    rest.find(')').map(|end| &rest[..end])
}

/// Whether a line begins with a slash, and would be skipped under block delete.
pub(crate) fn has_slash(line: &str) -> bool {
    line.trim_start().starts_with('/')
}

/// A line without the slash and the line number at its beginning.
pub(crate) fn without_number(line: &str) -> &str {
    let line = line.trim_start();
    let line = line.strip_prefix('/').unwrap_or(line).trim_start();
    let digit = |c: char| c.is_ascii_digit() || c == '.' || c.is_whitespace();
    line.strip_prefix(['n', 'N']).map_or(line, |rest| rest.trim_start_matches(digit))
}

/// What kind of block a line holds.
pub(crate) fn form(line: &str) -> Form {
    let code = code(line);
    let code = code.strip_prefix('/').unwrap_or(&code);
    let numbered = code.strip_prefix('n');
    let code = numbered
        .map_or(code, |rest| rest.trim_start_matches(|c: char| c.is_ascii_digit() || c == '.'));
    if code.is_empty() {
        let acts = numbered.is_some() || logs_probing(line);
        return if acts { Form::Other } else { Form::Empty };
    }
    if code.starts_with('%') {
        return Form::Percent;
    }
    if let Some(rest) = code.strip_prefix('o') {
        let command = if rest.starts_with('<') {
            rest.split_once('>').map_or("", |(_, rest)| rest)
        } else {
            rest
        };
        return if command.contains("call") { Form::Call } else { Form::Control };
    }
    let code = without_names(code);
    let has = |wanted: &[u32]| m_codes(&code).any(|code| wanted.contains(&code));
    if has(&[98]) {
        Form::Call
    } else if has(&[2, 30]) {
        Form::End
    } else if has(&[99]) {
        Form::Return
    } else {
        Form::Other
    }
}

/// Whether the line ends in (PROBEOPEN …) or (PROBECLOSE), which print no call.
fn logs_probing(line: &str) -> bool {
    let comment = last_comment(line).map(compact).unwrap_or_default();
    comment.starts_with("probeopen") || comment == "probeclose"
}

/// Whether a line opens or closes the file for probed points, where it does one of these.
pub(crate) fn opens_probe_log(line: &str) -> Option<bool> {
    logs_probing(line)
        .then(|| last_comment(line).map(compact).is_some_and(|text| text.starts_with("probeopen")))
}

/// The text without what is between `<` and `>`.
fn without_names(code: &str) -> String {
    let parts = code.split('<').enumerate();
    let outside = parts.map(|(index, part)| {
        if index == 0 { part } else { part.split_once('>').map_or("", |(_, rest)| rest) }
    });
    outside.collect()
}

/// The value of a word that is written as a plain number in a line's code ([`code`]).
pub(crate) fn plain_word(code: &str, letter: char) -> Option<f64> {
    let code = without_names(code);
    code.split(letter).skip(1).find_map(|rest| {
        let sign = usize::from(rest.starts_with(['+', '-']));
        let end = rest[sign..].find(|c: char| !c.is_ascii_digit() && c != '.');
        rest[..end.map_or(rest.len(), |end| sign + end)].parse().ok()
    })
}

/// Numbers that directly follow an M.
fn m_codes(code: &str) -> impl Iterator<Item = u32> {
    code.split('m').skip(1).filter_map(|rest| {
        let end = rest.find(|c: char| !c.is_ascii_digit()).unwrap_or(rest.len());
        rest[..end].parse().ok()
    })
}

/// Parameters that a program names.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Parameters {
    /// Numbers after a `#`.
    pub(crate) numbered: BTreeSet<u32>,
    /// Names between `#<` and `>`, in lower case without blanks.
    pub(crate) named: BTreeSet<String>,
    /// Those of the numbers to which something is assigned.
    pub(crate) set: BTreeSet<u32>,
    /// Whether a number is computed somewhere.
    pub(crate) indirect: bool,
}

impl Parameters {
    fn scan(&mut self, compact: &str) {
        for rest in compact.split('#').skip(1) {
            if let Some(rest) = rest.strip_prefix('<') {
                if let Some((name, _)) = rest.split_once('>') {
                    self.named.insert(name.to_owned());
                }
            } else {
                let end = rest.find(|c: char| !c.is_ascii_digit()).unwrap_or(rest.len());
                match rest[..end].parse() {
                    Ok(number) => {
                        self.numbered.insert(number);
                        if rest[end..].starts_with('=') {
                            self.set.insert(number);
                        }
                    }
                    Err(_) => self.indirect = true,
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn forms() {
        for (line, expected) in [
            ("", Form::Empty),
            ("  (only a comment) ; m2", Form::Empty),
            (" %", Form::Percent),
            ("o100 sub", Form::Control),
            ("N5 O100 CALL [1]", Form::Call),
            ("o<call> endsub", Form::Control),
            ("o [100] c a l l", Form::Call),
            ("/m98 p5", Form::Call),
            ("g0 x1 m99", Form::Return),
            ("m02", Form::End),
            ("m20 g1", Form::Other),
            ("n10", Form::Other),
            ("(PROBEOPEN points.txt)", Form::Other),
            ("#<m2> = 5", Form::Other),
        ] {
            assert_eq!(form(line), expected, "{line}");
        }
    }

    #[test]
    fn named_parameters_are_found() {
        let program =
            Program { main: "#1=#<_A b>\n#[31]=2 (print,#32)\n".to_owned(), ..Program::default() };
        let parameters = Source::new(&program).parameters();
        assert_eq!(parameters.numbered, BTreeSet::from([1, 32]));
        assert_eq!(parameters.set, BTreeSet::from([1]));
        assert_eq!(parameters.named, BTreeSet::from(["_ab".to_owned()]));
        assert!(parameters.indirect);
    }

    #[test]
    fn plain_words_are_found() {
        for (line, expected) in [
            ("g1 x1 f12.5", Some(12.5)),
            ("f-.5 x1", Some(-0.5)),
            ("g1 x fix[2] f3", Some(3.0)),
            ("g1 x1 (f3)", None),
            ("#<f3>=2", None),
            ("f[3]", None),
            ("f#3", None),
        ] {
            assert_eq!(plain_word(&code(line), 'f'), expected, "{line}");
        }
    }

    #[test]
    fn pauses_are_found() {
        for (line, expected) in [
            ("g0 x1 m0", Some(0)),
            ("M60", Some(60)),
            ("m00", Some(0)),
            ("m1", None),
            ("m0 m2", None),
        ] {
            let program = Program { main: format!("g0\n{line}\n"), ..Program::default() };
            let expected = expected.map(|code| (BlockLocation::new(Program::MAIN, 2), code));
            assert_eq!(Source::new(&program).pause(), expected, "{line}");
        }
    }

    #[test]
    fn g_codes_are_found() {
        let has = |line: &str| {
            let program = Program { main: format!("g0\n{line}\n"), ..Program::default() };
            Source::new(&program).has_code(&["g33", "g38.2"])
        };
        assert!(has("G33 z1 k1") && has("m3g38.2x1"));
        assert!(!has("g33.1 z1 k1") && !has("g3 x1") && !has("(g33)"));
    }

    #[test]
    fn messages_that_end_within_a_name_are_found() {
        for (line, expected) in [
            ("(print,a#)", true),
            ("g0 x1 (DEBUG, #<x)", true),
            ("(log,#<x> #<y)", true),
            ("(print,a# )", false),
            ("(print,#<x>)", false),
            ("(msg,a#)", false),
            ("(plain #)", false),
        ] {
            assert_eq!(shows_open_name(line), expected, "{line}");
        }
    }

    #[test]
    fn lines_that_reach_the_host_are_found() {
        let reaches = |line: &str| {
            let program = Program { main: format!("g0\n{line}\n"), ..Program::default() };
            Source::new(&program).reaches_host().is_some()
        };
        assert!(
            reaches("( P Y , x)")
                && reaches("g0 ;py,x")
                && reaches("o<../x> call")
                && reaches("o</etc/x> call")
        );
        assert!(!reaches("(copy) o1 if [6/3 gt 1]"));
    }
}
