//! A private directory for a controller: home, program files, INI file, tool table, parameter file.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write as _;
use std::path::Path;
use std::{env, fs};

use gaugeblock_adapter::HarnessError;
use gaugeblock_filesystem::PrivateFolder;
use gaugeblock_vocabulary::{Axis, Machine};

pub(crate) const INI: &str = "machine.ini";
pub(crate) const TOOLS: &str = "tools.tbl";
pub(crate) const PARAMETERS: &str = "parameters.var";
/// The servo samples that a controller has recorded.
pub(crate) const RECORDED_SAMPLES: &str = "samples.txt";

/// Where Linux keeps files in memory.
const MEMORY: &str = "/dev/shm";

/// A directory that is removed when it is dropped.
#[derive(Debug)]
pub(crate) struct Workspace {
    folder: PrivateFolder,
}

impl Workspace {
    /// A new, empty directory among the temporary files, named after the controller.
    pub(crate) fn new(controller: &str) -> Result<Self, HarnessError> {
        Self::create_below(&env::temp_dir(), controller)
    }

    /// A new, empty directory in memory, unless the environment names a place for temporary files or there is none in
    /// memory: on a disk, creating and syncing its files is a fifth of a short run.
    pub(crate) fn in_memory(controller: &str) -> Result<Self, HarnessError> {
        let memory = Path::new(MEMORY);
        match env::var_os("TMPDIR") {
            None if memory.is_dir() => {
                Self::create_below(memory, controller).or_else(|_| Self::new(controller))
            }
            _ => Self::new(controller),
        }
    }

    fn create_below(parent: &Path, controller: &str) -> Result<Self, HarnessError> {
        match PrivateFolder::below(parent, controller) {
            Ok(folder) => Ok(Self { folder }),
            Err(error) => Err(HarnessError::NotRun(format!("{}: {error}", parent.display()))),
        }
    }

    /// Where it is.
    pub(crate) fn path(&self) -> &Path {
        self.folder.path()
    }

    /// Writes a file.
    pub(crate) fn write(
        &self,
        name: &str,
        content: impl AsRef<[u8]>,
    ) -> Result<fs::File, HarnessError> {
        let written = self.folder.write(name, content);
        written.map_err(|error| HarnessError::NotRun(format!("{name}: {error}")))
    }

    /// Writes what a machine stores: INI file, tool table, and a parameter file that lists `numbers` besides, since
    /// only listed ones are written back.
    pub(crate) fn write_machine(
        &self,
        machine: &Machine,
        numbers: &BTreeSet<u32>,
    ) -> Result<(), HarnessError> {
        self.write(INI, ini(machine))?;
        self.write(TOOLS, tool_table(machine))?;
        self.write(PARAMETERS, parameter_file(machine, numbers)).map(drop)
    }

    /// The numbered parameters that the run left in a parameter file and that are not zero.
    pub(crate) fn read_parameters(&self, name: &str) -> Result<BTreeMap<u32, f64>, HarnessError> {
        let text = fs::read_to_string(self.path().join(name))
            .map_err(|error| HarnessError::NotRun(format!("{name}: {error}")))?;
        let mut parameters = BTreeMap::new();
        for line in text.lines().filter(|line| !line.trim().is_empty()) {
            let mut words = line.split_whitespace();
            let number = words.next().and_then(|word| word.parse().ok());
            let value: Option<f64> = words.next().and_then(|word| word.parse().ok());
            let (Some(number), Some(value)) = (number, value) else {
                let what = "parameter file".to_owned();
                return Err(HarnessError::Unreadable { what, line: line.to_owned() });
            };
            if value.abs() > 0.0 {
                parameters.insert(number, value);
            }
        }
        Ok(parameters)
    }
}

fn ini(machine: &Machine) -> String {
    ini_text(&ini_sections(machine))
}

/// Lines of an INI file by section.
pub(crate) type Sections = BTreeMap<String, Vec<String>>;

