//! The number of the first choice of each chapter; written from the pages by `cargo run -p gaugeblock-suite --bin model-ids`.

pub(super) const ABORT: u16 = 0;
pub(super) const ACTIVE_COMMENTS: u16 = 2;
pub(super) const ARCS: u16 = 8;
pub(super) const CONTROL: u16 = 15;
pub(super) const COOLANT: u16 = 22;
pub(super) const CYCLES: u16 = 23;
pub(super) const EXPRESSIONS: u16 = 30;
pub(super) const FANUC_SUBS: u16 = 38;
pub(super) const FEED: u16 = 42;
pub(super) const GPP: u16 = 43;
pub(super) const INPUTS: u16 = 51;
pub(super) const MODAL_GROUPS: u16 = 53;
pub(super) const MOTION: u16 = 59;
pub(super) const NCT: u16 = 61;
pub(super) const OFFSETS: u16 = 73;
pub(super) const ORDER: u16 = 78;
pub(super) const ORIENT: u16 = 79;
pub(super) const OUTPUTS: u16 = 82;
pub(super) const OVERRIDES: u16 = 86;
pub(super) const PARAMETERS: u16 = 89;
pub(super) const PATH_CONTROL: u16 = 98;
pub(super) const PAUSE: u16 = 99;
pub(super) const POSITIONS: u16 = 103;
pub(super) const PROBE: u16 = 105;
pub(super) const PROGRAM_END: u16 = 106;
pub(super) const SAVED_STATE: u16 = 109;
pub(super) const SPINDLE: u16 = 115;
pub(super) const SPLINES: u16 = 118;
pub(super) const SUBROUTINES: u16 = 119;
pub(super) const TASK: u16 = 120;
pub(super) const TEXT: u16 = 121;
pub(super) const THREADING: u16 = 128;
pub(super) const TOOL: u16 = 131;
pub(super) const TRAJECTORY: u16 = 143;
pub(super) const UNITS_PLANES: u16 = 145;
pub(super) const USER_CODES: u16 = 149;

/// How many there are.
pub(crate) const COUNT: u16 = 152;
