//! The forms of the vocabulary: text, TOML, JSON and its schemas.

mod generate;
mod motion;
mod refused_text;
mod round_trip;
mod schemas;
mod tagged;
