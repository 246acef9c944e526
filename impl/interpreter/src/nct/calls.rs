//! Calls: once, modally after a motion or by block, and of subprograms; their arguments, and the return.

use gaugeblock_vocabulary::FaultKind;

use super::frames::{Call, Frame, ModalCall, Reach};
use super::program::{Stop, refuse};
use super::run::{Flow, Runner};
use super::variables::Locals;
use crate::faults::{PlantedFault, planted};
use crate::math;

impl Runner {
    /// A block with G65, G66, G66.1 or G67.
    pub(super) fn call_block(&mut self) -> Result<Flow, Stop> {
        let mut codes = self.g.iter().filter(|code| is_call(**code));
        let code = codes.next().copied().unwrap_or_default();
        if codes.next().is_some() {
            return refuse(FaultKind::ModalConflict, "two codes of calls");
        }
        if code == 670 {
            return self.cancel();
        }
        if !matches!(self.words.first(), Some((b'G', _)) if self.g.first() == Some(&code)) {
            return refuse(FaultKind::Macro, "a word before the code of a call");
        }
        let call = self.call()?;
        if code == 661 && self.words.iter().skip(1).any(|(letter, _)| !is_of_call(*letter)) {
            return Err(Stop::Open("arguments in the block of G66.1"));
        }
        let arguments = self.arguments(1, true)?;
        if code == 650 {
            self.call_macro(call, &arguments)?;
        } else {
            self.command(ModalCall { call, by_block: code == 661, arguments })?;
        }
        Ok(Flow::On)
    }

    /// P and L of a call.
    fn call(&self) -> Result<Call, Stop> {
        let values = |letter| self.words.iter().filter(move |word| word.0 == letter);
        let (mut programs, mut repeats) = (values(b'P'), values(b'L'));
        let Some((_, program)) = programs.next() else {
            return refuse(FaultKind::MissingWord, "a call without P");
        };
        if programs.next().is_some() {
            return refuse(FaultKind::RepeatedWord, "P occurs twice");
        }
        let repeat = repeats.next().map(|(_, value)| *value);
        if repeats.next().is_some() {
            return refuse(FaultKind::RepeatedWord, "L occurs twice");
        }
        called(*program, repeat)
    }

    /// G66 and G66.1: puts a modal call in force.
    fn command(&mut self, modal: ModalCall) -> Result<(), Stop> {
        self.may_command()?;
        if self.modal_calls.first().is_some_and(|first| first.by_block != modal.by_block) {
            return Err(Stop::Open("G66 and G66.1 in force together"));
        }
        self.report_modal_call(self.modal_calls.len(), modal.call.program.unwrap_or(0));
        self.modal_calls.push(modal);
        Ok(())
    }

    /// G67: cancels the modal call that was commanded last.
    fn cancel(&mut self) -> Result<Flow, Stop> {
        if self.words.len() > 1 {
            return Err(Stop::Open("G67 with other words"));
        }
        self.may_command()?;
        if planted(PlantedFault::CancelsFirst) && !self.modal_calls.is_empty() {
            self.modal_calls.remove(0);
            self.report_modal_call(self.modal_calls.len(), 0);
        } else if self.modal_calls.pop().is_some() {
            self.report_modal_call(self.modal_calls.len(), 0);
        } else if self.choices.cancel_refused {
            return refuse(FaultKind::Macro, "G67 without a modal call");
        }
        Ok(Flow::On)
    }

    fn may_command(&self) -> Result<(), Stop> {
        if self.frame().commands_unspecified {
            let why = "G66, G66.1 or G67 in a program that a modal call reached or called";
            return Err(Stop::Open(why));
        }
        Ok(())
    }

    fn report_modal_call(&mut self, depth: usize, program: u32) {
        self.report.modal_call = Some((u32::try_from(depth).unwrap_or(u32::MAX), program));
    }

    /// Arguments from the words, from one of them on. In the block of a call G is none.
    fn arguments(&self, from: usize, of_call: bool) -> Result<Locals, Stop> {
        let mut arguments = Locals::VACANT;
        let mut sets = Sets::default();
        let mut seen = 0_u32;
        for (letter, value) in self.words.iter().skip(from) {
            let place = match letter {
                b'G' if of_call => return refuse(FaultKind::Macro, "G is not an argument"),
                b'P' | b'L' if of_call => continue,
                b'G' | b'P' | b'L' if !self.choices.own_numbers => continue,
                b'G' | b'P' | b'L' => number_of(*letter).wrapping_sub(1),
                b'I' | b'J' | b'K' => sets.place(letter.wrapping_sub(b'I'), self.choices.by_set)?,
                _ => {
                    let bit = 1_u32.wrapping_shl(u32::from(letter.wrapping_sub(b'A')));
                    if seen & bit != 0 {
                        return Err(Stop::Open("the letter of an argument occurs twice"));
                    }
                    seen |= bit;
                    number_of(*letter).wrapping_sub(1)
                }
            };
            arguments.put(place, Some(*value));
        }
        Ok(arguments)
    }

