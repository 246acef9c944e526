//! Whether a program is in the language that a controller declares.

use gaugeblock_adapter::protocol::{CommentKind, DeclaredLanguage, ParameterKind};
use gaugeblock_reference::rs274::{CodeUse, LanguageNeeds, language_needs};
use gaugeblock_suite::{Files, Suite};
use gaugeblock_vocabulary::Scenario;

/// Checks that a controller with this language can read the program of a scenario.
///
/// A code that no document has is no reason to leave a program out: each controller has to refuse it.
///
/// # Errors
/// What the program needs that is not in the declared language.
pub fn check_program(language: &DeclaredLanguage, scenario: &Scenario) -> Result<(), String> {
    match missing(language, &language_needs(scenario)) {
        Some(what) => Err(format!("{what}: not in the declared language")),
        None => Ok(()),
    }
}

/// Reads a suite. No edition has a case that needs more of the language than its documents have.
///
/// # Errors
/// Every page that is not in the form, each with path, place and reason.
pub fn read_suite(files: &Files) -> Result<Suite, Vec<String>> {
    let mut suite = Suite::read(files)?;
    suite.limit_to_languages(check_program);
    Ok(suite)
}

/// The first thing that a program needs and the language does not have.
fn missing(language: &DeclaredLanguage, needs: &LanguageNeeds) -> Option<String> {
    let of_codes = needs.codes.iter().find_map(|code| missing_of_code(language, code));
    let computed = || {
        let is_listed = |letter: &&char| match letter {
            'G' => language.g.is_some(),
            _ => language.m.is_some(),
        };
        let letter = needs.computed_codes.iter().find(is_listed)?;
        Some(format!("{letter} with a number that depends on a parameter"))
    };
    let lacks = |letters: &Option<String>, among: &str| {
        let letters = letters.as_ref()?;
        let mut needed = needs.letters.iter().filter(|letter| among.contains(**letter));
        needed.find(|letter| !letters.contains(**letter)).copied()
    };
    of_codes
        .or_else(computed)
        .or_else(|| missing_mark(language, needs).map(str::to_owned))
        .or_else(|| lacks(&language.letters, "FSTN").map(|letter| format!("the word {letter}")))
        .or_else(|| {
            lacks(&language.axes, "XYZABCUVW@^").map(|axis| format!("the axis word {axis}"))
        })
}

fn missing_of_code(
    language: &DeclaredLanguage,
    CodeUse { code, kind, letters }: &CodeUse,
) -> Option<String> {
    let (codes, number) = match code.strip_prefix('G') {
        Some(number) => (&language.g, number),
        None => (&language.m, code.trim_start_matches('M')),
    };
    if codes.as_ref().is_some_and(|codes| !codes.contains(number)) {
        return Some(code.clone());
    }
    let by_kind = kind.map(|kind| format!("{code} L{kind}"));
    let of_kind = by_kind.as_ref().and_then(|name| language.words.get(name));
    let kinds = format!("{code} L");
    let has_kinds = language.words.keys().any(|name| name.starts_with(&kinds));
    let name = by_kind.filter(|_| has_kinds).unwrap_or_else(|| code.clone());
    let known = match of_kind.or_else(|| language.words.get(code)) {
        // The number after L is that of the key.
        Some(known) => known,
        None if has_kinds && kind.is_some() => return Some(name),
        None => return None,
    };
    let unknown = letters
        .iter()
        .find(|letter| !(known.contains(**letter) || **letter == 'L' && of_kind.is_some()))?;
    Some(format!("{name} with {unknown}"))
}

