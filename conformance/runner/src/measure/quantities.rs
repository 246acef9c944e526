//! What is measured, with the program for a value.

/// How a value is searched.
#[derive(Clone, Copy, Debug)]
pub(super) enum Scale {
    /// Whole numbers.
    Whole {
        /// The value that should be accepted.
        low: u32,
        /// The largest that is tried.
        high: u32,
    },
    /// Numbers whose ratio counts.
    Real {
        /// The value that should be accepted, above zero.
        low: f64,
        /// The largest that is tried.
        high: f64,
        /// The part of a value to which the edge is found.
        closeness: f64,
    },
}

impl Scale {
    pub(super) fn ends(self) -> (f64, f64) {
        match self {
            Self::Whole { low, high } => (f64::from(low), f64::from(high)),
            Self::Real { low, high, .. } => (low, high),
        }
    }

    /// The next value on the way up.
    pub(super) fn beyond(self, value: f64) -> f64 {
        match self {
            Self::Whole { .. } => (value * 2.0).max(value + 1.0),
            Self::Real { .. } => value * 10.0,
        }
    }

    /// A value between two; none when they are close enough.
    pub(super) fn between(self, accepted: f64, refused: f64) -> Option<f64> {
        match self {
            Self::Whole { .. } => {
                let middle = f64::midpoint(accepted, refused).floor();
                (middle > accepted).then_some(middle)
            }
            Self::Real { closeness, .. } => {
                let middle = f64::midpoint(accepted, refused);
                (refused - accepted > closeness * accepted && middle > accepted && middle < refused)
                    .then_some(middle)
            }
        }
    }
}

/// A quantity whose edge is searched.
#[derive(Debug)]
pub(super) struct Quantity {
    pub(super) id: &'static str,
    pub(super) title: &'static str,
    pub(super) unit: &'static str,
    pub(super) scale: Scale,
    /// The program for a value. Its first refusal is the controller's limit.
    pub(super) program: fn(f64) -> String,
}

/// A program whose last move is a step of this length, millimetres.
pub(super) fn step_program(step: f64) -> String {
    format!("g21 g90\ng0 x1\ng0 x{:.13}\nm2\n", 1.0 + step)
}

/// Errors of an arc: lengths in this scale, millimetres.
const ERROR: Scale = Scale::Real { low: 1e-9, high: 100.0, closeness: 1e-4 };

/// Half a circle from X0 to X2r whose end is off it.
fn arc(radius: f64, error: f64) -> String {
    format!(
        "g21 g17 g90 g94 f100\ng0 x0 y0\ng2 x{:.10} y0 i{radius} j0\nm2\n",
        2.0 * radius + error
    )
}

/// Half a circle whose R is below half of the chord.
fn short_radius(radius: f64, error: f64) -> String {
    format!("g21 g17 g90 g94 f100\ng0 x0 y0\ng2 x{} y0 r{:.10}\nm2\n", 2.0 * radius, radius - error)
}

