//! A code such as M73: the rules, choices and quirks that concern it.

use std::fmt::Write as _;

use gaugeblock_suite::{ChoiceKind, Source, Suite};
use serde_json::json;

/// A G or M code, such as M73 or G5.2.
pub(super) struct Code {
    letter: char,
    number: String,
}

impl std::fmt::Display for Code {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}{}", self.letter, self.number)
    }
}

impl Code {
    /// The code that `text` names, with its leading zeros removed.
    pub(super) fn read(text: &str) -> Option<Self> {
        let mut rest = text.chars();
        let letter = rest.next()?.to_ascii_uppercase();
        let number = rest.as_str();
        let is_number = number.starts_with(|c: char| c.is_ascii_digit())
            && number.chars().all(|c| c.is_ascii_digit() || c == '.');
        (matches!(letter, 'G' | 'M') && is_number)
            .then(|| Self { letter, number: without_leading_zeros(number) })
    }

    /// Whether a title such as `M2, M30 Program End` or `M62 - M65 Digital Output Control` names the code.
    fn is_in_title(&self, title: &str) -> bool {
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
pub(super) struct Explanation<'a> {
    documented: Vec<(&'a str, &'a str)>,
    used: Vec<&'a str>,
    choices: Vec<CodeChoice<'a>>,
}

/// A choice or quirk that concerns a code.
struct CodeChoice<'a> {
    id: &'a str,
    kind: ChoiceKind,
    sentence: &'a str,
    /// Whether a source is a section of the code. Without that, its program has the code.
    is_documented: bool,
}

impl<'a> Explanation<'a> {
    pub(super) fn of(code: &Code, suite: &'a Suite) -> Self {
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

    pub(super) fn is_empty(&self) -> bool {
        self.documented.is_empty() && self.used.is_empty() && self.choices.is_empty()
    }

    /// Whether no section of a document that a rule or choice cites is about the code.
    pub(super) fn is_undocumented(&self) -> bool {
        self.documented.is_empty() && !self.choices.iter().any(|choice| choice.is_documented)
    }

    /// The first rules, choices and quirks whose programs have the code.
    pub(super) fn users(&self) -> String {
        let choices = self.choices.iter().map(|choice| choice.id);
        let users: Vec<_> = self.used.iter().copied().chain(choices).take(3).collect();
        users.join(", ")
    }

    pub(super) fn text(&self, code: &Code) -> String {
        let mut text = format!("{code}\n");
        if !self.documented.is_empty() {
            text.push_str("\nrules from the sections of this code:\n");
        }
        for (id, sentence) in &self.documented {
            let _infallible = writeln!(text, "  {id:<40} {sentence}");
        }
        let kinds = [
            (ChoiceKind::Choice, "choices: where documents differ or leave a question open"),
            (ChoiceKind::Quirk, "quirks: where a controller differs from its documents"),
        ];
        for (kind, title) in kinds {
            let is_listed = |choice: &&CodeChoice<'_>| choice.kind == kind && choice.is_documented;
            let of_kind: Vec<_> = self.choices.iter().filter(is_listed).collect();
            if !of_kind.is_empty() {
                let _infallible = writeln!(text, "\n{title}:");
            }
            for choice in of_kind {
                let _infallible = writeln!(text, "  {:<40} {}", choice.id, choice.sentence);
            }
        }
        let is_used_by = |kind: ChoiceKind| {
            let of_kind = self.choices.iter().filter(move |choice| choice.kind == kind);
            of_kind.filter(|choice| !choice.is_documented).map(|choice| choice.id)
        };
        let choices = is_used_by(ChoiceKind::Choice).collect();
        let quirks = is_used_by(ChoiceKind::Quirk).collect();
        for (one, many, ids) in [
            ("rule", "rules", &self.used),
            ("choice", "choices", &choices),
            ("quirk", "quirks", &quirks),
        ] {
            match ids.as_slice() {
                [] => {}
                [id] => {
                    let _infallible =
                        writeln!(text, "\n1 {one} about something else uses it in a program: {id}");
                }
                ids => {
                    let _infallible = writeln!(
                        text,
                        "\n{} {many} about something else use it in a program: {}",
                        ids.len(),
                        ids.join(", ")
                    );
                }
            }
        }
        text.push_str("\n`gaugeblock explain ID` prints one of them in full.\n");
        text
    }

    pub(super) fn document(&self, code: &Code) -> serde_json::Value {
        let rules: Vec<_> = self.documented.iter().map(|(id, _)| id).collect();
        let choices = self.choices.iter().map(|choice| {
            json!({ "id": choice.id, "kind": choice.kind, "documented": choice.is_documented })
        });
        json!({
            "gaugeblock": "explain", "code": code.to_string(), "rules": rules,
            "rules_that_use_it": self.used, "choices": choices.collect::<Vec<_>>(),
        })
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
