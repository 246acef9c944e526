//! A picture of a motion: the path from above, and speed and accelerations over time against their limits.
//!
//! It is for a person who wants to see where time goes and which limit binds. Nothing is judged here.

use std::error::Error;
use std::ops::Range;

use plotters::coord::Shift;
use plotters::prelude::*;

/// What is drawn. Lengths are millimetres, times seconds.
#[derive(Clone, Debug, Default)]
pub struct Picture<'a> {
    /// Lines of text above: what it is, how long it takes.
    pub title: &'a [String],
    /// Points of the programmed path, close enough for arcs to look round.
    pub programmed: &'a [[f64; 3]],
    /// Where the machine was commanded to be, a sample each.
    pub commanded: &'a [[f64; 3]],
    /// How far each sample is off the programmed path; empty where nobody knows.
    pub deviation: &'a [f64],
    /// Time between two samples.
    pub period: f64,
    /// Speed along the path by sample.
    pub speed: &'a [f64],
    /// The feed that was asked for, by sample, overrides counted; not a number where none was, as in a rapid move.
    pub requested: &'a [f64],
    /// What share of its limit each axis' acceleration takes, -1 to 1 where it is lawful: letter, and a number a
    /// sample.
    pub acceleration: &'a [(char, Vec<f64>)],
}

const SIZE: (u32, u32) = (1200, 1180);
/// Height of a line of text above, of the views of the path, and of the curves below each.
const LINE: i32 = 22;
const VIEWS: i32 = 520;
const CURVE: i32 = 300;
/// Room to the right of the curves, for the end of a number and for what colour is which axis.
const MARGIN: u32 = 56;
const INK: RGBColor = RGBColor(0x22, 0x22, 0x22);
const GREY: RGBColor = RGBColor(0xb0, 0xb0, 0xb0);
const LIMIT: RGBColor = RGBColor(0xb0, 0x1e, 0x1e);
/// Distinguishable for people who see few colours, too.
const AXES: [RGBColor; 9] = [
    RGBColor(0x00, 0x72, 0xb2),
    RGBColor(0xd5, 0x5e, 0x00),
    RGBColor(0x00, 0x9e, 0x73),
    RGBColor(0xcc, 0x79, 0xa7),
    RGBColor(0x56, 0xb4, 0xe9),
    RGBColor(0xe6, 0x9f, 0x00),
    RGBColor(0x80, 0x80, 0x00),
    RGBColor(0x66, 0x33, 0x99),
    RGBColor(0x55, 0x55, 0x55),
];
/// What is no farther off the path than this is on it, millimetres.
const ON_PATH: f64 = 1e-6;
/// More points than this in one curve nobody can see.
const MOST_POINTS: usize = 4000;

type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;
type Drawn = Result<(), Box<dyn Error>>;

