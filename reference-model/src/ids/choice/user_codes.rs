//! Each choice of `user-codes`; written from the pages by `cargo run -p gaugeblock-suite --bin model-ids`.

choices! {
    super::first::USER_CODES;

    /// What a status other than zero does at the end of the program of a user-defined code. The examples all
    /// end with zero.
    ExitStatus = "user-codes.exit-status" {
        /// the run ends there
        EndsTheRun = "ends-the-run",
        /// the run goes on
        Ignored = "ignored",
    }

    /// What a user-defined code hands to its program for a word that is not there.
    MissingArgument = "user-codes.missing-argument" {
        /// the text of -1
        MinusOne = "minus-one",
        /// an empty text
        Empty = "empty",
    }

    /// Where the program of a user-defined code is looked for. One text names the folder of programs, another
    /// the search path, the last one both.
    Place = "user-codes.place" {
        /// in the folder of programs and then in the search path
        SearchPath = "search-path",
        /// in the folder of programs only
        ProgramPrefix = "program-prefix",
    }
}
