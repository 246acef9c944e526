//! When two paths are the same.

use gaugeblock_vocabulary::motion::{PathElement, PathMode, ProgrammedPath, Shape};

use crate::math;
use crate::motion::curve::Curve;
use crate::motion::laws::follows;
use crate::motion::vector::{AxisVector, distance};

/// Where two paths part.
#[derive(Clone, Debug, PartialEq)]
pub struct Difference {
    /// The element of the first path, from 0; as many as it has where it ends before the other one.
    pub first: usize,
    /// The element of the second path.
    pub second: usize,
    /// What is different, for a person.
    pub words: String,
}

/// The first place at which two paths are not the same, or `None`.
///
/// Two paths are the same if they lead over the same points, within a tolerance in millimetres, at the same feed, in
/// the same mode, with the same stops and outputs in the same places. How their motion is divided into moves makes no
/// difference: a move may be split or merged where it goes straight on, and an arc may be chords within the
/// tolerance. Under exact stop each end of a move is a stop. A spline is the same as one that ends in the same place.
pub fn differ(
    first: &ProgrammedPath,
    second: &ProgrammedPath,
    tolerance: f64,
) -> Option<Difference> {
    let (mut one, mut other) = (Stretches::of(first), Stretches::of(second));
    loop {
        let (a, b) = (one.next(), other.next());
        let (at, place) = (one.begun, other.begun);
        let words = match (a, b) {
            (None, None) => return None,
            (Some(a), None) => format!("only the first path has {}", a.name()),
            (None, Some(b)) => format!("only the second path has {}", b.name()),
            (Some(a), Some(b)) => match a.differs(&b, tolerance) {
                None => continue,
                Some(words) => words,
            },
        };
        return Some(Difference { first: at, second: place, words });
    }
}

/// What lies between two points at which a path does more than lead on.
#[derive(Clone, Debug)]
enum Stretch<'a> {
    /// Moves that are alike in all but where they lead.
    Moves { like: &'a PathElement, curves: Vec<Curve> },
    /// Anything else.
    Other(&'a PathElement),
}

impl Stretch<'_> {
    fn name(&self) -> String {
        match self {
            Self::Moves { like, .. } => format!("a move at {}", like.block),
            Self::Other(element) => format!("something else at {}", element.block),
        }
    }

    fn differs(&self, other: &Self, tolerance: f64) -> Option<String> {
        match (self, other) {
            (Self::Moves { like, curves }, Self::Moves { like: their_like, curves: theirs }) => {
                if let Some(what) = unlike(like, their_like, tolerance) {
                    return Some(what);
                }
                let near = leads_along(curves, theirs, tolerance)
                    && leads_along(theirs, curves, tolerance);
                (!near).then(|| format!("the moves from {} on lead elsewhere", like.block))
            }
            (Self::Other(one), Self::Other(other)) => {
                let same = match (&one.shape, &other.shape) {
                    (Shape::Curve { end }, Shape::Curve { end: other }) => {
                        distance(&end.to_array(), &other.to_array()) <= tolerance
                    }
                    (one, other) => one == other,
                };
                (!same).then(|| format!("{:?} is not {:?}", one.shape, other.shape))
            }
            _ => Some(format!("{} is not {}", self.name(), other.name())),
        }
    }
}

/// What is different between two moves besides where they lead.
fn unlike(one: &PathElement, other: &PathElement, tolerance: f64) -> Option<String> {
    let close = |a: f64, b: f64| (a - b).abs() <= tolerance.max(1e-9 * a.abs());
    let feed = {
        use gaugeblock_vocabulary::motion::Feed;
        match (one.feed, other.feed) {
            (Feed::PerSecond(a), Feed::PerSecond(b)) | (Feed::InTime(a), Feed::InTime(b)) => {
                close(a, b)
            }
            (a, b) => a == b,
        }
    };
    let what = if !feed {
        format!("{:?} is not {:?}", one.feed, other.feed)
    } else if one.mode != other.mode {
        format!("{:?} is not {:?}", one.mode, other.mode)
    } else if one.controls != other.controls {
        "other controls act".to_owned()
    } else if one.switches != other.switches {
        "other outputs switch".to_owned()
    } else {
        return None;
    };
    Some(format!("{what} at {}", one.block))
}

/// Whether some curves lead along others, point by point in order, within a tolerance.
fn leads_along(curves: &[Curve], others: &[Curve], tolerance: f64) -> bool {
    let mut points: Vec<AxisVector> = vec![curves[0].start()];
    for curve in curves {
        // Chords that are nearer to the arc than half of the tolerance.
        let radius = curve.length() / curve.angle().abs().max(f64::MIN_POSITIVE);
        let angle = 2.0 * math::square_root(tolerance / radius);
        let steps = (curve.angle().abs() / angle).ceil().max(1.0);
        let mut done = 1.0;
        while done <= steps {
            points.push(curve.at(done / steps));
            done += 1.0;
        }
    }
    follows(&points, others, tolerance)
}

/// A path, stretch by stretch.
struct Stretches<'a> {
    path: &'a ProgrammedPath,
    here: gaugeblock_vocabulary::Position,
    next: usize,
    begun: usize,
}

impl<'a> Stretches<'a> {
    fn of(path: &'a ProgrammedPath) -> Self {
        Self { path, here: path.start, next: 0, begun: 0 }
    }

    fn curve(&self, element: &PathElement) -> Option<Curve> {
        Curve::of(self.here, &element.shape)
    }

    fn next(&mut self) -> Option<Stretch<'a>> {
        let mut stretch: Option<Stretch<'a>> = None;
        self.begun = self.next;
        while let Some(element) = self.path.elements.get(self.next) {
            let curve = self.curve(element);
            let inert = curve.is_some_and(|curve| curve.is_empty())
                && element.switches.is_empty()
                && element.mode != PathMode::ExactStop;
            match (&mut stretch, curve) {
                _ if inert => (),
                (None, None) => stretch = Some(Stretch::Other(element)),
                (None, Some(curve)) => {
                    stretch = Some(Stretch::Moves { like: element, curves: vec![curve] });
                }
                (Some(Stretch::Moves { like, curves }), Some(curve))
                    if element.switches.is_empty() && goes_on(like, element) =>
                {
                    curves.push(curve);
                }
                _ => break,
            }
            self.here = element.end().unwrap_or(self.here);
            self.next += 1;
            if matches!(stretch, Some(Stretch::Other(_))) {
                break;
            }
        }
        stretch
    }
}

/// Whether a move and the next one are one motion to the controller.
fn goes_on(one: &PathElement, next: &PathElement) -> bool {
    let plain = |element: &PathElement| !matches!(element.shape, Shape::Probe { .. });
    one.mode != PathMode::ExactStop
        && one.feed == next.feed
        && one.mode == next.mode
        && one.controls == next.controls
        && plain(one)
        && plain(next)
}
