//! Each rule of `abort`; written from the pages by `cargo run -p gaugeblock-suite --bin model-ids`.

rules! {
    super::first::ABORT;

    /// An abort in a sub with M73 does not restore the state that was saved.
    AUTORESTORE = "abort.autorestore",
    /// An abort ends the run: what follows is not executed, whatever block it breaks off.
    ENDS = "abort.ends",
    /// After an abort modes and parameters are those of the interrupted block, or those of the blocks that
    /// the interpreter had read ahead; reading ahead changes neither the machine's position nor its tools.
    READ_AHEAD = "abort.read-ahead",
    /// After an abort cycle start starts the program at the beginning of the file.
    RESTART = "abort.restart",
    /// An abort stops the spindles and switches coolant off, or leaves both alone.
    SPINDLE_AND_COOLANT = "abort.spindle-and-coolant",
}
