//! How the documents are read: the options of the choices in this language.

use gaugeblock_vocabulary::Options;

/// Every choice that the model reads, with its options; the first is the default.
pub const CHOICES: &[(&str, &[&str])] = &[
    ("nct.angles", &["degrees", "radians"]),
    ("nct.block-arguments", &["left-out", "own-numbers"]),
    ("nct.cancel-without-call", &["no-effect", "refused"]),
    ("nct.depth", &["four", "five"]),
    ("nct.dwell", &["seconds", "milliseconds"]),
    ("nct.fix-fup", &["by-magnitude", "floor-and-ceiling"]),
    ("nct.functions", &["usual", "documented"]),
    ("nct.loops", &["accepted", "refused"]),
    ("nct.main-return", &["begins-again", "refused"]),
    ("nct.repeated-locals", &["kept", "reloaded"]),
    ("nct.set-advance", &["by-letter", "by-set"]),
    ("nct.thirty-two-bits", &["signed", "unsigned"]),
];

/// The options that apply to a run. Each names the option that is not the default.
#[derive(Clone, Copy, Debug)]
pub struct Choices {
    /// Angles of functions are in radians.
    pub radians: bool,
    /// G, L, N and P of a block that is taken as arguments have variables of their own.
    pub own_numbers: bool,
    /// G67 without a modal call is refused.
    pub cancel_refused: bool,
    /// Five macro levels and fifteen calls in all, instead of four and eight.
    pub five_levels: bool,
    /// P of G4 is in milliseconds.
    pub milliseconds: bool,
    /// FIX and FUP round down and up, whatever the sign.
    pub floor_and_ceiling: bool,
    /// No function is known but those that a document names.
    pub documented_functions: bool,
    /// WHILE, DO and END are refused.
    pub no_loops: bool,
    /// M99 in the main program is refused.
    pub main_return_refused: bool,
    /// Each repetition of a call begins with the arguments again.
    pub reloaded: bool,
    /// A letter that stands again opens a new set for all three.
    pub by_set: bool,
    /// Thirty-two bits are a number without a sign.
    pub unsigned: bool,
}

impl Choices {
    /// Reads the options; what is not listed has its default.
    pub fn new(options: &Options) -> Self {
        Self {
            radians: options.is("nct.angles", "radians"),
            own_numbers: options.is("nct.block-arguments", "own-numbers"),
            cancel_refused: options.is("nct.cancel-without-call", "refused"),
            five_levels: options.is("nct.depth", "five"),
            milliseconds: options.is("nct.dwell", "milliseconds"),
            floor_and_ceiling: options.is("nct.fix-fup", "floor-and-ceiling"),
            documented_functions: options.is("nct.functions", "documented"),
            no_loops: options.is("nct.loops", "refused"),
            main_return_refused: options.is("nct.main-return", "refused"),
            reloaded: options.is("nct.repeated-locals", "reloaded"),
            by_set: options.is("nct.set-advance", "by-set"),
            unsigned: options.is("nct.thirty-two-bits", "unsigned"),
        }
    }
}
