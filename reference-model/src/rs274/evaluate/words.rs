//! A block's words with their values.

use gaugeblock_vocabulary::Sorted;

use crate::rs274::parameters::Name;
use crate::rs274::text::Comment;

/// A block's words with their values.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Words {
    /// G codes in tenths and in the order of the text: 10 is G1, 382 is G38.2.
    pub g_tenths: Vec<u32>,
    /// M codes in the order of the text.
    pub m: Vec<u32>,
    /// The other words by letter: lower case, `$`, `@`, `^`.
    pub letters: Sorted<char, f64>,
    /// Settings in the order of the text; of several for one parameter the last one counts.
    pub settings: Vec<(Name, f64)>,
    /// The comment that may be active.
    pub comment: Option<Comment>,
}
