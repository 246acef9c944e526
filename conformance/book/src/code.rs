//! A code such as M73: the rules, choices and quirks that concern it.

use std::cmp::Ordering;

use gaugeblock_suite::{ChoiceKind, Source, Suite};

/// A G or M code, such as M73 or G5.2.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Code {
    letter: char,
    number: String,
}

impl Ord for Code {
    /// G before M, then by number.
    fn cmp(&self, other: &Self) -> Ordering {
        let number = |code: &Self| code.number.parse().unwrap_or(f64::INFINITY);
        let by_number = || number(self).total_cmp(&number(other));
        let by_text = || self.number.cmp(&other.number);
        self.letter.cmp(&other.letter).then_with(by_number).then_with(by_text)
    }
}

impl PartialOrd for Code {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl std::fmt::Display for Code {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}{}", self.letter, self.number)
    }
}

impl Code {
    /// The code that `text` names, with its leading zeros removed.
    pub fn read(text: &str) -> Option<Self> {
        let mut rest = text.chars();
        let letter = rest.next()?.to_ascii_uppercase();
        let number = rest.as_str();
        let is_number = number.starts_with(|c: char| c.is_ascii_digit())
            && number.chars().all(|c| c.is_ascii_digit() || c == '.');
        (matches!(letter, 'G' | 'M') && is_number)
            .then(|| Self { letter, number: without_leading_zeros(number) })
    }

    /// The code that a word of a title names: in capitals, as documents write it.
    pub(super) fn in_title(word: &str) -> Option<Self> {
        let word = word.trim_end_matches('.');
        word.starts_with(['G', 'M']).then(|| Self::read(word)).flatten()
    }

    /// Whether a title such as `M2, M30 Program End` or `M62 - M65 Digital Output Control` names the code.
    pub(super) fn is_in_title(&self, title: &str) -> bool {
        let ranges = title.replace(" - ", "-").replace(" to ", "-");
        ranges.split(|c: char| !c.is_ascii_alphanumeric() && c != '.' && c != '-').any(|word| {
            match word.split_once('-') {
                Some((first, last)) => self.is_between(first, last),
                None => word == self.to_string(),
            }
        })
    }

    /// Whether the code is in a range of codes, such as G54 to G59.3.
    fn is_between(&self, first: &str, last: &str) -> bool {
        let number = |text: &str| text.strip_prefix(self.letter)?.parse::<f64>().ok();
        let own = self.number.parse::<f64>().ok();
        match (number(first), own, number(last)) {
            (Some(first), Some(own), Some(last)) => first <= own && own <= last,
            _ => false,
        }
    }

    /// Whether a program has the code, comments left out.
    fn is_in_program(&self, program: &str) -> bool {
        program.lines().any(|line| {
            let mut rest = without_comments(line);
            rest.retain(|c| !c.is_ascii_whitespace());
            let text = rest.to_ascii_uppercase();
            let starts = text.match_indices(self.letter).map(|(at, _)| at + 1);
            starts.into_iter().any(|at| {
                let digits = text[at..].chars().take_while(|c| c.is_ascii_digit() || *c == '.');
                let number: String = digits.collect();
                !number.is_empty() && without_leading_zeros(&number) == self.number
            })
        })
    }
}

fn without_leading_zeros(number: &str) -> String {
    let trimmed = number.trim_start_matches('0');
    let zero = trimmed.is_empty() || trimmed.starts_with('.');
    if zero { format!("0{trimmed}") } else { trimmed.to_owned() }
}

fn without_comments(line: &str) -> String {
    let mut depth = 0_u32;
    let code = line.split(';').next().unwrap_or_default().chars();
    code.filter(|c| {
        if *c == '(' {
            depth += 1;
        }
        let outside = depth == 0;
        if *c == ')' {
            depth = depth.saturating_sub(1);
        }
        outside
    })
    .collect()
}

/// What concerns a code: by the title of a section that is a source, or by a program that has the code.
#[derive(Debug)]
pub struct Explanation<'a> {
    /// Id and sentence of each rule from a section of the code.
    pub documented: Vec<(&'a str, &'a str)>,
    /// Ids of the rules whose programs have the code, without those above.
    pub used: Vec<&'a str>,
    /// The choices and quirks.
    pub choices: Vec<CodeChoice<'a>>,
}

