//! Each rule of `user-codes`; written from the pages by `cargo run -p gaugeblock-suite --bin model-ids`.

rules! {
    super::first::USER_CODES;

    /// P and Q reach the program as its first and second argument, as text.
    ARGUMENTS = "user-codes.arguments",
    /// A file that was added after the controller started is not known until the next start.
    AT_START = "user-codes.at-start",
    /// When the program of a user-defined code ends with a status other than zero, the run ends, or goes on.
    EXIT_STATUS = "user-codes.exit-status",
    /// A file whose name has an extension is not a program of a user-defined code.
    EXTENSION = "user-codes.extension",
    /// A file whose name is not M and the three digits of the code is not a program of it.
    FILE_NAME = "user-codes.file-name",
    /// A file whose name begins with a small m is not a program of a user-defined code.
    LOWER_CASE = "user-codes.lower-case",
    /// P and Q are optional; a missing one is replaced by -1 or by nothing.
    MISSING_ARGUMENT = "user-codes.missing-argument",
    /// A user-defined code whose file is not executable is unknown.
    NOT_EXECUTABLE = "user-codes.not-executable",
    /// The file must be in the folder of programs, or may be in the search path too; the first executable one
    /// counts.
    PLACE = "user-codes.place",
    /// M100 to M199 run the program of that name.
    RUN = "user-codes.run",
    /// User-defined codes are allowed while cutter compensation is on.
    UNDER_COMPENSATION = "user-codes.under-compensation",
    /// A user-defined code without a program is the error of an unknown code.
    UNKNOWN = "user-codes.unknown",
    /// The program goes on when the user-defined program has ended.
    WAITS = "user-codes.waits",
}
