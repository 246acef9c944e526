//! The number of the first rule of each chapter; written from the pages by `cargo run -p gaugeblock-suite --bin model-ids`.

pub(super) const ABORT: u16 = 0;
pub(super) const ACTIVE_COMMENTS: u16 = 5;
pub(super) const ARCS: u16 = 29;
pub(super) const CONTROL: u16 = 57;
pub(super) const COOLANT: u16 = 83;
pub(super) const CYCLES: u16 = 91;
pub(super) const DWELL: u16 = 127;
pub(super) const EXPRESSIONS: u16 = 133;
pub(super) const FANUC_SUBS: u16 = 163;
pub(super) const FEED: u16 = 182;
pub(super) const GPP: u16 = 198;
pub(super) const INPUTS: u16 = 231;
pub(super) const MODAL_GROUPS: u16 = 252;
pub(super) const MOTION: u16 = 290;
pub(super) const NCT: u16 = 308;
pub(super) const NUMBERS: u16 = 356;
pub(super) const OFFSETS: u16 = 364;
pub(super) const ORDER: u16 = 408;
pub(super) const ORIENT: u16 = 452;
pub(super) const OUTPUTS: u16 = 472;
pub(super) const OVERRIDES: u16 = 491;
pub(super) const PARAMETERS: u16 = 515;
pub(super) const PATH_CONTROL: u16 = 574;
pub(super) const PAUSE: u16 = 586;
pub(super) const POSITIONS: u16 = 597;
pub(super) const PROBE: u16 = 605;
pub(super) const PROGRAM_END: u16 = 618;
pub(super) const SAVED_STATE: u16 = 640;
pub(super) const SPINDLE: u16 = 697;
pub(super) const SPLINES: u16 = 727;
pub(super) const SUBROUTINES: u16 = 741;
pub(super) const TASK: u16 = 782;
pub(super) const TEXT: u16 = 787;
pub(super) const THREADING: u16 = 816;
pub(super) const TOOL: u16 = 835;
pub(super) const TRAJECTORY: u16 = 903;
pub(super) const UNITS_PLANES: u16 = 920;
pub(super) const USER_CODES: u16 = 940;

/// How many there are.
pub(crate) const COUNT: u16 = 953;
