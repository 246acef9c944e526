//! Each rule of `active-comments`; written from the pages by `cargo run -p gaugeblock-suite --bin model-ids`.

rules! {
    super::first::ACTIVE_COMMENTS;

    /// ABORT ends the program with its text as an error; the text may contain parameters.
    ABORT = "active-comments.abort",
    /// A named parameter that does not exist is printed as number signs, not refused.
    ABSENT_NAMED = "active-comments.absent-named",
    /// DEBUG displays a message with the values of parameters in it.
    DEBUG = "active-comments.debug",
    /// After %.0f to %.9f values are rounded to that number of decimals.
    DECIMALS_FORMAT = "active-comments.decimals-format",
    /// A format holds for the rest of the line until another one; it need not be next to the parameter.
    FORMAT_LASTS = "active-comments.format-lasts",
    /// A format does not outlast its line.
    FORMAT_PER_LINE = "active-comments.format-per-line",
    /// After %d values are rounded to integers.
    INTEGER_FORMAT = "active-comments.integer-format",
    /// Of several comments on a line only the last can be active.
    LAST_COMMENT = "active-comments.last-comment",
    /// LOG writes what follows its comma to the open log file, with the values of parameters in it.
    LOG = "active-comments.log",
    /// LOG writes nothing while no log file is open.
    LOG_CLOSED = "active-comments.log-closed",
    /// LOGOPEN opens and empties the named file, LOGAPPEND adds to it, LOGCLOSE closes it.
    LOG_OPEN = "active-comments.log-open",
    /// %lf is the format that holds where none is written.
    LONG_FORMAT = "active-comments.long-format",
    /// The message of a line comes before what its words do.
    MESSAGE_FIRST = "active-comments.message-first",
    /// MSG and a comma at the beginning of a comment display the rest of it.
    MSG = "active-comments.msg",
    /// MSG after other printing characters is a plain comment.
    MSG_FIRST = "active-comments.msg-first",
    /// MSG may have blanks within and before it and lower case letters.
    MSG_SPELLING = "active-comments.msg-spelling",
    /// The text of MSG is displayed unchanged; parameters are not replaced.
    MSG_VERBATIM = "active-comments.msg-verbatim",
    /// A number sign and a name in `<>` are replaced by the value of that parameter; blanks in the name do
    /// not count.
    NAMED = "active-comments.named",
    /// A number sign and a number are replaced by the value of that parameter.
    NUMBERED = "active-comments.numbered",
    /// A comment that is none of the active ones does nothing.
    PLAIN = "active-comments.plain",
    /// PRINT writes a message with the values of parameters in it.
    PRINT = "active-comments.print",
    /// PROBEOPEN opens a file for the points of successful probes, PROBECLOSE closes it.
    PROBE_LOG = "active-comments.probe-log",
    /// A semicolon comment is the last of its line and may be active.
    SEMICOLON = "active-comments.semicolon",
    /// What is not a format is printed unchanged.
    WRONG_FORMAT = "active-comments.wrong-format",
}
