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
