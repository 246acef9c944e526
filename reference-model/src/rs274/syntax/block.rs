//! The parts of a block, before anything is evaluated.

use gaugeblock_vocabulary::Span;

use crate::rs274::text::Comment;

/// A block: one line's worth of program.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Block {
    /// Whether it began with a slash.
    pub block_delete: bool,
    /// Its line number (N word), which means nothing.
    pub line_number: Option<String>,
    /// Its O-word; then there are no words and no settings.
    pub o_word: Option<OWord>,
    /// Its words in the order of the text.
    pub words: Vec<Word>,
    /// Its parameter settings in the order of the text.
    pub settings: Vec<Setting>,
    /// Its last comment, the only one that can be active.
    pub comment: Option<Comment>,
}

/// A letter and its value.
#[derive(Clone, Debug, PartialEq)]
pub struct Word {
    /// Lower-case letter, or `$`, `@`, `^`.
    pub letter: char,
    /// Its value.
    pub value: Expression,
    /// Its place in the line.
    pub span: Span,
}

/// `#3=15`: a value for a parameter.
#[derive(Clone, Debug, PartialEq)]
pub struct Setting {
    /// Which parameter.
    pub target: Parameter,
    /// Its new value.
    pub value: Expression,
    /// Its place in the line.
    pub span: Span,
}

/// A parameter as it is named in a block.
#[derive(Clone, Debug, PartialEq)]
pub enum Parameter {
    /// `#31`, `##2`, `#[1+2]`: the number is a value.
    Numbered(Box<Expression>),
    /// `#<name>`: lower case, without blanks; global when it begins with an underscore.
    Named(String),
}

/// Something that has a value.
#[derive(Clone, Debug, PartialEq)]
pub enum Expression {
    /// A number.
    Number(f64),
    /// A parameter's value.
    Parameter(Parameter),
    /// A sign before a value.
    Negate(Box<Self>),
    /// A function of one argument.
    Function(Function, Box<Self>),
    /// `ATAN[y]/[x]`.
    ArcTangent(Box<Self>, Box<Self>),
    /// `EXISTS[#<name>]`.
    Exists(Parameter),
    /// Two values and what is between them.
    Binary(Operator, Box<Self>, Box<Self>),
}

/// A function of one argument; angles are degrees.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Function {
    /// ABS.
    Absolute,
    /// ACOS.
    ArcCosine,
    /// ASIN.
    ArcSine,
    /// COS.
    Cosine,
    /// EXP.
    Exponential,
    /// FIX: down to an integer.
    RoundDown,
    /// FUP: up to an integer.
    RoundUp,
    /// ROUND: to the nearest integer.
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

/// An operator between two values. Each group has a higher precedence than the next.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Operator {
    /// `**`.
    Power,
    /// `*`.
    Multiply,
    /// `/`.
    Divide,
    /// MOD.
    Modulus,
    /// `+`.
    Add,
    /// `-`.
    Subtract,
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
    /// AND.
    And,
    /// OR.
    Or,
    /// XOR.
    ExclusiveOr,
}

/// An O-word: a label and what it does.
#[derive(Clone, Debug, PartialEq)]
pub struct OWord {
    /// The label.
    pub label: Label,
    /// What it does.
    pub keyword: Keyword,
    /// Bracketed values after the keyword: a condition, a count, arguments, a return value.
    pub arguments: Vec<Expression>,
    /// Its place in the line.
    pub span: Span,
}

/// The label after the letter O.
#[derive(Clone, Debug, PartialEq)]
pub enum Label {
    /// `o100`, `o#1`, `o[#1+2]`: a number, perhaps computed.
    Number(Expression),
    /// `o<name>`: lower case, without blanks.
    Name(String),
}

/// What an O-word does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Keyword {
    /// `sub`.
    Sub,
    /// `endsub`.
    EndSub,
    /// `call`.
    Call,
    /// `return`.
    Return,
    /// `if`.
    If,
    /// `elseif`.
    ElseIf,
    /// `else`.
    Else,
    /// `endif`.
    EndIf,
    /// `while`: a loop's head, or the end of a `do`.
    While,
    /// `endwhile`.
    EndWhile,
    /// `do`.
    Do,
    /// `repeat`.
    Repeat,
    /// `endrepeat`.
    EndRepeat,
    /// `break`.
    Break,
    /// `continue`.
    Continue,
    /// Nothing: a Fanuc-style program number.
    ProgramNumber,
}
