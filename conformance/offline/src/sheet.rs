//! An answer sheet: the text that a person fills in, and what it holds when it comes back.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write as _;

use gaugeblock_vocabulary::{BlockLocation, Channel, Position, Rs274State, Settings, State};

use super::exported_program::ExportedProgram;

/// How a run can end, in the words of a sheet.
pub(super) const ENDS: &[(&str, &str)] = &[
    ("program end", "M2 or M30"),
    ("percent sign", "the second % of the file was reached"),
    ("alarm", "the control refused something"),
    ("waiting", "it waits for cycle start"),
    ("aborted", "a person or the control stopped it early"),
    ("endless", "it began again from the top, by M99"),
    ("did not end", "you had to stop it"),
    ("crashed", "the control froze, or started again"),
];

/// Modes that a sheet has, and the words that each can have.
pub(super) const MODES: &[(&str, &str)] = &[
    ("motion", "traverse (G0), feed (G1), arc_cw (G2), arc_ccw (G3), none (G80)"),
    ("units", "mm (G21), inch (G20)"),
    ("distance", "absolute (G90), incremental (G91)"),
    ("plane", "xy (G17), zx (G18), yz (G19)"),
    ("feed_mode", "inverse_time (G93), per_minute (G94), per_revolution (G95)"),
    ("work_offset", "1 (G54) to 9 (G59.3)"),
];

/// The text before a message that is not on the display.
pub(super) const CHANNELS: &[(&str, Channel)] =
    &[("print: ", Channel::Print), ("log: ", Channel::Log), ("display: ", Channel::Display)];

/// What a sheet is filled in with; empty where nothing is known.
#[derive(Clone, Debug, Default)]
pub(super) struct Values {
    /// How it ended.
    pub ended: String,
    /// Why it was not possible.
    pub not_possible: String,
    /// The alarm's text.
    pub alarm: String,
    /// The block that was refused.
    pub block: Option<BlockLocation>,
    /// The position of the tool.
    pub position: Option<Position>,
    /// Variables by number.
    pub variables: BTreeMap<u32, f64>,
    /// Messages in order.
    pub messages: Option<Vec<(Channel, String)>>,
    /// Modes by name.
    pub modes: BTreeMap<String, String>,
}

/// What a person wrote down.
#[derive(Clone, Debug, PartialEq)]
pub struct Sheet {
    /// How it ended, one of the words of a sheet.
    pub ended: String,
    /// The alarm's text.
    pub alarm: String,
    /// The block that was refused.
    pub block: Option<BlockLocation>,
    /// The position of the tool.
    pub position: Option<Position>,
    /// Variables by number.
    pub variables: BTreeMap<u32, f64>,
    /// Messages in order.
    pub messages: Option<Vec<(Channel, String)>>,
    /// Settings among the modes.
    pub settings: Settings,
    /// The state among the modes.
    pub state: Rs274State,
    /// The names of the modes.
    pub modes: BTreeSet<String>,
}

/// What became of a sheet.
#[derive(Clone, Debug, PartialEq)]
pub enum Answer {
    /// Nothing is filled in.
    Blank,
    /// The control cannot run this, and why.
    NotPossible(String),
    /// It was run.
    Ran(Box<Sheet>),
}

