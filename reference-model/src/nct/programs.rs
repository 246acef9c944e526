//! Programs by number, blocks by sequence number, and which END belongs to which DO.

use std::collections::BTreeMap;

use gaugeblock_vocabulary::FaultKind;

use super::refusal::{StepError, open, refuse};
use super::syntax::{self, Block, Content};
use super::text;
use crate::Choices;
use crate::ids::{Rule, rule};

/// A program: from its number to the next one, or to the end of the text.
#[derive(Clone, Debug)]
pub struct Program {
    /// The line where it begins.
    pub line: u32,
    /// Its blocks.
    pub blocks: Vec<Block>,
    /// The block that a sequence number opens; none where it opens several.
    sequence: BTreeMap<u32, Option<usize>>,
    /// For the block of a DO that of its END, and the other way round.
    pub pairs: BTreeMap<usize, usize>,
    /// The DO of the innermost loop that each block stands in.
    within: Vec<Option<usize>>,
    /// Why a DO or END is refused when it is reached.
    faults: BTreeMap<usize, StepError>,
}

/// All programs of a text.
#[derive(Clone, Debug)]
pub struct Programs {
    /// In the order of the text; the first one is run.
    pub all: Vec<Program>,
    /// By number; none where a number stands several times.
    by_number: BTreeMap<u32, Option<usize>>,
}

impl Programs {
    /// The programs of a text. What is wrong with a block shows when it is reached.
    pub fn read(text: &str, block_delete: bool, choices: &Choices) -> Self {
        let mut begun: Vec<(u32, Vec<Block>)> = Vec::new();
        let mut by_number = BTreeMap::new();
        for line in text::lines(text) {
            if begun.is_empty() || line.program.is_some() {
                begun.push((line.number, Vec::new()));
            }
            if let Some(number) = line.program {
                let place = begun.len() - 1;
                by_number.entry(number).and_modify(|known| *known = None).or_insert(Some(place));
            }
            let is_number_alone =
                line.program.is_some() && line.sequence.is_none() && line.rest.is_empty();
            if !is_number_alone || line.fault.is_some() {
                let block = syntax::block(&line, choices);
                if let Some((_, blocks)) = begun.last_mut() {
                    blocks.push(block);
                }
            }
        }
        if begun.is_empty() {
            begun.push((1, Vec::new()));
        }
        let program = |(line, blocks)| Program::new(line, blocks, block_delete);
        Self { all: begun.into_iter().map(program).collect(), by_number }
    }

    /// Rule nct.call. A call names a program that there is.
    ///
    /// # Errors
    /// There is none of this number, or several.
    pub fn find(&self, number: i64) -> Result<usize, StepError> {
        let known = u32::try_from(number).ok().and_then(|number| self.by_number.get(&number));
        match known {
            Some(Some(place)) => Ok(*place),
            Some(None) => Err(open(format!("program {number} occurs several times"))),
            None => {
                let message = format!("there is no program {number}");
                Err(refuse(rule::nct::CALL, FaultKind::UnknownSub, message))
            }
        }
    }
}

impl Program {
    fn new(line: u32, blocks: Vec<Block>, block_delete: bool) -> Self {
        let mut sequence = BTreeMap::new();
        for (place, block) in blocks.iter().enumerate() {
            if let Some(number) = block.sequence {
                sequence.entry(number).and_modify(|known| *known = None).or_insert(Some(place));
            }
        }
        let (pairs, faults) = loops(&blocks, block_delete);
        let within = within(blocks.len(), &pairs);
        Self { line, blocks, sequence, pairs, within, faults }
    }

    /// The fault of a DO or END, if it has one.
    ///
    /// # Errors
    /// That fault.
    pub fn check(&self, place: usize) -> Result<(), StepError> {
        self.faults.get(&place).map_or(Ok(()), |fault| Err(fault.clone()))
    }

    /// Rule nct.goto. A jump leads to the block that its sequence number opens: 3070 NOT EXISTING BLOCK NO. P where
    /// none does.
    ///
    /// # Errors
    /// There is no such block in the program, or several; or it stands in a loop in which the jump does not.
    pub fn find(&self, number: i64, from: usize, rule: Rule) -> Result<usize, StepError> {
        let known = u32::try_from(number).ok().and_then(|number| self.sequence.get(&number));
        let place = match known {
            Some(Some(place)) => *place,
            Some(None) => return Err(open(format!("N{number} occurs several times"))),
            None => {
                let message = format!("no block begins with N{number}");
                return Err(refuse(rule, FaultKind::UnknownLabel, message));
            }
        };
        let around = self.around(from);
        if self.around(place).iter().any(|outer| !around.contains(outer)) {
            return Err(open("a jump into a loop"));
        }
        Ok(place)
    }

    /// The loops in which a block stands, by their DO.
    fn around(&self, place: usize) -> Vec<usize> {
        let within = |place: usize| self.within.get(place).copied().flatten();
        std::iter::successors(within(place), |outer| within(*outer)).collect()
    }
}

/// Which END belongs to which DO.
///
/// Rule nct.loop-pairs. An END ends the innermost DO that is open where it stands, which has its number. A DO has an
/// END, and no other one of its number is open where it stands. Rule nct.block-delete. Of a block that is skipped
/// only the numbers count.
fn loops(
    blocks: &[Block],
    block_delete: bool,
) -> (BTreeMap<usize, usize>, BTreeMap<usize, StepError>) {
    let rule = rule::nct::LOOP_PAIRS;
    let (mut pairs, mut faults) = (BTreeMap::new(), BTreeMap::new());
    let mut begun: Vec<(usize, u32)> = Vec::new();
    let is_read = |block: &Block| !(block_delete && block.is_optional);
    for (place, block) in blocks.iter().enumerate().filter(|(_, block)| is_read(block)) {
        match &block.content {
            Ok(Content::While(_, number)) => {
                if begun.iter().any(|(_, other)| other == number) {
                    let message = format!("DO{number} within DO{number}");
                    faults.insert(place, refuse(rule, FaultKind::DuplicateLabel, message));
                }
                begun.push((place, *number));
            }
            Ok(Content::End(number)) => match begun.pop_if(|(_, other)| other == number) {
                Some((begin, _)) => {
                    pairs.insert(begin, place);
                    pairs.insert(place, begin);
                }
                None => {
                    let message = format!("END{number} ends no loop");
                    faults.insert(place, refuse(rule, FaultKind::UnknownLabel, message));
                }
            },
            Ok(Content::Words(_) | Content::Assign { .. } | Content::Goto(_) | Content::If(..))
            | Err(_) => {}
        }
    }
    for (place, number) in begun {
        let message = format!("DO{number} without END{number}");
        faults.entry(place).or_insert_with(|| refuse(rule, FaultKind::MissingEnd, message));
    }
    (pairs, faults)
}

/// The DO of the innermost loop that each block stands in. A DO stands outside of its loop, an END in it.
fn within(count: usize, pairs: &BTreeMap<usize, usize>) -> Vec<Option<usize>> {
    let mut begun = Vec::new();
    let innermost = (0..count).map(|place| {
        let innermost = begun.last().copied();
        match pairs.get(&place) {
            Some(end) if *end > place => begun.push(place),
            Some(_) => {
                begun.pop();
            }
            None => {}
        }
        innermost
    });
    innermost.collect()
}
