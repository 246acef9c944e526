//! G71 and G72: a path is followed, and where it falls the material above it is cut level by level.

use alloc::vec::Vec;

use crate::limits::Limit;
use crate::math;

use super::super::refusal::Refusal;
use super::super::vector::Vector;
use super::motions::CycleMotion;
use super::numbers::{Contour, Pockets};
use super::piece::{Piece, ROUNDING};

/// Most levels: all of them differ as numbers.
const LEVELS_MAX: f64 = 1e15;

/// G71 or G72 under way.
#[derive(Clone, Debug)]
pub(super) struct Roughing {
    /// The lead, the pieces, and the line from their end to the depth of the start.
    path: Vec<Piece>,
    /// The depths of its corners.
    heights: Heights,
    /// The places of the second halves of arcs that were split at their highest point.
    halves: Vec<usize>,
    /// How many of them are followed.
    followed: usize,
    pockets: Pockets,
    increment: f64,
    retract: f64,
    /// The piece in progress.
    place: usize,
    /// Where the tool is on the path.
    here: Vector,
    next: Next,
    grid: Grid,
    /// Whether a rising piece was reached.
    has_risen: bool,
    /// Whether a pocket was reached.
    has_pocket: bool,
}

/// Depths that differ by more than rounding.
#[derive(Clone, Debug)]
struct Heights(Vec<f64>);

impl Heights {
    /// The known depth that is equal within rounding, if there is one.
    fn near(&self, depth: f64) -> Option<f64> {
        self.0.iter().copied().find(|known| (known - depth).abs() <= ROUNDING)
    }

    /// The same, and it is known from now on.
    fn of(&mut self, depth: f64) -> f64 {
        self.near(depth).unwrap_or_else(|| {
            self.0.push(depth);
            depth
        })
    }
}

/// The levels: from a depth downwards.
#[derive(Clone, Copy, Debug)]
struct Grid {
    top: f64,
    /// The number of the next level, the top is 0.
    count: u64,
}

/// What comes next.
#[derive(Clone, Copy, Debug)]
enum Next {
    /// The traverse to where the cycle starts.
    Start,
    /// A piece begins.
    Begin,
    /// A falling piece that is not cut.
    PassOver,
    /// A falling piece: the next level, or the rest of it.
    Level,
    /// The point of a level is reached: the level is cut.
    Cut(Vector),
    /// The level is cut from the first point to the second one.
    Lift(Vector, Vector),
    /// The tool is above the end of the level.
    Return(Vector, f64),
    /// The tool is above its beginning.
    Back(Vector),
    /// The rest of the piece.
    Rest,
    /// The next piece.
    After,
    Over,
}

/// The words of a roughing cycle.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cut {
    pub(super) pockets: Pockets,
    pub(super) increment: f64,
    pub(super) retract: f64,
}

impl Roughing {
    /// The cycle along offset pieces. Quirk rs274.turning-end: the path is followed up to the depth of the start.
    /// The tool is at the start already where `at_start` is set.
    pub(super) fn new(
        contour: &Contour,
        pieces: &[Piece],
        cut: Cut,
        (at_start, to_start_depth): (bool, bool),
    ) -> Self {
        let start = contour.start;
        let mut path = Vec::with_capacity(pieces.len().saturating_add(2));
        let mut halves = Vec::new();
        path.extend(pieces.first().map(|first| Piece::line(start, first.from)));
        for piece in pieces {
            match piece.highest_inside() {
                Some(top) => {
                    path.push(Piece { to: top, ..*piece });
                    halves.push(path.len());
                    path.push(Piece { from: top, ..*piece });
                }
                None => path.push(*piece),
            }
        }
        let mut heights = Heights(alloc::vec![start.q]);
        for piece in &mut path {
            (piece.from.q, piece.to.q) = (heights.of(piece.from.q), heights.of(piece.to.q));
        }
        let mut followed = path.len();
        if let Some(last) = path.last().copied()
            && last.to.q < start.q
        {
            path.push(Piece::line(last.to, Vector { q: start.q, ..last.to }));
            if to_start_depth {
                followed = path.len();
            }
        }
        let Cut { pockets, increment, retract } = cut;
        let next = if at_start { Next::Begin } else { Next::Start };
        Self {
            path,
            heights,
            halves,
            followed,
            pockets,
            increment,
            retract,
            place: 0,
            here: start,
            next,
            grid: Grid { top: start.q, count: 0 },
            has_risen: false,
            has_pocket: false,
        }
    }

    /// The next move; none where the cycle is over.
    pub(super) fn next(&mut self) -> Result<Option<CycleMotion>, Refusal> {
        loop {
            let Some(piece) = self.path.get(self.place).copied() else { return Ok(None) };
            let motion = match self.next {
                Next::Start => {
                    self.next = Next::Begin;
                    Some(CycleMotion::Traverse(self.here))
                }
                Next::Begin => self.begin(&piece)?,
                Next::PassOver => self.pass_over(&piece)?,
                Next::Level => self.level(&piece)?,
                Next::Cut(from) => self.cut(from)?,
                Next::Lift(from, to) => {
                    let half = to.minus(from).length() / 2.0;
                    let height = if self.retract < 0.0 { half } else { self.retract.min(half) };
                    self.next = Next::Return(from, height);
                    Some(CycleMotion::Traverse(Vector { p: to.p - height, q: to.q + height }))
                }
                Next::Return(from, height) => {
                    self.next = Next::Back(from);
                    Some(CycleMotion::Traverse(Vector { p: from.p + height, q: from.q + height }))
                }
                Next::Back(from) => {
                    self.next = Next::Level;
                    Some(self.straight(from))
                }
                Next::Rest => {
                    self.next = Next::After;
                    self.follow(&piece, piece.to)
                }
                Next::After => {
                    self.place = self.place.saturating_add(1);
                    self.next = if self.place < self.followed { Next::Begin } else { Next::Over };
                    None
                }
                Next::Over => return Ok(None),
            };
            if motion.is_some() {
                return Ok(motion);
            }
        }
    }

