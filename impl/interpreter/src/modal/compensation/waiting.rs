//! What waits until the end of a compensated move is known: the move itself, moves out of the plane, settings, dwells
//! and orientations, in program order.

use alloc::boxed::Box;

use gaugeblock_vocabulary::{Effect, LengthUnit, Position, Settings};

use crate::canon::{Reply, Sink, Waiting};

use super::super::Modal;
use super::super::coordinates::{Conversion, Coordinates};
use super::super::refusal::{Refusal, refuse};
use super::super::vector::Vector;
use super::queue::{Content, Item};

/// Takes settings over that are reported while they have to wait.
#[derive(Default)]
struct Collector(Option<Settings>);

impl Sink for Collector {
    fn set(&mut self, _line: u32, changed: &Settings) {
        self.0 = Some(changed.clone());
    }

    fn perform(&mut self, _line: u32, _effect: &Effect) -> Reply {
        Reply::Done
    }
}

impl Modal {
    /// Reports settings that the sink does not know yet, after what waits.
    #[inline]
    pub(in super::super) fn report<K: Sink>(&mut self, line: u32, sink: &mut K) {
        if self.compensation.waits() {
            self.hold_settings(line, sink);
        } else {
            self.active.report(line, sink);
        }
    }

    #[cold]
    fn hold_settings<K: Sink>(&mut self, line: u32, sink: &mut K) {
        let units = self.active.reported.units;
        let mut collector = Collector::default();
        self.active.report(line, &mut collector);
        let Some(settings) = collector.0 else { return };
        let place = sink.hold(line, Waiting::Settings(&settings));
        let feed = Settings { feed_rate: settings.feed_rate, ..Settings::default() };
        let content = match settings.feed_rate {
            Some(rate) if settings == feed => Content::Feed(rate),
            Some(_) | None => Content::Settings(Box::new(settings)),
        };
        self.compensation.queue.items.push_back(Item { place, line, units, content });
    }

    /// Lets an effect wait after what waits already, or begins to wait with it: a move in the plane that started at
    /// `start`.
    pub(in super::super) fn hold<K: Sink>(
        &mut self,
        line: u32,
        start: Coordinates,
        effect: Effect,
        sink: &mut K,
    ) {
        self.report(line, sink);
        let place = sink.hold(line, Waiting::Effect(&effect));
        let queue = &mut self.compensation.queue;
        if queue.is_empty() {
            queue.start = start;
        }
        let units = self.active.now().units;
        queue.items.push_back(Item { place, line, units, content: Content::Effect(effect) });
    }

    /// Refuses a block where more waits than may. Ends the run where a restore has changed the compensation of a path.
    pub(in super::super) fn check_compensated_path(&self) -> Result<(), Refusal> {
        if self.compensation.has_path()
            && let Some(why) = self.compensation.path.undefined
        {
            return Err(Refusal::Unspecified(why.into()));
        }
        let queue = &self.compensation.queue;
        if queue.items.len() > usize::try_from(queue.limit).unwrap_or(usize::MAX) {
            return Err(Refusal::LimitExceeded(crate::Limit::WaitingEffects));
        }
        Ok(())
    }

    /// Performs all that waits. The moves among it end at `end` in the plane, where that is given, or else where they
    /// were going to.
    pub(super) fn put_out<K: Sink>(
        &mut self,
        end: Option<Vector>,
        sink: &mut K,
    ) -> Result<(), Refusal> {
        let shifted = end.map(|point| point.plus(self.plane_shift()));
        while let Some(mut item) = self.compensation.queue.items.pop_front() {
            sink.release(item.place);
            match &mut item.content {
                Content::Feed(rate) => {
                    let changed = Settings { feed_rate: Some(*rate), ..Settings::default() };
                    sink.set(item.line, &changed);
                }
                Content::Settings(changed) => sink.set(item.line, changed),
                Content::Effect(effect) => {
                    if let (Some(point), Some(position)) = (shifted, end_of(effect)) {
                        let plane = self.active.now().plane;
                        let units = Conversion::between(self.active.now().units, item.units);
                        let moved = Coordinates::from(*position)
                            .with_in_plane(plane, point.converted(units));
                        *position = moved.position();
                    }
                    self.perform_late(&item.line, item.units, effect, sink)?;
                }
            }
        }
        Ok(())
    }

    /// Reports the settings that wait. The effects among them are lost.
    pub(in super::super) fn report_waiting<K: Sink>(&mut self, sink: &mut K) {
        while let Some(item) = self.compensation.queue.items.pop_front() {
            let changed = match item.content {
                Content::Feed(rate) => {
                    Box::new(Settings { feed_rate: Some(rate), ..Settings::default() })
                }
                Content::Settings(changed) => changed,
                Content::Effect(_) => continue,
            };
            sink.release(item.place);
            sink.set(item.line, &changed);
        }
    }

    /// Performs an effect that has waited.
    fn perform_late<K: Sink>(
        &mut self,
        line: &u32,
        units: LengthUnit,
        effect: &mut Effect,
        sink: &mut K,
    ) -> Result<(), Refusal> {
        let start = self.compensation.queue.start;
        match sink.perform(*line, effect) {
            Reply::Stop => self.stop_asked = true,
            Reply::Failed(kind) => return refuse(kind, "refused from outside"),
            Reply::Aborted => {
                self.forget_compensated_path();
                self.position = start;
                return Err(Refusal::Aborted);
            }
            Reply::ReadOnly => self.begin_read_ahead_at(start),
            Reply::Done | Reply::Contact(_) | Reply::Input(_) | Reply::Tool(_) => {}
        }
        if let Some(end) = end_of(effect) {
            let conversion = Conversion::between(units, self.active.now().units);
            self.compensation.queue.start = Coordinates::from(*end).converted(conversion);
        }
        Ok(())
    }

    /// Where the machine is: the controlled point before what waits.
    pub(in super::super) fn reached_point(&self) -> Coordinates {
        if self.compensation.waits() { self.compensation.queue.start } else { self.position }
    }
}

/// Whether an effect other than a move waits after a compensated move. Messages, outputs, tools and stops do not.
pub(in super::super) fn waits_after_move(effect: &Effect) -> bool {
    matches!(
        effect,
        Effect::Dwell { .. } | Effect::OrientSpindle { .. } | Effect::WaitOrient { .. }
    )
}

/// The end of a plain move.
fn end_of(effect: &mut Effect) -> Option<&mut Position> {
    if let Effect::StraightTraverse { end }
    | Effect::StraightFeed { end }
    | Effect::ArcFeed { end, .. } = effect
    {
        return Some(end);
    }
    None
}