/// A choice or quirk that concerns a code.
#[derive(Debug)]
pub struct CodeChoice<'a> {
    /// Its id.
    pub id: &'a str,
    /// Choice or quirk.
    pub kind: ChoiceKind,
    /// What is chosen.
    pub sentence: &'a str,
    /// Whether a source is a section of the code. Without that, its program has the code.
    pub is_documented: bool,
}

impl<'a> Explanation<'a> {
    /// What concerns `code`. Time is linear in the size of the suite.
    pub fn of(code: &Code, suite: &'a Suite) -> Self {
        let by_title =
            |sources: &[Source]| sources.iter().any(|source| code.is_in_title(&source.section));
        let (mut documented, mut used) = (Vec::new(), Vec::new());
        for rule in &suite.rules {
            let programs = rule.cases.iter().map(|case| &case.program);
            let mut programs = programs.chain(rule.motion.iter().map(|case| &case.program));
            if by_title(&rule.sources) {
                documented.push((rule.id.as_str(), rule.sentence.as_str()));
            } else if programs.any(|program| code.is_in_program(program)) {
                used.push(rule.id.as_str());
            }
        }
        let of_programs = suite.choices.iter().map(|choice| {
            (choice.id.as_str(), choice.kind, &choice.sentence, &choice.sources, &choice.program)
        });
        let of_motion = suite.motion_choices.iter().map(|choice| {
            let kind = ChoiceKind::Choice;
            (choice.id.as_str(), kind, &choice.sentence, &choice.sources, &choice.motion.program)
        });
        let choices =
            of_programs.chain(of_motion).filter_map(|(id, kind, sentence, sources, program)| {
                let is_documented = by_title(sources);
                (is_documented || code.is_in_program(program)).then_some(CodeChoice {
                    id,
                    kind,
                    sentence,
                    is_documented,
                })
            });
        Self { documented, used, choices: choices.collect() }
    }

    /// Whether nothing concerns the code.
    pub fn is_empty(&self) -> bool {
        self.documented.is_empty() && self.used.is_empty() && self.choices.is_empty()
    }

    /// Whether no section of a document that a rule or choice cites is about the code.
    pub fn is_undocumented(&self) -> bool {
        self.documented.is_empty() && !self.choices.iter().any(|choice| choice.is_documented)
    }

    /// The first rules, choices and quirks whose programs have the code.
    pub fn users(&self) -> String {
        let choices = self.choices.iter().map(|choice| choice.id);
        let users: Vec<_> = self.used.iter().copied().chain(choices).take(3).collect();
        users.join(", ")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_code_is_found_with_leading_zeros_blanks_and_either_case() {
        let code = Code::read("m2").expect("a code");
        for program in ["M2", "g0 x1 m02", "m 2", "x1 m2 (m3)"] {
            assert!(code.is_in_program(program), "{program}");
        }
        for program in ["m20", "m2.1", "(m2)", "g2", "; m2", "g1 x2"] {
            assert!(!code.is_in_program(program), "{program}");
        }
    }

    #[test]
    fn a_title_names_whole_codes() {
        let code = Code::read("M3").expect("a code");
        assert!(code.is_in_title("11.6.4 M3, M4, M5 Spindle Control"));
        assert!(!code.is_in_title("M30 Program End"));
    }

    #[test]
    fn a_title_with_a_range_names_the_codes_within() {
        for (code, title) in [
            ("M63", "11.6.15 M62 - M65 Digital Output Control"),
            ("M64", "M62 to M65 Output Control"),
            ("M101", "11.6.24 M100-M199 User Defined Commands"),
            ("G59.3", "11.5.34 G54-G59.3 Select Coordinate System"),
        ] {
            assert!(Code::read(code).expect("a code").is_in_title(title), "{code}: {title}");
        }
        let code = Code::read("M66").expect("a code");
        assert!(!code.is_in_title("11.6.15 M62 - M65 Digital Output Control"));
        assert!(!code.is_in_title("11.5.48 G84 Right-hand Tapping Cycle, Dwell"));
    }

    #[test]
    fn an_id_is_not_a_code() {
        for subject in ["saved-state", "gpp.text", "M", "Mx", "X1"] {
            assert!(Code::read(subject).is_none(), "{subject}");
        }
    }
}
