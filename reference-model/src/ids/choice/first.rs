//! The number of the first choice of each chapter; written from the pages by `cargo run -p gaugeblock-suite --bin model-ids`.

pub(super) const ABORT: u16 = 0;
pub(super) const ACTIVE_COMMENTS: u16 = 2;
pub(super) const ARCS: u16 = 8;
pub(super) const COMPENSATION: u16 = 15;
pub(super) const CONTROL: u16 = 16;
pub(super) const COOLANT: u16 = 23;
pub(super) const CYCLES: u16 = 24;
pub(super) const EXPRESSIONS: u16 = 31;
pub(super) const FANUC_SUBS: u16 = 39;
pub(super) const FEED: u16 = 43;
pub(super) const GPP: u16 = 44;
pub(super) const INPUTS: u16 = 52;
pub(super) const MODAL_GROUPS: u16 = 54;
pub(super) const MOTION: u16 = 60;
pub(super) const NCT: u16 = 62;
pub(super) const OFFSETS: u16 = 74;
pub(super) const ORDER: u16 = 79;
pub(super) const ORIENT: u16 = 80;
pub(super) const OUTPUTS: u16 = 83;
pub(super) const OVERRIDES: u16 = 87;
pub(super) const PARAMETERS: u16 = 90;
pub(super) const PATH_CONTROL: u16 = 99;
pub(super) const PAUSE: u16 = 100;
pub(super) const POSITIONS: u16 = 104;
pub(super) const PROBE: u16 = 106;
pub(super) const PROGRAM_END: u16 = 107;
pub(super) const SAVED_STATE: u16 = 110;
pub(super) const SPINDLE: u16 = 116;
pub(super) const SPLINES: u16 = 119;
pub(super) const SUBROUTINES: u16 = 120;
pub(super) const TASK: u16 = 121;
pub(super) const TEXT: u16 = 122;
pub(super) const THREADING: u16 = 129;
pub(super) const TOOL: u16 = 132;
pub(super) const TRAJECTORY: u16 = 144;
pub(super) const UNITS_PLANES: u16 = 146;
pub(super) const USER_CODES: u16 = 150;

/// How many there are.
pub(crate) const COUNT: u16 = 153;
