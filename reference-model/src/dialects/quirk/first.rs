//! The number of the first quirk of each chapter; written from the pages by `cargo run -p gaugeblock-suite --bin model-ids`.

pub(super) const GRBL: u16 = 0;
pub(super) const GRBLHAL: u16 = 10;
pub(super) const LINUXCNC: u16 = 14;
pub(super) const NIST: u16 = 40;
pub(super) const RS274: u16 = 53;

/// How many there are.
pub(crate) const COUNT: u16 = 221;
