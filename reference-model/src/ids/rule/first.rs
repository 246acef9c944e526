//! The number of the first rule of each chapter; written from the pages by `cargo run -p gaugeblock-suite --bin model-ids`.

pub(super) const ABORT: u16 = 0;
pub(super) const ACTIVE_COMMENTS: u16 = 5;
pub(super) const ARCS: u16 = 29;
pub(super) const CONTROL: u16 = 59;
pub(super) const COOLANT: u16 = 85;
pub(super) const CYCLES: u16 = 93;
pub(super) const DWELL: u16 = 131;
pub(super) const EXPRESSIONS: u16 = 137;
pub(super) const FANUC_SUBS: u16 = 168;
pub(super) const FEED: u16 = 187;
pub(super) const GPP: u16 = 204;
pub(super) const INPUTS: u16 = 237;
pub(super) const MODAL_GROUPS: u16 = 258;
pub(super) const MOTION: u16 = 298;
pub(super) const NCT: u16 = 317;
pub(super) const NUMBERS: u16 = 365;
pub(super) const OFFSETS: u16 = 373;
pub(super) const ORDER: u16 = 422;
pub(super) const ORIENT: u16 = 471;
pub(super) const OUTPUTS: u16 = 491;
pub(super) const OVERRIDES: u16 = 510;
pub(super) const PARAMETERS: u16 = 534;
pub(super) const PATH_CONTROL: u16 = 594;
pub(super) const PAUSE: u16 = 606;
pub(super) const POSITIONS: u16 = 618;
pub(super) const PROBE: u16 = 628;
pub(super) const PROGRAM_END: u16 = 641;
pub(super) const SAVED_STATE: u16 = 664;
pub(super) const SPINDLE: u16 = 721;
pub(super) const SPLINES: u16 = 751;
pub(super) const SUBROUTINES: u16 = 765;
pub(super) const TASK: u16 = 806;
pub(super) const TEXT: u16 = 811;
pub(super) const THREADING: u16 = 843;
pub(super) const TOOL: u16 = 862;
pub(super) const TRAJECTORY: u16 = 932;
pub(super) const UNITS_PLANES: u16 = 949;
pub(super) const USER_CODES: u16 = 969;

/// How many there are.
pub(crate) const COUNT: u16 = 982;
