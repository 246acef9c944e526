//! The name of a program where the vocabulary says `main.ngc`.

use std::borrow::Cow;
use std::path::Path;

use gaugeblock_report::escape_line;
use gaugeblock_vocabulary::{BlockLocation, End, Outcome, Program};

use crate::command::user_files;

/// File extension of the toolpath that drives a post-processor program.
pub(crate) const TOOLPATH: &str = "toolpath";

/// The name of a program without its folder.
pub(crate) fn own_name(file: &Path) -> String {
    let name = file.file_name().filter(|_| !user_files::is_standard_input(file));
    name.map_or_else(|| user_files::program_name(file), |name| name.to_string_lossy().into_owned())
}

/// A block's file, as the caller knows it.
pub(crate) fn location_name(block: &BlockLocation, file: &Path) -> String {
    match &*block.file {
        Program::MAIN => user_files::program_name(file),
        TOOLPATH => file.with_extension(TOOLPATH).display().to_string(),
        other => escape_line(other),
    }
}

/// A block under the name of its program.
pub(crate) fn of_block(block: BlockLocation, file: &Path) -> BlockLocation {
    let BlockLocation { file: named, line } = block;
    let named = if named == Program::MAIN { Cow::Owned(own_name(file)) } else { named };
    BlockLocation { file: named, line }
}

/// A text that names blocks, with the name of the program.
pub(crate) fn in_text(text: &str, file: &Path) -> String {
    text.replace(&format!("{}:", Program::MAIN), &format!("{}:", own_name(file)))
}

/// An outcome whose blocks have the name of the program.
pub(crate) fn of_outcome(outcome: &Outcome, file: &Path) -> Outcome {
    let mut named = outcome.clone();
    for step in &mut named.steps {
        step.block = of_block(step.block.clone(), file);
    }
    match &mut named.end {
        End::Fault(fault) => fault.block = fault.block.take().map(|block| of_block(block, file)),
        End::Unsupported { block, .. } | End::Unspecified { block, .. } => {
            *block = of_block(block.clone(), file);
        }
        End::ProgramEnd
        | End::PercentEnd
        | End::StreamEnd
        | End::Endless
        | End::Paused
        | End::Aborted
        | End::BudgetExhausted { .. } => {}
    }
    named
}
