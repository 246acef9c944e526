//! The operator's settings: switches and overrides.

use gaugeblock_vocabulary::scenario::Action;

/// Most spindles of a machine.
pub(super) const SPINDLES: usize = 8;

/// The operator's panel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Panel {
    /// M1 pauses.
    pub(super) optional_stop: bool,
    /// 1 is 100 %.
    pub(super) feed_override: f64,
    /// 1 is 100 %.
    pub(super) rapid_override: f64,
    /// By spindle; 1 is 100 %.
    pub(super) spindle_override: [f64; SPINDLES],
    /// The feed stop is pressed.
    pub(super) feed_hold: bool,
}

impl Panel {
    /// Nothing is pressed, and everything is at 100 %.
    pub(super) fn new() -> Self {
        Self {
            optional_stop: false,
            feed_override: 1.0,
            rapid_override: 1.0,
            spindle_override: [1.0; SPINDLES],
            feed_hold: false,
        }
    }

    /// Applies what the operator sets, in every mode and at every time; whether the action was only a setting.
    pub(super) fn apply(&mut self, action: &Action) -> bool {
        match action {
            Action::OptionalStop(on) => self.optional_stop = *on,
            Action::FeedOverride(factor) => self.feed_override = *factor,
            Action::RapidOverride(factor) => self.rapid_override = *factor,
            Action::SpindleOverride { spindle, factor } => {
                if let Some(place) = self.spindle_override.get_mut(usize::from(*spindle)) {
                    *place = *factor;
                }
            }
            Action::FeedHold(pressed) => self.feed_hold = *pressed,
            Action::CycleStart
            | Action::Pause
            | Action::Resume
            | Action::Abort
            | Action::Mode(_)
            | Action::Mdi(_) => return false,
        }
        true
    }
}
