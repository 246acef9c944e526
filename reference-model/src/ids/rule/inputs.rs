//! Each rule of `inputs`; written from the pages by `cargo run -p gaugeblock-suite --bin model-ids`.

rules! {
    super::first::INPUTS;

    /// M66 with an analog input allows L0 only.
    ANALOG_IMMEDIATE = "inputs.analog-immediate",
    /// M66 with both a digital and an analog input is refused.
    BOTH = "inputs.both",
    /// M66 reads what is connected to the input.
    CONNECTED = "inputs.connected",
    /// A machine can have another number of inputs than four.
    COUNT = "inputs.count",
    /// M66 L2 waits until the input goes from high to low.
    FALL = "inputs.fall",
    /// M66 L3 waits until the input is high.
    HIGH = "inputs.high",
    /// Q of M66 is ignored under L0.
    IGNORED_TIMEOUT = "inputs.ignored-timeout",
    /// M66 L0 reads the input without waiting; `#5399` holds its value.
    IMMEDIATE = "inputs.immediate",
    /// M66 L4 waits until the input is low.
    LOW = "inputs.low",
    /// M66 without L reads the input without waiting.
    MODE_OPTIONAL = "inputs.mode-optional",
    /// L of M66 is 0 to 4.
    MODE_RANGE = "inputs.mode-range",
    /// P and E of M66 are the number of an input: 0 to 3 unless the machine has more or fewer.
    NUMBER_RANGE = "inputs.number-range",
    /// M66 needs P, a digital input, or E, an analog one.
    ONE_INPUT = "inputs.one-input",
    /// `#5399` holds what the last M66 found.
    RESULT = "inputs.result",
    /// M66 L1 waits until the input goes from low to high.
    RISE = "inputs.rise",
    /// When what M66 waits for does not come within Q seconds, the wait ends and `#5399` is -1.
    TIMEOUT = "inputs.timeout",
    /// An input to which nothing is connected stays low: what is awaited there never comes.
    UNCONNECTED = "inputs.unconnected",
    /// M66 is allowed, or refused, while cutter compensation is on.
    UNDER_COMPENSATION = "inputs.under-compensation",
    /// M66 stops the program until what it waits for comes, or its time is over.
    WAITS = "inputs.waits",
    /// A wait of M66 without Q is refused, or lasts as long as it takes.
    WITHOUT_TIMEOUT = "inputs.without-timeout",
    /// Q0 of M66 is refused unless L is 0.
    ZERO_TIMEOUT = "inputs.zero-timeout",
}
