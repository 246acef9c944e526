//! What of a scenario would reach beyond the files of its program: it is refused before the run.

use super::workspace::RECORDED_SAMPLES;

/// Codes in comments that open a file of the host: logs of messages and of probed points.
const OPENING: [&str; 3] = ["logopen", "logappend", "probeopen"];

/// Endings of the names that a log may have: nothing reads such a file.
const LOG_ENDINGS: [&str; 2] = ["txt", "log"];

/// Whether a line would reach beyond the program's files: it runs Python, looks for a sub outside of the directory, or
/// writes a log elsewhere or over a file that something else reads. Where it is not clear what a line means, it would.
pub(crate) fn reaches_host(line: &str) -> bool {
    let text = compact(line);
    let calls_elsewhere = text.match_indices("o<").any(|(at, _)| {
        let name = text[at..].split('>').next().unwrap_or_default();
        name.contains(['/', '\\'])
    });
    let logs_elsewhere = OPENING.iter().any(|word| {
        text.match_indices(word).any(|(at, _)| {
            let name = text[at + word.len()..].split(')').next().unwrap_or_default();
            !is_log_name(name.strip_prefix(',').unwrap_or(name))
        })
    });
    text.contains("(py") || text.contains(";py") || calls_elsewhere || logs_elsewhere
}

/// Whether a log of this name would be a new file of the workspace.
fn is_log_name(name: &str) -> bool {
    let ending = name.split_once('.').map(|(_, ending)| ending);
    let is_plain = |c: char| c.is_ascii_alphanumeric() || "-_.".contains(c);
    name.chars().all(is_plain)
        && name != RECORDED_SAMPLES
        && ending.is_none_or(|ending| LOG_ENDINGS.contains(&ending))
}

/// A name on a machine's INI file: `[SECTION]NAME` of plain characters, so that nothing else is set with it.
pub(crate) fn is_ini_name(name: &str) -> bool {
    let is_plain = |part: &str| {
        let plain = |c: char| c.is_ascii_alphanumeric() || "-_".contains(c);
        !part.is_empty() && part.chars().all(plain)
    };
    let parts = name.strip_prefix('[').and_then(|rest| rest.split_once(']'));
    parts.is_some_and(|(section, name)| is_plain(section) && is_plain(name))
}

/// Without blanks, in lower case: how the interpreter reads a line.
pub(super) fn compact(line: &str) -> String {
    line.chars().filter(|c| !c.is_whitespace()).map(|c| c.to_ascii_lowercase()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn logs_subs_and_python_of_the_host_are_out_of_reach() {
        for line in [
            "(LOGOPEN,/tmp/x.txt)",
            "(LOGAPPEND,/tmp/x.txt)",
            "(PROBEOPEN /tmp/x.txt)",
            "(logopen,../x.txt)",
            "(logopen,a/../../x.txt)",
            "( LogOpen , . . / x )",
            "(logopen,~/x)",
            "(logopen,user/M101)",
            "(logopen,driver.py)",
            "(logopen,machine.ini)",
            "(logopen,.axisrc)",
            "(logopen,samples.txt)",
            "(msg,a)(logopen,/x)",
            "g1 x1 (logopen,/x)",
            "(logopen,/x",
            "o<../x> call",
            "o</etc/x> call",
            "(o<a>) o</etc/x> call",
            "o<a\\b> call",
            "(py,import os)",
            ";py,import os",
        ] {
            assert!(reaches_host(line), "{line}");
        }
        for line in [
            "(logopen,a.txt)",
            "(LOGAPPEND, a b.TXT )",
            "(logopen,f)",
            "(probeopen p.txt)",
            "(log,/x)",
            "o<x> call",
            "m2",
        ] {
            assert!(!reaches_host(line), "{line}");
        }
    }

    #[test]
    fn a_name_in_the_ini_file_sets_nothing_else() {
        for name in ["[SETUP]DEPTH", "[RS274NGC]HAL_PIN_VARS", "[AXIS_X]A-1"] {
            assert!(is_ini_name(name), "{name}");
        }
        for name in [
            "",
            "DEPTH",
            "[SETUP]",
            "[]DEPTH",
            "[RS274NGC]PARAMETER_FILE=/tmp/x #",
            "[PYTHON]TOPLEVEL=/tmp/x.py;",
            "[A]B\nC",
            "[A]\n[B]C",
            "[A]B C",
        ] {
            assert!(!is_ini_name(name), "{name:?}");
        }
    }
}
