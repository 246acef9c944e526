//! Each rule of `path-control`; written from the pages by `cargo run -p gaugeblock-suite --bin model-ids`.

rules! {
    super::first::PATH_CONTROL;

    /// G64 sets continuous mode.
    CONTINUOUS = "path-control.continuous",
    /// G61 sets exact path mode.
    EXACT_PATH = "path-control.exact-path",
    /// G61.1 sets exact stop mode.
    EXACT_STOP = "path-control.exact-stop",
    /// A path control mode holds over motion until another is programmed.
    MODE_HOLDS = "path-control.mode-holds",
    /// Q of G64 is the naive CAM tolerance; zero turns it off.
    NAIVE_CAM = "path-control.naive-cam",
    /// Q of G64 without P is refused.
    NAIVE_CAM_ALONE = "path-control.naive-cam-alone",
    /// Without Q the naive CAM tolerance is the value of P.
    NAIVE_CAM_DEFAULT = "path-control.naive-cam-default",
    /// A tolerance below zero is refused, or counts as no tolerance.
    NEGATIVE_TOLERANCE = "path-control.negative-tolerance",
    /// A path control mode may be programmed while it is active.
    REPEATED = "path-control.repeated",
    /// P of G64 is the blend tolerance, in the active length unit.
    TOLERANCE = "path-control.tolerance",
    /// G61 and G61.1 take neither P nor Q.
    UNUSED_TOLERANCE = "path-control.unused-tolerance",
    /// G64 without P knows no tolerance, whatever was set before.
    WITHOUT_TOLERANCE = "path-control.without-tolerance",
}
