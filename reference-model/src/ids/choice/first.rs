//! The number of the first choice of each chapter; written from the pages by `cargo run -p gaugeblock-suite --bin model-ids`.

pub(super) const ABORT: u16 = 0;
pub(super) const ACTIVE_COMMENTS: u16 = 2;
pub(super) const ARCS: u16 = 8;
pub(super) const COMPENSATION: u16 = 15;
pub(super) const CONTROL: u16 = 16;
pub(super) const COOLANT: u16 = 23;
pub(super) const CYCLES: u16 = 24;
pub(super) const EXPRESSIONS: u16 = 35;
pub(super) const FANUC_SUBS: u16 = 43;
pub(super) const FEED: u16 = 47;
pub(super) const GPP: u16 = 49;
pub(super) const INPUTS: u16 = 57;
pub(super) const MODAL_GROUPS: u16 = 59;
pub(super) const MOTION: u16 = 65;
pub(super) const NCT: u16 = 67;
pub(super) const OFFSETS: u16 = 79;
pub(super) const ORDER: u16 = 86;
pub(super) const ORIENT: u16 = 87;
pub(super) const OUTPUTS: u16 = 90;
pub(super) const OVERRIDES: u16 = 94;
pub(super) const PARAMETERS: u16 = 97;
pub(super) const PATH_CONTROL: u16 = 106;
pub(super) const PAUSE: u16 = 107;
pub(super) const POSITIONS: u16 = 111;
pub(super) const PROBE: u16 = 113;
pub(super) const PROGRAM_END: u16 = 114;
pub(super) const SAVED_STATE: u16 = 117;
pub(super) const SPINDLE: u16 = 123;
pub(super) const SPLINES: u16 = 126;
pub(super) const SUBROUTINES: u16 = 127;
pub(super) const TASK: u16 = 128;
pub(super) const TEXT: u16 = 129;
pub(super) const THREADING: u16 = 136;
pub(super) const TOOL: u16 = 139;
pub(super) const TRAJECTORY: u16 = 153;
pub(super) const UNITS_PLANES: u16 = 155;
pub(super) const USER_CODES: u16 = 160;

/// How many there are.
pub(crate) const COUNT: u16 = 163;
