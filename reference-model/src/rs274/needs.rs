//! What a program needs of the language: codes with their words, parameters, expressions, O-words, comments.
//!
//! A controller may have a part of the language. The text of a program is read here block by block, with the parser of
//! the model, and nothing is executed. So what is not known before a block is reached is not known here either: the
//! code of a computed G word, and the motion mode in a subroutine.

use std::cell::RefCell;
use std::collections::BTreeSet;

use gaugeblock_vocabulary::scenario::Action;
use gaugeblock_vocabulary::{Language, Scenario};

use super::evaluate::value_of;
use super::execute::message::{is_active, is_message};
use super::modes::{Code, ModalGroup, Rounding, g_code, g_text, m_code};
use super::state::State;
use super::syntax::{Block, Comment, Expression, parse};
use super::task::{RunCache, start};
use super::text::{Glyph, Line, Source, condense};
use crate::math::near_integer;

/// What the program of a scenario needs of the language, whether or not its blocks are reached.
///
/// Subroutine files and blocks that the operator enters count, too. Of a block that no parser accepts, it is what can
/// be read.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct LanguageNeeds {
    /// Codes that the documents have, with the words that belong to each.
    pub codes: BTreeSet<CodeUse>,
    /// `G` and `M`, where the number of a code depends on a parameter.
    pub computed_codes: BTreeSet<char>,
    /// Letters of all other words, in upper case, with `N` of line numbers, `$`, `@` and `^`.
    pub letters: BTreeSet<char>,
    /// Whether a numbered parameter is read or set.
    pub numbered_parameters: bool,
    /// Whether a named parameter is read or set.
    pub named_parameters: bool,
    /// The greatest number that is written after a number sign, and zero without any.
    pub greatest_parameter: u32,
    /// Whether an expression has a comparison, or EXISTS.
    pub comparisons: bool,
    /// Whether something is in square brackets.
    pub expressions: bool,
    /// Whether there is an O-word.
    pub o_words: bool,
    /// Whether there is a comment in parentheses.
    pub parentheses: bool,
    /// Whether there is a comment after a semicolon.
    pub semicolons: bool,
    /// Whether there is a comment `(MSG,…)`.
    pub messages: bool,
    /// Whether there is a comment that does something else, such as `(DEBUG,…)`.
    pub active_comments: bool,
}

/// A code, and the letters of its block that belong to it.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct CodeUse {
    /// Its name, such as `G43.1` or `M66`.
    pub code: String,
    /// Of G10: the number after L, which says what it sets.
    pub kind: Option<u32>,
    /// Letters in upper case, axes among them. A block with a code and no word of its motion mode has none.
    pub letters: BTreeSet<char>,
}

thread_local! {
    /// How the documents are read under the options of the program before, which are most often those of the next one.
    static CHOICES: RefCell<RunCache> = RefCell::default();
}

/// What the program of a scenario needs of the language. Programs in other languages than RS-274 need nothing.
pub fn language_needs(scenario: &Scenario) -> LanguageNeeds {
    if scenario.program.language != Language::Rs274 {
        return LanguageNeeds::default();
    }
    // Options that the model does not know end a run before its first block, and have no part in how text is read.
    let choices = CHOICES.with_borrow_mut(|cache| cache.choices(&scenario.options));
    let state = start(scenario, choices.unwrap_or_default(), Rounding::AsComputed);
    let block_delete = scenario.program.block_delete;
    let mut reader = Reader { state, needs: LanguageNeeds::default(), motion: None };
    reader.text(&scenario.program.main, block_delete);
    for text in scenario.program.files.values() {
        reader.text(text, block_delete);
    }
    for event in &scenario.operator {
        if let Action::Mdi(text) = &event.action {
            reader.text(text, block_delete);
        }
    }
    reader.needs
}

/// Reads the texts of a program.
struct Reader {
    state: State,
    needs: LanguageNeeds,
    /// The last code of the motion group in the order of the text.
    motion: Option<&'static Code>,
}

/// A letter, and the number after it if that is known before the block is reached.
type KnownWord = (char, Option<f64>);

