//! What an id stands for: a rule, a choice.

/// What accepts or refuses a block: a rule; or a choice, where an option of it does so by itself; or a dialect.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Rule(pub(super) u16);

/// A named point where documents differ or leave something open. Each implementation is a type of options.
pub trait Choice: Copy + PartialEq + 'static {
    /// Its number among all choices, from 0.
    const NUMBER: u16;
    /// Its options in the order of its page; the first one is the default.
    const OPTIONS: &'static [Self];

    /// The place of an option among all of its choice.
    fn place(self) -> u8;
}

/// The page of a choice.
#[derive(Clone, Copy, Debug)]
pub struct Page {
    /// Its id.
    pub id: &'static str,
    /// The names of its options; the first one is the default.
    pub options: &'static [&'static str],
}
