//! Each choice of `active-comments`; written from the pages by `cargo run -p gaugeblock-suite --bin model-ids`.

choices! {
    super::first::ACTIVE_COMMENTS;

    /// What a message prints for a named parameter that does not exist. The manual prints one number sign;
    /// its typesetting may have swallowed more.
    AbsentName = "active-comments.absent-name" {
        /// one number sign
        NumberSign = "number-sign",
        /// six number signs
        SixNumberSigns = "six-number-signs",
    }

    /// How many decimals a value has in a message without a format: %lf is said to be the default, which is
    /// not in the list of formats.
    DefaultFormat = "active-comments.default-format" {
        /// six
        SixDecimals = "six-decimals",
        /// four, as %f
        FourDecimals = "four-decimals",
    }

    /// Whether blanks around the name of a log belong to it. The manual writes none, and elsewhere takes
    /// comments unchanged.
    FileNameBlanks = "active-comments.file-name-blanks" {
        /// the name is the text between them
        LeftOut = "left-out",
        /// the name is all that follows the comma
        PartOfIt = "part-of-it",
    }

    /// Whether MSG without a comma is a message. The form has a comma; the sentence requires only that MSG
    /// comes first.
    MsgWithoutComma = "active-comments.msg-without-comma" {
        /// it is a plain comment
        Plain = "plain",
        /// the rest is displayed
        Message = "message",
    }

    /// How many decimals %f gives. The list says four; the language of the other formats has six.
    PlainFFormat = "active-comments.plain-f-format" {
        /// four
        FourDecimals = "four-decimals",
        /// six
        SixDecimals = "six-decimals",
    }

    /// Which value a message prints of a parameter that is set in its own block: settings wait for all
    /// parameter values of the line, and the message comes before the words.
    SameBlockSetting = "active-comments.same-block-setting" {
        /// the value that the block sets
        New = "new",
        /// the value from before
        Old = "old",
    }
}
