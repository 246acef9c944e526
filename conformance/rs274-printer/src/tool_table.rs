//! LinuxCNC's tool table: a tool a line, comments after a semicolon.

use gaugeblock_vocabulary::{Axis, TextError, Tool};

/// Reads a tool table. Lengths have the unit of the machine.
///
/// # Errors
/// The first line that does not describe a tool, or that describes one a second time.
pub fn read_tool_table(text: &str) -> Result<Vec<Tool>, TextError> {
    let mut tools: Vec<Tool> = Vec::new();
    for (place, line) in text.lines().enumerate() {
        let wrong = |message: String| TextError { line: Some(place + 1), message };
        let Some(tool) = tool(line).map_err(wrong)? else { continue };
        if tools.iter().any(|other| other.number == tool.number) {
            return Err(wrong(format!("tool {} is described twice", tool.number)));
        }
        tools.push(tool);
    }
    Ok(tools)
}

/// The lines of a tool table that describe a tool; `rs274` skips the others.
pub(super) fn tools(text: &str) -> Vec<Tool> {
    text.lines().filter_map(|line| tool(line).ok().flatten()).collect()
}

/// The tool of a line; none where it is blank.
fn tool(line: &str) -> Result<Option<Tool>, String> {
    let mut tool = Tool::default();
    let mut numbered = false;
    let words = line.split(';').next().unwrap_or_default();
    for word in words.split_whitespace() {
        let mut rest = word.chars();
        let letter = rest.next().map_or_else(String::new, |c| c.to_ascii_uppercase().to_string());
        let value: f64 = rest
            .as_str()
            .parse()
            .ok()
            .filter(|value: &f64| value.is_finite())
            .ok_or_else(|| format!("`{word}` is not a letter with a number"))?;
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
                let axes = Axis::ALL.iter();
                let mut axes = axes.filter(|axis| axis.to_string().eq_ignore_ascii_case(&letter));
                let axis = axes.next().ok_or_else(|| {
                    format!("`{word}`: expected T, P, X, Y, Z, A, B, C, U, V, W, D, I, J or Q")
                })?;
                *tool.offset.get_mut(*axis) = value;
            }
        }
    }
    if words.trim().is_empty() {
        return Ok(None);
    }
    if numbered { Ok(Some(tool)) } else { Err("no tool number: expected a word T".to_owned()) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_tool_table_is_read() {
        let text = "T1 P2 Z0.5 D.125 ; end mill\n\nt20 P1 X-1 I10 J20 Q3\n; T3\n";
        let tools = read_tool_table(text).unwrap();
        assert_eq!(tools, self::tools(text));
        assert_eq!(tools.len(), 2);
        assert_eq!((tools[0].number, tools[0].pocket, tools[0].offset.z), (1, Some(2), 0.5));
        assert_eq!(
            (tools[1].front_angle, tools[1].back_angle, tools[1].orientation),
            (10.0, 20.0, 3)
        );
    }

    #[test]
    fn line_without_a_tool_is_refused_with_its_place() {
        for (text, line, words) in [
            ("T1 P1\nT2 P2 K5\n", 2, "`K5`: expected T"),
            ("T1 Z\n", 1, "`Z` is not a letter with a number"),
            (";\n\nP1 Z5\n", 3, "no tool number"),
            ("T1 P1\nT1 P2\n", 2, "tool 1 is described twice"),
        ] {
            let error = read_tool_table(text).unwrap_err();
            assert_eq!(error.line, Some(line), "{text}");
            assert!(error.message.contains(words), "{text}: {}", error.message);
        }
        assert_eq!(tools("T1 P1\nT2 P2 K5\n").len(), 1);
    }
}
