//! Every quirk by its chapter; written from the pages by `cargo run -p gaugeblock-suite --bin model-ids`.

mod first;
pub mod grbl;
pub mod grblhal;
pub mod linuxcnc;
pub mod nist;
pub mod rs274;

pub(crate) use first::COUNT;

/// The ids of each chapter, in the order of their numbers.
pub(crate) const CHAPTERS: &[&[&str]] = &[
    grbl::CHAPTER_IDS,
    grblhal::CHAPTER_IDS,
    linuxcnc::CHAPTER_IDS,
    nist::CHAPTER_IDS,
    rs274::CHAPTER_IDS,
];