    /// A block that a modal call by block takes as its arguments.
    pub(super) fn take_as_arguments(&mut self, call: usize) -> Result<(), Stop> {
        if self.m.iter().any(|code| matches!(code, 2 | 30 | 98)) {
            return Err(Stop::Open("M2, M30 or M98 in a block that is taken as arguments"));
        }
        let arguments = self.arguments(0, false)?;
        let Some(modal) = self.modal_calls.get_mut(call) else { return Ok(()) };
        modal.arguments = arguments;
        self.call_modally(call)
    }

    /// A modal call, by its place.
    pub(super) fn call_modally(&mut self, call: usize) -> Result<(), Stop> {
        let Some(modal) = self.modal_calls.get(call).copied() else { return Ok(()) };
        let program = self.begins_macro(modal.call)?;
        let reach =
            if planted(PlantedFault::ReachesItself) { call.saturating_add(1) } else { call };
        self.begin(program, modal.call, (Reach::First(reach), true));
        self.variables.enter(&modal.arguments, self.choices.reloaded);
        Ok(())
    }

    /// G65.
    fn call_macro(&mut self, call: Call, arguments: &Locals) -> Result<(), Stop> {
        let program = self.begins_macro(call)?;
        let reach = match self.reached()? {
            _ if self.modal_calls.is_empty() => self.frame().reach,
            None => Reach::First(0),
            Some(_) => Reach::Unspecified,
        };
        self.begin(program, call, (reach, true));
        self.variables.enter(arguments, self.choices.reloaded);
        Ok(())
    }

    /// M98.
    pub(super) fn call_sub(
        &mut self,
        program: Option<f64>,
        repeats: Option<f64>,
    ) -> Result<(), Stop> {
        let Some(program) = program else {
            return refuse(FaultKind::MissingWord, "M98 without P");
        };
        let call = called(program, repeats)?;
        let program = self.program_of(call)?;
        if planted(PlantedFault::SubHasLocals) {
            self.begin(program, call, (self.frame().reach, true));
            self.variables.enter(&Locals::VACANT, false);
        } else {
            self.begin(program, call, (self.frame().reach, false));
        }
        Ok(())
    }

    /// The program of a macro that may begin.
    fn begins_macro(&self, call: Call) -> Result<usize, Stop> {
        let most = if self.choices.deeper || planted(PlantedFault::FifthLevel) { 5 } else { 4 };
        if self.variables.level() >= most {
            return refuse(FaultKind::TooManyLevels, "too many macro levels");
        }
        self.program_of(call)
    }

    fn program_of(&self, call: Call) -> Result<usize, Stop> {
        let numbers = &self.code.numbers;
        let none = Stop::Refused(FaultKind::UnknownSub, "there is no program of this number");
        let number = call.program.ok_or(none)?;
        let found = numbers.partition_point(|(one, _)| *one < number);
        let mut numbers = numbers.iter().skip(found);
        let is_it = |one: &&(u32, usize)| one.0 == number;
        let Some((_, program)) = numbers.next().filter(is_it) else { return Err(none) };
        if numbers.next().is_some_and(|one| is_it(&one)) {
            return Err(Stop::Open("a program number that occurs several times is searched"));
        }
        let most = if self.choices.deeper { 15 } else { 8 };
        if self.frames.len() > most {
            return refuse(FaultKind::TooManyLevels, "too many calls in progress");
        }
        Ok(*program)
    }

    fn begin(&mut self, program: usize, call: Call, (reach, is_macro): (Reach, bool)) {
        // A subprogram of M98 is a part of its caller; a macro is not.
        let commands_unspecified =
            self.frame().commands_unspecified || (is_macro && !matches!(self.reached(), Ok(None)));
        let first = self.code.programs.get(program).map_or(0, |program| program.blocks.from);
        let left = if planted(PlantedFault::OnceMore) && call.repeats > 1 {
            call.repeats.saturating_add(1)
        } else {
            call.repeats
        };
        self.frames.push(Frame {
            program,
            next: first,
            reach,
            is_macro,
            left,
            modal_calls: self.modal_calls.len(),
            commands_unspecified,
        });
    }

