//! Each choice of `control`; written from the pages by `cargo run -p gaugeblock-suite --bin model-ids`.

choices! {
    super::first::CONTROL;

    /// Whether a comment is allowed on the line of an o-word: 11.4.23 allows it, 11.7.3 calls the behaviour
    /// undefined.
    CommentAfterOWord = "control.comment-after-o-word" {
        /// the comment changes nothing
        Ignored = "ignored",
        /// the comment is refused like other words
        Refused = "refused",
    }

    /// Whether several do loops may carry the same label: 11.7.3 calls the use of one number for two blocks
    /// undefined, and the list of errors names repeat, while and if, but not do.
    DoLabel = "control.do-label" {
        /// what the list does not name is not an error: each while ends the do before it
        Each = "each",
        /// a label is defined once
        Refused = "refused",
        /// every while with the label goes back to the first do
        First = "first",
    }

    /// Whether a label still points to a condition or loop that has ended: the list of errors requires a
    /// matching if, the description requires a group that starts with if and ends with endif.
    EndedLabel = "control.ended-label" {
        /// the group has ended, so that nothing matches
        Refused = "refused",
        /// the label is defined, so that a further branch is skipped, a further endif does nothing and a
        /// further end of a loop goes back to its first block
        Followed = "followed",
    }

    /// How often a repeat runs whose count is not an integer. The document says: the number of times given.
    RepeatFraction = "control.repeat-fraction" {
        /// as often as the nearest integer says, from halfway the larger one
        Rounded = "rounded",
        /// as often as the nearest integer says, from halfway the even one
        RoundedToEven = "rounded-to-even",
        /// as often as the integer below says
        RoundedDown = "rounded-down",
        /// while fewer turns than the count have been made
        RoundedUp = "rounded-up",
        /// the count must be an integer
        Refused = "refused",
    }

    /// What a repeat with a negative count does. The document says: the number of times given.
    RepeatNegative = "control.repeat-negative" {
        /// no turn is made
        None = "none",
        /// a count is not negative
        Refused = "refused",
    }

    /// Whether a label is defined by a block that was skipped. The document calls a label that is defined
    /// elsewhere an error and does not say whether that other block must have been executed.
    SkippedDefinition = "control.skipped-definition" {
        /// the first definition in the text holds
        Counts = "counts",
        /// the first definition that is executed holds
        DoesNotCount = "does-not-count",
    }

    /// Whether a condition or loop inside a sub may carry the sub's own number: 11.7.3 calls the use of one
    /// number for two blocks undefined, 11.7.11 calls a label that is defined elsewhere an error.
    SubNumberAsLabel = "control.sub-number-as-label" {
        /// the sub's number is a label that is defined elsewhere
        Refused = "refused",
        /// numbers of subs and labels inside them do not meet
        Accepted = "accepted",
    }
}
