//! Reads an error message and the line that is printed with it: which block was refused, and why.

use gaugeblock_adapter::HarnessError;
use gaugeblock_vocabulary::{Fault, FaultKind};

use super::faults;
use super::instrument::{LONGEST_LINE, Plan};
use super::source::{Source, code, last_comment};

/// What the program says first, and means nothing.
const GREETING: &str = "executing";

/// The fault that standard error reports. `next` is the block after the last one that is known to have been executed.
///
/// The message comes first, the refused line last. A line that a jump can reach has a tag; any other is the next one.
/// If the end of a file is the error, the line is merely the last one that was read.
///
/// # Errors
/// A message that the fault table does not explain.
pub(crate) fn fault(
    stderr: &str,
    source: &Source,
    plan: &Plan,
    next: Option<(usize, u32)>,
) -> Result<Fault, HarnessError> {
    let mut lines: Vec<_> =
        stderr.lines().filter(|line| !line.trim().is_empty() && *line != GREETING).collect();
    let echo = if lines.len() > 1 { lines.pop().unwrap_or_default() } else { "" };
    let aborted =
        abort_text(echo).is_some_and(|text| lines.first().is_some_and(|line| line.trim() == text));
    let known = lines.iter().find_map(|line| Some((*line, faults::kind(line)?)));
    let (message, kind) = match known {
        _ if aborted => (lines.first().copied().unwrap_or_default(), FaultKind::AbortedByProgram),
        Some(known) => known,
        None if abort_text(echo).is_some() => {
            (lines.first().copied().unwrap_or_default(), FaultKind::AbortedByProgram)
        }
        None => return Err(HarnessError::UnknownMessage(lines.join(" | "))),
    };
    let place = if kind == FaultKind::MissingEnd {
        None
    } else if kind == FaultKind::LineTooLong {
        next.and_then(|next| too_long(source, next))
    } else if matches!(kind, FaultKind::UnknownSub | FaultKind::MixedStyles)
        || message.starts_with("M7x:")
        || ends_profile(echo, source, next)
    {
        // The echo is the last line that a call sought through, or the definition that it found, or what a restore
        // tried, or the end of the profile that a lathe cycle has read.
        next
    } else {
        refused_line(echo, source, plan, next)
    };
    let line = place.map_or("", |(file, line)| source.line(file, line));
    Ok(Fault {
        kind: Some(kind).filter(|kind| !is_ambiguous(*kind, message, line)),
        block: place.map(|(file, line)| source.block(file, line)),
        span: None,
        message: plan.untagged(message).to_owned(),
    })
}

/// Whether a line ends the profile of the lathe cycle that is the next block: the cycle is refused then, by itself or
/// one of its moves.
fn ends_profile(echo: &str, source: &Source, next: Option<(usize, u32)>) -> bool {
    let next = next.map_or("", |(file, line)| source.line(file, line));
    let is_cycle = ["g70", "g71", "g72"].iter().any(|cycle| code(next).contains(cycle));
    is_cycle && ends_sub(echo) && !echo.contains('[')
}

/// Whether a line is the end of a sub or a return from it.
fn ends_sub(line: &str) -> bool {
    let code = code(line);
    ["endsub", "return"].iter().any(|end| code.contains(end))
}

/// Whether the message is the same for two kinds, so that the controller does not report which: for a word's value and
/// a parameter's number, and for a missing word and a negative one.
fn is_ambiguous(kind: FaultKind, message: &str, line: &str) -> bool {
    let code = code(line);
    match message {
        _ if kind == FaultKind::NotAnInteger => code.contains('#'),
        _ if message.contains("Dwell time missing") => code.contains('p'),
        _ if message.contains("P value out of range") => !code.contains('p'),
        _ => false,
    }
}

/// The next line that is too long, which the interpreter may have come upon while it skipped a sub.
fn too_long(source: &Source, (file, line): (usize, u32)) -> Option<(usize, u32)> {
    let long = |(of, number, text): &(usize, u32, &str)| {
        *of == file && *number >= line && text.len() > LONGEST_LINE
    };
    let following = source.all().find(long);
    let first = || source.all().find(|(of, _, text)| *of == file && text.len() > LONGEST_LINE);
    following.or_else(first).map(|(file, line, _)| (file, line))
}

/// The words of an error output, for a person.
pub(crate) fn message(stderr: &str) -> Option<&str> {
    let lines = stderr.lines().filter(|line| !line.trim().is_empty() && *line != GREETING);
    let mut known = lines.clone().filter(|line| faults::kind(line).is_some());
    known.next().or_else(|| lines.clone().next())
}

/// The line that is printed as the refused one. A lathe cycle calls its profile by a line of its own.
fn refused_line(
    echo: &str,
    source: &Source,
    plan: &Plan,
    next: Option<(usize, u32)>,
) -> Option<(usize, u32)> {
    let releases = echo.trim() == plan.release();
    let is_next =
        |next: &(usize, u32)| releases || source.line(next.0, next.1).trim() == echo.trim();
    let calls_profile = || next.filter(|_| echo.starts_with('O') && echo.ends_with(" CALL"));
    let read = || next.filter(is_next).or_else(|| source.only_line(echo));
    plan.tagged(echo).or_else(read).or_else(calls_profile)
}