impl Reader {
    fn text(&mut self, text: &str, block_delete: bool) {
        self.motion = None;
        let source = Source::new("", text, &self.state.choices);
        for index in source.first.. {
            match source.line(index, block_delete, &mut self.state) {
                None | Some(Line::End) => break,
                Some(Line::Nothing | Line::Skipped(_)) => {}
                Some(Line::Block(line)) => self.line(line),
            }
        }
    }

    fn line(&mut self, line: &str) {
        let characters = self.characters(line);
        self.marks(&characters);
        match parse(line, &mut self.state) {
            Ok(block) => self.block(&block),
            Err(_) => self.broken(&characters),
        }
    }

    /// The characters of a line that count, in lower case. If a comment is wrong, or the line is too long, those up to
    /// the first comment.
    fn characters(&mut self, line: &str) -> String {
        let mut glyphs = Vec::new();
        if let Ok(comments) = condense(line, &mut glyphs, &mut self.state) {
            comments.iter().for_each(|comment| self.comment(comment));
            let counting = glyphs.iter().map(|glyph| glyph.character);
            return counting.filter(|character| *character != Glyph::COMMENT).collect();
        }
        self.needs.parentheses |= line.contains(['(', ')']);
        self.needs.semicolons |= line.contains(';');
        let before = line.split(['(', ')', ';']).next().unwrap_or_default();
        before.split_whitespace().collect::<String>().to_ascii_lowercase()
    }

    fn comment(&mut self, comment: &Comment) {
        self.needs.parentheses |= !comment.semicolon;
        self.needs.semicolons |= comment.semicolon;
        let choices = &self.state.choices;
        if is_message(&comment.text, choices) {
            self.needs.messages = true;
        } else if is_active(&comment.text, choices) {
            self.needs.active_comments = true;
            self.parameters(&comment.text);
        }
    }

    fn parameters(&mut self, text: &str) {
        self.needs.named_parameters |= text.contains("#<");
        self.needs.numbered_parameters |= text.replace("#<", "").contains('#');
        let numbers = text.split('#').skip(1).map(|rest| {
            let digits =
                rest.find(|mark: char| !mark.is_ascii_digit()).map_or(rest, |end| &rest[..end]);
            digits.parse().unwrap_or_default()
        });
        let greatest = numbers.max().unwrap_or_default();
        self.needs.greatest_parameter = self.needs.greatest_parameter.max(greatest);
    }

    /// What single characters need, in a line that is refused, too.
    fn marks(&mut self, characters: &str) {
        self.parameters(characters);
        self.needs.expressions |= characters.contains('[');
        self.needs.comparisons |= has_comparison(characters);
        let is_before = |character: char| matches!(character, '/' | 'n' | '0'..='9' | '.');
        self.needs.o_words |= characters.trim_start_matches(is_before).starts_with('o');
    }

    fn block(&mut self, block: &Block) {
        if block.line_number.is_some() {
            self.needs.letters.insert('N');
        }
        let words = block.words.iter();
        let words = words.map(|word| (word.letter, self.known(&word.value))).collect::<Vec<_>>();
        self.words(&words);
    }

    /// The value of an expression without a parameter.
    fn known(&mut self, value: &Expression) -> Option<f64> {
        if is_constant(value) { value_of(value, &mut self.state).ok() } else { None }
    }

    /// The words that can be read of a line that is refused: those before the first parameter or expression.
    fn broken(&mut self, characters: &str) {
        let begins = |character: char| matches!(character, 'a'..='n' | 'p'..='z' | '$' | '@' | '^');
        let mut rest = characters.split(['#', '[', 'o']).next().unwrap_or_default();
        let mut words = Vec::new();
        while let Some(place) = rest.find(begins) {
            let letter = rest[place..].chars().next().unwrap_or_default();
            rest = &rest[place + letter.len_utf8()..];
            let is_number = |character: char| matches!(character, '0'..='9' | '.' | '+' | '-');
            let end = rest.find(|character| !is_number(character)).unwrap_or(rest.len());
            words.push((letter, rest[..end].parse().ok()));
            rest = &rest[end..];
        }
        // Which code a G or M without a number would be, the line does not say.
        words.retain(|(letter, value)| value.is_some() || !matches!(letter, 'g' | 'm'));
        self.words(&words);
    }