/// What the interpreter reads of a machine in its INI file.
pub(crate) fn ini_sections(machine: &Machine) -> Sections {
    let flag = |on: bool| if on { "1" } else { "0" };
    let mut sections = Sections::new();
    let mut put =
        |section: &str, line: String| sections.entry(section.to_owned()).or_default().push(line);
    put("RS274NGC", "SUBROUTINE_PATH=.".to_owned());
    put("RS274NGC", format!("DISABLE_FANUC_STYLE_SUB={}", flag(!machine.fanuc_subs)));
    put("RS274NGC", format!("ORIENT_OFFSET={}", machine.orient_offset));
    put("TRAJ", format!("SPINDLES={}", machine.spindles));
    put("EMCIO", format!("TOOL_CHANGE_AT_G30={}", flag(machine.tool_change.at_g30)));
    put("EMCIO", format!("TOOL_CHANGE_QUILL_UP={}", flag(machine.tool_change.quill_up)));
    put(
        "EMCIO",
        format!("TOOL_CHANGE_WITH_SPINDLE_ON={}", flag(machine.tool_change.with_spindle_on)),
    );
    for (name, value) in &machine.ini {
        if let Some((section, name)) = name.strip_prefix('[').and_then(|rest| rest.split_once(']'))
        {
            put(section, format!("{name}={value}"));
        }
    }
    sections
}

/// The text of an INI file.
pub(crate) fn ini_text(sections: &Sections) -> String {
    let mut text = String::new();
    for (section, lines) in sections {
        // Writing to a string cannot fail.
        let _never = writeln!(text, "[{section}]\n{}", lines.join("\n"));
    }
    text
}

/// The text of the tool table, in the order of the machine's list: the controller names tools by their place in it.
pub(crate) fn tool_table(machine: &Machine) -> String {
    let mut text = String::from("\n");
    for tool in &machine.tools {
        let pocket = tool.pocket.unwrap_or(tool.number);
        let _never = write!(text, "T{} P{pocket}", tool.number);
        for axis in Axis::ALL {
            let _never = write!(text, " {}{}", axis.word().to_uppercase(), tool.offset.get(*axis));
        }
        let _never = writeln!(
            text,
            " D{} I{} J{} Q{}",
            tool.diameter, tool.front_angle, tool.back_angle, tool.orientation
        );
    }
    text
}

/// The text of a parameter file, which lists `numbers` besides what is stored.
pub(crate) fn parameter_file(machine: &Machine, numbers: &BTreeSet<u32>) -> String {
    let mut values: BTreeMap<u32, f64> = numbers.iter().map(|number| (*number, 0.0)).collect();
    values.insert(5220, 1.0);
    values.extend(machine.parameters.0.iter().map(|(number, value)| (*number, *value)));
    let mut text = String::new();
    for (number, value) in values {
        let _never = writeln!(text, "{number}\t{value}");
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;
    use gaugeblock_vocabulary::{Indexed, Position, Tool};

    #[test]
    fn a_workspace_is_private_and_goes_away() {
        let (one, two) = (Workspace::new("one").unwrap(), Workspace::new("one").unwrap());
        assert_ne!(one.path(), two.path());
        let path = one.path().to_owned();
        one.write("main.ngc", "m2\n").unwrap();
        drop(one);
        assert!(!path.exists() && two.path().exists());
    }

    #[test]
    fn a_machine_is_written_as_its_files() {
        let machine = Machine {
            spindles: 3,
            fanuc_subs: false,
            tools: vec![Tool {
                number: 7,
                offset: Position { z: 0.5, ..Position::default() },
                diameter: 0.25,
                ..Tool::default()
            }],
            parameters: Indexed::one(5241, 10.0),
            ..Machine::default()
        };
        let ini = ini(&machine);
        assert!(
            ini.contains("[TRAJ]\nSPINDLES=3") && ini.contains("DISABLE_FANUC_STYLE_SUB=1"),
            "{ini}"
        );
        let tools = "\nT7 P7 X0 Y0 Z0.5 A0 B0 C0 U0 V0 W0 D0.25 I0 J0 Q0\n";
        assert_eq!(tool_table(&machine), tools);
        let numbers = BTreeSet::from([1, 31]);
        assert_eq!(parameter_file(&machine, &numbers), "1\t0\n31\t0\n5220\t1\n5241\t10\n");
    }
}
