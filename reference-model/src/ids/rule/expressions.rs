//! Each rule of `expressions`; written from the pages by `cargo run -p gaugeblock-suite --bin model-ids`.

rules! {
    super::first::EXPRESSIONS;

    /// ABS gives the absolute value.
    ABSOLUTE = "expressions.absolute",
    /// Addition and subtraction come before the comparisons.
    ADD_BEFORE_COMPARE = "expressions.add-before-compare",
    /// SIN, COS and TAN take degrees; ASIN, ACOS and ATAN give degrees.
    ANGLES = "expressions.angles",
    /// ATAN takes two bracketed arguments with a slash between them and distinguishes all four quadrants.
    ARCTANGENT = "expressions.arctangent",
    /// Plus, minus, asterisk and slash add, subtract, multiply and divide real numbers.
    ARITHMETIC = "expressions.arithmetic",
    /// The comparisons come before AND, OR and XOR.
    COMPARE_BEFORE_LOGICAL = "expressions.compare-before-logical",
    /// A division by zero gives no number and is refused.
    DIVISION_BY_ZERO = "expressions.division-by-zero",
    /// A function of an argument outside its domain gives no number and is refused.
    DOMAIN = "expressions.domain",
    /// EXISTS is 1 when the named parameter exists and 0 when it does not.
    EXISTS = "expressions.exists",
    /// EXISTS of a numbered parameter or of an expression is refused.
    EXISTS_ARGUMENT = "expressions.exists-argument",
    /// EXP raises e to the given power and LN is its inverse.
    EXPONENTIAL = "expressions.exponential",
    /// A function takes its argument in brackets.
    FUNCTION_BRACKETS = "expressions.function-brackets",
    /// An expression that lacks an operand or an operator is refused.
    INCOMPLETE = "expressions.incomplete",
    /// Of operations of one group the one on the left comes first, powers and logical operations included.
    LEFT_FIRST = "expressions.left-first",
    /// AND, OR and XOR take any real numbers; zero is false, every other number is true.
    LOGICAL = "expressions.logical",
    /// Whether AND, OR and XOR come after additions and subtractions, or from left to right with them, is a
    /// choice.
    LOGICAL_PRECEDENCE = "expressions.logical-precedence",
    /// MOD gives the remainder of a division of any real numbers.
    MODULUS = "expressions.modulus",
    /// A modulus of zero gives no number and is refused.
    MODULUS_ZERO = "expressions.modulus-zero",
    /// Multiplication, division and modulus come before addition and subtraction.
    MULTIPLY_BEFORE_ADD = "expressions.multiply-before-add",
    /// An expression may be part of another expression and gives its value there.
    NESTED = "expressions.nested",
    /// Binary operators are allowed inside expressions only.
    OPERATORS_IN_BRACKETS = "expressions.operators-in-brackets",
    /// Two asterisks raise the number on the left to the power on the right.
    POWER = "expressions.power",
    /// A power that is not a real number is refused.
    POWER_DOMAIN = "expressions.power-domain",
    /// The power comes before multiplication, division and modulus.
    POWER_FIRST = "expressions.power-first",
    /// The expressions of a line are evaluated when it is read, before anything on it is executed.
    READ_BEFORE_EXECUTION = "expressions.read-before-execution",
    /// EQ, NE, GT, GE, LT and LE compare two numbers.
    RELATIONAL = "expressions.relational",
    /// FIX rounds down, FUP rounds up, also below zero; ROUND goes to the nearest integer.
    ROUNDING_FUNCTIONS = "expressions.rounding-functions",
    /// SQRT gives the square root.
    SQUARE_ROOT = "expressions.square-root",
    /// EQ and NE take two numbers as equal when they differ by less than 0.0001.
    TOLERANCE = "expressions.tolerance",
    /// An expression without its closing bracket, or a closing bracket without an opening one, is refused.
    UNBALANCED = "expressions.unbalanced",
    /// An operator or function that the tables do not list is refused.
    UNKNOWN_OPERATOR = "expressions.unknown-operator",
}
