//! Reports of runs on controllers that were made to fail.

mod comparison;
mod referee;
mod summary;
