//! Each rule of `task`; written from the pages by `cargo run -p gaugeblock-suite --bin model-ids`.

rules! {
    super::first::TASK;

    /// In auto mode a block by hand is refused; in MDI mode it is executed.
    AUTO_REFUSES_MDI = "task.auto-refuses-mdi",
    /// In manual mode a block by hand is refused, unless the controller changes its mode by itself.
    MDI_IN_MANUAL = "task.mdi-in-manual",
    /// While a program runs the controller stays in auto mode: a request for another mode is refused.
    MODE_KEPT = "task.mode-kept",
    /// Modes hold from one program to the next, and from blocks by hand to a program.
    MODES_CARRY_OVER = "task.modes-carry-over",
    /// Parameters have their values again when the program is run again: numbered and global ones, and those
    /// local to the main program.
    PARAMETERS_CARRY_OVER = "task.parameters-carry-over",
}
