//! The trajectory planner: canonical moves in, one servo sample out per cycle.
//!
//! A caller queues [`Segment`]s while the planner runs, and calls [`Planner::update`] once per servo cycle with what
//! the outside wants now ([`InputParameter`]); it gets where the machine shall be next ([`OutputParameter`]).
//!
//! ```text
//! Segment
//!   leg         a segment as one piece of path, by the distance, or several in one leg
//!   course      the end of the path: legs are cut, corners put between them        course, corner
//! Piece         a part of the path with one law for speed and acceleration         piece, limits
//!   ahead       how fast each piece may be entered, from the end of the queue back ahead, reach, strips
//!   retrace     the same for running back, from far behind up to the motion
//!   step        a cycle of motion along the pieces                                 step, cruise, bend, brakes
//! OutputParameter
//! ```
//!
//! Each stage sees the one before it through [`path_element::PathElement`] alone, so that another profile is another `reach` and
//! `step`.
//!
//! **Invariants.** No limit of an axis is broken, whatever the feed of segments, overrides, holds or aborts. A
//! cycle's work is bounded and allocates nothing: all memory is taken by [`Planner::new`]. When the queue runs short,
//! the machine stops on its path. Samples depend on segments and inputs alone, and on the time of queueing only where
//! the queue is so short that the machine could not go faster for it.
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
mod corner;
mod entry_speed;
mod error;
mod fast_path;
mod limits;
mod look_ahead;
mod math;
mod motion;
mod nominal_segment;
mod parameters;
mod path_builder;
mod path_element;
mod planner;
mod retrace;
mod ring;
mod segment;
mod segment_merge;
mod servo_cycle;
mod vector;

pub use error::{Error, NotQueued};
pub use parameters::{Axes, Dynamics, Hold, InputParameter, OutputParameter, Phase};
pub use planner::Planner;
pub use segment::{Feed, OutputSwitch, Path, PathControl, Segment};