/// The text of a sheet.
pub(super) fn text(exported: &ExportedProgram, values: &Values) -> String {
    let quoted = |word: &str| toml::Value::from(word).to_string();
    if exported.samples {
        return format!(
            "# Only if your control or machine cannot run this, or not be recorded: why.\nnot_possible = {}\n",
            quoted(&values.not_possible)
        );
    }
    let mut text = format!(
        "# What program {} did. Write between the quotes what you saw. What you leave empty is not judged.\n\n# How it ended:\n",
        exported.folder
    );
    let mut put = |line: &str| {
        text.push_str(line);
        text.push('\n');
    };
    for (word, means) in ENDS {
        put(&format!("#   {:14} {means}", quoted(word)));
    }
    put(&format!("ended = {}\n", quoted(&values.ended)));
    put(
        "# Only if your control or machine cannot run this at all: why. Then nothing else is needed.",
    );
    put(&format!("not_possible = {}\n", quoted(&values.not_possible)));
    if exported.messages {
        put(
            "# Messages of the program, in order: [\"first\", \"second\"], or [] for none. Put print: or log: in front of a text that",
        );
        put("# was not on the display but printed or written into a log: [\"print: first\"].");
        let texts = values.messages.as_ref().map_or_else(
            || quoted(""),
            |messages| {
                let texts =
                    messages.iter().map(|(channel, text)| quoted(&labelled(*channel, text)));
                format!("[{}]", texts.collect::<Vec<_>>().join(", "))
            },
        );
        put(&format!("messages = {texts}\n"));
    }
    put(
        "# After an alarm: its text, and the line of the block if the control displays it. The first line of the file is 1.",
    );
    put("# The file is main.ngc where you write none.");
    put(&format!("[alarm]\ntext = {}", quoted(&values.alarm)));
    let file = values.block.as_ref().map_or("", |block| block.file.as_ref());
    put(&format!("file = {}", quoted(file)));
    let line = values.block.as_ref().map_or_else(|| quoted(""), |block| block.line.to_string());
    put(&format!("line = {line}\n"));
    put(
        "# The position on the display after the end: program coordinates (not machine coordinates), in the unit",
    );
    put(
        "# that is in force then. All axes or none; 0 for an axis that your machine does not have. Leave it empty after an alarm.",
    );
    put("[position]");
    for axis in &exported.axes {
        let value = values.position.map_or_else(|| quoted(""), |at| number(at.get(*axis)));
        put(&format!("{} = {value}", axis.word()));
    }
    if !exported.variables.is_empty() {
        put(
            "\n# Variables after the end. An empty one is not judged: write 0 where it is 0.\n[variables]",
        );
        for variable in &exported.variables {
            let value = values.variables.get(variable);
            let value = value.map_or_else(|| quoted(""), |value| number(*value));
            put(&format!("\"#{variable}\" = {value}"));
        }
    }
    put(
        "\n# If your control has a page of active codes: its content after the end. Leave it empty after an alarm.\n[modes]",
    );
    for (mode, words) in MODES {
        let value = values.modes.get(*mode).map_or("", String::as_str);
        put(&format!("{:29} # {words}", format!("{mode} = {}", quoted(value))));
    }
    text
}

/// A number as TOML has it.
pub(super) fn number(value: f64) -> String {
    toml::Value::from(value + 0.0).to_string()
}

fn labelled(channel: Channel, text: &str) -> String {
    let label = CHANNELS.iter().find(|(_, known)| *known == channel).map_or("", |(label, _)| label);
    let needs_none =
        channel == Channel::Display && !CHANNELS.iter().any(|(label, _)| text.starts_with(label));
    if needs_none { text.to_owned() } else { format!("{label}{text}") }
}

/// The text of what is said of the control.
pub fn control_text(name: &str, version: &str, resolution: f64) -> String {
    let quoted = |word: &str| toml::Value::from(word).to_string();
    let mut text = String::from("# The control that the programs ran on. Fill this in once.\n");
    // Writing to a string cannot fail.
    let _never = writeln!(text, "name = {}\nversion = {}\n", quoted(name), quoted(version));
    let _never = writeln!(
        text,
        "# The last digit of the display, in the unit of the program: the error of the numbers that you write down.\nresolution = {}",
        number(resolution)
    );
    text
}

impl Sheet {
    pub(super) fn mode(&mut self, mode: &str, value: &str) -> Result<(), String> {
        let known = self.settings.read(mode, None, value).is_ok()
            || self.state.read(mode, None, value).is_ok();
        if !known {
            let words = MODES.iter().find(|(name, _)| *name == mode).map(|(_, words)| *words);
            let hint = words.map_or_else(String::new, |words| format!(": one of {words}"));
            return Err(format!("[modes] {mode}: {value:?} is not understood{hint}"));
        }
        self.modes.insert(mode.to_owned());
        Ok(())
    }

    /// The state at the end, if anything of it is known.
    pub(crate) fn last_state(&self) -> Option<State> {
        let mut state = self.state.clone();
        state.position = self.position.or(state.position);
        let state = State::Rs274(state);
        (!state.is_empty()).then_some(state)
    }
}