    /// A piece begins.
    fn begin(&mut self, piece: &Piece) -> Result<Option<CycleMotion>, Refusal> {
        let falls = piece.falls();
        self.here = piece.from;
        let climbed = self.has_risen;
        self.has_risen |= !falls;
        let before = self.place.checked_sub(1).and_then(|place| self.path.get(place));
        // After a falling piece its levels go on below those of that piece.
        let follows_rise = !before.is_some_and(Piece::falls);
        if follows_rise {
            self.grid.count = 0;
        }
        match self.pockets {
            Pockets::Cut if falls => self.next = Next::Level,
            Pockets::Left if falls && !climbed => self.next = Next::Level,
            Pockets::Left if falls => {
                self.next = Next::PassOver;
                if self.begins_at_top(piece) {
                    return Ok(Some(CycleMotion::Feed(piece.from)));
                }
            }
            Pockets::Left => {
                self.next = Next::Rest;
                return Ok(Some(CycleMotion::Feed(piece.from)));
            }
            Pockets::Alone if falls && climbed => {
                if !self.has_pocket || follows_rise && piece.from.q > self.grid.top {
                    self.grid = Grid { top: piece.from.q, count: 0 };
                }
                self.has_pocket = true;
                self.next = Next::Level;
            }
            Pockets::Cut | Pockets::Alone => self.next = Next::Rest,
        }
        Ok(None)
    }

    /// Whether a piece is an arc that begins at its highest point, and not the second half of one that was split.
    fn begins_at_top(&self, piece: &Piece) -> bool {
        let Some(arc) = piece.as_arc() else { return false };
        (piece.from.p - arc.centre.p).abs() <= ROUNDING && !self.halves.contains(&self.place)
    }

    /// G71.1 goes over a pocket, along a level to the first point that is as high as its edge.
    fn pass_over(&mut self, piece: &Piece) -> Result<Option<CycleMotion>, Refusal> {
        let depth = piece.from.q;
        let Some((place, point)) = self.rising(self.place, depth) else {
            self.next = Next::Over;
            return Ok(None);
        };
        if place >= self.followed {
            return Err(Refusal::Unspecified(
                "where a cycle without pockets ends if its profile ends in one (11.5.39)".into(),
            ));
        }
        self.place = place;
        self.here = point;
        self.next = Next::Rest;
        Ok(Some(CycleMotion::Feed(point)))
    }

    /// The next level of a falling piece, or the rest of it.
    fn level(&mut self, piece: &Piece) -> Result<Option<CycleMotion>, Refusal> {
        let lowest = piece.lowest();
        let first = (self.grid.top - self.here.q) / self.increment - 1.0;
        if first > LEVELS_MAX {
            return Err(Refusal::LimitExceeded(Limit::ProfileMoves));
        }
        let mut count = self.grid.count.max(math::to_count(first));
        let mut depth = self.depth(count);
        while depth > piece.from.q {
            count = count.saturating_add(1);
            depth = self.depth(count);
        }
        self.grid.count = count;
        if piece.lowest_inside().is_some_and(|point| (depth - point.q).abs() <= ROUNDING) {
            return Err(Refusal::Unspecified("a level at the lowest point of an arc".into()));
        }
        if depth <= lowest + ROUNDING {
            self.next = Next::Rest;
            return Ok(None);
        }
        self.grid.count = count.saturating_add(1);
        let point = piece.falling_at(depth);
        self.next = Next::Cut(point);
        Ok(self.follow(piece, point))
    }

    fn depth(&self, count: u64) -> f64 {
        let depth = self.grid.top - math::from_u64(count) * self.increment;
        self.heights.near(depth).unwrap_or(depth)
    }

    /// A level is cut from a point of the path to the next one that is as high.
    fn cut(&mut self, from: Vector) -> Result<Option<CycleMotion>, Refusal> {
        let Some((_, to)) = self.rising(self.place, from.q) else {
            return Err(Refusal::Unspecified("a level that no part of the profile ends".into()));
        };
        if to.p < from.p - ROUNDING {
            return Err(Refusal::Unspecified("a level that ends before its start".into()));
        }
        if to.minus(from).length() <= ROUNDING {
            self.next = Next::Level;
            return Ok(None);
        }
        self.next = Next::Lift(from, to);
        Ok(Some(CycleMotion::Feed(to)))
    }

    /// The first point of the rest of the path, from a piece on, at which a rising piece has a depth.
    fn rising(&self, place: usize, depth: f64) -> Option<(usize, Vector)> {
        let rest = self.path.iter().enumerate().skip(place);
        rest.filter_map(|(place, piece)| Some((place, piece.rising_at(depth)?))).next()
    }

    /// The move along a piece to a point of it; none along an arc that is at its end.
    fn follow(&mut self, piece: &Piece, to: Vector) -> Option<CycleMotion> {
        let from = core::mem::replace(&mut self.here, to);
        if piece.as_arc().is_some() {
            let is_short = to.minus(from).length() <= ROUNDING;
            return (!is_short).then(|| CycleMotion::along(piece.curve, to));
        }
        Some(self.straight(to))
    }

    /// A straight move along the piece in progress: a traverse on the lead of a cycle that cuts it or goes down it.
    fn straight(&self, to: Vector) -> CycleMotion {
        let falls = self.path.first().is_some_and(Piece::falls);
        if self.place == 0 && falls { CycleMotion::Traverse(to) } else { CycleMotion::Feed(to) }
    }
}
