//! Motion: a program becomes servo samples, and the laws of motion judge samples of any controller.
//!
//! ```text
//! Outcome of production ─► drive: resolver, planner ─► Samples ──┐
//! Outcome of the model ──► programmed path ──────────────────────┼─► laws, bound ─► summary, picture
//! machine: limits of the axes ───────────────────────────────────┘
//! ```
//!
//! The suite's cases of motion are judged here too: samples that a page gives (`synthesize`) and those of a controller
//! (`assertions`).
//!
//! Laws and bound are the model's, planner and resolver are production's: a misreading of one side shows as a
//! difference.

mod assertions;
mod document;
mod picture;
mod polyline;
mod sketch;
mod summary;
mod synthesize;
mod thinned;

pub use assertions::{FEED_INTERVALS, check_assertions, scenario_and_path};
pub use document::{JudgedMotionRule, MotionDocument, MotionVerdict, MotionViolation};
pub use picture::Picture;
pub use polyline::polyline;
pub use sketch::Sketch;
pub use summary::Summary;
pub use synthesize::synthesize;
pub use thinned::Thinned;
