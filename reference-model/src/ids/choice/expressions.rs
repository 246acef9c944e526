//! Each choice of `expressions`; written from the pages by `cargo run -p gaugeblock-suite --bin model-ids`.

choices! {
    super::first::EXPRESSIONS;

    /// The turn in which ATAN gives its angle. The document says that it distinguishes four quadrants.
    ArctangentRange = "expressions.arctangent-range" {
        /// above -180 up to 180 degrees
        HalfTurns = "half-turns",
        /// from 0 to below 360 degrees
        FullTurn = "full-turn",
    }

    /// When AND, OR and XOR are performed: LinuxCNC puts them after the comparisons, NIST among additions and
    /// subtractions.
    LogicalPrecedence = "expressions.logical-precedence" {
        /// after additions, subtractions and comparisons
        AfterComparisons = "after-comparisons",
        /// with additions and subtractions, from left to right
        WithAddition = "with-addition",
    }

    /// The sign of MOD for a negative number on its left. The document is silent.
    ModulusSign = "expressions.modulus-sign" {
        /// the remainder is never negative
        NotNegative = "not-negative",
        /// the remainder has the sign of the number on the left
        Dividend = "dividend",
    }

    /// Whether a zero has a sign, which decides the quadrant of ATAN. A number may have a sign, and no
    /// sentence says in which quadrant a zero is.
    NegativeZero = "expressions.negative-zero" {
        /// there is one zero
        None = "none",
        /// a negative zero is to the left of, and below, the other one
        Kept = "kept",
    }

    /// Whether GT, GE, LT and LE too take numbers as equal that differ by less than 0.0001. The document
    /// speaks of equality and inequality.
    OrderTolerance = "expressions.order-tolerance" {
        /// they compare the numbers as they are
        Exact = "exact",
        /// numbers this close are equal, hence neither greater nor less
        Tolerant = "tolerant",
    }

    /// Where ROUND goes from halfway between two integers. The document is silent.
    RoundHalf = "expressions.round-half" {
        /// away from zero
        Away = "away",
        /// to the greater one
        Up = "up",
        /// to the even one
        Even = "even",
    }

    /// The number that a true comparison or logical operation gives. The document says only which numbers
    /// count as true.
    TrueValue = "expressions.true-value" {
        /// 1
        One = "one",
        /// -1
        MinusOne = "minus-one",
    }

    /// Whether a sign is allowed before a parameter, an expression or a function. The document knows a sign
    /// only as a part of a number.
    UnaryMinus = "expressions.unary-minus" {
        /// before a parameter, an expression or a function minus negates it; a number has one sign of its own
        /// and no more
        Accepted = "accepted",
        /// a sign belongs to a number only
        Refused = "refused",
    }
}
