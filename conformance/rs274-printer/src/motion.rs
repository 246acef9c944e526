//! The motion of a block: moves, probing, threads, and canned cycles, around which the path mode is switched.

use gaugeblock_vocabulary::{
    Compensation, Distance, Effect, Event, FeedMode, LengthUnit, PathControlMode, Plane, Position,
    SpindleTurn,
};

use super::block::Printed;
use super::codes::INCH;
use super::modes::Modes;
use super::plane::in_plane;
use super::refusals::CycleProgress;

/// What a cycle switches to on its way.
const EXACT_PATH: &str = "SET_MOTION_CONTROL_MODE(CANON_EXACT_PATH)";

impl Printed<'_> {
    /// The block's motion.
    pub(super) fn motion(&mut self) {
        if self.words.g_of(&[800]).is_some() {
            self.out.note("motion mode set to none");
        }
        self.by_way_of();
        self.speed_of_programmed();
        let exact = self.after.path == PathControlMode::ExactPath;
        let mut stage = self.before;
        let mut moved =
            self.cycle.is_some_and(|code| code != 870) && self.come_to_r(&mut stage, exact);
        let mut switched = moved || self.cycle.is_none() || exact;
        loop {
            self.put_out(self.at);
            let Some(event) = self.events.get(self.at) else { break };
            match event {
                Event::Set(changed) => {
                    let before = stage;
                    stage.apply(changed);
                    if moved {
                        self.changed_within(&before, &stage);
                    }
                }
                Event::Unknown(_) => {}
                Event::Do(effect) if is_after_motion(effect, self.cycle.is_some()) => break,
                Event::Do(_) => {
                    if !std::mem::replace(&mut switched, true) {
                        self.out.begin(EXACT_PATH).end();
                    }
                    moved = true;
                    self.moved(event);
                    self.bored_out();
                }
            }
            self.at += 1;
        }
        if self.cycle.is_some() && moved && !exact {
            let after = self.after;
            self.out.path_mode(&after);
            self.out.naive_cam_tolerance(&after);
        }
    }

    /// The moves of a cycle down to the R plane; whether there are any.
    ///
    /// Where the point was below the R plane when the first of a row of cycles began, every one of them first moves
    /// to the R plane at its old place, and only then is the path mode switched.
    fn come_to_r(&mut self, stage: &mut Modes, exact: bool) -> bool {
        let mut hole = None;
        while let Some(event) = self.events.get(self.at) {
            match event {
                Event::Set(changed) if hole.is_none() => stage.apply(changed),
                Event::Do(Effect::StraightTraverse { end }) => hole = Some(*end),
                Event::Set(_) | Event::Do(_) | Event::Unknown(_) => break,
            }
            self.at += 1;
        }
        if let Some(hole) = hole {
            self.over_hole(hole, exact);
        }
        hole.is_some()
    }

    /// The same of a cycle that is refused when it has begun, by its words.
    pub(super) fn begun(&mut self, begun: CycleProgress) {
        let plane = self.after.plane;
        let letters = match plane {
            Plane::Xy => [b'X', b'Y'],
            Plane::Zx => [b'Z', b'X'],
            Plane::Yz => [b'Y', b'Z'],
            Plane::Uv | Plane::Wu | Plane::Vw => return,
        };
        let Some(r) = self.words.get(b'R') else { return };
        let (mut place, level) = in_plane(plane, &self.position);
        let incremental = self.after.distance == Distance::Incremental;
        let from = |value: f64| if incremental { value } else { 0.0 };
        for (coordinate, letter) in place.iter_mut().zip(letters) {
            if let Some(word) = self.words.get(letter) {
                *coordinate = from(*coordinate) + word;
            }
        }
        let mut hole = with_level(plane, &self.position, from(level) + r);
        let [first, second] = place;
        match plane {
            Plane::Zx => (hole.z, hole.x) = (first, second),
            Plane::Yz => (hole.y, hole.z) = (first, second),
            Plane::Xy | Plane::Uv | Plane::Wu | Plane::Vw => (hole.x, hole.y) = (first, second),
        }
        let exact = self.after.path == PathControlMode::ExactPath;
        match begun {
            CycleProgress::Above => {
                self.above(&hole, exact);
            }
            CycleProgress::OverHole => self.over_hole(hole, exact),
        }
    }

    /// The move to the R plane from below it; whether there is one.
    fn above(&mut self, hole: &Position, exact: bool) -> bool {
        let plane = self.after.plane;
        let (_, level) = in_plane(plane, &self.position);
        let (_, r) = in_plane(plane, hole);
        let rises = *self.old_level.get_or_insert(level) < r;
        if rises {
            let above = with_level(plane, &self.position, r);
            self.out.call_to("STRAIGHT_TRAVERSE", &above);
        }
        if !exact {
            self.out.begin(EXACT_PATH).end();
        }
        rises
    }

    /// The moves to the R plane over a hole.
    fn over_hole(&mut self, hole: Position, exact: bool) {
        let plane = self.after.plane;
        let (_, level) = in_plane(plane, &self.position);
        let (_, r) = in_plane(plane, &hole);
        let rises = self.above(&hole, exact);
        if !rises && level > r {
            let above = with_level(plane, &hole, level);
            self.out.call_to("STRAIGHT_TRAVERSE", &above);
        }
        self.out.call_to("STRAIGHT_TRAVERSE", &hole);
        self.position = hole;
    }

    /// G28 and G30 without axis words go by way of where they are.
    fn by_way_of(&mut self) {
        let axes = b"XYZABCUVW".iter().any(|axis| self.words.get(*axis).is_some());
        if self.words.g_of(&[280, 300]).is_some() && !axes {
            let here = self.position;
            self.out.call_to("STRAIGHT_TRAVERSE", &here);
        }
    }

    /// G85 ends each hole with a traverse, though it has come out by a feed already.
    fn bored_out(&mut self) {
        let Some(Event::Do(Effect::StraightFeed { end })) = self.events.get(self.at) else {
            return;
        };
        let next = self.events.get(self.at + 1);
        let goes_on = matches!(next, Some(Event::Do(Effect::StraightFeed { .. })));
        let place = |at: &Position| in_plane(self.after.plane, at).0.map(f64::to_bits);
        let rises = matches!(next, Some(Event::Do(Effect::StraightTraverse { end: next }))
            if place(next) == place(end));
        if self.cycle == Some(850) && !goes_on && !rises {
            self.out.call_to("STRAIGHT_TRAVERSE", end);
        }
    }

    /// What a cycle or a thread switches on its way.
    fn changed_within(&mut self, before: &Modes, stage: &Modes) {
        let pairs = before.spindles.iter().zip(&stage.spindles);
        let turns = |turn| matches!(turn, SpindleTurn::Clockwise | SpindleTurn::Counterclockwise);
        for (number, (before, now)) in self.all().zip(pairs) {
            if before.turn != now.turn {
                if turns(before.turn) {
                    self.out.turn(number, SpindleTurn::Stopped);
                }
                if turns(now.turn) {
                    self.out.turn(number, now.turn);
                }
            }
        }
        if before.feed_override != stage.feed_override {
            self.out.feed_override(stage.feed_override);
        }
        let pairs = before.spindles.iter().zip(&stage.spindles);
        for (number, (before, now)) in self.all().zip(pairs) {
            if before.speed_override != now.speed_override {
                self.out.speed_override(number, now.speed_override);
            }
        }
    }

    /// Prints an effect of the motion.
    fn moved(&mut self, event: &Event) {
        if self.threaded(event) {
            return;
        }
        if let Some(place) = self.places.of(self.at) {
            self.out.late().hold(place);
            if let Event::Do(
                Effect::StraightTraverse { end }
                | Effect::StraightFeed { end }
                | Effect::ArcFeed { end, .. },
            ) = event
            {
                self.position = *end;
            }
            return;
        }
        match event {
            Event::Do(Effect::StraightTraverse { end }) => {
                self.out.call_to("STRAIGHT_TRAVERSE", end);
                self.position = *end;
            }
            Event::Do(Effect::StraightFeed { end }) => {
                self.speed_of(distance(&self.position, end));
                self.out.call_to("STRAIGHT_FEED", &self.tapped(end));
                self.position = *end;
            }
            Event::Do(Effect::ArcFeed { end, first_centre, second_centre, turns }) => {
                let centre = [*first_centre, *second_centre];
                let length = arc_length(self.after.plane, &self.position, end, centre, *turns);
                self.speed_of(length);
                self.out.arc(self.after.plane, end, centre, *turns);
                self.position = *end;
            }
            Event::Do(Effect::NurbsFeed { points, end }) => {
                self.out.begin("NURBS_FEED(").integer((*points).into()).text(", ...)").end();
                self.position = *end;
            }
            Event::Do(Effect::StraightProbe { end, .. }) => {
                self.out.call("TURN_PROBE_ON");
                self.out.call_to("STRAIGHT_PROBE", end);
                self.out.call("TURN_PROBE_OFF");
                self.position = *end;
            }
            Event::Do(Effect::RigidTap { end }) => {
                let Position { x, y, z, .. } = *end;
                self.out.begin("RIGID_TAP(").numbers(&[x, y, z], ", ").text(")").end();
            }
            Event::Do(Effect::StartSpindleSynchronisation { pitch, .. }) => {
                self.out.synchronised(*pitch);
            }
            Event::Do(Effect::StopSpindleSynchronisation {}) => {
                self.out.call("STOP_SPEED_FEED_SYNCH");
            }
            Event::Do(Effect::Dwell { seconds }) => self.out.call_with("DWELL", *seconds),
            Event::Do(Effect::OrientSpindle { .. } | Effect::WaitOrient { .. }) => self.orient(),
            Event::Do(Effect::Stop { .. }) => self.out.call("PROGRAM_STOP"),
            Event::Do(_) | Event::Set(_) | Event::Unknown(_) => {}
        }
    }

    /// Under inverse time the speed of a move, in length units per minute, is printed before it.
    fn speed_of(&mut self, length: f64) {
        if self.after.feed_mode == FeedMode::InverseTime
            && self.after.compensation == Compensation::Off
            && let Some(feed) = self.words.get(b'F')
        {
            self.out.call_with("SET_FEED_RATE", length * feed);
        }
    }

    /// G10 L1, L10 and L11 write into the tool table, whose lengths are inches.
    pub(super) fn tool_entry(&mut self) {
        let Some(Effect::SetToolEntry {
            tool, offset, front_angle, back_angle, orientation, ..
        }) = self.next(|effect| matches!(effect, Effect::SetToolEntry { .. }))
        else {
            return;
        };
        let scale = if self.after.units == LengthUnit::Millimetre { INCH } else { 1.0 };
        let mut offsets = offset.to_array();
        for (place, value) in offsets.iter_mut().enumerate() {
            if !(3..6).contains(&place) {
                *value /= scale;
            }
        }
        // The tool in the spindle stands in place 0 too.
        let spindle = Some(0).filter(|_| self.loaded == tool);
        for place in [Some(self.machine.place(tool)), spindle].into_iter().flatten() {
            let begun = self.out.begin("SET_TOOL_TABLE_ENTRY(").integer(place).text(", ");
            begun.integer(tool.into()).text(", ").numbers(&offsets, " ").text(", ");
            begun.number(front_angle).text(", ").number(back_angle).text(", ");
            begun.integer(orientation.into()).text(")").end();
        }
    }
}

