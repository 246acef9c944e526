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
pub(super) const ORIENT: u16 = 456;
pub(super) const OUTPUTS: u16 = 476;
pub(super) const OVERRIDES: u16 = 495;
pub(super) const PARAMETERS: u16 = 519;
pub(super) const PATH_CONTROL: u16 = 578;
pub(super) const PAUSE: u16 = 590;
pub(super) const POSITIONS: u16 = 601;
pub(super) const PROBE: u16 = 609;
pub(super) const PROGRAM_END: u16 = 622;
pub(super) const SAVED_STATE: u16 = 644;
pub(super) const SPINDLE: u16 = 701;
pub(super) const SPLINES: u16 = 731;
pub(super) const SUBROUTINES: u16 = 745;
pub(super) const TASK: u16 = 786;
pub(super) const TEXT: u16 = 791;
pub(super) const THREADING: u16 = 820;
pub(super) const TOOL: u16 = 839;
pub(super) const TRAJECTORY: u16 = 907;
pub(super) const UNITS_PLANES: u16 = 924;
pub(super) const USER_CODES: u16 = 944;

/// How many there are.
pub(crate) const COUNT: u16 = 957;
