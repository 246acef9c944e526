//! The number of the first quirk of each chapter; written from the pages by `cargo run -p gaugeblock-suite --bin model-ids`.

pub(super) const GRBL: u16 = 0;
pub(super) const GRBLHAL: u16 = 8;
pub(super) const LINUXCNC: u16 = 11;
pub(super) const NIST: u16 = 37;
pub(super) const RS274: u16 = 50;

/// How many there are.
pub(crate) const COUNT: u16 = 218;
