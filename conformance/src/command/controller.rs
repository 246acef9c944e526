//! A controller by the name that a person writes.

use std::path::Path;

use gaugeblock_trace::{Language, Options, Scenario};

use super::Refused;
use crate::adapters::linuxcnc::LinuxCnc;
use crate::adapters::production::Production;
use crate::adapters::reference::Reference;
use crate::adapters::rs274::Rs274;
use crate::adapters::{Adapter, ControllerError};
use crate::suite::Edition;

/// The names, as the help tells them.
pub(super) const NAMES: &str = "reference: the specification itself; production: the interpreter of this project for embedding; rs274: LinuxCNC's stand-alone interpreter, or rs274:PATH for its binary; linuxcnc: LinuxCNC's whole controller with a simulated machine";

/// The controller of a name.
pub(super) fn controller(name: &str) -> Result<Box<dyn Adapter>, Refused> {
    match name.split_once(':') {
        None if name == "reference" => Ok(Box::new(Reference::default())),
        None if name == "production" => Ok(Box::new(Production::default())),
        None if name == "rs274" => rs274(None),
        Some(("rs274", path)) => rs274(Some(Path::new(path))),
        None if name == "linuxcnc" => Ok(Box::new(linuxcnc()?)),
        Some(("faulty", fault)) => faulty(fault),
        _ if name.starts_with("exec:") => Err(Refused::unfinished(
            format!("the controller `{name}` is not there yet"),
            format!("one of {NAMES}"),
        )),
        _ => Err(Refused::wrong(
            format!("there is no controller `{name}`"),
            format!("one of {NAMES}"),
        )),
    }
}

#[cfg(feature = "faulty")]
fn faulty(fault: &str) -> Result<Box<dyn Adapter>, Refused> {
    use crate::adapters::faulty::{Faulty, named};
    let fault = named(fault).ok_or_else(|| {
        Refused::wrong(
            format!("there is no planted fault `{fault}`"),
            "`gaugeblock rules --faults` lists them",
        )
    })?;
    match Faulty::new(fault) {
        Some(faulty) => Ok(Box::new(faulty)),
        None => Err(Refused::wrong(
            "two planted faults at once",
            "compare one of them with another controller",
        )),
    }
}

#[cfg(not(feature = "faulty"))]
fn faulty(fault: &str) -> Result<Box<dyn Adapter>, Refused> {
    Err(Refused::wrong(
        format!("the planted fault `{fault}` is not in this build"),
        "build one that has them: cargo build --release --features faulty",
    ))
}

fn rs274(path: Option<&Path>) -> Result<Box<dyn Adapter>, Refused> {
    match Rs274::find(path) {
        Ok(found) => Ok(Box::new(found)),
        Err(error @ ControllerError::Missing { .. }) => Err(Refused::unfinished(
            error.to_string(),
            "install it (Debian: apt-get install linuxcnc-uspace), or name its binary: rs274:PATH",
        )),
        Err(error @ ControllerError::WrongVersion { .. }) => Err(Refused::unfinished(
            error.to_string(),
            "results of another version would be charged to the wrong documents",
        )),
        Err(error @ ControllerError::Broken(_)) => {
            Err(Refused::unfinished(error.to_string(), "run it by hand: rs274 -g FILE"))
        }
    }
}

/// LinuxCNC's whole controller.
pub(super) fn linuxcnc() -> Result<LinuxCnc, Refused> {
    match LinuxCnc::find() {
        Ok(found) => Ok(found),
        Err(error @ ControllerError::Missing { .. }) => Err(Refused::unfinished(
            error.to_string(),
            "install it (Debian: apt-get install linuxcnc-uspace)",
        )),
        Err(error @ ControllerError::WrongVersion { .. }) => Err(Refused::unfinished(
            error.to_string(),
            "results of another version would be charged to the wrong documents",
        )),
        Err(error @ ControllerError::Broken(_)) => Err(Refused::unfinished(
            error.to_string(),
            "it needs process, mount, network and message spaces: run as root, or where the system lets users have them",
        )),
    }
}

/// Refuses an edition that a controller cannot be held to, before anything runs.
pub(super) fn honours(controller: &dyn Adapter, options: &Options) -> Result<(), Refused> {
    controller.honours(options).map_err(|why| {
        let name = &controller.capabilities().name;
        Refused::wrong(
            format!("{name} cannot be held to this edition: {why}"),
            "an edition of what a real controller does is for that controller; name one of the documents'",
        )
    })
}

/// Refuses an edition in another language than the controller's: of such programs each would be unsupported, which is no certificate.
pub(super) fn speaks(controller: &dyn Adapter, edition: &Edition) -> Result<(), Refused> {
    if edition.language == Language::Rs274 {
        return Ok(());
    }
    let mut scenario = Scenario::default();
    scenario.program.language = edition.language;
    controller.supports(&scenario).map_err(|why| {
        let name = &controller.capabilities().name;
        Refused::unfinished(
            format!("unsupported: {name} cannot be held to {}: {why}", edition.id),
            "nothing was run and nothing is certified; `reference` speaks this language",
        )
    })
}

/// The edition that a controller is held to where none is named.
pub(super) fn own_edition(name: &str) -> &'static str {
    if name.starts_with("rs274") || name == "linuxcnc" {
        "linuxcnc-2.9"
    } else {
        crate::suite::DEFAULT_EDITION
    }
}
