//! Instruments a program, so that its output reports where it is: checkpoint lines after each line, and tags on lines
//! that a jump can reach.
//!
//! A checkpoint line is a (PRINT,…) of file, line and parameters. The output between two checkpoints belongs to the
//! block between them. (DEBUG,…) is not used, since a program can switch it off.

use std::collections::BTreeSet;
use std::fmt::Write as _;

use super::source::{Form, LAST_PARAMETER, Source, form, has_slash, without_number};

/// Longest line that the interpreter reads, bytes.
pub(crate) const LONGEST_LINE: usize = 252;

/// Parameters that a checkpoint line prints at most. A message of more than about 500 characters, with its values,
/// crashes the interpreter, and large numbers are long.
const VALUES_MAX: usize = 12;

/// Characters that binding an end to a parameter may take.
const ROOM_TO_BIND: usize = 40;

/// Parameters that report a mode; they are printed as integers.
pub(crate) const MODES: [&[&str]; 2] = [
    &[
        "_motion_mode",
        "_plane",
        "_metric",
        "_absolute",
        "_inverse_time",
        "_units_per_minute",
        "_ccomp",
        "_coord_system",
        "_retract_old_z",
        "_ijk_absolute_mode",
        "_lathe_diameter_mode",
    ],
    &[
        "_mist",
        "_flood",
        "_feed_override",
        "_speed_override",
        "_adaptive_feed",
        "_feed_hold",
        "_spindle_css_mode",
        "_spindle_on",
        "_spindle_cw",
        "_selected_tool",
        "_selected_pocket",
        "_call_level",
    ],
];

/// Parameters that report a number; they are printed with nine decimals.
const NUMBERS: &[&str] = &["_feed", "_rpm", "_x", "_y", "_z", "_a", "_b", "_c", "_u", "_v", "_w"];

/// How many of the last are for machines with U, V or W alone.
const PARALLEL_AXES: usize = 3;

/// How a program is observed.
#[derive(Clone, Debug)]
pub(crate) struct Plan {
    /// The beginning of each checkpoint line; it does not occur in the program.
    pub(crate) marker: String,
    /// Parameters that are printed after each block, as written after `#`.
    pub(crate) parameters: Vec<String>,
    /// For a controller that reads ahead: marks that pass through its queue and report what has been executed.
    pub(crate) marks: Option<Marks>,
    /// Whether the positions of U, V and W are printed. The stand-alone interpreter has none of these axes.
    pub(crate) parallel_axes: bool,
    /// Whether cutter compensation may be switched on. Calls then wait, and each checkpoint has a comment that waits
    /// with them.
    pub(crate) compensates: bool,
}

/// Messages that pass through the controller's queue in order with the commands: after each block, and before some.
#[derive(Clone, Debug, Default)]
pub(crate) struct Marks {
    /// File and line of blocks with a gate and a mark before them, too.
    pub(crate) before: BTreeSet<(usize, u32)>,
}

/// The user-defined code of a gate. Its program waits until the driver lets it end. The controller starts it once all
/// motions before it are over, and meanwhile reads ahead as it would without it.
pub(crate) const GATE: &str = "M187";

impl Plan {
    /// A plan for a program: it prints the parameters that the text names, #1 to #30, and `more`.
    pub(crate) fn new(source: &Source, more: &BTreeSet<u32>) -> Self {
        let named = source.parameters();
        let mut numbers: BTreeSet<u32> =
            (1..=30).chain(named.numbered).chain(more.iter().copied()).collect();
        numbers.retain(|number| is_plain(*number));
        let is_word = |name: &str| name.chars().all(|c| c.is_alphanumeric() || c == '_');
        let own = |name: &&String| !PREDEFINED.contains(&name.as_str()) && is_word(name);
        let names = named.named.iter().filter(own).map(|name| format!("<{name}>"));
        // The checkpoint lines change `#<_line>`. If the program reads it, values under observation are not those of
        // the program.
        let parameters = if source.names_line() {
            Vec::new()
        } else {
            numbers.iter().map(u32::to_string).chain(names).collect()
        };
        Self {
            marker: unused_marker(source),
            parameters,
            marks: None,
            parallel_axes: false,
            compensates: source.may_compensate(),
        }
    }

