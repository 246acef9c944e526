//! Detects programs and INI entries that could access the host beyond the program's files. Such a scenario is refused
//! before it runs.

use super::workspace::RECORDED_SAMPLES;

/// Active comments that open a file: logs of messages and of probed points.
const OPENING_KEYWORDS: [&str; 3] = ["logopen", "logappend", "probeopen"];

/// File extensions that a log may have: neither LinuxCNC nor its driver reads such files.
const LOG_ENDINGS: [&str; 2] = ["txt", "log"];

/// Whether a line could access the host: it runs Python, calls a sub in another directory, or writes a log into another
/// directory or over a file that is read. An ambiguous line counts as one that could.
pub(crate) fn reaches_host(line: &str) -> bool {
    let text = compact(line);
    let calls_elsewhere = text.match_indices("o<").any(|(at, _)| {
        let name = text[at..].split('>').next().unwrap_or_default();
        name.contains(['/', '\\'])
    });
    let logs_elsewhere = OPENING_KEYWORDS.iter().any(|word| {
        text.match_indices(word).any(|(at, _)| {
            let name = text[at + word.len()..].split(')').next().unwrap_or_default();
            // A name comes after a comma; only PROBEOPEN has none.
            let is_longer = name.starts_with(|c: char| c.is_ascii_alphanumeric());
            let opens = !is_longer || *word == "probeopen";
            opens && !is_log_name(name.strip_prefix(',').unwrap_or(name))
        })
    });
    text.contains("(py") || text.contains(";py") || calls_elsewhere || logs_elsewhere
}

/// Whether a log of this name is a new file in the workspace.
fn is_log_name(name: &str) -> bool {
    let ending = name.split_once('.').map(|(_, ending)| ending);
    let is_plain = |c: char| c.is_ascii_alphanumeric() || "-_.".contains(c);
    name.chars().all(is_plain)
        && name != RECORDED_SAMPLES
        && ending.is_none_or(|ending| LOG_ENDINGS.contains(&ending))
}

/// Whether a name of an INI entry is `[SECTION]NAME` of plain characters: it cannot set another entry.
pub(crate) fn is_ini_name(name: &str) -> bool {
    let is_plain = |part: &str| {
        let plain = |c: char| c.is_ascii_alphanumeric() || "-_".contains(c);
        !part.is_empty() && part.chars().all(plain)
    };
    let parts = name.strip_prefix('[').and_then(|rest| rest.split_once(']'));
    parts.is_some_and(|(section, name)| is_plain(section) && is_plain(name))
}

/// A line without blanks and in lower case, as the interpreter reads it.
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
            "(probeopen user/M101)",
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
            "(logopens,/x)",
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
