//! `gaugeblock rs274`.

pub(super) use crate::rs274::Arguments;

use super::Refused;

/// Runs the program. As in LinuxCNC's `rs274`, an error ends with exit status 1.
pub(super) fn rs274(arguments: &Arguments) -> Result<u8, Refused> {
    let refused = |message| Refused {
        status: 1,
        message,
        hint: Some("`gaugeblock rs274 --help` lists the options".to_owned()),
    };
    let editions = gaugeblock_embedded_suite::page("editions.toml").map_err(refused)?;
    crate::rs274::rs274(arguments, &editions).map_err(refused)
}
