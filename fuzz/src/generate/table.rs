//! The table of all statements.

use super::statements;
use super::writer::Statement;

/// All statements, by chapter.
pub const TABLE: &[&[Statement]] = &[
    statements::motion::STATEMENTS,
    statements::modes::STATEMENTS,
    statements::spindle::STATEMENTS,
    statements::tool::STATEMENTS,
    statements::outside::STATEMENTS,
    statements::parameters::STATEMENTS,
    statements::control::STATEMENTS,
    statements::text::STATEMENTS,
    statements::offsets::STATEMENTS,
    statements::arcs::STATEMENTS,
    statements::cycles::STATEMENTS,
    statements::compensation::STATEMENTS,
    statements::turning::STATEMENTS,
];
