//! `gaugeblock explain`: one rule, choice or quirk in full, or all of them that concern a code such as M73.

use std::fmt::Write as _;

use clap::Args;
use gaugeblock_suite::{Choice, ChoiceKind, Rule, Source, Suite};
use serde_json::json;

use crate::arguments::Format;
use crate::error::CliError;
use crate::streams::write_out;

const EXAMPLES: &str = "Examples:
  gaugeblock explain saved-state.feed                a rule: sentence, sources, programs, assertions
  gaugeblock explain saved-state.motion-mode         a choice with its options
  gaugeblock explain rs274.feed-zero-at-end          a quirk of a controller
  gaugeblock explain M73                             the rules, choices and quirks of a code

Exit status: 0 found; 2 unknown id or code.";

#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Arguments {
    /// Id of a rule, a choice or a quirk, or a code such as M73 or G5.2
    #[arg(value_name = "ID|CODE")]
    subject: String,
    /// Output format
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
}

pub(crate) fn explain(arguments: &Arguments, suite: &Suite) -> Result<u8, CliError> {
    let Arguments { subject, format } = arguments;
    let rule = suite.rules.iter().find(|rule| rule.id == *subject);
    let choice = suite.choices.iter().find(|choice| choice.id == *subject);
    let (text, document) = match (rule, choice, Code::read(subject)) {
        (None, None, None) => return Err(unknown(subject, suite)),
        (None, None, Some(code)) => {
            let about = Explanation::of(&code, suite);
            if about.is_empty() {
                return Err(CliError::usage(
                    format!("no rule concerns {code}"),
                    "`gaugeblock rules` lists all rules",
                ));
            }
            (about.text(&code), about.document(&code))
        }
        (rule, choice, _) => {
            let (mut text, mut document) = (String::new(), json!({ "gaugeblock": "explain" }));
            if let Some(rule) = rule {
                text.push_str(&rule_text(rule));
                document["rule"] = json!({
                    "id": rule.id, "sentence": rule.sentence, "sources": rule.sources,
                    "outcomes": rule.outcomes, "options": rule.options,
                    "cases": rule.case_names().collect::<Vec<_>>(),
                });
            }
            if let Some(choice) = choice {
                text.push_str(&choice_text(choice));
                document["choice"] = json!({
                    "id": choice.id, "kind": choice.kind, "sentence": choice.sentence,
                    "sources": choice.sources,
                    "options": choice.options.iter()
                        .map(|option| json!({ "option": option.name, "means": option.means }))
                        .collect::<Vec<_>>(),
                });
            }
            (text, document)
        }
    };
    match format {
        Format::Text => write_out(&text),
        Format::Json => write_out(&format!("{document:#}\n")),
    }
    Ok(0)
}

/// An error that lists the ids that are nearest to an unknown one.
fn unknown(subject: &str, suite: &Suite) -> CliError {
    let rules = suite.rules.iter().map(|rule| rule.id.as_str());
    let ids = rules.chain(suite.choices.iter().map(|choice| choice.id.as_str()));
    let mut near: Vec<(usize, &str)> = ids
        .filter_map(|id| {
            let distance = strsim::damerau_levenshtein(id, subject);
            (distance <= 4 || id.starts_with(subject)).then_some((distance, id))
        })
        .collect();
    near.sort_unstable();
    let near: Vec<&str> = near.into_iter().take(5).map(|(_, id)| id).collect();
    let hint = if near.is_empty() {
        "`gaugeblock rules` and `gaugeblock choices` list all ids".to_owned()
    } else {
        format!("did you mean `{}`?", near.join("`, `"))
    };
    CliError::usage(format!("unknown rule, choice, quirk or code `{subject}`"), hint)
}

fn rule_text(rule: &Rule) -> String {
    let mut text = format!("{}\n  {}\n", rule.id, rule.sentence);
    text.push_str(&sources_text(&rule.sources));
    if !rule.options.is_empty() {
        let _infallible = writeln!(text, "  depends on {}", rule.options.join(", "));
    }
    for case in &rule.cases {
        let _infallible = writeln!(text, "\n  case \"{}\"", case.name);
        for (at, line) in rule.language.lines(&case.program).enumerate() {
            let _infallible = writeln!(text, "    {:>4} | {line}", at + 1);
        }
        for assertion in &case.assertions {
            let _infallible = writeln!(text, "    assert {assertion}");
        }
    }
    let _infallible = writeln!(
        text,
        "\n  run its cases: gaugeblock certify --only {} --controller CONTROLLER\n",
        rule.id
    );
    text
}

