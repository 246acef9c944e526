//! Each rule of `outputs`; written from the pages by `cargo run -p gaugeblock-suite --bin model-ids`.

rules! {
    super::first::OUTPUTS;

    /// M68 sets an analog output when its block is executed; zero turns it off.
    ANALOG_AT_ONCE = "outputs.analog-at-once",
    /// M67 and M68 without E are refused.
    ANALOG_NEEDS_NUMBER = "outputs.analog-needs-number",
    /// M67 and M68 without Q are refused.
    ANALOG_NEEDS_VALUE = "outputs.analog-needs-value",
    /// E of M67 and M68 is the number of an analog output: 0 to 3 unless the machine has more or fewer.
    ANALOG_NUMBER_RANGE = "outputs.analog-number-range",
    /// M67 sets an analog output together with the next motion; zero turns it off.
    ANALOG_WITH_MOTION = "outputs.analog-with-motion",
    /// What M62, M63 and M67 set changes when the next motion begins, and not before.
    AT_NEXT_MOTION = "outputs.at-next-motion",
    /// M64, M65 and M68 keep, or cancel, what is queued for the same output until the next motion.
    AT_ONCE_OVER_WAITING = "outputs.at-once-over-waiting",
    /// A machine can have another number of outputs than four.
    COUNT = "outputs.count",
    /// Of several settings of one output that wait for a motion only the last one counts.
    LATEST_COUNTS = "outputs.latest-counts",
    /// M62 to M65 without P are refused.
    NEEDS_NUMBER = "outputs.needs-number",
    /// P of M62 to M65 is the number of an output: 0 to 3 unless the machine has more or fewer.
    NUMBER_RANGE = "outputs.number-range",
    /// M65 turns a digital output off when its block is executed.
    OFF_AT_ONCE = "outputs.off-at-once",
    /// M63 turns a digital output off together with the next motion.
    OFF_WITH_MOTION = "outputs.off-with-motion",
    /// M64 turns a digital output on when its block is executed.
    ON_AT_ONCE = "outputs.on-at-once",
    /// M62 turns a digital output on together with the next motion.
    ON_WITH_MOTION = "outputs.on-with-motion",
    /// Several outputs can wait for one motion.
    SEVERAL = "outputs.several",
    /// M62 to M65, M67 and M68 are allowed, or refused, while cutter compensation is on.
    UNDER_COMPENSATION = "outputs.under-compensation",
    /// After an abort what waited for a motion is forgotten, or waits for the next one.
    WAITING_AFTER_ABORT = "outputs.waiting-after-abort",
    /// What waits for a motion never changes when none follows.
    WITHOUT_MOTION = "outputs.without-motion",
}
