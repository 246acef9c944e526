//! The machine that runs a block's operations: numbers in, words and settings out.

use alloc::vec::Vec;

use gaugeblock_vocabulary::FaultKind;

use crate::faults::{PlantedFault, planted};
use crate::modal::{Modal, Refusal};
use crate::parameters::{NameId, Parameters, Slot};
use crate::quirks;
use crate::syntax::bytecode::Op;
use crate::syntax::{
    LineCompiler, arithmetic, g_number, is_machine_state, is_position, m_number, parameter_number,
};
use crate::words::Words;

impl Parameters {
    /// A numbered parameter, also one that the modes keep.
    #[inline]
    pub(crate) fn numbered(&self, number: u16, modal: &Modal) -> f64 {
        let number = u32::from(number);
        match modal.numbered(number) {
            Some(value) => value,
            None => self.numbered.get(number),
        }
    }
}

/// A parameter that a block sets when all its values have been found (11.4.3.1).
#[derive(Clone, Copy, Debug)]
pub(crate) enum Setting {
    /// By number.
    Numbered(u16, f64),
    /// A local one.
    Local(NameId, f64),
    /// A global one.
    Global(NameId, f64),
    /// A named one as it was before it was set.
    Before(NameId, Slot),
}

/// The stack, and what waits for the end of the block's evaluation.
#[derive(Clone, Debug)]
pub(crate) struct Evaluator {
    /// Values that the operations pushed and nothing took: a label, a condition, arguments.
    pub(crate) stack: Vec<f64>,
    /// Settings in the order of writing; once they are in force, what was in force before.
    pub(crate) settings: Vec<Setting>,
    /// Whether they are in force.
    applied: bool,
}

impl Evaluator {
    /// With room for every line that the documents allow.
    pub(crate) fn new() -> Self {
        Self { stack: Vec::with_capacity(256), settings: Vec::with_capacity(128), applied: false }
    }

    /// Makes it ready for a block.
    #[inline]
    pub(crate) fn clear(&mut self) {
        self.stack.clear();
        self.settings.clear();
        self.applied = false;
    }

    #[inline]
    fn pop(&mut self) -> f64 {
        self.stack.pop().unwrap_or(0.0)
    }

    /// Puts the settings into force.
    #[inline]
    pub(crate) fn apply(&mut self, parameters: &mut Parameters) {
        if self.settings.is_empty() {
            return;
        }
        if planted(PlantedFault::RightToLeft) {
            self.settings.reverse();
        }
        self.applied = true;
        for setting in &mut self.settings {
            match setting {
                // A parameter that reports the tool or the point keeps its value, where it can be set at all.
                Setting::Numbered(number, value) if is_machine_state(*number) => {
                    *value = parameters.numbered.get(u32::from(*number));
                }
                Setting::Numbered(number, value) => {
                    *value = parameters.numbered.replace(u32::from(*number), *value);
                }
                Setting::Local(id, value) => {
                    *setting = Setting::Before(*id, parameters.named.set_local(*id, *value));
                }
                Setting::Global(id, value) => {
                    *setting = Setting::Before(*id, parameters.named.set_global(*id, *value));
                }
                Setting::Before(..) => {}
            }
        }
    }

    /// Undoes [`Self::apply`], which may be called again.
    pub(crate) fn postpone(&mut self, parameters: &mut Parameters) {
        if !self.applied {
            return;
        }
        self.applied = false;
        for setting in self.settings.iter_mut().rev() {
            match setting {
                Setting::Numbered(number, value) => {
                    *value = parameters.numbered.replace(u32::from(*number), *value);
                }
                Setting::Before(id, before) => {
                    let (id, set) = (*id, parameters.named.restore_slot(*id, *before));
                    *setting = if set.is_global() {
                        Setting::Global(id, set.value())
                    } else {
                        Setting::Local(id, set.value())
                    };
                }
                Setting::Local(..) | Setting::Global(..) => {}
            }
        }
    }

    /// Takes the settings back, in a block that is refused after all.
    #[cold]
    pub(crate) fn roll_back(&mut self, parameters: &mut Parameters) {
        if !self.applied {
            return;
        }
        for setting in self.settings.drain(..).rev() {
            match setting {
                Setting::Numbered(number, before) => {
                    parameters.numbered.replace(u32::from(number), before);
                }
                Setting::Before(id, before) => {
                    parameters.named.restore_slot(id, before);
                }
                Setting::Local(..) | Setting::Global(..) => {}
            }
        }
    }

