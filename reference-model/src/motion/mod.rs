//! Motion: the path that a program requests, the laws that every trajectory must satisfy, and a lower bound of its
//! time.
//!
//! | read | to learn |
//! | --- | --- |
//! | [`path`] | the path that an outcome requests, in machine coordinates, and when two paths are the same |
//! | [`laws`] | samples held against path, limits and operator script: a law a section |
//! | [`bound`] | a lower bound on the time of a path, and the distance in which a motion can stop |
//! | [`recording`] | the samples that laws read, with a store for those that do not fit into memory |
//! | `curve`, `route`, `vector` | the geometry below: lines, arcs and helices; legs and corners; nine coordinates |
//!
//! **Invariants.** It reads its arguments and nothing else. It is written from the documents and from mechanics,
//! without a look at any planner. What it cannot know it does not judge, and says so.

pub mod bound;
mod curve;
mod envelope;
pub mod laws;
pub mod path;
pub mod recording;
mod route;
mod vector;
