//! Positions after each block, from a run block by block.

use std::fmt::Write as _;

use gaugeblock_vocabulary::{Axis, BlockLocation, Position, Program};

use super::sheet::number;

/// Positions after each block, in order; none for a block after which none was written down.
pub type Blocks = Vec<(BlockLocation, Option<Position>)>;

/// The text of positions after each block.
pub(super) fn blocks_text(axes: &[Axis], blocks: &Blocks) -> String {
    let names: Vec<&str> = axes.iter().map(|axis| axis.word()).collect();
    let mut text = format!("file,line,{}\n", names.join(","));
    for (block, position) in blocks {
        let _never = write!(text, "{},{}", block.file, block.line);
        for axis in axes {
            let value = position.map(|at| number(at.get(*axis))).unwrap_or_default();
            let _never = write!(text, ",{value}");
        }
        text.push('\n');
    }
    text
}

/// Reads positions after each block; none where no block is written down.
///
/// # Errors
/// What cannot be read, with its line.
pub fn read_blocks(text: &str, axes: &[Axis]) -> Result<Option<Blocks>, String> {
    let mut blocks = Blocks::new();
    let rows = (1..).zip(text.lines()).skip(1);
    for (at, row) in rows.filter(|(_, row)| !row.trim().is_empty()) {
        let wrong = |what: String| format!("line {at}: {what}");
        let fields: Vec<&str> = row.split(',').map(str::trim).collect();
        let &[file, line, ref values @ ..] = fields.as_slice() else {
            return Err(wrong("it has no file and line".to_owned()));
        };
        let line = line.parse().map_err(|_| wrong(format!("{line:?} is not a line number")))?;
        let mut position = Position::default();
        let is_told = values.iter().any(|value| !value.is_empty());
        if is_told && values.len() != axes.len() {
            return Err(wrong(format!(
                "expected the positions of {} axes, not of {}",
                axes.len(),
                values.len()
            )));
        }
        for (axis, value) in axes.iter().zip(values).filter(|_| is_told) {
            *position.get_mut(*axis) =
                value.parse().map_err(|_| wrong(format!("{value:?} is not a number")))?;
        }
        let file = if file.is_empty() { Program::MAIN } else { file };
        blocks.push((BlockLocation::new(file, line), is_told.then_some(position)));
    }
    Ok((!blocks.is_empty()).then_some(blocks))
}