    /// The text of a file with checkpoints and tags, and with an error before each line of `ends`. The error stops the
    /// program there and leaves the interpreter running.
    pub(crate) fn with_checkpoints(&self, file: usize, lines: &[String], ends: &Ends) -> String {
        let mut text = String::new();
        let begins_with_percent = lines
            .iter()
            .find(|line| !line.trim().is_empty())
            .is_some_and(|line| form(line) == Form::Percent);
        if file == 0 && !begins_with_percent {
            text.push_str(&self.checkpoint(file, 0));
            text.push_str(&self.marks(file, 0));
        }
        let mut begun = !begins_with_percent;
        for (number, line) in (1_u32..).zip(lines) {
            if self.marks.as_ref().is_some_and(|marks| marks.before.contains(&(file, number))) {
                let (gate, mark) = (self.mark_gate(file, number), self.mark_before(file, number));
                text.push_str(&format!("(MSG,{gate})\n{GATE} ({})\n(MSG,{mark})\n", self.marker));
            }
            if let Some(block) = ends.block(line) {
                if self.compensates {
                    text.push_str(&self.release());
                    text.push('\n');
                }
                let _never = writeln!(text, "#<{}>=1\n{}", self.reached(block), self.stop());
            }
            text.push_str(line);
            text.push_str(&self.tag(file, number, line));
            text.push('\n');
            begun |= !line.trim().is_empty();
            if begun {
                text.push_str(&self.checkpoint(file, number));
                text.push_str(&self.marks(file, number));
            }
        }
        text
    }

    /// The text of the mark after a block.
    pub(crate) fn mark_after(&self, file: usize, line: u32) -> String {
        format!("{}{file}.{line}", self.marker)
    }

    /// The text of the mark between the gate of a block and the block.
    pub(crate) fn mark_before(&self, file: usize, line: u32) -> String {
        format!("{}>{file}.{line}", self.marker)
    }

    /// The text of the mark before the gate of a block.
    pub(crate) fn mark_gate(&self, file: usize, line: u32) -> String {
        format!("{}<{file}.{line}", self.marker)
    }

    /// The marks after a block: two, so that the first one has passed before a controller that reads one command ahead
    /// reads the next block.
    fn marks(&self, file: usize, line: u32) -> String {
        if self.marks.is_none() {
            return String::new();
        }
        format!("(MSG,{})\n(MSG,{}+)\n", self.mark_after(file, line), self.marker)
    }

    /// For each line of an instrumented file, its number in the original file; `None` for inserted lines.
    pub(crate) fn own_lines(&self, instrumented: &str) -> Vec<Option<u32>> {
        let inserted = [
            format!("(PRINT,{} ", self.marker),
            format!("(MSG,{}", self.marker),
            format!("{GATE} ({}", self.marker),
            format!("({}", self.marker),
        ];
        let mut own = 0;
        let number = |line: &str| {
            let is_own = !inserted.iter().any(|start| line.starts_with(start));
            own += u32::from(is_own);
            is_own.then_some(own)
        };
        instrumented.lines().map(number).collect()
    }

    /// The blocks that are entered by hand after the program has stopped: a sign, the end before which it stopped, and
    /// a checkpoint.
    ///
    /// An end reads a parameter that the program sets before it. The end is therefore not executed if another error
    /// stopped the program. An end that is too long for that is entered unchanged ([`Ends::has_substitutions`]).
    pub(crate) fn mdi_checkpoint(&self, ends: &Ends) -> String {
        let mut text = format!("(PRINT,{})\n", self.mdi_sign());
        for (block, end) in ends.blocks.iter().enumerate() {
            let reached = self.reached(block);
            let bound = format!("#<{reached}>=[1/#<{reached}>] {end}");
            let has_room = end.len() <= LONGEST_LINE - ROOM_TO_BIND;
            text.push_str(if has_room { &bound } else { end });
            text.push('\n');
        }
        text + &self.checkpoint(0, 0) + "quit\n"
    }

    /// The block that stops the program.
    pub(crate) fn stop(&self) -> String {
        format!("(ABORT,{})", self.marker)
    }

    /// The block before an end that puts out what waits, as the end would. An error would lose it.
    pub(crate) fn release(&self) -> String {
        format!("M1 ({})", self.release_comment())
    }

    /// The comment of that block.
    pub(crate) fn release_comment(&self) -> String {
        format!("{}release", self.marker)
    }

    /// The comment of each checkpoint, which waits with the calls before it.
    pub(crate) fn waiting_comment(&self) -> String {
        format!("{}+", self.marker)
    }

    /// The text that is printed when manual input begins.
    pub(crate) fn mdi_sign(&self) -> String {
        format!("{}by hand", self.marker)
    }

    /// The parameter that is set before an end; it reports at which end the program stopped.
    fn reached(&self, block: usize) -> String {
        format!("_{}{block}", self.marker.trim_matches('@'))
    }

