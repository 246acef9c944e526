//! Reports of runs on controllers that were made to fail.

mod referee;
mod summary;