impl Picture<'_> {
    /// The picture as SVG.
    ///
    /// # Errors
    /// What plotters says; not for want of samples.
    pub fn svg(&self) -> Result<String, Box<dyn Error>> {
        let mut text = String::new();
        {
            let root = SVGBackend::with_string(&mut text, SIZE).into_drawing_area();
            root.fill(&WHITE)?;
            let mut row = 12;
            for (place, title) in self.title.iter().enumerate() {
                let size = if place == 0 { 20 } else { 15 };
                let style = ("sans-serif", size).into_font().color(&INK);
                root.draw(&Text::new(title.as_str(), (16, row), style))?;
                row += LINE;
            }
            let (_, body) = root.split_vertically(row + 8);
            let (path, curves) = body.split_vertically(VIEWS);
            self.draw_path(&path)?;
            let (speed, acceleration) = curves.split_vertically(CURVE);
            self.draw_speed(&speed)?;
            self.draw_acceleration(&acceleration)?;
            root.present()?;
        }
        Ok(text)
    }

    /// The path from above, where it climbs also from the front; both axes in the same scale.
    fn draw_path(&self, area: &Area<'_>) -> Drawn {
        let climbs = span(self.programmed.iter().chain(self.commanded).map(|point| point[2]));
        if climbs.end - climbs.start <= 1e-9 {
            return self.draw_view(area, 0, 1, "seen from above: X, Y in mm");
        }
        let (above, front) = area.split_horizontally(600);
        self.draw_view(&above, 0, 1, "seen from above: X, Y in mm")?;
        self.draw_view(&front, 0, 2, "seen from the front: X, Z in mm")
    }

    fn draw_view(&self, area: &Area<'_>, across: usize, up: usize, what: &str) -> Drawn {
        let all = || self.programmed.iter().chain(self.commanded);
        let (wide, high) = area.dim_in_pixel();
        let (horizontal, vertical) = same_scale(
            span(all().map(|point| point[across])),
            span(all().map(|point| point[up])),
            f64::from(wide.saturating_sub(80)) / f64::from(high.saturating_sub(80)),
        );
        let worst = self.deviation.iter().copied().fold(0.0, f64::max);
        let off = if worst > ON_PATH {
            format!("; blue: on the path, red: {worst:.6} mm off it")
        } else if self.deviation.is_empty() {
            String::new()
        } else {
            "; all of it on the path".to_owned()
        };
        let mut chart = ChartBuilder::on(area)
            .caption(format!("{what}{off}"), ("sans-serif", 14).into_font().color(&INK))
            .margin(10)
            .x_label_area_size(26)
            .y_label_area_size(54)
            .build_cartesian_2d(horizontal, vertical)?;
        chart
            .configure_mesh()
            .light_line_style(TRANSPARENT)
            .bold_line_style(GREY.mix(0.4))
            .draw()?;
        let flat = |point: &[f64; 3]| (point[across], point[up]);
        chart
            .draw_series(LineSeries::new(self.programmed.iter().map(flat), GREY.stroke_width(3)))?;
        for piece in pieces(self.commanded.len()) {
            let off = self.deviation.get(piece.clone()).unwrap_or_default();
            let off = off.iter().copied().fold(0.0, f64::max);
            let colour = heat(if worst > ON_PATH { off / worst } else { 0.0 });
            let points = self.commanded[piece].iter().map(flat);
            chart.draw_series(LineSeries::new(points, colour.stroke_width(1)))?;
        }
        Ok(())
    }

    fn draw_speed(&self, area: &Area<'_>) -> Drawn {
        let highest =
            self.speed.iter().chain(self.requested).copied().filter(|speed| speed.is_finite());
        let highest =
            Some(highest.fold(0.0, f64::max) * 1.05).filter(|it| *it > 0.0).unwrap_or(1.0);
        let mut chart = ChartBuilder::on(area)
            .caption(
                "speed along the path, mm/s (red: the requested feed with overrides)",
                ("sans-serif", 14).into_font().color(&INK),
            )
            .margin(10)
            .margin_right(MARGIN)
            .x_label_area_size(26)
            .y_label_area_size(54)
            .build_cartesian_2d(0.0..self.duration(), 0.0..highest)?;
        chart
            .configure_mesh()
            .light_line_style(TRANSPARENT)
            .bold_line_style(GREY.mix(0.4))
            .draw()?;
        for run in finite_runs(self.requested) {
            chart.draw_series(LineSeries::new(
                self.over_time(self.requested, run),
                LIMIT.stroke_width(1),
            ))?;
        }
        chart.draw_series(LineSeries::new(
            self.over_time(self.speed, 0..self.speed.len()),
            AXES[0].stroke_width(1),
        ))?;
        Ok(())
    }

    fn draw_acceleration(&self, area: &Area<'_>) -> Drawn {
        let mut chart = ChartBuilder::on(area)
            .caption(
                "acceleration of each axis over its limit, by time in s (red: the limit)",
                ("sans-serif", 14).into_font().color(&INK),
            )
            .margin(10)
            .margin_right(MARGIN)
            .x_label_area_size(26)
            .y_label_area_size(54)
            .build_cartesian_2d(0.0..self.duration(), -1.2..1.2)?;
        chart
            .configure_mesh()
            .light_line_style(TRANSPARENT)
            .bold_line_style(GREY.mix(0.4))
            .draw()?;
        for limit in [-1.0, 1.0] {
            let line = [(0.0, limit), (self.duration(), limit)];
            chart.draw_series(LineSeries::new(line, LIMIT.stroke_width(1)))?;
        }
        for (place, (_, shares)) in self.acceleration.iter().enumerate() {
            let colour = AXES[place % AXES.len()];
            let curve =
                LineSeries::new(self.over_time(shares, 0..shares.len()), colour.stroke_width(1));
            chart.draw_series(curve)?;
        }
        self.draw_legend(area)
    }

    /// Which colour is which axis, beside the curves and not above them.
    fn draw_legend(&self, area: &Area<'_>) -> Drawn {
        let left = i32::try_from(area.dim_in_pixel().0.saturating_sub(MARGIN))? + 10;
        let mut row = 34;
        for (place, (axis, _)) in self.acceleration.iter().enumerate() {
            let line = [(left, row), (left + 16, row)];
            area.draw(&PathElement::new(line, AXES[place % AXES.len()].stroke_width(2)))?;
            let style = ("sans-serif", 14).into_font().color(&INK);
            area.draw(&Text::new(axis.to_string(), (left + 22, row - 7), style))?;
            row += LINE;
        }
        Ok(())
    }

    /// How long all of it takes, seconds; never nothing, so that it can be an axis.
    fn duration(&self) -> f64 {
        self.at(self.commanded.len().max(2) - 1)
    }

    /// When a sample is taken, seconds.
    fn at(&self, sample: usize) -> f64 {
        f64::from(u32::try_from(sample).unwrap_or(u32::MAX)) * self.period
    }

    /// Points of a curve over time: the highest and the lowest number of each stretch that is no wider than can be
    /// seen.
    fn over_time(&self, numbers: &[f64], run: Range<usize>) -> Vec<(f64, f64)> {
        let step = (run.len() / (MOST_POINTS / 2)).max(1);
        let mut points = Vec::new();
        let mut start = run.start;
        while start < run.end {
            let stretch = start..(start + step).min(run.end);
            let lowest = stretch.clone().min_by(|a, b| numbers[*a].total_cmp(&numbers[*b]));
            let highest = stretch.clone().max_by(|a, b| numbers[*a].total_cmp(&numbers[*b]));
            let mut both: Vec<usize> = lowest.into_iter().chain(highest).collect();
            both.sort_unstable();
            both.dedup();
            points.extend(both.into_iter().map(|at| (self.at(at), numbers[at])));
            start = stretch.end;
        }
        points
    }
}

