//! The number of the first choice of each chapter; written from the pages by `cargo run -p gaugeblock-suite --bin model-ids`.

pub(super) const ABORT: u16 = 0;
pub(super) const ACTIVE_COMMENTS: u16 = 2;
pub(super) const ARCS: u16 = 8;
pub(super) const COMPENSATION: u16 = 15;
pub(super) const CONTROL: u16 = 17;
pub(super) const COOLANT: u16 = 24;
pub(super) const CYCLES: u16 = 25;
pub(super) const EXPRESSIONS: u16 = 36;
pub(super) const FANUC_SUBS: u16 = 44;
pub(super) const FEED: u16 = 48;
pub(super) const GPP: u16 = 50;
pub(super) const INPUTS: u16 = 58;
pub(super) const MODAL_GROUPS: u16 = 60;
pub(super) const MOTION: u16 = 66;
pub(super) const NCT: u16 = 68;
pub(super) const OFFSETS: u16 = 80;
pub(super) const ORDER: u16 = 87;
pub(super) const ORIENT: u16 = 88;
pub(super) const OUTPUTS: u16 = 91;
pub(super) const OVERRIDES: u16 = 95;
pub(super) const PARAMETERS: u16 = 98;
pub(super) const PATH_CONTROL: u16 = 107;
pub(super) const PAUSE: u16 = 108;
pub(super) const POSITIONS: u16 = 112;
pub(super) const PROBE: u16 = 114;
pub(super) const PROGRAM_END: u16 = 115;
pub(super) const SAVED_STATE: u16 = 118;
pub(super) const SPINDLE: u16 = 124;
pub(super) const SPLINES: u16 = 127;
pub(super) const SUBROUTINES: u16 = 128;
pub(super) const TASK: u16 = 129;
pub(super) const TEXT: u16 = 130;
pub(super) const THREADING: u16 = 137;
pub(super) const TOOL: u16 = 140;
pub(super) const TRAJECTORY: u16 = 154;
pub(super) const UNITS_PLANES: u16 = 156;
pub(super) const USER_CODES: u16 = 161;

/// How many there are.
pub(crate) const COUNT: u16 = 164;
