//! Threads and taps: divergences of `rs274` from its manual, and what appears in the printed moves alone.

use gaugeblock_vocabulary::{Effect, Event, Lathe, Plane, Position};

use super::block::Printed;

/// The G code of a thread, in tenths.
const THREAD: u16 = 760;

/// The position of a traverse within a thread.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Traverse {
    /// To where a pass begins, before the one to the depth of the pass.
    ToPass,
    /// From the end of a pass.
    FromPass,
    /// Any other.
    Other,
}

impl Printed<'_> {
    /// Quirk `rs274.tap-axes`. Outside of the XY plane the feeds of G74 and G84 have their axes in another order.
    pub(super) fn tapped(&self, end: &Position) -> Position {
        let Position { x, y, z, .. } = *end;
        let taps = matches!(self.cycle, Some(740 | 840));
        match self.after.plane {
            Plane::Zx if taps => Position { x: y, y: z, z: x, ..*end },
            Plane::Yz if taps => Position { x: z, y: x, z: y, ..*end },
            Plane::Xy | Plane::Zx | Plane::Yz | Plane::Uv | Plane::Wu | Plane::Vw => *end,
        }
    }

    /// Prints an effect of a thread. True if `rs274` prints it differently there.
    ///
    /// Quirk `rs274.thread-clearance`. Each pass begins and ends as far from its cut as the last one does from the
    /// drive line, and a last traverse leads to the end of that line. Quirk `rs274.thread-feed-override`. The feed
    /// override is disabled within a pass.
    pub(super) fn threaded(&mut self, event: &Event) -> bool {
        if self.words.g_of(&[THREAD]).is_none() {
            return false;
        }
        match event {
            Event::Do(Effect::StartSpindleSynchronisation { .. }) => {
                if is_traverse(self.before(1)) {
                    self.out.call("DISABLE_FEED_OVERRIDE");
                }
                false
            }
            Event::Do(Effect::StraightTraverse { end }) => {
                let kind = self.kind();
                let cut = match kind {
                    Traverse::ToPass => end_of(self.behind(1)),
                    Traverse::FromPass => Some(self.position),
                    Traverse::Other => return false,
                };
                let Some(cut) = cut else { return false };
                let x = match kind {
                    Traverse::ToPass => cut.x + self.clearance(),
                    Traverse::FromPass | Traverse::Other => self.cut_x() + self.clearance(),
                };
                self.out.call_to("STRAIGHT_TRAVERSE", &Position { x, ..*end });
                self.position = *end;
                if kind == Traverse::FromPass {
                    self.out.call("ENABLE_FEED_OVERRIDE");
                    if self.behind(1).is_none() {
                        self.out.call_to("STRAIGHT_TRAVERSE", end);
                    }
                }
                true
            }
            Event::Do(_) | Event::Set(_) | Event::Unknown(_) => false,
        }
    }

    /// How far a pass begins from its cut: the way from the deepest cut to the drive line, I and K, in length units
    /// along X.
    fn clearance(&self) -> f64 {
        let [peak, depth] = [b'I', b'K'].map(|letter| self.words.get(letter).unwrap_or(0.0));
        let way = if peak < 0.0 { depth - peak } else { -depth - peak };
        if self.after.lathe == Lathe::Diameter { way / 2.0 } else { way }
    }

    /// Where the pass that ends here has cut: where the traverse to its depth led.
    fn cut_x(&self) -> f64 {
        let done = self.events.get(..self.at).unwrap_or_default();
        let cut = done.iter().rev().find_map(|event| end_of(Some(event)));
        cut.map_or(self.position.x, |cut| cut.x)
    }

    fn kind(&self) -> Traverse {
        let synchronised = |event: Option<&Event>| {
            matches!(event, Some(Event::Do(Effect::StartSpindleSynchronisation { .. })))
        };
        if is_traverse(self.behind(1)) && synchronised(self.behind(2)) {
            Traverse::ToPass
        } else if matches!(self.before(1), Some(Event::Do(Effect::StopSpindleSynchronisation {}))) {
            Traverse::FromPass
        } else {
            Traverse::Other
        }
    }

    /// The effect that is so many effects ahead.
    fn behind(&self, count: usize) -> Option<&Event> {
        let rest = self.events.get(self.at + 1..).unwrap_or_default();
        rest.iter().filter(|event| matches!(event, Event::Do(_))).nth(count - 1)
    }

    /// The effect that was so many effects ago.
    fn before(&self, count: usize) -> Option<&Event> {
        let done = self.events.get(..self.at).unwrap_or_default();
        done.iter().rev().filter(|event| matches!(event, Event::Do(_))).nth(count - 1)
    }
}

fn is_traverse(event: Option<&Event>) -> bool {
    end_of(event).is_some()
}

/// Where a traverse leads.
fn end_of(event: Option<&Event>) -> Option<Position> {
    if let Some(Event::Do(Effect::StraightTraverse { end })) = event { Some(*end) } else { None }
}