/// From the smallest to the largest.
fn span(numbers: impl Iterator<Item = f64>) -> Range<f64> {
    let (low, high) = numbers.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), number| {
        (low.min(number), high.max(number))
    });
    if low <= high { low..high } else { 0.0..0.0 }
}

/// Both ranges with some room around, and so that a millimetre is as long across as it is up; `shape` is width over
/// height.
fn same_scale(across: Range<f64>, up: Range<f64>, shape: f64) -> (Range<f64>, Range<f64>) {
    let high = (up.end - up.start).max((across.end - across.start) / shape) * 1.1;
    // Where nothing moves the room around it is a millimetre.
    let high = if high > 1e-6 { high } else { 1.0 };
    let around = |range: &Range<f64>, size: f64| {
        let middle = f64::midpoint(range.start, range.end);
        middle - size / 2.0..middle + size / 2.0
    };
    (around(&across, high * shape), around(&up, high))
}

/// Stretches of a path that have one colour each; they share their ends.
fn pieces(samples: usize) -> impl Iterator<Item = Range<usize>> {
    let step = (samples / (MOST_POINTS / 4)).max(1);
    (0..samples.saturating_sub(1))
        .step_by(step)
        .map(move |start| start..(start + step + 1).min(samples))
}

/// Stretches in which there are numbers.
fn finite_runs(numbers: &[f64]) -> Vec<Range<usize>> {
    let mut runs: Vec<Range<usize>> = Vec::new();
    for (at, _) in numbers.iter().enumerate().filter(|(_, number)| number.is_finite()) {
        match runs.last_mut() {
            Some(run) if run.end == at => run.end = at + 1,
            _ => runs.push(at..at + 1),
        }
    }
    runs
}

/// Blue for nothing, red for the most.
fn heat(share: f64) -> RGBColor {
    #[expect(clippy::cast_possible_truncation, reason = "between two numbers of a byte")]
    #[expect(clippy::cast_sign_loss, reason = "between two numbers of a byte")]
    let mix = |from: f64, to: f64| (from + (to - from) * share.clamp(0.0, 1.0)).round() as u8;
    RGBColor(mix(0.0, 208.0), mix(114.0, 32.0), mix(178.0, 32.0))
}
