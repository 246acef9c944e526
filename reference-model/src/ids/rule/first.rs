//! The number of the first rule of each chapter; written from the pages by `cargo run -p gaugeblock-suite --bin model-ids`.

pub(super) const ABORT: u16 = 0;
pub(super) const ACTIVE_COMMENTS: u16 = 5;
pub(super) const ARCS: u16 = 29;
pub(super) const COMPENSATION: u16 = 59;
pub(super) const CONTROL: u16 = 87;
pub(super) const COOLANT: u16 = 113;
pub(super) const CYCLES: u16 = 121;
pub(super) const DWELL: u16 = 159;
pub(super) const EXPRESSIONS: u16 = 165;
pub(super) const FANUC_SUBS: u16 = 196;
pub(super) const FEED: u16 = 215;
pub(super) const GPP: u16 = 232;
pub(super) const INPUTS: u16 = 265;
pub(super) const MODAL_GROUPS: u16 = 286;
pub(super) const MOTION: u16 = 326;
pub(super) const NCT: u16 = 345;
pub(super) const NUMBERS: u16 = 393;
pub(super) const OFFSETS: u16 = 401;
pub(super) const ORDER: u16 = 450;
pub(super) const ORIENT: u16 = 499;
pub(super) const OUTPUTS: u16 = 519;
pub(super) const OVERRIDES: u16 = 538;
pub(super) const PARAMETERS: u16 = 562;
pub(super) const PATH_CONTROL: u16 = 622;
pub(super) const PAUSE: u16 = 634;
pub(super) const POSITIONS: u16 = 646;
pub(super) const PROBE: u16 = 656;
pub(super) const PROGRAM_END: u16 = 669;
pub(super) const SAVED_STATE: u16 = 692;
pub(super) const SPINDLE: u16 = 749;
pub(super) const SPLINES: u16 = 779;
pub(super) const SUBROUTINES: u16 = 793;
pub(super) const TASK: u16 = 834;
pub(super) const TEXT: u16 = 839;
pub(super) const THREADING: u16 = 871;
pub(super) const TOOL: u16 = 890;
pub(super) const TRAJECTORY: u16 = 960;
pub(super) const UNITS_PLANES: u16 = 977;
pub(super) const USER_CODES: u16 = 997;

/// How many there are.
pub(crate) const COUNT: u16 = 1010;
