//! Programs in which every transcendental result is changed by about one unit in its last place (ULP).

use gaugeblock_vocabulary::{Language, Scenario};

/// Functions whose results differ in the last bit from one library to the next.
const FUNCTIONS: &[&str] = &["sin", "cos", "tan", "asin", "acos", "atan", "exp", "ln"];

/// Those whose argument is converted into radians, which moves their zeros.
const OF_ANGLES: &[&str] = &["sin", "cos", "tan"];

/// About the last bit of an angle of one turn, in radians.
const LAST_BIT: &str = "0.000000000000001";

/// One and its neighbours, as they are written.
const UP: &str = "1.0000000000000002";
const DOWN: &str = "0.9999999999999999";

/// The scenario with the result of each function moved up or down by about one ULP, and the argument of a function of
/// an angle by one too. `None` if the program has no function. If the outcome changes, the program is fragile.
pub fn ulp_perturbed(scenario: &Scenario, up: bool) -> Option<Scenario> {
    let mut other = scenario.clone();
    let brackets = scenario.program.language != Language::Nct;
    other.program.main = text(&scenario.program.main, up, brackets);
    for (name, file) in &scenario.program.files {
        other.program.files.insert(name.clone(), text(file, up, brackets));
    }
    (other.program != scenario.program).then_some(other)
}

fn text(text: &str, up: bool, brackets: bool) -> String {
    text.split_inclusive('\n').map(|piece| line(piece, up, brackets)).collect()
}

/// Inner functions are to the right of outer ones, so that they are wrapped first. Custom macros allow five levels of
/// brackets, and a factor without brackets belongs to the function.
fn line(line: &str, up: bool, brackets: bool) -> String {
    let (factor, sign) = if up { (UP, '+') } else { (DOWN, '-') };
    let mut line = line.to_owned();
    let lower = line.to_ascii_lowercase();
    let speech = lower.find(['(', ';']).unwrap_or(lower.len());
    for at in (0..speech).rev() {
        let Some(rest) = lower.get(at..) else { continue };
        let begins =
            |name: &&&str| rest.strip_prefix(**name).is_some_and(|rest| rest.starts_with('['));
        // The letter of a word may stand before a function; an A there makes it another one.
        let in_word = at > 0 && lower.as_bytes()[at - 1] == b'a';
        let named =
            FUNCTIONS.iter().find(begins).filter(|name| !(in_word && OF_ANGLES.contains(*name)));
        let Some(name) = named else { continue };
        if let Some(end) = end_of(&line, at + name.len()) {
            let call = &line[at..end];
            let wrapped = if !brackets {
                format!("{call} * {factor}")
            } else if OF_ANGLES.contains(name) {
                format!("[{call} * {factor} {sign} {LAST_BIT}]")
            } else {
                format!("[{call} * {factor}]")
            };
            line.replace_range(at..end, &wrapped);
        }
    }
    line
}

/// Where the brackets that open here end, with those that divide them (`atan[1]/[2]`).
fn end_of(line: &str, open: usize) -> Option<usize> {
    let mut depth = 0_u32;
    for (at, byte) in line.bytes().enumerate().skip(open) {
        match byte {
            b'[' => depth += 1,
            b']' => depth = depth.checked_sub(1)?,
            _ => {}
        }
        if depth == 0 {
            let after = &line[at + 1..];
            return if after.starts_with("/[") { end_of(line, at + 2) } else { Some(at + 1) };
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_function_is_moved() {
        let up = |text| ulp_perturbed(&Scenario::of(text), true).map(|other| other.program.main);
        assert_eq!(up("g1 x[1 + 2] (sin[1])\n"), None);
        assert_eq!(up("x sin[30]\n").unwrap(), format!("x [sin[30] * {UP} + {LAST_BIT}]\n"));
        assert_eq!(
            up("#1 = atan[1]/[cos[2]]\n").unwrap(),
            format!("#1 = [atan[1]/[[cos[2] * {UP} + {LAST_BIT}]] * {UP}]\n")
        );
        let down =
            ulp_perturbed(&Scenario::of("#1 = tan[180]\n"), false).map(|other| other.program.main);
        assert_eq!(down.unwrap(), format!("#1 = [tan[180] * {DOWN} - {LAST_BIT}]\n"));
        assert_eq!(up("#1 = ASIN[.5]\n").unwrap(), format!("#1 = [ASIN[.5] * {UP}]\n"));
        assert_eq!(up("xsin[30]\n").unwrap(), format!("x[sin[30] * {UP} + {LAST_BIT}]\n"));
        // How a half is rounded the documents say; where a computed position decides, the model is asked to round
        // that otherwise.
        assert_eq!(up("x round[#5420]\n"), None);
        let mut of_macros = Scenario::of("#1 = 2 * SIN[[30]]\n");
        of_macros.program.language = Language::Nct;
        let moved = ulp_perturbed(&of_macros, true).map(|other| other.program.main);
        assert_eq!(moved.unwrap(), format!("#1 = 2 * SIN[[30]] * {UP}\n"));
    }
}
