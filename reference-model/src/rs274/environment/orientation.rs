//! Spindles that turn to an angle, and what their encoders answer.

use gaugeblock_vocabulary::scenario::OrientAnswer;

use super::state::{EnvironmentState, Orientation};

impl EnvironmentState {
    /// A spindle begins to turn to an angle. An encoder of which nothing is said answers at once.
    pub(crate) fn begin_orientation(&mut self, spindle: usize) {
        let at_once = OrientAnswer::After(0.0);
        let answer = self.scenario.orient.get(spindle).copied();
        let answer = answer.filter(|_| !self.is_stand_alone()).unwrap_or(at_once);
        let orientation = Orientation { begun: self.time, answer };
        self.orienting.insert(spindle, orientation);
        self.last_orientations.insert(spindle, orientation);
    }

    /// What is only read ahead waits for no encoder, and executes no program that could fail.
    pub(crate) fn answers_at_once(&mut self) {
        self.scenario.orient.clear();
        for program in &mut self.scenario.user_programs {
            program.exit_status = 0;
        }
    }

    /// Whether a spindle turns to an angle.
    pub(crate) fn is_orienting(&self) -> bool {
        !self.orienting.is_empty()
    }

    /// The orientation of a spindle that has not ended.
    pub(crate) fn orientation(&self, spindle: usize) -> Option<Orientation> {
        self.orienting.get(&spindle).copied()
    }

    /// The orientation of a spindle has ended, one way or another.
    pub(crate) fn end_orientation(&mut self, spindle: usize) {
        self.orienting.remove(&spindle);
    }

    /// When the next spindle that is being oriented reaches its angle.
    pub(crate) fn next_orientation(&self) -> Option<f64> {
        let done = self.orienting.values().filter_map(|orientation| orientation.done());
        done.reduce(f64::min).map(|time| time.max(self.time))
    }

    /// The operator asks for something now, or that is answered: what answers at the same time does so afterwards.
    pub(crate) fn is_asked(&mut self, is_asked: bool) {
        self.is_asked = is_asked;
    }

    /// Spindles that have reached their angle by now, each with the time at which it did.
    pub(crate) fn oriented(&self) -> Vec<(usize, f64)> {
        let done =
            self.orienting.iter().filter_map(|(spindle, begun)| Some((*spindle, begun.done()?)));
        let has_come = |time: f64| time < self.time || time <= self.time && !self.is_asked;
        done.filter(|(_, time)| has_come(*time)).collect()
    }
}
