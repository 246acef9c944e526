//! The number of the first rule of each chapter; written from the pages by `cargo run -p gaugeblock-suite --bin model-ids`.

pub(super) const ABORT: u16 = 0;
pub(super) const ACTIVE_COMMENTS: u16 = 5;
pub(super) const ARCS: u16 = 29;
pub(super) const COMPENSATION: u16 = 59;
pub(super) const CONTROL: u16 = 89;
pub(super) const COOLANT: u16 = 115;
pub(super) const CYCLES: u16 = 123;
pub(super) const DWELL: u16 = 161;
pub(super) const EXPRESSIONS: u16 = 167;
pub(super) const FANUC_SUBS: u16 = 198;
pub(super) const FEED: u16 = 217;
pub(super) const GPP: u16 = 234;
pub(super) const INPUTS: u16 = 267;
pub(super) const MODAL_GROUPS: u16 = 288;
pub(super) const MOTION: u16 = 328;
pub(super) const NCT: u16 = 347;
pub(super) const NUMBERS: u16 = 395;
pub(super) const OFFSETS: u16 = 403;
pub(super) const ORDER: u16 = 452;
pub(super) const ORIENT: u16 = 501;
pub(super) const OUTPUTS: u16 = 521;
pub(super) const OVERRIDES: u16 = 540;
pub(super) const PARAMETERS: u16 = 564;
pub(super) const PATH_CONTROL: u16 = 624;
pub(super) const PAUSE: u16 = 636;
pub(super) const POSITIONS: u16 = 648;
pub(super) const PROBE: u16 = 658;
pub(super) const PROGRAM_END: u16 = 671;
pub(super) const SAVED_STATE: u16 = 694;
pub(super) const SPINDLE: u16 = 751;
pub(super) const SPLINES: u16 = 781;
pub(super) const SUBROUTINES: u16 = 795;
pub(super) const TASK: u16 = 836;
pub(super) const TEXT: u16 = 841;
pub(super) const THREADING: u16 = 873;
pub(super) const TOOL: u16 = 892;
pub(super) const TRAJECTORY: u16 = 962;
pub(super) const TURNING: u16 = 979;
pub(super) const UNITS_PLANES: u16 = 1005;
pub(super) const USER_CODES: u16 = 1025;

/// How many there are.
pub(crate) const COUNT: u16 = 1038;