    /// Runs operations. Words go to `words`, settings wait, and what else was pushed stays on the stack.
    ///
    /// # Errors
    /// A value that there is not.
    #[expect(clippy::wildcard_enum_match_arm, reason = "the others are matched in `rare`")]
    pub(crate) fn run(
        &mut self,
        ops: &[Op],
        parameters: &Parameters,
        modal: &Modal,
        compiler: &LineCompiler,
        words: &mut Words,
    ) -> Result<(), Refusal> {
        let choices = &compiler.choices;
        for op in ops {
            match *op {
                Op::WordNumber(letter, value) => words.set(letter, value),
                Op::GCode(code) => push_g(words, code)?,
                Op::MCode(code) => push_m(words, code)?,
                Op::Number(value) => self.stack.push(value),
                Op::Numbered(number) => {
                    self.stack.push(parameters.numbered.get(u32::from(number)));
                }
                Op::BinaryNumber(operator, right) => {
                    let left = self.pop();
                    let result =
                        arithmetic::binary(operator, left, right, choices).map_err(wrong)?;
                    self.stack.push(result);
                }
                Op::BinaryNumbered(operator, number) => {
                    let right = parameters.numbered.get(u32::from(number));
                    let left = self.pop();
                    let result =
                        arithmetic::binary(operator, left, right, choices).map_err(wrong)?;
                    self.stack.push(result);
                }
                Op::Binary(operator) => {
                    let right = self.pop();
                    let left = self.pop();
                    let result =
                        arithmetic::binary(operator, left, right, choices).map_err(wrong)?;
                    self.stack.push(result);
                }
                Op::Word(letter) => {
                    let value = self.pop();
                    words.set(letter, value);
                }
                Op::WordNumbered(letter, number) => {
                    words.set(letter, parameters.numbered.get(u32::from(number)));
                }
                Op::SetNumbered(number) => {
                    let value = self.pop();
                    self.settings.push(Setting::Numbered(number, value));
                }
                Op::SetLocal(id) => {
                    let value = self.pop();
                    self.settings.push(Setting::Local(id, value));
                }
                Op::SetGlobal(id) => {
                    let value = self.pop();
                    self.settings.push(Setting::Global(id, value));
                }
                Op::Local(id) => match parameters.named.local(id) {
                    Some(value) => self.stack.push(value),
                    None => return Err(no_such(compiler.names.name(id))),
                },
                Op::Global(id) => match parameters.named.global(id) {
                    Some(value) => self.stack.push(value),
                    None if choices.absent_zero || planted(PlantedFault::AbsentIsZero) => {
                        self.stack.push(0.0);
                    }
                    None => return Err(no_such(compiler.names.name(id))),
                },
                Op::Function(function) => {
                    let value = self.pop();
                    let result = arithmetic::function(function, value, choices).map_err(wrong)?;
                    self.stack.push(result);
                }
                _ => self.run_rare(op, parameters, modal, compiler, words)?,
            }
        }
        Ok(())
    }

    /// The operations that hardly a block has.
    #[expect(clippy::wildcard_enum_match_arm, reason = "the others are matched in `run`")]
    fn run_rare(
        &mut self,
        op: &Op,
        parameters: &Parameters,
        modal: &Modal,
        compiler: &LineCompiler,
        words: &mut Words,
    ) -> Result<(), Refusal> {
        match *op {
            Op::Mode(name) => self.stack.push(modal.predefined(name)),
            Op::Internal(name) => self.stack.push(parameters.internal(name)),
            Op::Negate => {
                let value = self.pop();
                self.stack.push(-value);
            }
            Op::Indirect => {
                let number = parameter_number(self.pop(), &compiler.choices).map_err(wrong)?;
                self.stack.push(if is_position(number) {
                    parameters.numbered(number, modal)
                } else {
                    parameters.numbered.get(u32::from(number))
                });
            }
            Op::Arctangent => {
                let x = self.pop();
                let y = self.pop();
                self.stack.push(arithmetic::arctangent(y, x, &compiler.choices));
            }
            Op::ExistsLocal(id) => {
                let sees_all = planted(PlantedFault::ExistsSeesCaller);
                let outside = sees_all && parameters.named.exists_anywhere(id);
                self.push_truth(parameters.named.local(id).is_some() || outside);
            }
            Op::ExistsGlobal(id) => self.push_truth(parameters.named.global(id).is_some()),
            Op::ExistsNumbered => {
                let number = self.pop();
                self.push_truth(quirks::is_parameter(number));
            }
            Op::Absent => return Err(no_such("of this INI entry or pin")),
            Op::G => match g_number(self.pop(), compiler.choices.code_hundredths) {
                Some(code) => push_g(words, code)?,
                None => return Err(Refusal::fault(FaultKind::UnknownCode, "no such G code")),
            },
            Op::M => match m_number(self.pop(), compiler.choices.code_hundredths) {
                Some(code) => push_m(words, code)?,
                None => return Err(Refusal::fault(FaultKind::UnknownCode, "no such M code")),
            },
            Op::Dollar => words.dollar = Some(self.pop()),
            Op::At => words.at = Some(self.pop()),
            Op::Caret => words.caret = Some(self.pop()),
            Op::SetIndirect => {
                let value = self.pop();
                let number = parameter_number(self.pop(), &compiler.choices).map_err(wrong)?;
                if compiler.is_read_only(number) {
                    return Err(Refusal::fault(
                        FaultKind::ReadOnlyParameter,
                        "this parameter is read-only",
                    ));
                }
                self.settings.push(Setting::Numbered(number, value));
            }
            _ => {}
        }
        Ok(())
    }

    fn push_truth(&mut self, holds: bool) {
        self.stack.push(f64::from(u8::from(holds)));
    }
}

#[inline]
fn push_g(words: &mut Words, code: u16) -> Result<(), Refusal> {
    if words.push_g(code) {
        return Ok(());
    }
    Err(Refusal::fault(FaultKind::ModalConflict, "more G codes than there are modal groups"))
}

#[inline]
fn push_m(words: &mut Words, code: u16) -> Result<(), Refusal> {
    if words.push_m(code) {
        return Ok(());
    }
    Err(Refusal::fault(FaultKind::TooManyMCodes, "a block has at most four M codes"))
}

#[cold]
fn wrong((kind, message): arithmetic::ArithmeticError) -> Refusal {
    Refusal::fault(*kind, *message)
}

#[cold]
fn no_such(name: &str) -> Refusal {
    Refusal::fault(FaultKind::NoSuchParameter, alloc::format!("there is no parameter {name}"))
}