    /// Attributes the letters of a block to its codes, and those that none of them uses to the motion mode.
    fn words(&mut self, words: &[KnownWord]) {
        let mut codes = Vec::new();
        for (letter, value) in words {
            match (letter, value) {
                ('g' | 'm', None) => {
                    self.needs.computed_codes.insert(letter.to_ascii_uppercase());
                }
                ('g', Some(value)) => codes.extend(code_of(10.0 * value, g_code, g_text)),
                ('m', Some(value)) => {
                    codes.extend(code_of(*value, m_code, |number| format!("M{number}")));
                }
                _ => {
                    self.needs.letters.insert(letter.to_ascii_uppercase());
                }
            }
        }
        if let Some((_, code)) =
            codes.iter().find(|(_, code)| code.group == Some(ModalGroup::Motion))
        {
            self.motion = Some(code);
        }
        let letters = || words.iter().map(|(letter, _)| *letter);
        let of = |code: &Code| letters().filter(|letter| uses(code, *letter)).collect::<Vec<_>>();
        let is_free = |letter: char| !codes.iter().any(|(_, code)| uses(code, letter));
        let repeated = self.motion.filter(|code| of(code).into_iter().any(is_free));
        let repeated = repeated.map(|code| (g_text(code.number), code, true));
        let written = codes.iter().map(|(name, code)| (name.clone(), *code, false));
        for (name, code, only_free) in written.chain(repeated) {
            let mut letters = of(code);
            letters.retain(|letter| !only_free || is_free(*letter));
            let kind = words.iter().find(|(letter, _)| *letter == 'l' && code.number == 100);
            let kind = kind.and_then(|(_, value)| u32::try_from(near_integer((*value)?)?).ok());
            let kind = kind.filter(|_| name == "G10");
            let letters = letters.iter().map(char::to_ascii_uppercase).collect();
            self.needs.codes.insert(CodeUse { code: name, kind, letters });
        }
    }
}

/// The code of a number, if the documents have it, with its name.
fn code_of(
    number: f64,
    code: fn(u32) -> Option<&'static Code>,
    name: fn(u32) -> String,
) -> Option<(String, &'static Code)> {
    let number = u32::try_from(near_integer(number)?).ok()?;
    Some((name(number), code(number)?))
}

/// Whether a letter belongs to a code where they are in one block.
fn uses(code: &Code, letter: char) -> bool {
    let is_axis = matches!(letter, 'a' | 'b' | 'c' | 'u'..='z' | '@' | '^');
    code.words.contains(letter) || code.axis_words && is_axis
}

/// Whether a comparison or EXISTS is between the brackets of a line, which is in lower case without blanks.
fn has_comparison(line: &str) -> bool {
    const SPELLINGS: [&str; 6] = ["eq", "ne", "gt", "ge", "lt", "le"];
    let from = line.find('[').unwrap_or(line.len());
    let to = line.rfind(']').map_or(from, |end| end.max(from));
    let outside_names =
        line[from..to].split('<').map(|part| part.split_once('>').map_or(part, |(_, rest)| rest));
    line.contains("exists[")
        || outside_names.into_iter().any(|part| SPELLINGS.iter().any(|name| part.contains(name)))
}

