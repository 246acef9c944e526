//! A trajectory planner for CNC: canonical moves in, one servo sample out per cycle.
//!
//! A caller queues [`Segment`]s while the planner runs. It calls [`Planner::update`] once per servo cycle with what the
//! operator and the machine request ([`InputParameter`]), and gets the next position ([`OutputParameter`]).
//!
//! ```text
//! Segment
//!   nominal_segment   a segment as one element, by its length; short lines are merged        segment_merge
//!   path_builder      the end of the path: segments are cut, corners are put between them    corner,
//!                                                                                   round_corner
//! PathElement         a part of the path with one acceleration model   path_element, acceleration_model, limits
//!   look_ahead        how fast each element may be entered, from the end of the queue back   entry_speed, blend_limits
//!   retrace           the same for running in reverse
//!   servo_cycle       a cycle of motion along the elements    motion, fast_path, acceleration_window, blend_motion,
//!                                                             arc_braking
//!   smoothing         with limits of jerk: a moving average of the positions       stretch, lone_line
//! OutputParameter
//! ```
//!
//! Each stage sees the one before it as [`path_element::PathElement`] alone. Another velocity profile needs another
//! `entry_speed` and another `servo_cycle`. `docs/planner.md` in the repository explains the theory.
//!
//! The planner limits velocity, acceleration and, where [`Dynamics::jerk`] is set, jerk of each axis.
//!
//! **Invariants.**
//! * No limit of an axis is broken, whatever the feed of segments, overrides, holds or aborts.
//! * The work of a cycle is bounded, and a cycle allocates nothing: [`Planner::new`] allocates all memory.
//! * When the queue runs short, the machine stops on its path.
//! * Samples depend on segments and inputs alone. They depend on the time of queueing only where the queue is so short
//!   that the machine could not go faster.
//! * The crate has no `std`: no clock, no file, no thread. It never panics; the lints below refuse what could.
#![no_std]
#![cfg_attr(
    not(test),
    deny(
        clippy::unwrap_used,
        clippy::expect_used,
        clippy::panic,
        clippy::unreachable,
        clippy::indexing_slicing,
        clippy::string_slice,
        clippy::arithmetic_side_effects,
        clippy::integer_division,
        clippy::as_conversions
    )
)]

extern crate alloc;

mod acceleration_model;
mod acceleration_window;
mod arc_braking;
mod blend_limits;
mod blend_motion;
mod chord;
mod chord_row;
mod corner;
mod crowded_speed;
mod entry_speed;
mod error;
mod fast_path;
mod feed_path;
mod limits;
mod lone_line;
mod look_ahead;
mod math;
mod motion;
mod nominal_segment;
mod parameters;
mod path_builder;
mod path_element;
mod path_smoothing;
mod planner;
mod retrace;
mod ring;
mod round_corner;
mod row_end;
mod segment;
mod segment_merge;
mod servo_cycle;
mod sign_changes;
mod smoothing;
mod stretch;
mod tangent_break;
mod vector;

pub use error::{Error, NotQueued};
pub use parameters::{Axes, Dynamics, Hold, InputParameter, OutputParameter, Phase};
pub use planner::Planner;
pub use segment::{Feed, OutputSwitch, Path, PathControl, Segment};
