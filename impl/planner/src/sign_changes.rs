//! When an acceleration had either sign.

/// For how many cycles the acceleration has not been positive, and for how many it has not been negative, along the
/// line.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SignChanges {
    not_positive: u16,
    not_negative: u16,
}

impl Default for SignChanges {
    fn default() -> Self {
        Self { not_positive: u16::MAX, not_negative: u16::MAX }
    }
}

impl SignChanges {
    /// For how many cycles the motion has not sped up, and for how many it has not slowed down.
    pub(crate) fn in_direction(self, is_reversed: bool) -> (u16, u16) {
        if is_reversed {
            (self.not_negative, self.not_positive)
        } else {
            (self.not_positive, self.not_negative)
        }
    }

    /// Records the acceleration of a cycle.
    pub(crate) fn note(&mut self, along: f64) {
        self.not_positive = if along > 0.0 { 0 } else { self.not_positive.saturating_add(1) };
        self.not_negative = if along < 0.0 { 0 } else { self.not_negative.saturating_add(1) };
    }
}
