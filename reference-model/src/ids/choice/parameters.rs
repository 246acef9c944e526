//! Each choice of `parameters`; written from the pages by `cargo run -p gaugeblock-suite --bin model-ids`.

choices! {
    super::first::PARAMETERS;

    /// What a global named parameter that was never set is worth: uninitialised global parameters are zero
    /// says one sentence, uninitialised named ones are an error says the next.
    AbsentGlobal = "parameters.absent-global" {
        /// as a named one it is an error
        Refused = "refused",
        /// as a global one it is zero
        Zero = "zero",
    }

    /// Whether a function may follow a number sign, with its value as the parameter's number. The document
    /// names an integer, a further number sign and an expression in brackets.
    FunctionNumber = "parameters.function-number" {
        /// a number sign comes before an integer, a number sign or an expression
        Refused = "refused",
        /// a function is a value like any other
        Accepted = "accepted",
    }

    /// Up to which number there are parameters: to 5602 in LinuxCNC, to 5399 in NIST.
    Greatest = "parameters.greatest" {
        /// there are
        To5602 = "to-5602",
        /// there are none
        To5399 = "to-5399",
    }

    /// Whether `_lathe_diameter_mode` and `_lathe_radius_mode` report G7 and G8 on a machine that is not set
    /// up as a lathe. The document says that they need a lathe configuration and not what that is.
    LatheFlags = "parameters.lathe-flags" {
        /// they report the mode on every machine
        AnyMachine = "any-machine",
        /// they are 0 where the machine is not a lathe
        LatheOnly = "lathe-only",
    }

    /// Which code `_feed_override` and `_speed_override` follow. The list gives M50, the feed override, to
    /// the speed one, and M51 to the feed one.
    OverrideNames = "parameters.override-names" {
        /// `_feed_override` follows M50, `_speed_override` M51
        ByName = "by-name",
        /// `_feed_override` follows M51, `_speed_override` M50
        AsWritten = "as-written",
    }

    /// Whether a program may set the parameters of position and tool, 5400 to 5428. The document calls
    /// predefined parameters read-only and does not say which numbered ones.
    ReadOnlyNumbered = "parameters.read-only-numbered" {
        /// they are read-only
        Refused = "refused",
        /// it is accepted, and they still report the machine
        Written = "written",
    }

    /// Under which of G98 and G99 `_retract_old_z` and `_retract_r_plane` are 1. The table gives each the
    /// other one's code.
    RetractNames = "parameters.retract-names" {
        /// old Z under G98, R plane under G99
        ByName = "by-name",
        /// R plane under G98, old Z under G99
        AsWritten = "as-written",
    }

    /// Whether the settings of a block take effect before or after its words act. They wait until all values
    /// of the line have been found, and no longer is said; the order of execution does not list them.
    SettingTime = "parameters.setting-time" {
        /// they take effect last, over what the words set
        AfterWords = "after-words",
        /// they take effect first, and the words may set the same again
        BeforeWords = "before-words",
    }

    /// What `_spindle_on` is after M3 or M4 with a speed of zero: it reports whether the spindle runs, with
    /// M3 and M4 in parentheses, and at zero the spindle does not start turning.
    SpindleOnAtZero = "parameters.spindle-on-at-zero" {
        /// 1: it was started
        Commanded = "commanded",
        /// 0: it does not turn
        Turning = "turning",
    }
}
