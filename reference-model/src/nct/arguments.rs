//! Which local variable takes which word of a call.

use gaugeblock_vocabulary::FaultKind;

use super::refusal::{StepError, open, refuse};
use super::state::Run;
use super::variables::Locals;
use super::words::Words;
use crate::ids::{choice, rule};

/// Most sets of I, J and K.
const MOST_SETS: usize = 10;

/// The letters that stand for one variable each, with its number. I, J and K have more than one.
const LETTERS: &[(char, usize)] = &[
    ('A', 1),
    ('B', 2),
    ('C', 3),
    ('D', 7),
    ('E', 8),
    ('F', 9),
    ('H', 11),
    ('M', 13),
    ('Q', 17),
    ('R', 18),
    ('S', 19),
    ('T', 20),
    ('U', 21),
    ('V', 22),
    ('W', 23),
    ('X', 24),
    ('Y', 25),
    ('Z', 26),
];

/// Letters that are no arguments, with the variables that some controllers give them in a block that is taken as
/// arguments.
const OTHERS: &[(char, usize)] = &[('G', 10), ('L', 12), ('P', 16)];

/// How many sets of I, J and K have begun.
#[derive(Default)]
struct Sets {
    /// How many sets have each letter.
    of_letter: [usize; 3],
    /// The set in progress, from 1, and which letters it has.
    current: usize,
    has: [bool; 3],
}

impl Sets {
    /// The set that a further letter belongs to, from 1.
    ///
    /// Choice nct.set-advance.
    fn next(&mut self, place: usize, by_set: bool) -> usize {
        if by_set {
            if self.current == 0 || self.has[place] {
                self.current += 1;
                self.has = [false; 3];
            }
            self.has[place] = true;
            return self.current;
        }
        self.of_letter[place] += 1;
        self.of_letter[place]
    }
}

impl Run<'_> {
    /// The local variables with which a macro begins.
    ///
    /// Rule nct.arguments. Each letter stands for a variable of its own; G, L, N, O and P are no arguments. Rule
    /// nct.argument-sets. I, J and K in their n-th set are #3n+1, #3n+2 and #3n+3, for ten sets; of two words for one
    /// variable the later one counts. So it does where G, L or P has a variable.
    pub(super) fn arguments(&mut self, words: &Words, is_block: bool) -> Result<Locals, StepError> {
        let mut locals: Locals = [None; 33];
        let mut sets = Sets::default();
        let mut seen = std::collections::BTreeSet::new();
        for (letter, value) in words {
            let set_letter = "IJK".find(*letter);
            let may_repeat = matches!(letter, 'G' | 'I' | 'J' | 'K' | 'L' | 'P');
            if !may_repeat && !seen.insert(*letter) {
                return Err(open(format!("the argument {letter} twice")));
            }
            let number = match set_letter {
                Some(place) => {
                    let set = sets.next(place, self.choices.is(choice::nct::SetAdvance::BySet));
                    if set > MOST_SETS {
                        let message = format!("more than {MOST_SETS} sets of I, J and K");
                        let rule = rule::nct::ARGUMENT_SETS;
                        return Err(refuse(rule, FaultKind::TooManyArguments, message));
                    }
                    if set > 1 {
                        self.coverage.accepted(rule::nct::ARGUMENT_SETS);
                    }
                    3 * set + place + 1
                }
                None => match self.letter(*letter, is_block)? {
                    Some(number) => number,
                    None => continue,
                },
            };
            locals[number - 1] = Some(*value);
            self.coverage.accepted(rule::nct::ARGUMENTS);
        }
        Ok(locals)
    }

    /// The variable of a letter; none where the letter is left out.
    ///
    /// Choice nct.block-arguments.
    fn letter(&self, letter: char, is_block: bool) -> Result<Option<usize>, StepError> {
        let number = |table: &[(char, usize)]| {
            table.iter().find(|(other, _)| *other == letter).map(|(_, number)| *number)
        };
        match number(LETTERS) {
            Some(number) => Ok(Some(number)),
            None if is_block && self.choices.is(choice::nct::BlockArguments::OwnNumbers) => {
                Ok(number(OTHERS))
            }
            None if is_block => Ok(None),
            None => {
                let message = format!("{letter} is not an argument");
                Err(refuse(rule::nct::ARGUMENTS, FaultKind::Macro, message))
            }
        }
    }
}
