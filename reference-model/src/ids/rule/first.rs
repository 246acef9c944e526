//! The number of the first rule of each chapter; written from the pages by `cargo run -p gaugeblock-suite --bin model-ids`.

pub(super) const ABORT: u16 = 0;
pub(super) const ACTIVE_COMMENTS: u16 = 5;
pub(super) const ARCS: u16 = 29;
pub(super) const CONTROL: u16 = 58;
pub(super) const COOLANT: u16 = 84;
pub(super) const CYCLES: u16 = 92;
pub(super) const DWELL: u16 = 128;
pub(super) const EXPRESSIONS: u16 = 134;
pub(super) const FANUC_SUBS: u16 = 164;
pub(super) const FEED: u16 = 183;
pub(super) const GPP: u16 = 200;
pub(super) const INPUTS: u16 = 233;
pub(super) const MODAL_GROUPS: u16 = 254;
pub(super) const MOTION: u16 = 294;
pub(super) const NCT: u16 = 313;
pub(super) const NUMBERS: u16 = 361;
pub(super) const OFFSETS: u16 = 369;
pub(super) const ORDER: u16 = 416;
pub(super) const ORIENT: u16 = 465;
pub(super) const OUTPUTS: u16 = 485;
pub(super) const OVERRIDES: u16 = 504;
pub(super) const PARAMETERS: u16 = 528;
pub(super) const PATH_CONTROL: u16 = 587;
pub(super) const PAUSE: u16 = 599;
pub(super) const POSITIONS: u16 = 611;
pub(super) const PROBE: u16 = 620;
pub(super) const PROGRAM_END: u16 = 633;
pub(super) const SAVED_STATE: u16 = 655;
pub(super) const SPINDLE: u16 = 712;
pub(super) const SPLINES: u16 = 742;
pub(super) const SUBROUTINES: u16 = 756;
pub(super) const TASK: u16 = 797;
pub(super) const TEXT: u16 = 802;
pub(super) const THREADING: u16 = 834;
pub(super) const TOOL: u16 = 853;
pub(super) const TRAJECTORY: u16 = 922;
pub(super) const UNITS_PLANES: u16 = 939;
pub(super) const USER_CODES: u16 = 959;

/// How many there are.
pub(crate) const COUNT: u16 = 972;
