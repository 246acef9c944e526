//! Modes and offsets of a block, and what M72 and the end of a sub with M73 bring back.

use gaugeblock_vocabulary::{
    Compensation, FeedMode, LengthUnit, PathControlMode, SpindleLimit, SpindleMode, Switch,
};

use super::block::Printed;
use super::codes::{WORK_OFFSETS, system_of};
use super::modes::{Modes, Spindle};
use super::scale::{scale, scaled};

impl Printed<'_> {
    /// Settings after the block, except those that the end of a program resets after they were set.
    pub(super) fn set(&self) -> Modes {
        let mut after = self.after;
        if self.words.has_m(2) || self.words.has_m(30) {
            after.assume(self.words);
        }
        after
    }

    /// Lathe mode and compensation.
    pub(super) fn compensation(&mut self) {
        let after = self.set();
        if self.words.g_of(&[70, 80]).is_some() && self.before.lathe != after.lathe {
            self.out.lathe(after.lathe);
        }
        match self.words.g_of(&[400, 410, 420, 411, 421]) {
            Some(400) => {
                self.put_out(usize::MAX);
                self.out.compensation(Compensation::Off);
            }
            // A negative diameter changes the side.
            Some(code) => {
                let negative = self.words.get(b'D').is_some_and(|diameter| diameter < 0.0);
                let left = matches!(code, 410 | 411) != negative;
                self.out.compensation(if left { Compensation::Left } else { Compensation::Right });
            }
            None => {}
        }
    }

    /// Whether compensation is on for what the block does after its code.
    fn compensates(&self) -> bool {
        let code = self.words.g_of(&[400, 410, 420, 411, 421]);
        code.map_or(self.before.compensation != Compensation::Off, |code| code != 400)
    }

    /// Tool length, work offset, path, distance, retract.
    pub(super) fn modes(&mut self) {
        if self.words.g.is_empty() {
            return;
        }
        let (before, after) = (self.before, self.set());
        if self.words.g_of(&[430, 431, 432, 490]).is_some() {
            self.out.tool_offset(&after.tool_offset);
        }
        if let Some(code) = self.words.g_of(&WORK_OFFSETS) {
            self.work_offset(code);
        }
        match self.words.g_of(&[610, 611, 640]) {
            Some(640) => {
                self.out.path_mode(&after);
                self.out.naive_cam_tolerance(&after);
            }
            Some(_) => self.out.path_mode(&after),
            None => {}
        }
        if before.distance != after.distance && self.words.g_of(&[900, 910]).is_some() {
            self.out.distance(after.distance);
        }
        if before.arc_distance != after.arc_distance {
            self.out.arc_distance(after.arc_distance);
        }
        if self.words.g_of(&[980, 990]).is_some() {
            self.out.retract(after.retract);
        }
    }

    fn work_offset(&mut self, code: u16) {
        if self.before.work_offset == system_of(code) {
            self.out.note("continuing to use same coordinate system");
            return;
        }
        let mut selected = Modes { g92_offset: self.before.g92_offset, ..self.after };
        if let Some((origin, rotation)) = self.words.stored {
            let scale = scale(LengthUnit::Inch, selected.units);
            (selected.g5x_offset, selected.rotation) = (scaled(origin, scale), rotation);
        }
        self.out.g5x_offset(&selected);
        self.out.g92_offset(&selected);
        self.out.rotation(&selected);
    }

    /// G10, G52, G92 and its kin.
    pub(super) fn offsets(&mut self) {
        let Some(code) = self.words.g_of(&[100, 520, 920, 921, 922, 923]) else { return };
        if code != 100 {
            // Under compensation only an offset that is none can be cleared, and it is not printed.
            if !self.compensates() {
                self.out.g92_offset(&self.after);
            }
            return;
        }
        let whole = |letter| self.words.get(letter).unwrap_or(0.0).round();
        if whole(b'L').abs() < 0.5 {
            self.out.call("RELOAD_TOOLDATA");
            return;
        }
        if ![2.0, 20.0].contains(&whole(b'L')) {
            self.tool_entry();
            return;
        }
        let system = whole(b'P');
        if system <= 0.0 || (system - f64::from(self.after.work_offset)).abs() < 0.5 {
            self.out.g5x_offset(&self.after);
            self.out.rotation(&self.after);
        } else {
            self.out.note("setting coordinate system origin");
        }
    }

    /// What restoring changes: units, then what is set by one block, then coolant and overrides.
    pub(super) fn restored(&mut self) {
        let before = self.before;
        let after = self.without_own_codes(&before);
        if before.units != after.units {
            self.out.units(after.units);
        }
        if before.feed_mode != after.feed_mode {
            self.out.feed_mode(after.feed_mode, 0);
        }
        let feed = self.saved_feed.unwrap_or(after.feed_rate);
        let changed = self.saved_feed.map_or(before.feed_rate, |_| self.feed);
        if differ(changed, feed) && after.feed_mode != FeedMode::InverseTime {
            // It comes back with one decimal.
            self.out.call_with("SET_FEED_RATE", (feed * 10.0).round_ties_even() / 10.0);
        }
        self.restored_spindles(&before, &after);
        if before.plane != after.plane {
            self.out.plane(after.plane);
        }
        if before.lathe != after.lathe {
            self.out.lathe(after.lathe);
        }
        if before.compensation != after.compensation {
            self.out.compensation(after.compensation);
        }
        if before.units == after.units && before.tool_offset != after.tool_offset {
            self.out.tool_offset(&after.tool_offset);
        }
        if before.work_offset != after.work_offset {
            self.out.g5x_offset(&after);
            self.out.g92_offset(&after);
            self.out.rotation(&after);
        }
        let scale = scale(before.units, after.units);
        let tolerances = differ(before.blend_tolerance * scale, after.blend_tolerance)
            || differ(before.naive_cam_tolerance * scale, after.naive_cam_tolerance);
        if before.path != after.path || tolerances {
            self.out.path_mode(&after);
            if after.path == PathControlMode::Continuous {
                self.out.naive_cam_tolerance(&after);
            }
        }
        if before.distance != after.distance {
            self.out.distance(after.distance);
        }
        if before.arc_distance != after.arc_distance {
            self.out.arc_distance(after.arc_distance);
        }
        if before.retract != after.retract {
            self.out.retract(after.retract);
        }
        self.restored_switches(&before, &after);
        (self.before, self.feed) = (self.after, feed);
    }

    /// Settings after the block, without those that codes of the block itself set after the restore.
    fn without_own_codes(&self, before: &Modes) -> Modes {
        let own = |codes: &[u16]| self.words.g_of(codes).is_some();
        let mut after = self.after;
        if own(&[200, 210]) {
            after.units = before.units;
        }
        if own(&[170, 180, 190, 171, 181, 191]) {
            after.plane = before.plane;
        }
        if own(&[70, 80]) {
            after.lathe = before.lathe;
        }
        if own(&[900, 910]) {
            after.distance = before.distance;
        }
        if own(&[901, 911]) {
            after.arc_distance = before.arc_distance;
        }
        if own(&[980, 990]) {
            after.retract = before.retract;
        }
        if own(&[610, 611, 640]) {
            after.path = before.path;
            after.blend_tolerance = before.blend_tolerance;
            after.naive_cam_tolerance = before.naive_cam_tolerance;
        }
        after
    }

    fn restored_spindles(&mut self, before: &Modes, after: &Modes) {
        let spindles = before.spindles.iter().zip(&after.spindles);
        for (number, (before, after)) in self.all().zip(spindles) {
            let mode = before.mode != after.mode
                || after.mode == SpindleMode::SurfaceSpeed && before.limit != after.limit;
            if mode {
                // The limit does not come back.
                self.out.spindle_mode(number, &Spindle { limit: SpindleLimit::None, ..*after });
            }
            if mode || differ(before.speed, after.speed) {
                // It comes back as an integer.
                self.out.spindle_speed(number, after.speed.round_ties_even());
            }
            if before.turn != after.turn {
                self.out.turn(number, after.turn);
            }
        }
    }

    /// Coolant that was on comes back, and so do enabled overrides and inputs; what was off does not, but for both
    /// coolants.
    fn restored_switches(&mut self, before: &Modes, after: &Modes) {
        let off = (after.mist, after.flood) == (Switch::Off, Switch::Off);
        if (before.mist, before.flood) == (after.mist, after.flood) {
        } else if off {
            self.out.mist(Switch::Off);
            self.out.flood(Switch::Off);
        } else {
            if restored(before.mist, after.mist, &mut self.after.mist) {
                self.out.mist(Switch::On);
            }
            if restored(before.flood, after.flood, &mut self.after.flood) {
                self.out.flood(Switch::On);
            }
        }
        if before.feed_override != after.feed_override {
            if restored(before.feed_override, after.feed_override, &mut self.after.feed_override) {
                self.out.feed_override(Switch::On);
            }
            for number in self.all() {
                self.out.speed_override(number, Switch::On);
            }
        }
        if restored(before.adaptive_feed, after.adaptive_feed, &mut self.after.adaptive_feed) {
            self.out.adaptive_feed(Switch::On);
        }
        if restored(before.feed_stop, after.feed_stop, &mut self.after.feed_stop) {
            self.out.feed_stop(Switch::On);
        }
    }
}

/// Whether a switch is turned on again. One that was off stays as it is.
fn restored(before: Switch, saved: Switch, now: &mut Switch) -> bool {
    if before != saved && saved == Switch::Off {
        *now = before;
    }
    before != saved && saved == Switch::On
}

/// Whether two numbers differ by more than a conversion loses.
fn differ(one: f64, other: f64) -> bool {
    (one - other).abs() > 1.0e-9
}