    /// M99, with the value of P.
    pub(super) fn end_call(&mut self, to: Option<f64>) -> Result<Flow, Stop> {
        if self.frames.len() <= 1 {
            return self.end_main(to);
        }
        let frame = self.frame();
        if frame.modal_calls != self.modal_calls.len() {
            return Err(Stop::Open("a program returns with another number of modal calls"));
        }
        if frame.left > 1 {
            if to.is_some() {
                return Err(Stop::Open("M99 with P where the call is to be repeated"));
            }
            self.repeat();
            return Ok(Flow::On);
        }
        if let Some(number) = to.filter(|_| planted(PlantedFault::ReturnWithin)) {
            self.jump_to(number)?;
            return Ok(Flow::On);
        }
        self.frames.pop();
        if let Some(number) = to {
            self.jump_to(number)?;
        }
        if frame.is_macro {
            self.variables.leave();
        }
        Ok(Flow::On)
    }

    fn end_main(&mut self, to: Option<f64>) -> Result<Flow, Stop> {
        if self.choices.main_return_refused {
            return refuse(FaultKind::OutsideSub, "M99 in the main program");
        }
        match to {
            Some(number) => self.jump_to(number).map(|()| Flow::On),
            None => match self.turns_left.checked_sub(1) {
                Some(left) => {
                    self.turns_left = left;
                    self.begin_again();
                    Ok(Flow::On)
                }
                None => Ok(Flow::Endless),
            },
        }
    }

    /// Continues at the first block of the program in progress.
    fn begin_again(&mut self) {
        let programs = &self.code.programs;
        if let Some(frame) = self.frames.last_mut() {
            frame.next = programs.get(frame.program).map_or(0, |program| program.blocks.from);
        }
    }

    /// Repeats the program in progress and counts the turn.
    fn repeat(&mut self) {
        self.begin_again();
        if let Some(frame) = self.frames.last_mut() {
            frame.left = frame.left.saturating_sub(1);
            if frame.is_macro && self.choices.reloaded {
                self.variables.reload();
            }
        }
    }
}

/// The call of P and L.
fn called(program: f64, repeats: Option<f64>) -> Result<Call, Stop> {
    let whole =
        |value| math::whole(math::round_away(value)).and_then(|one| u32::try_from(one).ok());
    match repeats.map_or(Some(1), whole) {
        Some(repeats @ 1..=9999) => Ok(Call { program: whole(program), repeats }),
        Some(_) | None => refuse(FaultKind::WordOutOfRange, "L is from 1 to 9999"),
    }
}

/// Whether a code in tenths is that of a call.
pub(super) fn is_call(code: u16) -> bool {
    matches!(code, 650 | 660 | 661 | 670)
}

/// Whether a word of the block of a call is none of its arguments; G is refused.
fn is_of_call(letter: u8) -> bool {
    matches!(letter, b'G' | b'P' | b'L')
}

/// The number of the variable of a letter.
fn number_of(letter: u8) -> u8 {
    match letter {
        b'D' => 7,
        b'E' => 8,
        b'F' => 9,
        b'G' => 10,
        b'H' => 11,
        b'L' => 12,
        b'M' => 13,
        b'P' => 16,
        // A to C are #1 to #3, Q to Z #17 to #26.
        _ => letter.wrapping_sub(64),
    }
}

/// Sets of I, J and K, as they are read.
#[derive(Clone, Copy, Debug, Default)]
struct Sets {
    /// How many of each letter there have been, or of which set it was last.
    of_letter: [u8; 3],
    /// The set in progress.
    current: u8,
}

impl Sets {
    /// The place from 0 of the variable of the next I, J or K, which are 0, 1 and 2.
    fn place(&mut self, letter: u8, by_set: bool) -> Result<u8, Stop> {
        let Some(of_letter) = self.of_letter.get_mut(usize::from(letter)) else { return Ok(0) };
        let set = if !by_set {
            of_letter.saturating_add(1)
        } else if *of_letter >= self.current {
            self.current.saturating_add(1)
        } else {
            self.current
        };
        *of_letter = set;
        self.current = self.current.max(set);
        if set > 10 {
            return refuse(FaultKind::TooManyArguments, "more than ten sets of I, J and K");
        }
        // The n-th I is #3n+1.
        Ok(set.saturating_mul(3).saturating_add(letter))
    }
}
