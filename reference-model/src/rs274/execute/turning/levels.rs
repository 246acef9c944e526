//! The layers of a roughing cycle. The path is looked at so that the tool is above it and moves in the direction of
//! growing w.

use super::cycle::Cycle;
use super::tool::Tool;
use crate::ids::rule;
use crate::rs274::refusal::StepError;
use crate::rs274::turning::{Curve, Piece, Point, ROUNDING, is_tied};

/// A roughing cycle on its way along its path.
pub(super) struct Roughing<'a> {
    pub(super) tool: Tool<'a>,
    pub(super) cycle: &'a Cycle,
    /// The lead, then the profile at its distance, then the line that closes it.
    pub(super) path: Vec<Piece>,
    /// The places of the second parts of arcs that were split at their highest point.
    pub(super) halves: Vec<usize>,
    /// The depth from which layers are counted.
    pub(super) highest: f64,
    /// The number of the next layer.
    pub(super) layer: f64,
    /// The place of the line that closes the path.
    pub(super) closes: usize,
    /// Whether the tool follows this line.
    pub(super) goes_on: bool,
}

impl Roughing<'_> {
    /// Rule turning.roughing-whole. Layers in each falling piece, and along each rising one.
    pub(super) fn whole(&mut self) -> Result<(), StepError> {
        for place in 0..self.path.len() {
            if self.path[place].falls() {
                self.cut_layers(place)?;
            } else {
                self.rise(place)?;
            }
        }
        Ok(())
    }

    /// Rule turning.roughing-without-pockets. Layers down to the first rising piece; from there on each later fall is
    /// passed over at the depth of its start.
    pub(super) fn without_pockets(&mut self) -> Result<(), StepError> {
        self.starts_above()?;
        let mut place = 0;
        while place < self.path.len() && self.path[place].falls() {
            self.cut_layers(place)?;
            place += 1;
        }
        while place < self.path.len() {
            let piece = self.path[place];
            if piece.falls() {
                let Some(after) = self.pass_over(place)? else { return Ok(()) };
                place = after;
            } else {
                self.feed_in_place(place)?;
                self.rise(place)?;
            }
            place += 1;
        }
        Ok(())
    }

    /// Rule turning.roughing-pockets. The path is followed down to the first rising piece; from there on layers are cut
    /// in each fall, counted from the highest fall so far.
    pub(super) fn pockets(&mut self) -> Result<(), StepError> {
        self.starts_above()?;
        let start = self.path[1].start;
        self.tool.traverse(start)?;
        let mut place = 1;
        while place < self.path.len() && self.path[place].falls() {
            self.tool.along(&self.path[place].clone())?;
            place += 1;
        }
        self.highest = f64::NEG_INFINITY;
        for place in place..self.path.len() {
            let piece = self.path[place];
            if piece.falls() {
                if self.follows_rise(place) {
                    self.highest = self.highest.max(piece.start.u);
                }
                self.cut_layers(place)?;
            } else {
                self.rise(place)?;
            }
        }
        Ok(())
    }

    /// What the variants do if the tool starts below the profile is open.
    fn starts_above(&self) -> Result<(), StepError> {
        if self.path[0].falls() {
            return Ok(());
        }
        let why = "a variant of G71 or G72 that starts on the other side of the profile";
        Err(StepError::Unspecified(why.to_owned()))
    }

    /// Follows a rising piece at feed rate; the line that closes the path only where the tool goes on.
    fn rise(&mut self, place: usize) -> Result<(), StepError> {
        if place == self.closes && !self.goes_on {
            return Ok(());
        }
        self.tool.along(&self.path[place].clone())
    }

    /// A feed to where a piece starts, where the tool is.
    fn feed_in_place(&mut self, place: usize) -> Result<(), StepError> {
        if place == self.closes && !self.goes_on {
            return Ok(());
        }
        self.tool.feed(self.path[place].start)
    }

    /// Cuts the layers of a falling piece, then moves to its end.
    ///
    /// Rule turning.roughing-increment. Layers are one increment apart. A piece that follows a fall, such as an arc
    /// that falls and rises, goes on with the layer after those of this fall.
    fn cut_layers(&mut self, place: usize) -> Result<(), StepError> {
        let mut rest = self.path[place];
        let (top, bottom) = (rest.start.u, rest.lowest());
        if self.follows_rise(place) {
            let above = (self.highest - top) / self.cycle.increment;
            self.layer = (above - 1.0).floor().max(0.0);
        }
        loop {
            let depth = self.highest - self.layer * self.cycle.increment;
            if self.is_open(place, &rest, depth) {
                let why = "a layer at the depth of a corner within rounding, or at the lowest point of an arc";
                return Err(StepError::Unspecified(why.to_owned()));
            }
            if depth <= bottom {
                break;
            }
            self.layer += 1.0;
            if depth <= top {
                rest = self.cut_layer(place, rest, depth)?;
            }
        }
        self.descend(place, &rest)
    }

    /// Whether a piece is the first one or comes after one that rises.
    fn follows_rise(&self, place: usize) -> bool {
        place == 0 || !self.path[place - 1].falls()
    }

    /// Whether rounding decides if a layer meets a corner, or it meets the lowest point inside an arc.
    fn is_open(&self, place: usize, piece: &Piece, depth: f64) -> bool {
        let own = self.path[place];
        if own.is_lowest_inside() && (depth - own.lowest()).abs() <= ROUNDING {
            return true;
        }
        if is_tied(depth, own.start.u) || is_tied(depth, own.lowest()) {
            return true;
        }
        let end = self.rises_to(place, piece, depth).map_or(place, |(found, _)| found);
        let mut passed = self.path.iter().take(end + 1).skip(place + 1);
        passed.any(|piece| is_tied(depth, piece.start.u) || is_tied(depth, piece.end.u))
    }

    /// Cuts one layer: down the piece to its depth, along to the next rising piece, and back. Returns the rest of the
    /// piece.
    fn cut_layer(&mut self, place: usize, piece: Piece, depth: f64) -> Result<Piece, StepError> {
        let from = piece.sinking_at(depth);
        let (before, rest) = piece.split(from);
        self.descend(place, &before)?;
        let Some((_, to)) = self.rises_to(place, &rest, depth) else {
            let why = "a layer of a lathe cycle without an end";
            return Err(StepError::Unspecified(why.to_owned()));
        };
        if to.w < from.w - ROUNDING {
            let why = "a layer of a lathe cycle against the direction of travel";
            return Err(StepError::Unspecified(why.to_owned()));
        }
        if to.distance(from) > ROUNDING {
            self.tool.feed(to)?;
            self.retract(from, to)?;
            if place == 0 {
                self.tool.traverse(from)?;
            } else {
                self.tool.feed(from)?;
            }
            self.tool.state.coverage.accepted(rule::turning::ROUGHING_INCREMENT);
        }
        Ok(rest)
    }

    /// Moves down a falling piece: in traverse along the lead, and at feed rate elsewhere.
    fn descend(&mut self, place: usize, piece: &Piece) -> Result<(), StepError> {
        if place == 0 { self.tool.traverse(piece.end) } else { self.tool.along(piece) }
    }

    /// Rule turning.roughing-retract. After a layer the tool retracts by R along both axes, and traverses back; half of
    /// the layer is the most.
    fn retract(&mut self, from: Point, to: Point) -> Result<(), StepError> {
        let half = from.distance(to) / 2.0;
        let retract = self.cycle.retract;
        let up = if retract < 0.0 { half } else { retract.min(half) };
        self.tool.traverse(Point { w: to.w - up, u: to.u + up })?;
        self.tool.traverse(Point { w: from.w + up, u: from.u + up })?;
        self.tool.state.coverage.accepted(rule::turning::ROUGHING_RETRACT);
        Ok(())
    }

    /// The first point after the rest of a falling piece where the path rises to a depth, and the place of its piece.
    fn rises_to(&self, place: usize, rest: &Piece, depth: f64) -> Option<(usize, Point)> {
        let round =
            matches!(rest.curve, Curve::Arc { .. }).then(|| rest.rising_at(depth)).flatten();
        let own = round.map(|point| (place, point));
        own.or_else(|| {
            let later = self.path.iter().enumerate().skip(place + 1);
            later.filter_map(|(place, piece)| Some((place, piece.rising_at(depth)?))).next()
        })
    }

    /// Passes over a fall at the depth of its start, then follows the rest of the piece that rises to it. Returns the
    /// place of this piece, and nothing where the path does not rise as high.
    fn pass_over(&mut self, place: usize) -> Result<Option<usize>, StepError> {
        let piece = self.path[place];
        if self.starts_at_top(place) {
            self.tool.feed(piece.start)?;
        }
        let Some((place, point)) = self.rises_to(place, &piece, piece.start.u) else {
            return Ok(None);
        };
        if place == self.closes && !self.goes_on {
            let why = "where the tool stops if the profile ends in a pocket that is not cut";
            return Err(StepError::Unspecified(why.to_owned()));
        }
        self.tool.feed(point)?;
        let (_, rest) = self.path[place].split(point);
        self.tool.along(&rest)?;
        Ok(Some(place))
    }

    /// Whether an arc starts at the highest point of its circle, and is not the second part of one that was split
    /// there.
    fn starts_at_top(&self, place: usize) -> bool {
        self.path[place].starts_at_top() && !self.halves.contains(&place)
    }
}
