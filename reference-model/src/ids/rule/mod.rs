//! Every rule by its chapter; written from the pages by `cargo run -p gaugeblock-suite --bin model-ids`.

pub mod abort;
pub mod active_comments;
pub mod arcs;
pub mod compensation;
pub mod control;
pub mod coolant;
pub mod cycles;
pub mod dwell;
pub mod expressions;
pub mod fanuc_subs;
pub mod feed;
mod first;
pub mod gpp;
pub mod inputs;
pub mod modal_groups;
pub mod motion;
pub mod nct;
pub mod numbers;
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
pub mod turning;
pub mod units_planes;
pub mod user_codes;

pub(crate) use first::COUNT;

/// The ids of each chapter, in the order of their numbers.
pub(crate) const CHAPTERS: &[&[&str]] = &[
    abort::CHAPTER_IDS,
    active_comments::CHAPTER_IDS,
    arcs::CHAPTER_IDS,
    compensation::CHAPTER_IDS,
    control::CHAPTER_IDS,
    coolant::CHAPTER_IDS,
    cycles::CHAPTER_IDS,
    dwell::CHAPTER_IDS,
    expressions::CHAPTER_IDS,
    fanuc_subs::CHAPTER_IDS,
    feed::CHAPTER_IDS,
    gpp::CHAPTER_IDS,
    inputs::CHAPTER_IDS,
    modal_groups::CHAPTER_IDS,
    motion::CHAPTER_IDS,
    nct::CHAPTER_IDS,
    numbers::CHAPTER_IDS,
    offsets::CHAPTER_IDS,
    order::CHAPTER_IDS,
    orient::CHAPTER_IDS,
    outputs::CHAPTER_IDS,
    overrides::CHAPTER_IDS,
    parameters::CHAPTER_IDS,
    path_control::CHAPTER_IDS,
    pause::CHAPTER_IDS,
    positions::CHAPTER_IDS,
    probe::CHAPTER_IDS,
    program_end::CHAPTER_IDS,
    saved_state::CHAPTER_IDS,
    spindle::CHAPTER_IDS,
    splines::CHAPTER_IDS,
    subroutines::CHAPTER_IDS,
    task::CHAPTER_IDS,
    text::CHAPTER_IDS,
    threading::CHAPTER_IDS,
    tool::CHAPTER_IDS,
    trajectory::CHAPTER_IDS,
    turning::CHAPTER_IDS,
    units_planes::CHAPTER_IDS,
    user_codes::CHAPTER_IDS,
];
