//! The parameter file: a number and a value a line, read at the beginning and written at the end.

use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::io;
use std::path::Path;

use gaugeblock_filesystem::{copy_output, write_output};
use gaugeblock_vocabulary::TextError;

/// Parameters that are always written: probing, G28, G30, G92, the work coordinate systems.
const REQUIRED: [(u32, u32); 5] =
    [(5161, 5169), (5181, 5189), (5210, 5219), (5220, 5220), (5221, 5390)];
/// Each work coordinate system has ten of twenty numbers.
const SYSTEM: u32 = 20;

/// The parameters of a file. Lines that are not pairs of numbers are skipped.
///
/// # Errors
/// The numbers do not ascend.
pub fn read_parameter_file(text: &str) -> Result<BTreeMap<u32, f64>, TextError> {
    let pairs = text.lines().enumerate().filter_map(|(place, line)| {
        let mut words = line.split_whitespace();
        Some((place + 1, words.next()?.parse().ok()?, words.next()?.parse().ok()?))
    });
    let mut parameters = BTreeMap::new();
    for (line, number, value) in pairs {
        if parameters.last_key_value().is_some_and(|(last, _)| *last >= number) {
            let message = format!("{number} is out of order: numbers must ascend");
            return Err(TextError { line: Some(line), message });
        }
        parameters.insert(number, value);
    }
    Ok(parameters)
}

fn is_required(number: u32) -> bool {
    let within = REQUIRED.iter().any(|(first, last)| (*first..=*last).contains(&number));
    let between = number > 5220 && (number - 5221) % SYSTEM > 9;
    within && !between
}

/// The text of a file with the parameters that it had, and those that are always written.
fn text(before: &BTreeMap<u32, f64>, now: &BTreeMap<u32, f64>) -> String {
    let mut text = String::new();
    let required = (5161..=5390).filter(|number| is_required(*number));
    let numbers: std::collections::BTreeSet<u32> = before.keys().copied().chain(required).collect();
    for number in numbers {
        let value = now.get(&number).copied().unwrap_or(0.0);
        // Writing into a text cannot fail.
        let _done = writeln!(text, "{number}\t{value:.6}");
    }
    text
}

/// Writes the file; a regular file that was there before is kept with `.bak` after its name.
///
/// # Errors
/// It cannot be written.
pub(super) fn write(
    path: &Path,
    before: &BTreeMap<u32, f64>,
    now: &BTreeMap<u32, f64>,
) -> io::Result<()> {
    let mut kept = path.as_os_str().to_owned();
    kept.push(".bak");
    copy_output(path, Path::new(&kept))?;
    write_output(path, text(before, now))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parameter_file_keeps_its_entries_and_adds_required_ones() {
        assert_eq!(read_parameter_file("31 5\n31 5\n").unwrap_err().line, Some(2));
        let before = read_parameter_file("31 5\n5220\t2\nabc\n").unwrap();
        assert_eq!(before, BTreeMap::from([(31, 5.0), (5220, 2.0)]));
        let text = text(&before, &BTreeMap::from([(31, 6.5), (100, 1.0)]));
        assert!(text.starts_with("31\t6.500000\n5161\t0.000000\n"));
        assert_eq!(text.lines().count(), 120);
    }
}
