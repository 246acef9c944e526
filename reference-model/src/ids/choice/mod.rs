//! Every choice by its chapter; written from the pages by `cargo run -p gaugeblock-suite --bin model-ids`.

pub mod abort;
pub mod active_comments;
pub mod arcs;
pub mod compensation;
pub mod control;
pub mod coolant;
pub mod cycles;
pub mod expressions;
pub mod fanuc_subs;
pub mod feed;
mod first;
pub mod gpp;
pub mod inputs;
pub mod modal_groups;
pub mod motion;
pub mod nct;
pub mod offsets;
pub mod order;
pub mod orient;
pub mod outputs;
pub mod overrides;
pub mod parameters;
pub mod path_control;
pub mod pause;
pub mod positions;
pub mod probe;
pub mod program_end;
pub mod saved_state;
pub mod spindle;
pub mod splines;
pub mod subroutines;
pub mod task;
pub mod text;
pub mod threading;
pub mod tool;
pub mod trajectory;
pub mod units_planes;
pub mod user_codes;

use super::page::Page;
pub(crate) use first::COUNT;

/// The pages of each chapter, in the order of their numbers.
pub(crate) const CHAPTERS: &[&[Page]] = &[
    abort::CHAPTER_PAGES,
    active_comments::CHAPTER_PAGES,
    arcs::CHAPTER_PAGES,
    compensation::CHAPTER_PAGES,
    control::CHAPTER_PAGES,
    coolant::CHAPTER_PAGES,
    cycles::CHAPTER_PAGES,
    expressions::CHAPTER_PAGES,
    fanuc_subs::CHAPTER_PAGES,
    feed::CHAPTER_PAGES,
    gpp::CHAPTER_PAGES,
    inputs::CHAPTER_PAGES,
    modal_groups::CHAPTER_PAGES,
    motion::CHAPTER_PAGES,
    nct::CHAPTER_PAGES,
    offsets::CHAPTER_PAGES,
    order::CHAPTER_PAGES,
    orient::CHAPTER_PAGES,
    outputs::CHAPTER_PAGES,
    overrides::CHAPTER_PAGES,
    parameters::CHAPTER_PAGES,
    path_control::CHAPTER_PAGES,
    pause::CHAPTER_PAGES,
    positions::CHAPTER_PAGES,
    probe::CHAPTER_PAGES,
    program_end::CHAPTER_PAGES,
    saved_state::CHAPTER_PAGES,
    spindle::CHAPTER_PAGES,
    splines::CHAPTER_PAGES,
    subroutines::CHAPTER_PAGES,
    task::CHAPTER_PAGES,
    text::CHAPTER_PAGES,
    threading::CHAPTER_PAGES,
    tool::CHAPTER_PAGES,
    trajectory::CHAPTER_PAGES,
    units_planes::CHAPTER_PAGES,
    user_codes::CHAPTER_PAGES,
];
