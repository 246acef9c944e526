//! The state of compiling lines: the names of the whole run, and the choices of the dialect.

use alloc::collections::BTreeMap;
use alloc::string::String;
use alloc::vec::Vec;

use gaugeblock_vocabulary::Machine;

use crate::limits::{Limit, Limits};
use crate::parameters::{ItemName, Names};
use crate::syntax::Choices;
use crate::syntax::bytecode::ParameterRef;

/// Compiles lines. It holds the names of the whole run.
#[derive(Clone, Debug)]
pub(crate) struct LineCompiler {
    /// Named parameters.
    pub(crate) names: Names,
    /// Labels of o-words.
    pub(crate) labels: Names,
    /// Entries of the INI file that can be read.
    pub(crate) ini: BTreeMap<String, f64>,
    /// HAL items that can be read, in the order of their values. A program reads few of them, and looks each up once.
    pub(crate) items: Vec<ItemName>,
    /// Whether HAL items can be read.
    pub(crate) items_enabled: bool,
    /// The choices of the dialect.
    pub(crate) choices: Choices,
    /// Whether blocks that begin with a slash are skipped.
    pub(crate) block_delete: bool,
    /// Whether a line that holds a plain comment only is a block, which does nothing.
    pub(crate) report_comments: bool,
    /// Whether the label of an o-word is being read.
    pub(crate) in_label: bool,
    /// The limit that the line just compiled exceeds.
    pub(crate) limit_exceeded: Option<Limit>,
    /// Most named parameters.
    pub(crate) names_max: u32,
    /// Deepest nesting of brackets.
    pub(crate) bracket_depth: u32,
    /// Scratch memory for a name.
    pub(crate) scratch: String,
    /// Scratch memory for a line with blanks in the place of its comments.
    pub(crate) uncommented: Vec<u8>,
    /// The reference of each named parameter, by its number.
    pub(crate) parameter_refs: Vec<ParameterRef>,
}

impl LineCompiler {
    /// A compiler without names.
    pub(crate) fn new(machine: &Machine, choices: Choices, limits: &Limits) -> Self {
        Self {
            names: Names::new(),
            labels: Names::new(),
            ini: if enables(machine, "[RS274NGC]INI_VARS") {
                machine.ini.clone()
            } else {
                BTreeMap::new()
            },
            items: Vec::new(),
            items_enabled: enables(machine, "[RS274NGC]HAL_PIN_VARS"),
            choices,
            block_delete: false,
            report_comments: false,
            in_label: false,
            limit_exceeded: None,
            names_max: limits.named_parameters,
            bracket_depth: limits.bracket_depth,
            scratch: String::new(),
            uncommented: Vec::new(),
            parameter_refs: Vec::new(),
        }
    }
}

/// Whether a switch of the INI file is on; it is on where the file does not set it (4.4.2.6).
fn enables(machine: &Machine, entry: &str) -> bool {
    machine.ini.get(entry).is_none_or(|value| value.abs() > 0.0)
}
