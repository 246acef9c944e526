//! The number of the first choice of each chapter; written from the pages by `cargo run -p gaugeblock-suite --bin model-ids`.

pub(super) const ABORT: u16 = 0;
pub(super) const ACTIVE_COMMENTS: u16 = 2;
pub(super) const ARCS: u16 = 8;
pub(super) const CONTROL: u16 = 14;
pub(super) const COOLANT: u16 = 21;
pub(super) const CYCLES: u16 = 22;
pub(super) const EXPRESSIONS: u16 = 27;
pub(super) const FANUC_SUBS: u16 = 34;
pub(super) const GPP: u16 = 38;
pub(super) const INPUTS: u16 = 46;
pub(super) const MODAL_GROUPS: u16 = 48;
pub(super) const MOTION: u16 = 52;
pub(super) const NCT: u16 = 53;
pub(super) const OFFSETS: u16 = 65;
pub(super) const ORIENT: u16 = 66;
pub(super) const OUTPUTS: u16 = 69;
pub(super) const OVERRIDES: u16 = 73;
pub(super) const PARAMETERS: u16 = 76;
pub(super) const PATH_CONTROL: u16 = 84;
pub(super) const PAUSE: u16 = 85;
pub(super) const POSITIONS: u16 = 88;
pub(super) const PROBE: u16 = 89;
pub(super) const PROGRAM_END: u16 = 90;
pub(super) const SAVED_STATE: u16 = 92;
pub(super) const SPINDLE: u16 = 98;
pub(super) const SPLINES: u16 = 101;
pub(super) const SUBROUTINES: u16 = 102;
pub(super) const TASK: u16 = 103;
pub(super) const TEXT: u16 = 104;
pub(super) const THREADING: u16 = 108;
pub(super) const TOOL: u16 = 111;
pub(super) const TRAJECTORY: u16 = 120;
pub(super) const UNITS_PLANES: u16 = 122;
pub(super) const USER_CODES: u16 = 126;

/// How many there are.
pub(crate) const COUNT: u16 = 129;
