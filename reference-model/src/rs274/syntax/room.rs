//! Room for what the parser makes of a line.

use crate::ids::Rule;
use crate::rs274::text::Glyph;

/// What the parser of a line needs room for; the parser of the next line takes it over.
#[derive(Debug, Default)]
pub struct Room {
    /// The characters of the line that count.
    pub(crate) glyphs: Vec<Glyph>,
    /// The digits of a number.
    pub(super) digits: String,
    /// Rules that decided something; they count when the whole line is accepted.
    pub(super) reached: Vec<Rule>,
}

impl Clone for Room {
    /// The content is temporary, so a copy is empty.
    fn clone(&self) -> Self {
        Self::default()
    }
}