fn choice_text(choice: &Choice) -> String {
    let kind = match choice.kind {
        ChoiceKind::Choice => "choice",
        ChoiceKind::Quirk => "quirk",
    };
    let mut text = format!("{} ({kind})\n  {}\n", choice.id, choice.sentence);
    text.push_str(&sources_text(&choice.sources));
    for option in &choice.options {
        let _infallible = writeln!(text, "  {:<24} {}", option.name, option.means);
    }
    let _infallible = writeln!(
        text,
        "\n  set it: gaugeblock run FILE --option {}={}\n",
        choice.id,
        choice.options.last().map_or("OPTION", |option| option.name.as_str())
    );
    text
}

/// The sources, one line per section with the numbers of its sentences.
fn sources_text(sources: &[Source]) -> String {
    let mut sections: Vec<(&str, &str, Vec<String>)> = Vec::new();
    for Source { document, section, ordinal, says: _ } in sources {
        let place = sections.iter().position(|(d, s, _)| d == document && s == section);
        let place = place.unwrap_or_else(|| {
            sections.push((document, section, Vec::new()));
            sections.len() - 1
        });
        sections[place].2.extend(ordinal.map(|ordinal| ordinal.to_string()));
    }
    let line = |(document, section, ordinals): (&str, &str, Vec<String>)| {
        let ordinals =
            if ordinals.is_empty() { String::new() } else { format!(" ({})", ordinals.join(", ")) };
        format!("  {document}, {section}{ordinals}\n")
    };
    sections.into_iter().map(line).collect()
}

/// A G or M code, such as M73 or G5.2.
struct Code {
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
    fn read(text: &str) -> Option<Self> {
        let mut rest = text.chars();
        let letter = rest.next()?.to_ascii_uppercase();
        let number = rest.as_str();
        let is_number = number.starts_with(|c: char| c.is_ascii_digit())
            && number.chars().all(|c| c.is_ascii_digit() || c == '.');
        (matches!(letter, 'G' | 'M') && is_number)
            .then(|| Self { letter, number: without_leading_zeros(number) })
    }

    /// Whether a title such as `M2, M30 Program End` names the code.
    fn is_in_title(&self, title: &str) -> bool {
        let name = self.to_string();
        title.split(|c: char| !c.is_ascii_alphanumeric() && c != '.').any(|word| word == name)
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
struct Explanation<'a> {
    documented: Vec<(&'a str, &'a str)>,
    used: Vec<&'a str>,
    choices: Vec<(&'a Choice, bool)>,
}

impl<'a> Explanation<'a> {
    fn of(code: &Code, suite: &'a Suite) -> Self {
        let by_title =
            |sources: &[Source]| sources.iter().any(|source| code.is_in_title(&source.section));
        let (mut documented, mut used) = (Vec::new(), Vec::new());
        for rule in &suite.rules {
            if by_title(&rule.sources) {
                documented.push((rule.id.as_str(), rule.sentence.as_str()));
            } else if rule.cases.iter().any(|case| code.is_in_program(&case.program)) {
                used.push(rule.id.as_str());
            }
        }
        let choices = suite.choices.iter().filter_map(|choice| {
            let documented = by_title(&choice.sources);
            let used = code.is_in_program(&choice.program);
            (documented || used).then_some((choice, documented))
        });
        Self { documented, used, choices: choices.collect() }
    }

    fn is_empty(&self) -> bool {
        self.documented.is_empty() && self.used.is_empty() && self.choices.is_empty()
    }

    fn text(&self, code: &Code) -> String {
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
            let of_kind: Vec<_> = self
                .choices
                .iter()
                .filter(|(choice, documented)| choice.kind == kind && *documented)
                .collect();
            if !of_kind.is_empty() {
                let _infallible = writeln!(text, "\n{title}:");
            }
            for (choice, _) in of_kind {
                let _infallible = writeln!(text, "  {:<40} {}", choice.id, choice.sentence);
            }
        }
        if !self.used.is_empty() {
            let _infallible = writeln!(
                text,
                "\n{} other rules use it in a program: {}",
                self.used.len(),
                self.used.join(", ")
            );
        }
        text.push_str("\n`gaugeblock explain ID` prints one of them in full.\n");
        text
    }

    fn document(&self, code: &Code) -> serde_json::Value {
        let rules: Vec<_> = self.documented.iter().map(|(id, _)| id).collect();
        let choices: Vec<_> = self
            .choices
            .iter()
            .map(|(choice, documented)| {
                json!({ "id": choice.id, "kind": choice.kind, "documented": documented })
            })
            .collect();
        json!({
            "gaugeblock": "explain", "code": code.to_string(), "rules": rules,
            "rules_that_use_it": self.used, "choices": choices,
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
    fn an_id_is_not_a_code() {
        for subject in ["saved-state", "gpp.text", "M", "Mx", "X1"] {
            assert!(Code::read(subject).is_none(), "{subject}");
        }
    }
}
