//! How the documents are read: the options of the choices in this language.

use gaugeblock_vocabulary::Options;

/// Every choice that the model reads, with its options; the first is the default.
pub const CHOICES: &[(&str, &[&str])] = &[
    ("gpp.array-members", &["go-off", "stay-on"]),
    ("gpp.assigned-again", &["if-changed", "always", "first-only"]),
    ("gpp.default-modality", &["non-modal", "by-format"]),
    ("gpp.newline", &["each", "lazy"]),
    ("gpp.off-modal", &["printed", "left-out"]),
    ("gpp.old-words", &["refused", "accepted"]),
    ("gpp.tie", &["away", "even"]),
    ("gpp.without-value", &["refused", "zero"]),
];

/// What turns a variable on that has a value and is assigned again.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AssignedAgain {
    /// A value that is printed otherwise.
    IfChanged,
    /// Any value.
    Always,
    /// None.
    FirstOnly,
}

/// Where a number that lies in the middle is rounded to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Tie {
    /// Away from zero.
    Away,
    /// To the even digit.
    Even,
}

/// The options that apply to a run.
#[derive(Clone, Copy, Debug)]
pub struct Choices {
    /// A printed member of a modal array stays on.
    pub members_stay_on: bool,
    /// What turns a variable on again.
    pub assigned_again: AssignedAgain,
    /// The modality of a variable is that of its format until it is declared.
    pub modality_by_format: bool,
    /// A newline waits until something is printed.
    pub lazy_newline: bool,
    /// A modal variable that is off is left out.
    pub off_modal_left_out: bool,
    /// Words of the old GPP are understood.
    pub old_words: bool,
    /// How a tie is rounded.
    pub tie: Tie,
    /// What has no value counts as zero, or as the empty text.
    pub without_value_is_zero: bool,
}

impl Choices {
    /// Reads the options; what is not listed has its default.
    pub fn new(options: &Options) -> Self {
        let assigned_again = match options.get("gpp.assigned-again") {
            Some("always") => AssignedAgain::Always,
            Some("first-only") => AssignedAgain::FirstOnly,
            _ => AssignedAgain::IfChanged,
        };
        Self {
            members_stay_on: options.is("gpp.array-members", "stay-on"),
            assigned_again,
            modality_by_format: options.is("gpp.default-modality", "by-format"),
            lazy_newline: options.is("gpp.newline", "lazy"),
            off_modal_left_out: options.is("gpp.off-modal", "left-out"),
            old_words: options.is("gpp.old-words", "accepted"),
            tie: if options.is("gpp.tie", "even") { Tie::Even } else { Tie::Away },
            without_value_is_zero: options.is("gpp.without-value", "zero"),
        }
    }
}
