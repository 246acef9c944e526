//! Faults: why a controller refuses a block. Kinds are compared; messages are for people.

use alloc::string::String;

use crate::block::{BlockLocation, Span};
use crate::words::words;

words! {
    /// The kind of a fault.
    pub enum FaultKind {
        /// A character that belongs nowhere.
        BadCharacter = "bad_character",
        /// More characters in a line than are allowed.
        LineTooLong = "line_too_long",
        /// A malformed number.
        BadNumber = "bad_number",
        /// An expression that is not closed, or not one.
        BadExpression = "bad_expression",
        /// A comment that is not closed, or nested.
        BadComment = "bad_comment",
        /// A block of no other wrong form.
        BadBlock = "bad_block",
        /// The file ends without a program end or a second percent sign.
        MissingEnd = "missing_end",
        /// Division by zero.
        DivideByZero = "divide_by_zero",
        /// An argument outside of a function's domain, or a result that is not a number.
        OutOfDomain = "out_of_domain",
        /// A parameter number outside of the range.
        ParameterOutOfRange = "parameter_out_of_range",
        /// A parameter number that is not close to an integer.
        ParameterNotInteger = "parameter_not_integer",
        /// An assignment to a read-only parameter.
        ReadOnlyParameter = "read_only_parameter",
        /// A named parameter that does not exist.
        NoSuchParameter = "no_such_parameter",
        /// A letter twice in a block.
        RepeatedWord = "repeated_word",
        /// A G or M code that does not exist.
        UnknownCode = "unknown_code",
        /// Two codes of one modal group in a block, or codes that exclude each other.
        ModalConflict = "modal_conflict",
        /// More M words in a block than are allowed.
        TooManyMCodes = "too_many_m_codes",
        /// A word that nothing in the block uses.
        UnusedWord = "unused_word",
        /// A word that a code needs.
        MissingWord = "missing_word",
        /// A word's value outside of its range.
        WordOutOfRange = "word_out_of_range",
        /// A word's value that is not close to an integer.
        NotAnInteger = "not_an_integer",
        /// Axis words without a code that uses them, or used by two.
        AxisWords = "axis_words",
        /// A feed move without a feed rate.
        ZeroFeed = "zero_feed",
        /// A code that needs a turning spindle or a speed.
        ZeroSpeed = "zero_speed",
        /// A subroutine defined within another.
        NestedSub = "nested_sub",
        /// A subroutine defined twice.
        DuplicateSub = "duplicate_sub",
        /// A label used for two structures.
        DuplicateLabel = "duplicate_label",
        /// A label that belongs to no open structure of its kind.
        UnknownLabel = "unknown_label",
        /// A return or endsub outside of a subroutine.
        OutsideSub = "outside_sub",
        /// A subroutine that is not found.
        UnknownSub = "unknown_sub",
        /// Calls nested too deep.
        TooManyLevels = "too_many_levels",
        /// More arguments than a call takes.
        TooManyArguments = "too_many_arguments",
        /// Subroutines of one style called or ended in the other.
        MixedStyles = "mixed_styles",
        /// M98 or M99 where they are disabled.
        FanucDisabled = "fanuc_disabled",
        /// A restore without anything saved at this call level.
        NothingSaved = "nothing_saved",
        /// A tool that the tool table does not hold.
        ToolNotFound = "tool_not_found",
        /// A spindle that the machine does not have.
        SpindleOutOfRange = "spindle_out_of_range",
        /// A code that is not allowed while cutter compensation is on.
        CompensationActive = "compensation_active",
        /// The program itself raised the error: (ABORT,…).
        AbortedByProgram = "aborted_by_program",
        /// An axis that the machine does not have.
        NoSuchAxis = "no_such_axis",
        /// A file that is missing or unreadable.
        BadFile = "bad_file",
        /// An arc whose words give no arc.
        BadArc = "bad_arc",
        /// A cutter path that gouges, or an impossible compensated corner.
        Gouging = "gouging",
        /// A probe that does not or should not touch.
        Probe = "probe",
        /// A position beyond a limit.
        BeyondLimit = "beyond_limit",
        /// An input or output number that the machine does not have.
        NoSuchInputOrOutput = "no_such_input_or_output",
        /// A spindle that did not reach its angle, or reported a fault.
        Orient = "orient",
        /// A user-defined code that failed.
        UserCode = "user_code",
        /// A mode of the controller in which this is not allowed.
        ControllerMode = "controller_mode",
        /// A macro call that is not allowed (NCT).
        Macro = "macro",
        /// A statement of a wrong form (GPP; NCT: 3064 BAD MACRO STATEMENT).
        Statement = "statement",
        /// A declaration that is not allowed, or not here (GPP).
        Declaration = "declaration",
        /// A variable that is not declared (GPP).
        NoSuchVariable = "no_such_variable",
        /// A text where a number belongs, or a number where a text does (GPP).
        WrongType = "wrong_type",
        /// More variables than are allowed (GPP).
        TooManyVariables = "too_many_variables",
        /// A text of more characters than are allowed (GPP).
        TextTooLong = "text_too_long",
        /// A number with more digits than its format has (GPP).
        NumberTooLong = "number_too_long",
        /// An index that leads to no member of the array (GPP).
        IndexOutOfRange = "index_out_of_range",
        /// A variable that has no value yet (GPP).
        NoValue = "no_value",
    }
}

/// Why a block was refused, and where.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(deny_unknown_fields)
)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Fault {
    /// Its kind, if the controller reports it; compared.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub kind: Option<FaultKind>,
    /// The refused block, if the controller reports it; compared.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub block: Option<BlockLocation>,
    /// The part of the block's text that is at fault; never compared.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub span: Option<Span>,
    /// A text for people; never compared.
    pub message: String,
}
