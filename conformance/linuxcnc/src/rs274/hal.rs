//! Who may use the memory of HAL. The controller attaches to it as it starts, one memory for the whole machine, where a
//! run that is killed leaves its entry behind, and one that finds itself alone clears what another is about to use.
//!
//! So only a program that names HAL gets one, and such programs run one after the other.

use std::borrow::Cow;
use std::fs::File;
use std::io;

use gaugeblock_filesystem::open_lock;
use gaugeblock_vocabulary::Machine;

use crate::instrumentation::source::Source;

/// The lock file of the memory of HAL, in the folder for temporary files.
const FILE: &str = "gaugeblock-hal.lock";

/// Whether HAL items can be named.
const SWITCH: &str = "[RS274NGC]HAL_PIN_VARS";

/// What the controller says where the memory is full of entries, or holds one of its own number, and goes on without.
const COMPLAINT: (&str, &str) = ("HAL: ERROR: ", " component");

/// HAL for one program.
#[derive(Debug)]
pub(super) enum Hal {
    /// It does without.
    Off,
    /// It has the memory to itself until this is dropped or the process ends.
    Own(#[expect(dead_code, reason = "held for its lock")] File),
}

impl Hal {
    /// What a program needs; waits where another uses the memory.
    ///
    /// # Errors
    /// The file cannot be locked.
    pub(super) fn of(source: &Source) -> io::Result<Self> {
        if !source.names_hal() {
            return Ok(Self::Off);
        }
        let path = std::env::temp_dir().join(FILE);
        let file = open_lock(&path)?;
        file.lock()?;
        Ok(Self::Own(file))
    }

    /// The machine, whose INI file switches HAL off where it is not needed.
    pub(super) fn machine<'a>(&self, machine: &'a Machine) -> Cow<'a, Machine> {
        match self {
            Self::Own(_) => Cow::Borrowed(machine),
            Self::Off => {
                let mut machine = machine.clone();
                machine.ini.insert(SWITCH.to_owned(), 0.0);
                Cow::Owned(machine)
            }
        }
    }
}

/// An error output without what it says of entries in the memory of HAL: others left them.
pub(super) fn without_complaints(stderr: String) -> String {
    let complains = |line: &str| line.starts_with(COMPLAINT.0) && line.contains(COMPLAINT.1);
    if stderr.lines().any(complains) {
        stderr.split_inclusive('\n').filter(|line| !complains(line)).collect()
    } else {
        stderr
    }
}

#[cfg(test)]
mod tests {
    use gaugeblock_vocabulary::Program;

    use super::*;

    fn switch(program: &str) -> Option<f64> {
        let source = Source::new(&Program { main: program.to_owned(), ..Program::default() });
        let machine = Machine::default();
        Hal::of(&source).unwrap().machine(&machine).ini.get(SWITCH).copied()
    }

    #[test]
    fn a_program_that_cannot_name_it_does_without() {
        assert_eq!(switch("g0 x1\n(half a turn)\nm2\n"), Some(0.0));
        assert_eq!(switch("#1=#<_ H a l [motion.on]>\n"), None);
        assert_eq!(switch("#1=#<_ini[rs274ngc]HAL_PIN_VARS>\n"), None);
    }

    #[test]
    fn output_of_earlier_runs_is_ignored() {
        let said =
            "executing\nHAL: ERROR: insufficient memory for component 'interp7'\nwrong\nline\n";
        assert_eq!(without_complaints(said.to_owned()), "executing\nwrong\nline\n");
        let own = "executing\nHAL: ERROR: mine\n";
        assert_eq!(without_complaints(own.to_owned()), own);
    }
}