fn is_constant(value: &Expression) -> bool {
    match value {
        Expression::Number(_) => true,
        Expression::Parameter(_) | Expression::Exists(_) => false,
        Expression::Negate(value) | Expression::Function(_, value) => is_constant(value),
        Expression::ArcTangent(one, other) | Expression::Binary(_, one, other) => {
            is_constant(one) && is_constant(other)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Codes with their words, computed codes, then the other letters and marks.
    fn text(needs: &LanguageNeeds) -> String {
        let word = |letters: &BTreeSet<char>| letters.iter().collect::<String>();
        let kind = |code: &CodeUse| code.kind.map(|kind| format!(" L{kind}")).unwrap_or_default();
        let code = |code: &CodeUse| format!("{}{}:{}", code.code, kind(code), word(&code.letters));
        let mut parts: Vec<String> = needs.codes.iter().map(code).collect();
        parts.extend(needs.computed_codes.iter().map(|letter| format!("{letter}?")));
        let marks = [
            (needs.numbered_parameters, "#1"),
            (needs.named_parameters, "#<>"),
            (needs.expressions, "[]"),
            (needs.o_words, "O"),
            (needs.parentheses, "()"),
            (needs.semicolons, ";"),
            (needs.comparisons, "eq"),
            (needs.messages, "msg"),
            (needs.active_comments, "active"),
        ];
        parts.extend(marks.iter().filter(|(is, _)| *is).map(|(_, mark)| (*mark).to_owned()));
        parts.join(" ")
    }

    fn check(program: &str, expect: &str) {
        assert_eq!(text(&language_needs(&Scenario::of(program))), expect, "{program}");
    }

    #[test]
    fn words_belong_to_the_codes_of_their_block() {
        check("g0 x1 y2\nm2\n", "G0:XY M2:");
        check("g43.1 x1\n", "G43.1:X");
        check("g4 p1 m49\n", "G4:P M49:");
        check("g64 p1 x2\n", "G64:P");
        check("g10 l2 p1 x1 y2\n", "G10 L2:LPXY");
        check("m66 p0 l3 q1\n", "M66:LPQ");
        check("t1 m6 s100 f5\n", "M6:");
    }

    #[test]
    fn words_without_a_code_belong_to_the_motion_mode() {
        check("g2 x1 i1\nx2 i1 p2\n", "G2:IPX G2:IX");
        check("g81 z-1 r1\nx2 g91\n", "G81:RZ G81:X G91:");
        check("g1 x1\ng92 x0\n", "G1:X G92:X");
        check("x1\n", "");
    }

    #[test]
    fn code_that_no_document_has_is_not_a_need() {
        check("g999\nm250\ng1.05 x1\ng-1\n", "");
    }

    #[test]
    fn computed_code_is_known_if_no_parameter_has_a_part_in_it() {
        check("g[40+3] h1\n", "G43:H []");
        check("g#1 x1\n", "G? #1");
        check("m[#<_a>+1]\n", "M? #<> []");
    }

    #[test]
    fn marks_are_needed() {
        check("#31=5\n", "#1");
        check("#<a>=#31\n", "#1 #<>");
        check("o1 sub\no1 endsub\n", "O");
        check("o1 if [1]\n", "[] O");
        check("(a)\n", "()");
        check("g0;a\n", "G0: ;");
        check("(msg, a)\n", "() msg");
        check("#31=[1 le 2]\n#<one>=[exists[#<a>]]\n", "#1 #<> [] eq");
        check("(print,#<a>)\n", "#<> () active");
    }

    #[test]
    fn refused_line_needs_what_can_be_read_of_it() {
        check("g43.1 x[1\n", "G43.1:X []");
        check("g38.2 x1 (open\n", "G38.2:X ()");
        check("g1 x1 )g2\n", "G1:X ()");
        check("g2 x1 i1 =\n", "G2:IX");
        check("n1 o1 call 5\n", "O");
        check("g\n", "");
    }

    #[test]
    fn all_texts_count_and_skipped_blocks_do_not() {
        let mut scenario = Scenario::of("%\ng0 x1\n/g1\n%\ng5\n");
        scenario.program.block_delete = true;
        scenario.program.files.insert("a.ngc".to_owned(), "g17\n".to_owned());
        assert_eq!(text(&language_needs(&scenario)), "G0:X G17:");
        scenario.program.language = Language::Gpp;
        assert_eq!(language_needs(&scenario), LanguageNeeds::default());
    }

    #[test]
    fn letters_are_those_of_all_words_without_codes() {
        let needs = language_needs(&Scenario::of("n10 g1 x1 a2 f100\ns5 t1\n@1 ^2\n"));
        assert_eq!(needs.letters.iter().collect::<String>(), "@AFNSTX^");
    }
}
