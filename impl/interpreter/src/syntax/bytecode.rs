//! The compiled form of lines: text, names and constants are resolved.
//!
//! A block is a run of operations for a machine with a stack of numbers. Most operations of a plain line carry their
//! number and never touch the stack. The blocks of a loop or sub follow each other in a segment.

use alloc::vec::Vec;

use crate::parameters::{Internal, NameId, Predefined};
use crate::syntax::LineError;

/// "None" among the numbers of this module.
pub(crate) const NONE: u32 = u32::MAX;

/// Operators between two numbers, by rising precedence of their groups (11.4.6).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Binary {
    And,
    Or,
    Xor,
    /// EQ.
    Equal,
    /// NE.
    NotEqual,
    /// GT.
    Greater,
    /// GE.
    GreaterOrEqual,
    /// LT.
    Less,
    /// LE.
    LessOrEqual,
    /// `+`.
    Add,
    /// `-`.
    Subtract,
    /// `*`.
    Multiply,
    /// `/`.
    Divide,
    /// MOD.
    Modulus,
    /// `**`.
    Power,
}

/// Functions of one number (11.4.8).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Function {
    /// ABS.
    Absolute,
    /// ACOS.
    Arccosine,
    /// ASIN.
    Arcsine,
    /// COS.
    Cosine,
    /// EXP.
    Exponential,
    /// FIX.
    RoundDown,
    /// FUP.
    RoundUp,
    Round,
    /// LN.
    Logarithm,
    /// SIN.
    Sine,
    /// SQRT.
    SquareRoot,
    /// TAN.
    Tangent,
}

/// One operation. "Pushes" and "takes" refer to the stack.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Op {
    /// Pushes a number.
    Number(f64),
    /// Pushes a numbered parameter.
    Numbered(u16),
    /// Pushes a local named parameter.
    Local(NameId),
    /// Pushes a global named parameter.
    Global(NameId),
    /// Pushes a predefined value of the modes.
    Mode(Predefined),
    /// Pushes a predefined value of the interpreter itself.
    Internal(Internal),
    /// Names a parameter that cannot exist: an INI entry or a pin that is not there.
    Absent,
    /// Takes a parameter's number, pushes its value.
    Indirect,
    /// Takes two numbers, pushes one.
    Binary(Binary),
    /// Takes the left number, pushes the result with this one on the right.
    BinaryNumber(Binary, f64),
    /// Takes the left number, pushes the result with this parameter on the right.
    BinaryNumbered(Binary, u16),
    /// Takes a number, pushes another.
    Function(Function),
    /// Takes y and x, pushes an angle.
    Arctangent,
    /// Takes a number, pushes its negative.
    Negate,
    /// Pushes whether a local parameter exists.
    ExistsLocal(NameId),
    /// Pushes whether a global parameter exists.
    ExistsGlobal(NameId),
    /// Takes a number, pushes whether a parameter has it.
    ExistsNumbered,
    /// Takes the value of a word; the letter's place from 0 for A.
    Word(u8),
    /// A word with its number.
    WordNumber(u8, f64),
    /// A word with a parameter.
    WordNumbered(u8, u16),
    /// Takes a G code.
    G,
    /// A G code in tenths.
    GCode(u16),
    /// Takes an M code.
    M,
    MCode(u16),
    /// Takes the value of `$`.
    Dollar,
    /// Takes the value of `@`.
    At,
    /// Takes the value of `^`.
    Caret,
    /// Takes the value of a numbered parameter.
    SetNumbered(u16),
    /// Takes a value, then the parameter's number.
    SetIndirect,
    /// Takes the value of a local parameter.
    SetLocal(NameId),
    /// Takes the value of a global parameter.
    SetGlobal(NameId),
}

/// Refers to a parameter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum ParameterRef {
    /// By a number that is known.
    Numbered(u16),
    /// By a number that the operations push.
    Indirect,
    /// By name, local.
    Local(NameId),
    /// By name, global.
    Global(NameId),
    /// A predefined name that the modes answer.
    Mode(Predefined),
    /// A predefined name that the interpreter answers.
    Internal(Internal),
    /// An INI entry.
    Entry(f64),
    /// An INI entry or pin that is not there.
    Absent,
}

/// The keyword of an o-word (11.7).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Keyword {
    Sub,
    EndSub,
    Return,
    Call,
    If,
    ElseIf,
    Else,
    EndIf,
    /// `while`: the head of a loop or the end of a do.
    While,
    EndWhile,
    Do,
    Repeat,
    EndRepeat,
    Break,
    Continue,
    /// A number alone: the beginning of a numbered program.
    Program,
    /// Not an o-word that the documents know; the block is refused when it is executed.
    Unknown,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct OWord {
    pub(crate) keyword: Keyword,
    /// Its label; [`NONE`] where it is computed, by the first number that the block's operations push.
    pub(crate) label: NameId,
    /// How many numbers the operations push after the label: arguments, a condition, a count, a returned value.
    pub(crate) values: u8,
    /// The next block of the segment with the same label; [`NONE`] where there is none. Where the label is computed:
    /// one past the last of the block's operations that compute it.
    pub(crate) next: u32,
}

