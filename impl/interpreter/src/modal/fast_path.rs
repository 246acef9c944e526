//! The fast paths of [`Modal::whole_block`]: a block that is a straight move or an arc and nothing else.
//!
//! **Invariant:** a fast path has the outcome of the whole block, and takes only blocks that no mode in force changes.

use gaugeblock_vocabulary::{Effect, FaultKind, FeedMode, Lathe, Motion};

use crate::canon::{Reply, Sink};
use crate::faults::{PlantedFault, planted};
use crate::words::Words;

use super::Modal;
use super::coordinates::Coordinates;
use super::letters::{ARC_WORDS, AXES, F};
use super::mode_select::checked_feed;
use super::refusal::{Flow, Refusal, refuse};

impl Modal {
    /// Whether a block is a straight move and nothing else, with at most G0 or G1 and F in addition to its axis
    /// words, and whether no mode in force changes it.
    #[inline]
    pub(super) fn is_straight(&self, words: &Words) -> bool {
        let explicit = words.g.first().copied().unwrap_or(0);
        words.m_count == 0
            && words.g_count <= 1
            && words.dollar.is_none()
            && words.present & !(self.axes | F) == 0
            && words.present & AXES != 0
            && words.at.is_none()
            && words.caret.is_none()
            && (words.g_count == 0 || explicit == 0 || explicit == 10)
            && (words.g_count == 1 || matches!(self.motion, Motion::Traverse | Motion::Feed))
            && self.is_plain()
    }

    /// Whether a block is an arc and nothing else, likewise.
    #[inline]
    pub(super) fn is_arc(&self, words: &Words) -> bool {
        let explicit = words.g.first().copied().unwrap_or(0);
        let modal = matches!(self.motion, Motion::ArcClockwise | Motion::ArcCounterclockwise);
        words.m_count == 0
            && words.g_count <= 1
            && words.dollar.is_none()
            && words.present & !(self.axes | F | ARC_WORDS) == 0
            && !words.is_polar()
            && match words.g_count {
                0 => modal && words.present & AXES != 0,
                _ => explicit == 20 || explicit == 30,
            }
            && self.is_plain()
    }

    /// Whether no mode in force needs more than the end point of a straight move.
    #[inline]
    fn is_plain(&self) -> bool {
        let now = self.active.now();
        self.compensation.is_idle()
            && now.lathe == Lathe::Radius
            && now.feed_mode != FeedMode::InverseTime
            && !self.surface_speed
            && self.motion != Motion::Nurbs
            && !planted(PlantedFault::FeedNeverChanges)
    }

    /// Fast path of [`Self::whole_block`]: a straight move and nothing else, in one pass.
    #[inline]
    pub(super) fn straight_block<K: Sink>(
        &mut self,
        words: &Words,
        sink: &mut K,
    ) -> Result<Flow, Refusal> {
        let motion = match words.g.first() {
            Some(0) if words.g_count == 1 => Motion::Traverse,
            Some(_) if words.g_count == 1 => Motion::Feed,
            Some(_) | None => self.motion,
        };
        let rate_before = self.active.now().feed_rate;
        let feed = if words.present & F != 0 { words.get(b'F') } else { None };
        let rate = feed.map_or(Ok(rate_before), checked_feed)?;
        let feeds = motion == Motion::Feed || planted(PlantedFault::TraverseNeedsFeed);
        if feeds && rate <= 0.0 {
            return refuse(FaultKind::ZeroFeed, "a feed move without a feed rate");
        }
        if feed.is_some() {
            self.active.set_feed_rate(rate);
        }
        let before = (self.motion, self.position, rate_before);
        self.motion = motion;
        self.apply_axis_words(words);
        let end = self.position.position();
        let effect = if motion == Motion::Traverse {
            Effect::StraightTraverse { end }
        } else {
            Effect::StraightFeed { end }
        };
        self.only_effect(words.line, before, &effect, sink)
    }

    /// Fast path of [`Self::whole_block`]: an arc and nothing else, in one pass.
    #[inline(never)]
    pub(super) fn arc_block<K: Sink>(
        &mut self,
        words: &Words,
        sink: &mut K,
    ) -> Result<Flow, Refusal> {
        let motion = match words.g.first() {
            Some(20) if words.g_count == 1 => Motion::ArcClockwise,
            Some(_) if words.g_count == 1 => Motion::ArcCounterclockwise,
            Some(_) | None => self.motion,
        };
        let feed = if words.present & F != 0 { words.get(b'F') } else { None };
        let rate_before = self.active.now().feed_rate;
        let rate = feed.map_or(Ok(rate_before), checked_feed)?;
        if rate <= 0.0 {
            return refuse(FaultKind::ZeroFeed, "an arc without a feed rate");
        }
        let before = (self.motion, self.position, rate_before);
        self.apply_axis_words(words);
        let effect = match self.arc(words, motion, &before.1) {
            Ok(effect) => effect,
            Err(refusal) => {
                self.position = before.1;
                return Err(refusal);
            }
        };
        if feed.is_some() {
            self.active.set_feed_rate(rate);
        }
        self.motion = motion;
        self.only_effect(words.line, before, &effect, sink)
    }

    /// Performs the only effect of a fast path. Where it is refused, mode, point and feed rate are restored.
    #[inline]
    fn only_effect<K: Sink>(
        &mut self,
        line: u32,
        before: (Motion, Coordinates, f64),
        effect: &Effect,
        sink: &mut K,
    ) -> Result<Flow, Refusal> {
        self.active.report(line, sink);
        match sink.perform(line, effect) {
            Reply::Stop => Ok(Flow::Stopped),
            Reply::Failed(kind) => {
                let rate;
                (self.motion, self.position, rate) = before;
                self.active.set_feed_rate(rate);
                refuse(kind, "refused from outside")
            }
            Reply::Aborted => {
                (self.motion, self.position, _) = before;
                Err(Refusal::Aborted)
            }
            Reply::ReadOnly => {
                self.begin_read_ahead_at(before.1);
                Ok(Flow::More)
            }
            Reply::Done | Reply::Contact(_) | Reply::Input(_) | Reply::Tool(_) => Ok(Flow::More),
        }
    }
}