/// The text of (ABORT,…), if it is what the line ends in.
fn abort_text(line: &str) -> Option<&str> {
    let (command, text) = last_comment(line)?.split_once(',')?;
    command.trim().eq_ignore_ascii_case("abort").then_some(text.trim())
}

#[cfg(test)]
mod tests {
    use super::*;
    use gaugeblock_vocabulary::{BlockLocation, Program};

    fn read(main: &str, stderr: &str, next: u32) -> Result<Fault, HarnessError> {
        let source = Source::new(&Program { main: main.to_owned(), ..Program::default() });
        let plan = Plan::new(&source, &std::collections::BTreeSet::new());
        fault(stderr, &source, &plan, Some((0, next)))
    }

    fn at(fault: &Fault) -> Option<u32> {
        fault.block.as_ref().map(|BlockLocation { line, .. }| *line)
    }

    #[test]
    fn the_next_block_is_refused() {
        let fault = read(
            "g0\nx1\nx1\n",
            "executing\nCannot use axis values without a g code that uses them\nx1\n",
            2,
        );
        let fault = fault.unwrap();
        assert_eq!((fault.kind, at(&fault)), (Some(FaultKind::AxisWords), Some(2)));
    }

    #[test]
    fn a_tag_names_a_block_that_was_reached_by_a_jump() {
        let stderr = "executing\nAttempt to divide by zero\no1 while [1/#1];@gb0@0.1\n";
        let fault = read("o1 while [1/#1]\n#1=0\no1 endwhile\n", stderr, 3).unwrap();
        assert_eq!((fault.kind, at(&fault)), (Some(FaultKind::DivideByZero), Some(1)));
    }

    #[test]
    fn a_line_that_was_only_skipped_is_found() {
        let long = " ".repeat(LONGEST_LINE);
        let stderr = "executing\nCommand too long\ng0 x1\n";
        assert_eq!(
            at(&read(&format!("o1 sub\ng0 x1{long}\no1 endsub\n"), stderr, 1).unwrap()),
            Some(2)
        );
        let stderr = "executing\nNested comment found\ng0 (((\n";
        assert_eq!(at(&read("o1 sub\ng0 (((\no1 endsub\n", stderr, 1).unwrap()), Some(2));
    }

    #[test]
    fn a_message_that_may_mean_two_kinds_has_none() {
        let stderr = |line| format!("executing\nNon integer value for integer\n{line}\n");
        assert_eq!(read("#1.5=2\n", &stderr("#1.5=2"), 1).unwrap().kind, None);
        assert_eq!(
            read("g43 h1.5\n", &stderr("g43 h1.5"), 1).unwrap().kind,
            Some(FaultKind::NotAnInteger)
        );
    }

    #[test]
    fn the_end_of_a_file_has_no_block() {
        let stderr = "executing\nFile ended with no percent sign or program end\ng0\n";
        assert_eq!(at(&read("g0\n", stderr, 2).unwrap()), None);
        let stderr = "executing\nEOF in file:main.ngc seeking o-word: o<9> from line: 1\nm2\n";
        assert_eq!(at(&read("o9 call\nm2\n", stderr, 1).unwrap()), Some(1));
    }

    #[test]
    fn an_error_after_a_profile_is_one_of_its_cycle() {
        let main = "o1 sub\ng1 x8 w-1 z0\no1 endsub\ng18\ng70 q1\nm2\n";
        let of = |message: &str, echo: &str| {
            at(&read(main, &format!("executing\n{message}\n{echo}\n"), 5).unwrap())
        };
        assert_eq!(of("G7X error: Not monotonic", "o1 endsub"), Some(5));
        assert_eq!(of("Cannot do G1 with zero feed rate", "o1 endsub"), Some(5));
        let in_a_block = "G7x error: Cannot use W and Z in the same block";
        assert_eq!(of(in_a_block, "g1 x8 w-1 z0"), Some(2));
        assert_eq!(of("Non integer value for integer", "O1.500000 CALL"), Some(5));
    }

    #[test]
    fn abort_is_distinguished_from_its_text() {
        let of = |main: &str, stderr: &str| read(main, stderr, 1).unwrap().kind;
        let abort = "(abort,divide by zero)\n";
        assert_eq!(
            of(abort, "executing\ndivide by zero\n(abort,divide by zero)\n"),
            Some(FaultKind::AbortedByProgram)
        );
        let other = "x[1/0] (abort,no)\n";
        let stderr = "executing\nAttempt to divide by zero\nx[1/0] (abort,no)\n";
        assert_eq!(of(other, stderr), Some(FaultKind::DivideByZero));
        assert_eq!(
            of("(abort,#1)\n", "executing\n5.000000\n(abort,#1)\n"),
            Some(FaultKind::AbortedByProgram)
        );
    }

    #[test]
    fn unknown_message_is_not_a_fault() {
        assert!(matches!(
            read("g0\n", "executing\nsurprise\ng0\n", 1),
            Err(HarnessError::UnknownMessage(_))
        ));
    }
}
