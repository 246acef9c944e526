//! Parts of a run, for many machines: together they do everything exactly once.

use std::fmt;
use std::str::FromStr;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A part: of pieces in a row each `of`-th, from the `index`-th; every piece is in exactly one part.
#[derive(
    Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize, JsonSchema,
)]
#[serde(try_from = "String", into = "String")]
#[schemars(with = "String")]
pub struct Shard {
    /// From 1 to `of`.
    pub index: u64,
    /// How many parts there are.
    pub of: u64,
}

impl Shard {
    /// All of it.
    pub const WHOLE: Self = Self { index: 1, of: 1 };

    /// The number of this part's n-th piece, both from 0.
    pub fn nth(self, n: u64) -> u64 {
        n * self.of + self.index - 1
    }

    /// Whether the piece of this number, from 0, is in this part.
    pub fn has(self, number: usize) -> bool {
        u64::try_from(number).is_ok_and(|number| number % self.of == self.index - 1)
    }
}

impl fmt::Display for Shard {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}/{}", self.index, self.of)
    }
}

impl FromStr for Shard {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let wrong = || "I/N, with I from 1 to N, such as 3/8".to_owned();
        let (index, of) = text.split_once('/').ok_or_else(wrong)?;
        let (index, of) = (index.parse().map_err(|_| wrong())?, of.parse().map_err(|_| wrong())?);
        if (1..=of).contains(&index) { Ok(Self { index, of }) } else { Err(wrong()) }
    }
}

impl TryFrom<String> for Shard {
    type Error = String;

    fn try_from(text: String) -> Result<Self, String> {
        text.parse()
    }
}

impl From<Shard> for String {
    fn from(shard: Shard) -> Self {
        shard.to_string()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_piece_is_in_exactly_one_part() {
        for of in 1..=7 {
            let parts: Vec<_> = (1..=of).map(|index| Shard { index, of }).collect();
            for piece in 0..50 {
                assert_eq!(parts.iter().filter(|part| part.has(piece)).count(), 1);
            }
            assert!(
                parts
                    .iter()
                    .all(|part| (0..9).all(|n| part.has(usize::try_from(part.nth(n)).unwrap())))
            );
        }
    }

    #[test]
    fn a_part_is_written_as_it_is_read() {
        assert_eq!("3/8".parse::<Shard>().unwrap().to_string(), "3/8");
        for wrong in ["0/8", "9/8", "3", "a/b", "1/0", "-1/3", ""] {
            assert!(wrong.parse::<Shard>().is_err(), "{wrong}");
        }
    }
}