/// A position with another coordinate along the plane's normal.
fn with_level(plane: Plane, at: &Position, level: f64) -> Position {
    let mut at = *at;
    *match plane {
        Plane::Xy => &mut at.z,
        Plane::Zx => &mut at.y,
        Plane::Yz => &mut at.x,
        Plane::Uv => &mut at.w,
        Plane::Wu => &mut at.v,
        Plane::Vw => &mut at.u,
    } = level;
    at
}

/// The length of an arc.
pub(super) fn arc_length(
    plane: Plane,
    start: &Position,
    end: &Position,
    centre: [f64; 2],
    turns: i32,
) -> f64 {
    let ([x, y], z) = in_plane(plane, start);
    let ([end_x, end_y], end_z) = in_plane(plane, end);
    let radius = libm::hypot(x - centre[0], y - centre[1]);
    let from = libm::atan2(y - centre[1], x - centre[0]);
    let to = libm::atan2(end_y - centre[1], end_x - centre[0]);
    let full = std::f64::consts::TAU;
    let mut angle = if turns > 0 { to - from } else { from - to };
    if angle <= 1.0e-9 {
        angle += full;
    }
    angle += full * f64::from(turns.saturating_abs().saturating_sub(1));
    libm::hypot(radius * angle, end_z - z)
}

/// The length of a straight move: that of X, Y and Z, or of the rotary axes if those do not move.
pub(super) fn distance(from: &Position, to: &Position) -> f64 {
    let (from, to) = (from.to_array(), to.to_array());
    let length = |axes: std::ops::Range<usize>| {
        let squares = axes.map(|axis| (to[axis] - from[axis]) * (to[axis] - from[axis]));
        libm::sqrt(squares.sum())
    };
    [0..3, 6..9, 3..6].into_iter().map(length).find(|length| *length > 0.0).unwrap_or(0.0)
}

/// Whether an effect belongs to what follows the motion. A cycle may stop for a person.
fn is_after_motion(effect: &Effect, cycle: bool) -> bool {
    let stops = matches!(effect, Effect::Stop { .. });
    stops && !cycle
        || matches!(
            effect,
            Effect::PalletShuttle {} | Effect::ProgramEnd {} | Effect::ChangeControllerMode { .. }
        )
}
