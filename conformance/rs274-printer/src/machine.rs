//! The machine that a run has: from the INI file, the tool table and the parameter file.
//!
//! `rs274` begins in millimetres, and reads stored lengths as inches whatever the INI file says.

use std::path::{Path, PathBuf};

use gaugeblock_vocabulary::scenario::ToolChange;
use gaugeblock_vocabulary::{Axis, LengthUnit, Machine, Options, TextError, Tool};

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

/// A machine with what LinuxCNC's INI file says of it: unit and axes, spindles, tool changes, and the entries that a
/// program can read. What it does not say stays as it is in `base`.
///
/// # Errors
/// The text has no entry, or an unknown unit or axis.
pub fn read_machine(text: &str, base: Machine) -> Result<Machine, TextError> {
    let ini = Ini::read(text);
    if ini.is_empty() {
        return Err(TextError::new("no entry in a section, such as [TRAJ]"));
    }
    let length_unit = match ini.get("TRAJ", "LINEAR_UNITS").map(str::to_ascii_lowercase).as_deref()
    {
        None => base.length_unit,
        Some("mm" | "metric") => LengthUnit::Millimetre,
        Some("in" | "inch" | "imperial") => LengthUnit::Inch,
        Some(other) => {
            let message = format!("[TRAJ]LINEAR_UNITS is `{other}`: expected mm or inch");
            return Err(TextError::new(message));
        }
    };
    let mut axes = base.axes.clone();
    if let Some(letters) = ini.get("TRAJ", "COORDINATES") {
        let letters: Vec<_> = letters.chars().filter(|c| !c.is_whitespace()).collect();
        let is_of =
            |axis: &Axis, letter: char| axis.to_string().eq_ignore_ascii_case(&letter.to_string());
        let unknown =
            letters.iter().find(|letter| !Axis::ALL.iter().any(|axis| is_of(axis, **letter)));
        if let Some(unknown) = unknown {
            let message = format!("[TRAJ]COORDINATES has the unknown axis `{unknown}`");
            return Err(TextError::new(message));
        }
        let named = |axis: &&Axis| letters.iter().any(|letter| is_of(axis, *letter));
        axes = Axis::ALL.iter().filter(named).copied().collect();
    }
    let read = machine(&ini, Vec::new());
    Ok(Machine {
        length_unit,
        axes,
        spindles: read.spindles,
        orient_offset: read.orient_offset,
        tool_change: read.tool_change,
        random_tool_changer: read.random_tool_changer,
        fanuc_subs: read.fanuc_subs,
        ini: read.ini,
        ..base
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn machine_is_read_from_an_ini_file() {
        let text = "[TRAJ]\nLINEAR_UNITS = inch\nCOORDINATES = X Y Y Z\nSPINDLES = 2\n";
        let machine = read_machine(text, Machine::default()).unwrap();
        assert_eq!((machine.length_unit, machine.spindles), (LengthUnit::Inch, 2));
        assert_eq!(machine.axes, [Axis::X, Axis::Y, Axis::Z]);
        assert_eq!(machine.digital_io, Machine::default().digital_io);
        for (text, words) in [
            ("g0 x1\n", "no entry"),
            ("[TRAJ]\nLINEAR_UNITS = cubit\n", "`cubit`: expected mm or inch"),
            ("[TRAJ]\nCOORDINATES = XYQ\n", "unknown axis `Q`"),
        ] {
            let error = read_machine(text, Machine::default()).unwrap_err();
            assert!(error.message.contains(words), "{text}: {}", error.message);
        }
    }

    #[test]
    fn options_hold_no_quirk() {
        let editions = gaugeblock_embedded_suite::page("editions.toml").expect("the editions");
        let options = options(&editions);
        assert!(!options.0.is_empty());
        assert!(!options.0.values().any(|option| option == QUIRK));
    }
}
