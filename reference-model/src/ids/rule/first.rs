//! The number of the first rule of each chapter; written from the pages by `cargo run -p gaugeblock-suite --bin model-ids`.

pub(super) const ABORT: u16 = 0;
pub(super) const ACTIVE_COMMENTS: u16 = 5;
pub(super) const ARCS: u16 = 29;
pub(super) const COMPENSATION: u16 = 59;
pub(super) const CONTROL: u16 = 88;
pub(super) const COOLANT: u16 = 114;
pub(super) const CYCLES: u16 = 122;
pub(super) const DWELL: u16 = 160;
pub(super) const EXPRESSIONS: u16 = 166;
pub(super) const FANUC_SUBS: u16 = 197;
pub(super) const FEED: u16 = 216;
pub(super) const GPP: u16 = 233;
pub(super) const INPUTS: u16 = 266;
pub(super) const MODAL_GROUPS: u16 = 287;
pub(super) const MOTION: u16 = 327;
pub(super) const NCT: u16 = 346;
pub(super) const NUMBERS: u16 = 394;
pub(super) const OFFSETS: u16 = 402;
pub(super) const ORDER: u16 = 451;
pub(super) const ORIENT: u16 = 500;
pub(super) const OUTPUTS: u16 = 520;
pub(super) const OVERRIDES: u16 = 539;
pub(super) const PARAMETERS: u16 = 563;
pub(super) const PATH_CONTROL: u16 = 623;
pub(super) const PAUSE: u16 = 635;
pub(super) const POSITIONS: u16 = 647;
pub(super) const PROBE: u16 = 657;
pub(super) const PROGRAM_END: u16 = 670;
pub(super) const SAVED_STATE: u16 = 693;
pub(super) const SPINDLE: u16 = 750;
pub(super) const SPLINES: u16 = 780;
pub(super) const SUBROUTINES: u16 = 794;
pub(super) const TASK: u16 = 835;
pub(super) const TEXT: u16 = 840;
pub(super) const THREADING: u16 = 872;
pub(super) const TOOL: u16 = 891;
pub(super) const TRAJECTORY: u16 = 961;
pub(super) const UNITS_PLANES: u16 = 978;
pub(super) const USER_CODES: u16 = 998;

/// How many there are.
pub(crate) const COUNT: u16 = 1011;
