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
pub(super) const MOTION: u16 = 53;
pub(super) const NCT: u16 = 54;
pub(super) const OFFSETS: u16 = 66;
pub(super) const ORIENT: u16 = 67;
pub(super) const OUTPUTS: u16 = 70;
pub(super) const OVERRIDES: u16 = 74;
pub(super) const PARAMETERS: u16 = 77;
pub(super) const PATH_CONTROL: u16 = 85;
pub(super) const PAUSE: u16 = 86;
pub(super) const POSITIONS: u16 = 89;
pub(super) const PROBE: u16 = 90;
pub(super) const PROGRAM_END: u16 = 91;
pub(super) const SAVED_STATE: u16 = 93;
pub(super) const SPINDLE: u16 = 99;
pub(super) const SPLINES: u16 = 102;
pub(super) const SUBROUTINES: u16 = 103;
pub(super) const TASK: u16 = 104;
pub(super) const TEXT: u16 = 105;
pub(super) const THREADING: u16 = 109;
pub(super) const TOOL: u16 = 112;
pub(super) const TRAJECTORY: u16 = 121;
pub(super) const UNITS_PLANES: u16 = 123;
pub(super) const USER_CODES: u16 = 127;

/// How many there are.
pub(crate) const COUNT: u16 = 130;
