//! Each choice of `text`; written from the pages by `cargo run -p gaugeblock-suite --bin model-ids`.

choices! {
    super::first::TEXT;

    /// Whether a comment in parentheses may hold a left parenthesis. The document is silent.
    CommentNested = "text.comment-nested" {
        /// a left parenthesis within a comment is an error
        Refused = "refused",
        /// it is a character like any other
        Plain = "plain",
    }

    /// What a comment without its right parenthesis is: LinuxCNC refuses it, in Grbl it takes the rest of the
    /// line.
    CommentToLineEnd = "text.comment-to-line-end" {
        /// the comment is not closed
        Refused = "refused",
        /// it ends with its line
        ToLineEnd = "to-line-end",
    }

    /// Whether a comment can stand between a letter and its value: LinuxCNC refuses it, Grbl removes comments
    /// before it reads words.
    CommentsRemoved = "text.comments-removed" {
        /// the letter has no value
        Refused = "refused",
        /// the line is read as if the comment were not there
        Removed = "removed",
    }

    /// Whether there is a greatest line number: in LinuxCNC it is an unsigned integer, Grbl refuses one above
    /// 9,999,999, and NIST one that is not written with one to five digits.
    GreatestLineNumber = "text.greatest-line-number" {
        /// a line number has no bound
        None = "none",
        /// a line number above 9,999,999 is refused
        SevenDigits = "seven-digits",
        /// a line number has one to five digits, leading zeros counted
        FiveDigits = "five-digits",
    }

    /// Whether the line end is one of the at most 256 characters of a line. The document lists it among a
    /// line's parts and does not say.
    LineEndCounted = "text.line-end-counted" {
        /// 255 characters and the line end
        Counted = "counted",
        /// 256 characters and the line end
        NotCounted = "not-counted",
    }

    /// What a percent line is in a file that does not begin with one. The document is silent; no input that
    /// it does not allow is legal.
    PercentAlone = "text.percent-alone" {
        /// an illegal line
        Refused = "refused",
        /// the end of the file's contents
        Ends = "ends",
        /// a line without meaning
        Ignored = "ignored",
    }

    /// Whether a file that begins with a percent line needs the second one although an M2 ends it: one
    /// sentence requires it, another says that nothing after the end is read.
    PercentUnclosedEnded = "text.percent-unclosed-ended" {
        /// the program end is enough
        Accepted = "accepted",
        /// the second percent line is missed
        Refused = "refused",
    }
}