/// The kind of a block.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Kind {
    /// Words, settings of parameters, comments.
    Plain,
    Control(OWord),
    /// A sub in a segment of its own.
    Definition {
        /// The sub's label.
        label: NameId,
        segment: u32,
    },
    /// The percent line that ends a file.
    Percent,
}

/// One line's worth.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Block {
    /// Line in its file, from 1.
    pub(crate) line: u32,
    /// First operation.
    pub(crate) first: u32,
    /// One past the last operation.
    pub(crate) end: u32,
    pub(crate) kind: Kind,
    /// The comment that acts; [`NONE`] for none.
    pub(crate) comment: u32,
    /// Whether it holds a comment and nothing else.
    pub(crate) bare: bool,
    /// Why it cannot be executed; [`NONE`] where it can.
    pub(crate) refused: u32,
    /// Where its line begins in the file, bytes.
    pub(crate) offset: u64,
}

/// The action of an active comment.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Act {
    /// MSG.
    Message,
    Debug,
    Print,
    Log,
    LogOpen,
    LogAppend,
    LogClose,
    ProbeOpen,
    ProbeClose,
    Abort,
}

/// A part of a message.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Piece {
    /// Characters of the segment's texts.
    Text(u32, u32),
    /// The value of a numbered parameter.
    Numbered(u32),
    /// The value of a local parameter.
    Local(NameId),
    /// The value of a global parameter.
    Global(NameId),
    /// A predefined value of the modes.
    Mode(Predefined),
    /// A predefined value of the interpreter itself.
    Internal(Internal),
    /// An entry of the INI file, by its place among the segment's constants.
    Constant(u32),
    /// A parameter that cannot exist.
    Absent,
    /// From here on, values have so many decimals.
    Decimals(u8),
}

/// An active comment.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Comment {
    /// The action.
    pub(crate) act: Act,
    /// First piece of its text.
    pub(crate) first: u32,
    /// One past the last piece.
    pub(crate) end: u32,
}

/// Blocks that are stored together: a loop of the main program, a sub, or the one block that is being read.
#[derive(Clone, Debug, Default)]
pub(crate) struct CodeSegment {
    /// The blocks in the order of the text.
    pub(crate) blocks: Vec<Block>,
    /// Operations of all blocks.
    pub(crate) ops: Vec<Op>,
    /// Active comments.
    pub(crate) comments: Vec<Comment>,
    /// Parts of active comments.
    pub(crate) pieces: Vec<Piece>,
    /// Characters of active comments.
    pub(crate) texts: Vec<u8>,
    /// Values of INI entries in comments.
    pub(crate) constants: Vec<f64>,
    /// Why blocks cannot be executed.
    pub(crate) refusals: Vec<LineError>,
    /// Whether a label of a control block is computed: then labels are compared as they come.
    pub(crate) computed: bool,
    /// The file's number.
    pub(crate) file: u32,
    /// The line of another sub that begins within this one, which therefore cannot be defined.
    pub(crate) inner: Option<u32>,
}

impl CodeSegment {
    /// Removes everything and keeps the memory.
    pub(crate) fn clear(&mut self) {
        self.blocks.clear();
        self.ops.clear();
        self.comments.clear();
        self.pieces.clear();
        self.texts.clear();
        self.constants.clear();
        self.refusals.clear();
        self.computed = false;
        self.inner = None;
    }

    /// A block by its place.
    #[inline]
    pub(crate) fn block(&self, place: u32) -> Option<&Block> {
        usize::try_from(place).ok().and_then(|place| self.blocks.get(place))
    }

    /// A block's operations.
    #[inline]
    pub(crate) fn ops_of(&self, block: &Block) -> &[Op] {
        let first = usize::try_from(block.first).unwrap_or(usize::MAX);
        let end = usize::try_from(block.end).unwrap_or(usize::MAX);
        self.ops.get(first..end).unwrap_or(&[])
    }

    /// Bytes that it takes.
    pub(crate) fn bytes(&self) -> usize {
        let of = |count: usize, size: usize| count.saturating_mul(size);
        of(self.blocks.len(), size_of::<Block>())
            .saturating_add(of(self.ops.len(), size_of::<Op>()))
            .saturating_add(of(self.pieces.len(), size_of::<Piece>()))
            .saturating_add(of(self.comments.len(), size_of::<Comment>()))
            .saturating_add(of(self.refusals.len(), size_of::<LineError>()))
            .saturating_add(self.texts.len())
    }

    /// Joins each control block to the next one with its label.
    pub(crate) fn join_labels(&mut self) {
        let mut labels: Vec<(NameId, u32)> = (0_u32..)
            .zip(self.blocks.iter())
            .filter_map(|(place, block)| match block.kind {
                Kind::Control(o_word) if o_word.label != NONE => Some((o_word.label, place)),
                Kind::Control(_) | Kind::Plain | Kind::Definition { .. } | Kind::Percent => None,
            })
            .collect();
        labels.sort_unstable();
        for pair in labels.windows(2) {
            let [(label, place), (next_label, next)] = pair else { continue };
            let block = usize::try_from(*place).ok().and_then(|place| self.blocks.get_mut(place));
            if let (Some(Block { kind: Kind::Control(o_word), .. }), true) =
                (block, label == next_label)
            {
                o_word.next = *next;
            }
        }
    }
}