pub(super) const QUANTITIES: &[Quantity] = &[
    Quantity {
        id: "arc-end-radius-1",
        title: "end of an arc off its circle, radius 1 mm",
        unit: "mm",
        scale: Scale::Real { low: 1e-9, high: 1.0, closeness: 1e-4 },
        program: |error| arc(1.0, error),
    },
    Quantity {
        id: "arc-end-radius-10",
        title: "end of an arc off its circle, radius 10 mm",
        unit: "mm",
        scale: ERROR,
        program: |error| arc(10.0, error),
    },
    Quantity {
        id: "arc-end-radius-1000",
        title: "end of an arc off its circle, radius 1000 mm",
        unit: "mm",
        scale: ERROR,
        program: |error| arc(1000.0, error),
    },
    Quantity {
        id: "arc-end-radius-inch",
        title: "end of an arc off its circle, radius 1 inch",
        unit: "inch",
        scale: Scale::Real { low: 1e-9, high: 1.0, closeness: 1e-4 },
        program: |error| {
            format!("g20 g17 g90 g94 f100\ng0 x0 y0\ng2 x{:.10} y0 i1 j0\nm2\n", 2.0 + error)
        },
    },
    Quantity {
        id: "arc-radius-short-10",
        title: "R of half a circle below its radius of 10 mm",
        unit: "mm",
        scale: Scale::Real { low: 1e-9, high: 9.0, closeness: 1e-4 },
        program: |error| short_radius(10.0, error),
    },
    Quantity {
        id: "code-decimals",
        title: "number of a G code off that of G1",
        unit: "",
        scale: Scale::Real { low: 1e-12, high: 0.04, closeness: 1e-3 },
        program: |off| format!("g21 g94 f100\ng{:.14} x1\nm2\n", 1.0 + off),
    },
    Quantity {
        id: "whole-number",
        title: "number of a tool off a whole number",
        unit: "",
        scale: Scale::Real { low: 1e-12, high: 0.4, closeness: 1e-3 },
        program: |off| format!("t{:.14}\nm2\n", 1.0 + off),
    },
    Quantity {
        id: "call-depth",
        title: "calls of a sub within each other",
        unit: "",
        scale: Scale::Whole { low: 1, high: 4096 },
        program: |depth| {
            format!(
                "o100 sub\no101 if [#1 gt 1]\no100 call [#1-1]\no101 endif\no100 endsub\no100 call [{depth}]\nm2\n"
            )
        },
    },
    Quantity {
        id: "bracket-depth",
        title: "brackets of an expression within each other",
        unit: "",
        scale: Scale::Whole { low: 1, high: 4096 },
        program: |depth| {
            let depth = whole(depth);
            format!("#1={}1{}\nm2\n", "[".repeat(depth), "]".repeat(depth))
        },
    },
    Quantity {
        id: "line-length",
        title: "characters of a line",
        unit: "",
        scale: Scale::Whole { low: 16, high: 1 << 17 },
        program: |length| format!("g0 x1{}\nm2\n", " ".repeat(whole(length).saturating_sub(5))),
    },
    Quantity {
        id: "line-number",
        title: "N of a line",
        unit: "",
        scale: Scale::Whole { low: 1, high: u32::MAX },
        program: |number| format!("n{number} g0 x1\nm2\n"),
    },
    Quantity {
        id: "parameter-number",
        title: "number of a parameter that can be set",
        unit: "",
        scale: Scale::Whole { low: 31, high: u32::MAX },
        program: |number| format!("#{number}=1\nm2\n"),
    },
    Quantity {
        id: "parameter-name",
        title: "characters of the name of a parameter",
        unit: "",
        scale: Scale::Whole { low: 1, high: 1 << 14 },
        program: |length| format!("#<{}>=1\nm2\n", "n".repeat(whole(length))),
    },
    Quantity {
        id: "settings-per-line",
        title: "parameters that one line sets",
        unit: "",
        scale: Scale::Whole { low: 1, high: 1024 },
        program: |count| format!("{}\nm2\n", "#1=1 ".repeat(whole(count))),
    },
    Quantity {
        id: "tool-number",
        title: "number of a tool that can be selected",
        unit: "",
        scale: Scale::Whole { low: 1, high: u32::MAX },
        program: |number| format!("t{number}\nm2\n"),
    },
    Quantity {
        id: "cycle-repeats",
        title: "L of a canned cycle",
        unit: "",
        scale: Scale::Whole { low: 1, high: 1024 },
        program: |count| {
            format!("g21 g17 g90 g94 f100\ng0 x0 y0 z5\ng91 g81 x1 z-1 r-1 l{count}\nm2\n")
        },
    },
    Quantity {
        id: "axis-value",
        title: "a coordinate",
        unit: "mm",
        scale: Scale::Real { low: 1.0, high: 1e15, closeness: 1e-3 },
        program: |value| format!("g21 g90\ng0 x{value:.3}\nm2\n"),
    },
];

fn whole(value: f64) -> usize {
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a scale of whole numbers holds no other"
    )]
    let whole = value as usize;
    whole
}
