//! The number of the first choice of each chapter; written from the pages by `cargo run -p gaugeblock-suite --bin model-ids`.

pub(super) const ABORT: u16 = 0;
pub(super) const ACTIVE_COMMENTS: u16 = 2;
pub(super) const ARCS: u16 = 8;
pub(super) const CONTROL: u16 = 15;
pub(super) const COOLANT: u16 = 22;
pub(super) const CYCLES: u16 = 23;
pub(super) const EXPRESSIONS: u16 = 28;
pub(super) const FANUC_SUBS: u16 = 35;
pub(super) const FEED: u16 = 39;
pub(super) const GPP: u16 = 40;
pub(super) const INPUTS: u16 = 48;
pub(super) const MODAL_GROUPS: u16 = 50;
pub(super) const MOTION: u16 = 56;
pub(super) const NCT: u16 = 58;
pub(super) const OFFSETS: u16 = 70;
pub(super) const ORDER: u16 = 74;
pub(super) const ORIENT: u16 = 75;
pub(super) const OUTPUTS: u16 = 78;
pub(super) const OVERRIDES: u16 = 82;
pub(super) const PARAMETERS: u16 = 85;
pub(super) const PATH_CONTROL: u16 = 93;
pub(super) const PAUSE: u16 = 94;
pub(super) const POSITIONS: u16 = 98;
pub(super) const PROBE: u16 = 99;
pub(super) const PROGRAM_END: u16 = 100;
pub(super) const SAVED_STATE: u16 = 102;
pub(super) const SPINDLE: u16 = 108;
pub(super) const SPLINES: u16 = 111;
pub(super) const SUBROUTINES: u16 = 112;
pub(super) const TASK: u16 = 113;
pub(super) const TEXT: u16 = 114;
pub(super) const THREADING: u16 = 121;
pub(super) const TOOL: u16 = 124;
pub(super) const TRAJECTORY: u16 = 134;
pub(super) const UNITS_PLANES: u16 = 136;
pub(super) const USER_CODES: u16 = 140;

/// How many there are.
pub(crate) const COUNT: u16 = 143;
