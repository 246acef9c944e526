//! How far, and for how long, a motion may go on that is requested to stop or to slow down.

use super::easing::Easing;
use super::matching::Matching;
use super::record::Record;
use crate::math::power;
use crate::motion::bound::{Stop, stopping, stopping_on_blend};
use crate::motion::envelope::Envelope;
use crate::motion::route::Route;

impl Record<'_> {
    /// The time for which a motion that stops may be near a point before it reaches it, or after it leaves it. With a
    /// limit of jerk a way s takes the cube root of 6·s/j. Twice that is granted at each end.
    pub(super) fn lingers(&self) -> f64 {
        let moves = (0..9).filter(|axis| self.moves(*axis));
        let jerk = moves.map(|axis| self.envelope.jerk[axis]).fold(f64::INFINITY, f64::min);
        if jerk.is_finite() { 4.0 * power(6.0 * self.slack / jerk, 1.0 / 3.0) } else { 0.0 }
    }

    /// The distance and time that a motion is granted to stop from a speed at a sample.
    pub(super) fn granted_stop(
        &self,
        (route, matching): (&Route<'_>, &Matching),
        sample: usize,
        speed: f64,
    ) -> Stop {
        let place = matching.place(sample);
        let from = (place.leg, place.part);
        if !self.envelope.limits_jerk() || speed <= 0.0 {
            let stop = stopping(route, &self.envelope, from, speed);
            return stop.most(self.stopping_on_blend(&self.envelope, (route, matching), sample));
        }
        let easing = Easing::of(&self.envelope, speed, |axis| self.moves(axis));
        let stop = stopping(route, &easing.envelope, from, easing.speed);
        let stop = stop.most(self.stopping_on_blend(&easing.envelope, (route, matching), sample));
        Stop {
            distance: stop.distance + easing.speed * easing.seconds,
            seconds: stop.seconds + easing.seconds,
        }
    }

    /// What it takes to stop at a sample on a blend that the motion may be on.
    fn stopping_on_blend(
        &self,
        envelope: &Envelope,
        (route, matching): (&Route<'_>, &Matching),
        sample: usize,
    ) -> Stop {
        if sample == 0 {
            return Stop::default();
        }
        let (place, step) = (matching.place(sample), self.step(sample));
        let velocity = step.map(|step| step / self.period);
        stopping_on_blend(route, envelope, (place.leg, place.part), &velocity)
    }
}
