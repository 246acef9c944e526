//! A small picture of a motion: the path from above and the speed over time, in a few hundred numbers, so that it can
//! stand in a report.
//!
//! [`Picture`](super::Picture) is the large one.

use std::fmt::Write as _;

use gaugeblock_vocabulary::Position;
use gaugeblock_vocabulary::motion::{ProgrammedPath, Samples};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::polyline::polyline;

/// Most points of a curve.
const MOST: usize = 160;
/// Width and height of each of the two views, in pixels.
const SIZE: (f64, f64) = (320.0, 200.0);
const MARGIN: f64 = 8.0;

/// Few points of a motion. Lengths are millimetres, times seconds.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Sketch {
    /// How long the motion takes.
    pub seconds: f64,
    /// X and Y of the programmed path.
    pub programmed: Vec<[f64; 2]>,
    /// X and Y of where the machine was commanded to be, evenly in time.
    pub commanded: Vec<[f64; 2]>,
    /// Speed along the path, millimetres per second, evenly in time; the highest of each stretch.
    pub speed: Vec<f64>,
}

impl Sketch {
    /// The sketch of samples, over the path that was programmed.
    pub fn of(samples: &Samples, path: &ProgrammedPath) -> Self {
        let positions = samples.positions(Position::default());
        let flat: Vec<[f64; 2]> = positions.iter().map(|at| [tidy(at.x), tidy(at.y)]).collect();
        let speed: Vec<f64> = positions
            .windows(2)
            .map(|pair| {
                let [x, y, z] =
                    [pair[1].x - pair[0].x, pair[1].y - pair[0].y, pair[1].z - pair[0].z];
                libm::sqrt(x * x + y * y + z * z) / samples.period()
            })
            .collect();
        let highest = |stretch: &[f64]| tidy(stretch.iter().copied().fold(0.0, f64::max));
        let programmed: Vec<[f64; 2]> =
            polyline(path).iter().map(|at| [tidy(at[0]), tidy(at[1])]).collect();
        let cycles = u32::try_from(positions.len().saturating_sub(1)).unwrap_or(u32::MAX);
        Self {
            seconds: tidy(f64::from(cycles) * samples.period()),
            programmed: few(&programmed),
            commanded: few(&flat),
            speed: speed.chunks(step(speed.len())).map(highest).collect(),
        }
    }

    /// Both views as SVG, in the colour of the text around it. Nothing but numbers of this is in it.
    pub fn svg(&self) -> String {
        let (wide, high) = SIZE;
        let mut svg = format!(
            "<svg viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"path from above, and speed over time\">",
            wide * 2.0,
            high + 20.0
        );
        let frame = Frame::around(self.programmed.iter().chain(&self.commanded));
        for (points, class) in [(&self.programmed, "asked"), (&self.commanded, "moved")] {
            let placed = points.iter().map(|point| frame.place(*point));
            push_polyline(&mut svg, placed, class);
        }
        let highest = self.speed.iter().copied().fold(1e-9, f64::max);
        let last = u32::try_from(self.speed.len().max(2) - 1).map_or(1.0, f64::from);
        let curve = self.speed.iter().zip(0_u32..).map(|(speed, at)| {
            let x = wide + MARGIN + f64::from(at) / last * (wide - 2.0 * MARGIN);
            [x, high - MARGIN - speed / highest * (high - 2.0 * MARGIN)]
        });
        push_polyline(&mut svg, curve, "moved");
        let [x, y] = frame.size;
        let _infallible = write!(
            svg,
            "<text x=\"{MARGIN}\" y=\"{0}\">from above, {x} by {y} mm</text><text x=\"{1}\" y=\"{0}\">speed to {highest} mm/s, in {2} s</text></svg>",
            high + 12.0,
            wide + MARGIN,
            self.seconds
        );
        svg
    }
}

/// Which part of the plane is drawn; a millimetre is as long across as it is up.
#[derive(Debug)]
struct Frame {
    low: [f64; 2],
    size: [f64; 2],
    scale: f64,
}

impl Frame {
    fn around<'a>(points: impl Iterator<Item = &'a [f64; 2]>) -> Self {
        let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
        for point in points {
            for axis in 0..2 {
                low[axis] = low[axis].min(point[axis]);
                high[axis] = high[axis].max(point[axis]);
            }
        }
        if low[0] > high[0] {
            (low, high) = ([0.0; 2], [0.0; 2]);
        }
        let size = [tidy(high[0] - low[0]), tidy(high[1] - low[1])];
        let fits = |room: f64, size: f64| (room - 2.0 * MARGIN) / size.max(1e-3);
        let scale = fits(SIZE.0, size[0]).min(fits(SIZE.1, size[1]));
        Self { low, size, scale }
    }

    fn place(&self, point: [f64; 2]) -> [f64; 2] {
        let across = (point[0] - self.low[0]) * self.scale;
        let up = (point[1] - self.low[1]) * self.scale;
        [MARGIN + across, SIZE.1 - MARGIN - up]
    }
}

fn push_polyline(svg: &mut String, points: impl Iterator<Item = [f64; 2]>, class: &str) {
    let points: Vec<String> = points.map(|[x, y]| format!("{x:.1},{y:.1}")).collect();
    let _infallible = write!(svg, "<polyline class=\"{class}\" points=\"{}\"/>", points.join(" "));
}

/// Every so many of so many are as many as can be drawn.
fn step(all: usize) -> usize {
    all.div_ceil(MOST).max(1)
}

/// So few that they can be drawn, with the last one.
fn few<T: Copy + PartialEq>(all: &[T]) -> Vec<T> {
    let mut few: Vec<T> = all.iter().copied().step_by(step(all.len())).collect();
    if few.last() != all.last() {
        few.extend(all.last());
    }
    few
}

/// Four places are more than can be seen.
fn tidy(number: f64) -> f64 {
    (number * 1e4).round() / 1e4 + 0.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_long_motion_is_a_few_points_and_ends_where_it_does() {
        let all: Vec<f64> = (0..100_000).map(f64::from).collect();
        let few = few(&all);
        assert!(few.len() <= MOST + 1, "{}", few.len());
        assert_eq!((few.first(), few.last()), (all.first(), all.last()));
    }

    #[test]
    fn a_motion_of_one_point_is_drawn() {
        let sketch = Sketch { commanded: vec![[1.0, 2.0]], ..Sketch::default() };
        let svg = sketch.svg();
        assert!(!svg.contains("NaN") && !svg.contains("inf"), "{svg}");
    }
}
