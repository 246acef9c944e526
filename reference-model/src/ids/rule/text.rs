//! Each rule of `text`; written from the pages by `cargo run -p gaugeblock-suite --bin model-ids`.

rules! {
    super::first::TEXT;

    /// The letter of an axis that the machine does not have is refused.
    ABSENT_AXIS = "text.absent-axis",
    /// Blank lines are allowed and ignored.
    BLANK_LINES = "text.blank-lines",
    /// Spaces and tabs are allowed anywhere on a line, within words and numbers too, and change nothing.
    BLANKS = "text.blanks",
    /// While block delete is off, a line that begins with a slash is executed like any other.
    BLOCK_DELETE_OFF = "text.block-delete-off",
    /// While block delete is on, a line that begins with a slash is skipped; not even its errors count.
    BLOCK_DELETE_ON = "text.block-delete-on",
    /// The slash is first on its line, once, before the line number; elsewhere it is refused.
    BLOCK_DELETE_PLACE = "text.block-delete-place",
    /// A letter outside a comment means the same in upper and in lower case.
    CASE = "text.case",
    /// Each of several comments on a line is checked, also those that are ignored.
    COMMENT_FORMAT_CHECKED = "text.comment-format-checked",
    /// A comment between a letter and its value is refused.
    COMMENT_INSIDE_WORD = "text.comment-inside-word",
    /// A comment in parentheses is allowed between words and has no influence.
    COMMENT_PARENTHESES = "text.comment-parentheses",
    /// A semicolon begins a comment that takes the rest of the line, but not inside parentheses.
    COMMENT_SEMICOLON = "text.comment-semicolon",
    /// Whether a comment without its right parenthesis is refused, or takes the rest of its line, is a
    /// choice.
    COMMENT_TO_LINE_END = "text.comment-to-line-end",
    /// A comment whose right parenthesis is missing, and a right parenthesis without a comment, are refused.
    COMMENT_UNCLOSED = "text.comment-unclosed",
    /// Inside a comment blanks and case stay as they are written.
    COMMENT_VERBATIM = "text.comment-verbatim",
    /// Whether a comment between a letter and its value is refused is a choice.
    COMMENTS_REMOVED = "text.comments-removed",
    /// Whether a line number above 9,999,999, or one of more than five digits, is refused is a choice.
    GREATEST_LINE_NUMBER = "text.greatest-line-number",
    /// Characters that no rule allows are refused.
    ILLEGAL_INPUT = "text.illegal-input",
    /// What is neither a word, a parameter setting nor a comment is refused.
    ILLEGAL_ITEM = "text.illegal-item",
    /// Words, settings and comments may be in any order among each other without changing a line's meaning.
    ITEM_ORDER = "text.item-order",
    /// A line needs neither words nor settings: a line number, a slash or a comment alone is a line.
    ITEMS_OPTIONAL = "text.items-optional",
    /// A line ends with a carriage return, a line feed or both.
    LINE_END = "text.line-end",
    /// A line has at most 256 characters; a longer one is refused.
    LINE_LENGTH = "text.line-length",
    /// A line number is N and an unsigned integer, and may go on with a period and another unsigned integer.
    LINE_NUMBER = "text.line-number",
    /// A line number with a sign, without digits on either side of its period, or computed, is refused.
    LINE_NUMBER_FORM = "text.line-number-form",
    /// Line numbers may be repeated, skipped and out of order, and mean nothing.
    LINE_NUMBER_ORDER = "text.line-number-order",
    /// A line number is first on its line or after the slash; elsewhere, or a second one, is refused.
    LINE_NUMBER_PLACE = "text.line-number-place",
    /// In a file that begins with a percent line, the second percent line ends the program; what follows is
    /// ignored.
    PERCENT_FILE = "text.percent-file",
    /// A percent line holds nothing else than the percent sign and blanks, and may follow blank lines.
    PERCENT_LINE = "text.percent-line",
    /// Percent lines are optional where the program has an M2 or M30, which ends it before the second percent
    /// line.
    PERCENT_OPTIONAL = "text.percent-optional",
    /// A file with a percent line at its beginning, and neither another one nor a program end, is refused.
    PERCENT_UNCLOSED = "text.percent-unclosed",
    /// The letters of the table begin words; another one only where a code has it, as E of G76 and of M66 to
    /// M68.
    WORD_LETTERS = "text.word-letters",
    /// A word is a letter and a number, or something that evaluates to a number.
    WORD_VALUE = "text.word-value",
}