    /// The checkpoint lines after a line.
    pub(crate) fn checkpoint(&self, file: usize, line: u32) -> String {
        let mut text = String::new();
        if self.compensates {
            let _never = writeln!(text, "({})", self.waiting_comment());
        }
        let references =
            |names: &[&str]| names.iter().map(|name| format!(" #<{name}>")).collect::<String>();
        let mut part = 0;
        let mut put = |format: &str, values: &str| {
            let _never =
                writeln!(text, "(PRINT,{} {file} {line} {part} {format}{values})", self.marker);
            part += 1;
        };
        for names in MODES {
            put("%d", &references(names));
        }
        put("%.9f", &references(self.numbers()));
        for parameters in self.parameter_groups() {
            put("%.9f", &parameters.iter().map(|name| format!(" #{name}")).collect::<String>());
        }
        text
    }

    /// The parameters that report a number and are printed after each block.
    pub(crate) fn numbers(&self) -> &'static [&'static str] {
        let left_out = if self.parallel_axes { 0 } else { PARALLEL_AXES };
        &NUMBERS[..NUMBERS.len() - left_out]
    }

    /// The parameters, in groups that one checkpoint line can print.
    pub(crate) fn parameter_groups(&self) -> Vec<&[String]> {
        let mut groups = Vec::new();
        let mut rest = self.parameters.as_slice();
        while !rest.is_empty() {
            let mut room = LONGEST_LINE - 60;
            let fits = rest.iter().take(VALUES_MAX).take_while(|name| {
                let fits = room > name.len() + 2;
                room = room.saturating_sub(name.len() + 2);
                fits
            });
            let count = fits.count().max(1);
            let (group, others) = rest.split_at(count);
            groups.push(group);
            rest = others;
        }
        groups
    }

    /// A tag that an error message quotes, on lines that a jump can reach. It is a comment; comments of O-word lines
    /// are never active, so that it hides no active comment.
    fn tag(&self, file: usize, number: u32, line: &str) -> String {
        if form(line) != Form::Control {
            return String::new();
        }
        let tag = format!(";{}{file}.{number}", self.marker);
        if line.len() + tag.len() > LONGEST_LINE { String::new() } else { tag }
    }

    /// The line that the tag in an error message's echo names.
    pub(crate) fn tagged(&self, echo: &str) -> Option<(usize, u32)> {
        let at = echo.rfind(&format!(";{}", self.marker))?;
        let tag = echo[at + 1..].strip_prefix(&self.marker)?;
        let (file, line) = tag.trim().split_once('.')?;
        Some((file.parse().ok()?, line.parse().ok()?))
    }

    /// A text without the tags and checkpoints in it.
    pub(crate) fn untagged<'a>(&self, text: &'a str) -> &'a str {
        text.find(&format!(";{}", self.marker)).map_or(text, |at| &text[..at])
    }
}

/// The blocks that end a program, each different one once, as they can be entered by hand.
#[derive(Clone, Debug, Default)]
pub(crate) struct Ends {
    blocks: Vec<String>,
    block_delete: bool,
}

impl Ends {
    /// The ends of a program.
    pub(crate) fn new(source: &Source, block_delete: bool) -> Self {
        let mut ends = Self { blocks: Vec::new(), block_delete };
        for (_, _, line) in source.all() {
            if let Some(block) =
                ends.is_entered_by_jump(line).filter(|block| !ends.blocks.contains(block))
            {
                ends.blocks.push(block);
            }
        }
        ends
    }

    /// Those that are not the block at this line.
    pub(crate) fn without(&self, line: &str) -> Self {
        let block = self.block(line);
        let others = (0..).zip(&self.blocks).filter(|(number, _)| Some(*number) != block);
        Self { blocks: others.map(|(_, block)| block.clone()).collect(), ..self.clone() }
    }

    /// How many different ones there are.
    pub(crate) fn count(&self) -> usize {
        self.blocks.len()
    }

    /// Whether each of them is executed by hand only if the program stopped before it.
    pub(crate) fn has_substitutions(&self) -> bool {
        self.blocks.iter().all(|block| block.len() <= LONGEST_LINE - ROOM_TO_BIND)
    }

    /// Which of the blocks a line is.
    fn block(&self, line: &str) -> Option<usize> {
        let block = self.is_entered_by_jump(line)?;
        self.blocks.iter().position(|known| *known == block)
    }

    /// A line that ends a program, without slash and line number; nothing for any other.
    fn is_entered_by_jump(&self, line: &str) -> Option<String> {
        let is_skipped = self.block_delete && has_slash(line);
        // A line that holds a carriage return is more than one line to a person's input.
        let is_one = !line.contains('\r');
        (form(line) == Form::End && is_one && !is_skipped).then(|| without_number(line).to_owned())
    }
}

/// Whether a numbered parameter is only written by the program: not offsets and predefined positions, whose unit is
/// that of stored data, and not the position and the tool, which other fields show.
pub(crate) fn is_plain(number: u32) -> bool {
    (1..=LAST_PARAMETER).contains(&number) && !(5161..=5428).contains(&number)
}