fn missing_mark(language: &DeclaredLanguage, needs: &LanguageNeeds) -> Option<&'static str> {
    let lacks = |kind| language.parameters.as_ref().is_some_and(|kinds| !kinds.contains(&kind));
    let no_comment = |kind| language.comments.as_ref().is_some_and(|kinds| !kinds.contains(&kind));
    let is_above =
        language.greatest_parameter.is_some_and(|greatest| needs.greatest_parameter > greatest);
    let marks = [
        (needs.numbered_parameters && lacks(ParameterKind::Numbered), "a numbered parameter"),
        (needs.named_parameters && lacks(ParameterKind::Named), "a named parameter"),
        (is_above, "a parameter of a greater number"),
        (needs.expressions && language.expressions == Some(false), "an expression"),
        (needs.comparisons && language.comparisons == Some(false), "a comparison"),
        (needs.o_words && language.o_words == Some(false), "an O-word"),
        (needs.parentheses && no_comment(CommentKind::Parentheses), "a comment in parentheses"),
        (needs.semicolons && no_comment(CommentKind::Semicolon), "a comment after a semicolon"),
        (
            needs.messages && no_comment(CommentKind::Active) && no_comment(CommentKind::Message),
            "a message",
        ),
        (needs.active_comments && no_comment(CommentKind::Active), "an active comment"),
    ];
    marks.iter().find(|(is_missing, _)| *is_missing).map(|(_, what)| *what)
}

#[cfg(test)]
mod tests {
    use super::*;

    const MILL: &str = r#"{"g":["0","1","2","10","43.1","92"],"m":["2","66"],"words":{"G2":"XYZIJKR","G10 L2":"PXYZ",
        "G43.1":"Z","G92":"XYZ"},"axes":"XYZ","letters":"FS","parameters":["numbered"],"expressions":false,
        "o_words":false,"comments":["parentheses"]}"#;

    fn check(program: &str, expect: &str) {
        let language = serde_json::from_str(MILL).expect("a language");
        let found = check_program(&language, &Scenario::of(program));
        let expected = if expect.is_empty() {
            Ok(())
        } else {
            Err(format!("{expect}: not in the declared language"))
        };
        assert_eq!(found, expected, "{program}");
    }

    #[test]
    fn program_in_the_language_is_run() {
        check("g1 f10 x1 #31=5\n(a comment)\ng2 x1 i1\nm2\n", "");
        check("g10 l2 p1 x1\n", "");
        check("m66 p1 l3 q2\n", "");
    }

    #[test]
    fn program_that_needs_more_is_left_out_and_says_what() {
        check("g43\n", "G43");
        check("m7\n", "M7");
        check("g43.1 x1\n", "G43.1 with X");
        check("g2 x1 i1\nx2 i1 p2\n", "G2 with P");
        check("g10 l20 p1 x1\n", "G10 L20");
        check("g10 l2 p1 x1 r5\n", "G10 L2 with R");
        check("g[#31]\n", "G with a number that depends on a parameter");
        check("g0 x[1]\n", "an expression");
        check("g0 x#<a>\n", "a named parameter");
        check("o1 sub\no1 endsub\n", "an O-word");
        check("g0;x\n", "a comment after a semicolon");
        check("(debug,a)\n", "an active comment");
        check("(msg,a)\n", "a message");
        check("t1\n", "the word T");
        check("g0 a1\n", "the axis word A");
    }

    #[test]
    fn language_of_numbers_and_messages_only() {
        let language = r#"{"greatest_parameter":5399,"comparisons":false,"comments":["parentheses","message"]}"#;
        let language = serde_json::from_str(language).expect("a language");
        for (program, expect) in [
            ("#5399=[1 or 2]\n(msg,a)\n(debugging)\n", Ok(())),
            ("#31=#5400\n", Err("a parameter of a greater number")),
            ("#31=[1 eq 2]\n", Err("a comparison")),
            ("#31=[1] (eq)\no1 while\n", Ok(())),
            ("#31=exists[#<a>]\n", Err("a comparison")),
            ("(print,a)\n", Err("an active comment")),
        ] {
            let found = check_program(&language, &Scenario::of(program));
            let expect = expect.map_err(|what| format!("{what}: not in the declared language"));
            assert_eq!(found, expect, "{program}");
        }
    }

    #[test]
    fn code_that_no_document_has_is_left_to_the_controller() {
        check("g999\n", "");
        check("g0 x1 q5\n", "");
    }

    #[test]
    fn language_without_members_has_everything() {
        let all = "g43.1 x1\no1 call [#<a>] ;b\n";
        assert_eq!(check_program(&DeclaredLanguage::default(), &Scenario::of(all)), Ok(()));
    }
}
