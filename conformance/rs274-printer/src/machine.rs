//! The machine that a run has: from the INI file, the tool table and the parameter file.
//!
//! `rs274` begins in millimetres, and reads stored lengths as inches whatever the INI file says.

use std::path::{Path, PathBuf};

use gaugeblock_vocabulary::scenario::ToolChange;
use gaugeblock_vocabulary::{Axis, LengthUnit, Machine, Options, Tool};

use super::ini::Ini;

/// The edition of what is printed, and the word for a quirk that is on: those the interpreter does not know.
const EDITION: &str = "rs274-2.9-observed";
const QUIRK: &str = "observed";
/// Parameters of the offset of G92.
const G92: std::ops::RangeInclusive<u32> = 5210..=5219;

/// A machine without stored parameters.
pub(super) fn machine(ini: &Ini, tools: Vec<Tool>) -> Machine {
    let spindles = ini.number("TRAJ", "SPINDLES").filter(|count| (1.0..=8.0).contains(count));
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "1 to 8")]
    let spindles = spindles.map_or(1, |count| count as u8);
    Machine {
        length_unit: LengthUnit::Inch,
        spindles,
        // Which there are is known to the motion controller only.
        digital_io: u16::from(u8::MAX),
        analog_io: u16::from(u8::MAX),
        orient_offset: ini.number("RS274NGC", "ORIENT_OFFSET").unwrap_or(0.0),
        tool_change: ToolChange {
            at_g30: ini.on("EMCIO", "TOOL_CHANGE_AT_G30"),
            quill_up: ini.on("EMCIO", "TOOL_CHANGE_QUILL_UP"),
            with_spindle_on: ini.on("EMCIO", "TOOL_CHANGE_WITH_SPINDLE_ON"),
        },
        random_tool_changer: ini.on("EMCIO", "RANDOM_TOOLCHANGER"),
        fanuc_subs: !ini.on("RS274NGC", "DISABLE_FANUC_STYLE_SUB"),
        tools,
        ini: ini.numbers(),
        ..Machine::default()
    }
}

/// Whether the offset of G92 is forgotten between runs.
pub(super) fn forgets_g92(ini: &Ini) -> bool {
    ini.on("RS274NGC", "DISABLE_G92_PERSISTENCE")
}

/// Whether a parameter belongs to the offset of G92.
pub(super) fn is_g92(number: u32) -> bool {
    G92.contains(&number)
}

/// The folders in which subroutine files are looked for, in order.
pub(super) fn folders(ini: &Ini, program: Option<&Path>) -> Vec<PathBuf> {
    let mut folders = Vec::new();
    let beside = program.and_then(Path::parent).filter(|folder| !folder.as_os_str().is_empty());
    folders.push(beside.unwrap_or(Path::new(".")).to_owned());
    folders.extend(ini.get("DISPLAY", "PROGRAM_PREFIX").map(PathBuf::from));
    let searched = ini.get("RS274NGC", "SUBROUTINE_PATH").unwrap_or_default();
    folders.extend(searched.split(':').filter(|folder| !folder.is_empty()).map(PathBuf::from));
    folders
}

/// The options of the edition that is printed, without the quirks that the interpreter does not know. `editions` is the
/// text of the suite's `editions.toml`.
pub(super) fn options(editions: &str) -> Options {
    let mut options = Options::default();
    let Ok(editions) = editions.parse::<toml::Table>() else { return options };
    // It is no departure there, since no document says otherwise of `rs274` itself.
    options.0.insert("tool.change-without-selection".to_owned(), "accepted".to_owned());
    let editions = editions.get("edition").and_then(toml::Value::as_array);
    let mut wanted = Some(EDITION);
    while let Some(id) = wanted {
        let named =
            |edition: &&toml::Value| edition.get("id").and_then(toml::Value::as_str) == Some(id);
        let edition = editions.and_then(|editions| editions.iter().find(named));
        let chosen = edition.and_then(|edition| edition.get("options")?.as_table());
        for (choice, option) in chosen.into_iter().flatten() {
            if let Some(option) = option.as_str().filter(|option| *option != QUIRK) {
                options.0.entry(choice.clone()).or_insert_with(|| option.to_owned());
            }
        }
        wanted = edition.and_then(|edition| edition.get("base")?.as_str());
    }
    options
}

/// Reads a tool table: a tool a line, comments after a semicolon.
pub(super) fn tools(text: &str) -> Vec<Tool> {
    text.lines().filter_map(tool).collect()
}

fn tool(line: &str) -> Option<Tool> {
    let mut tool = Tool::default();
    let mut numbered = false;
    for word in line.split(';').next()?.split_whitespace() {
        let letter = word.get(..1)?.to_ascii_uppercase();
        let value: f64 = word.get(1..)?.parse().ok()?;
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "a saturating cast will do"
        )]
        let whole = value as u32;
        match letter.as_str() {
            "T" => {
                tool.number = whole;
                numbered = true;
            }
            "P" => tool.pocket = Some(whole),
            "D" => tool.diameter = value,
            "I" => tool.front_angle = value,
            "J" => tool.back_angle = value,
            "Q" => tool.orientation = u8::try_from(whole).unwrap_or(0),
            _ => {
                let axis =
                    Axis::ALL.iter().find(|axis| axis.to_string().eq_ignore_ascii_case(&letter))?;
                *tool.offset.get_mut(*axis) = value;
            }
        }
    }
    numbered.then_some(tool)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_tool_table_is_read() {
        let tools = tools("T1 P2 Z0.5 D.125 ; end mill\n\nT20 P1 X-1 I10 J20 Q3\n; T3\n");
        assert_eq!(tools.len(), 2);
        assert_eq!((tools[0].number, tools[0].pocket, tools[0].offset.z), (1, Some(2), 0.5));
        assert_eq!(
            (tools[1].front_angle, tools[1].back_angle, tools[1].orientation),
            (10.0, 20.0, 3)
        );
    }

    #[test]
    fn options_hold_no_quirk() {
        let editions = gaugeblock_embedded_suite::page("editions.toml").expect("the editions");
        let options = options(&editions);
        assert!(!options.0.is_empty());
        assert!(!options.0.values().any(|option| option == QUIRK));
    }
}
