//! Each rule of `fanuc-subs`; written from the pages by `cargo run -p gaugeblock-suite --bin model-ids`.

rules! {
    super::first::FANUC_SUBS;

    /// A block-deleted program end stops an endless program when block delete is off.
    BLOCK_DELETED_END = "fanuc-subs.block-deleted-end",
    /// M98 P calls the numbered subprogram, which M99 ends; the program goes on after the call.
    CALL = "fanuc-subs.call",
    /// Numbered programs can be disabled: then M98 is refused.
    DISABLED = "fanuc-subs.disabled",
    /// M99 in the main program begins it again at its first block: the program is endless.
    ENDLESS = "fanuc-subs.endless",
    /// Subprograms count as call levels: ten and no more.
    LEVEL_LIMIT = "fanuc-subs.level-limit",
    /// A block with a number alone may begin the main program; a comment after it has no meaning.
    MAIN_NUMBER = "fanuc-subs.main-number",
    /// An endsub or return cannot end a numbered subprogram.
    MIXED_ENDSUB = "fanuc-subs.mixed-endsub",
    /// M98 of a sub that begins with sub is refused.
    MIXED_M98 = "fanuc-subs.mixed-m98",
    /// M99 cannot end a sub that begins with sub.
    MIXED_M99 = "fanuc-subs.mixed-m99",
    /// An o-word call of a numbered subprogram is refused.
    MIXED_O_CALL = "fanuc-subs.mixed-o-call",
    /// A subprogram sees the local named parameters of its caller, or has a scope of its own for them; global
    /// ones are shared in any case.
    NAMED_LOCALS = "fanuc-subs.named-locals",
    /// A subprogram can call another one that follows; repeats multiply.
    NESTED = "fanuc-subs.nested",
    /// A call by M98 has no return value.
    NO_RETURN_VALUE = "fanuc-subs.no-return-value",
    /// M98 without P is refused.
    NUMBER_MISSING = "fanuc-subs.number-missing",
    /// L gives how many times the subprogram runs; without L it runs once.
    REPEAT_COUNT = "fanuc-subs.repeat-count",
    /// A subprogram shares `#1` to `#30` with its caller, and what it changes stays.
    SHARED_PARAMETERS = "fanuc-subs.shared-parameters",
    /// The subprogram is later in the file than its call; an earlier one is refused.
    SUB_FOLLOWS = "fanuc-subs.sub-follows",
    /// M98 to a number that the file does not define is refused.
    UNKNOWN_NUMBER = "fanuc-subs.unknown-number",
    /// With L0 the subprogram is not executed.
    ZERO_COUNT = "fanuc-subs.zero-count",
}
