//! Each rule of `orient`; written from the pages by `cargo run -p gaugeblock-suite --bin model-ids`.

rules! {
    super::first::ORIENT;

    /// M19 turns the spindle to the angle R, in degrees.
    ANGLE = "orient.angle",
    /// R of M19 is 0 to 360 degrees.
    ANGLE_RANGE = "orient.angle-range",
    /// The brake is applied whenever the spindle is stopped and is not on its way to an angle, or only while
    /// it is locked.
    BRAKE_OTHERWISE = "orient.brake-otherwise",
    /// M3, M4 and M5 clear the request of M19 and unlock the spindle.
    CLEARED = "orient.cleared",
    /// When the encoder reports that the spindle is at its angle, the request is cleared, and the spindle is
    /// locked and braked.
    COMPLETE = "orient.complete",
    /// P of M19 says which way the spindle turns: 0 the shortest, 1 clockwise, 2 counterclockwise; 0 when it
    /// is not given.
    DIRECTION = "orient.direction",
    /// P of M19 is 0, 1 or 2.
    DIRECTION_RANGE = "orient.direction-range",
    /// A fault that the encoder reports while the spindle turns to its angle is an error.
    FAULT = "orient.fault",
    /// M19 and M3, M4 or M5 in one block are refused.
    GROUP = "orient.group",
    /// M19 without R is refused.
    NEEDS_ANGLE = "orient.needs-angle",
    /// M19 without Q is refused.
    NEEDS_TIMEOUT = "orient.needs-timeout",
    /// `ORIENT_OFFSET` of the machine is added to R of M19.
    OFFSET = "orient.offset",
    /// M19 sets the pins of the spindle: angle, direction and the request.
    PINS = "orient.pins",
    /// M19 takes the place of M3 and M4: the spindle that is oriented no longer turns by them.
    REPLACES_TURNING = "orient.replaces-turning",
    /// $ of M19 says which spindle is oriented.
    SPINDLE = "orient.spindle",
    /// $ of M19 must be a spindle of the machine.
    SPINDLE_RANGE = "orient.spindle-range",
    /// A spindle that is not oriented within Q seconds is an error.
    TIMEOUT = "orient.timeout",
    /// M19 waits for the spindle up to Q seconds.
    WAIT = "orient.wait",
    /// M19 without $ orients the first spindle, or every one.
    WITHOUT_DOLLAR = "orient.without-dollar",
    /// Q0 of M19 is refused, or is enough where the spindle is at its angle at once.
    ZERO_TIMEOUT = "orient.zero-timeout",
}