/// Named parameters that the interpreter provides.
const PREDEFINED: &[&str] = &[
    "_vmajor",
    "_vminor",
    "_metric_machine",
    "_line",
    "_motion_mode",
    "_plane",
    "_ccomp",
    "_metric",
    "_imperial",
    "_absolute",
    "_incremental",
    "_inverse_time",
    "_units_per_minute",
    "_units_per_rev",
    "_coord_system",
    "_tool_offset",
    "_retract_r_plane",
    "_retract_old_z",
    "_spindle_rpm_mode",
    "_spindle_css_mode",
    "_ijk_absolute_mode",
    "_lathe_diameter_mode",
    "_lathe_radius_mode",
    "_spindle_on",
    "_spindle_cw",
    "_speed_override",
    "_mist",
    "_flood",
    "_feed_override",
    "_adaptive_feed",
    "_feed_hold",
    "_feed",
    "_rpm",
    "_current_tool",
    "_current_pocket",
    "_selected_pocket",
    "_selected_tool",
    "_x",
    "_y",
    "_z",
    "_a",
    "_b",
    "_c",
    "_u",
    "_v",
    "_w",
    "_abs_x",
    "_abs_y",
    "_abs_z",
    "_abs_a",
    "_abs_b",
    "_abs_c",
    "_abs_u",
    "_abs_v",
    "_abs_w",
    "_value",
    "_value_returned",
    "_task",
    "_call_level",
    "_remap_level",
];

fn unused_marker(source: &Source) -> String {
    let text: String = source.all().map(|(_, _, line)| line.to_lowercase() + "\n").collect();
    (0_u32..)
        .map(|salt| format!("@gb{salt}@"))
        .find(|marker| !text.contains(marker.trim_end_matches('@').trim_start_matches('@')))
        .expect("a finite text does not hold every marker")
}

#[cfg(test)]
mod tests {
    use super::*;
    use gaugeblock_vocabulary::Program;

    fn plan(main: &str) -> (Plan, Source) {
        let source = Source::new(&Program { main: main.to_owned(), ..Program::default() });
        (Plan::new(&source, &BTreeSet::new()), source)
    }

    fn without_checkpoints(main: &str) -> String {
        let (plan, source) = plan(main);
        let text = plan.with_checkpoints(0, &source.files()[0].1, &Ends::default());
        let own = |line: &&str| !line.starts_with("(PRINT,@gb") || line.contains(" 0 %d");
        let short = |line: &str| {
            if line.starts_with("(PRINT") { "checkpoint".to_owned() } else { line.to_owned() }
        };
        text.lines().filter(own).map(short).collect::<Vec<_>>().join("|")
    }

    #[test]
    fn lines_get_checkpoints_and_control_lines_tags() {
        assert_eq!(
            without_checkpoints("o1 if [1] (c)\nx1 (msg,hi)\n"),
            "checkpoint|o1 if [1] (c);@gb0@0.1|checkpoint|x1 (msg,hi)|checkpoint"
        );
    }

    #[test]
    fn percent_lines_stay_unchanged() {
        assert_eq!(without_checkpoints("\n%\nm2\n%"), "|%|checkpoint|m2|checkpoint|%|checkpoint");
    }

    #[test]
    fn no_line_becomes_too_long() {
        let long = format!("o1 if [1{}]", " ".repeat(235));
        let names: String =
            (0..40).map(|n| format!("#<some_rather_long_name_{n}>=#{}\n", 4000 + n)).collect();
        let (plan, source) = plan(&format!("{long}\n{names}"));
        let text = plan.with_checkpoints(99, &source.files()[0].1, &Ends::default());
        assert!(text.lines().all(|line| line.len() <= LONGEST_LINE), "{text}");
        assert!(text.contains(&format!("{long}\n")));
    }

    #[test]
    fn no_checkpoint_becomes_too_long_with_its_values() {
        let (plan, _) = plan("#1=1e30 #5000=2\n");
        assert_eq!(plan.parameters.len(), 31);
        assert!(plan.parameter_groups().iter().all(|group| group.len() <= VALUES_MAX));
        assert_eq!(plan.parameter_groups().concat(), plan.parameters);
    }

    #[test]
    fn marker_does_not_occur_in_the_program() {
        let (plan, _) = plan("(print,@GB0@)\n");
        assert_eq!(plan.marker, "@gb1@");
        assert_eq!(plan.tagged("o1 endif;@gb1@2.17"), Some((2, 17)));
        assert_eq!(plan.tagged("o1 endif;@gb0@2.17"), None);
    }
}
