//! A controller by the name that a person writes.

use std::path::Path;

use gaugeblock_adapter::exec::{Exec, Limits};
use gaugeblock_adapter::{Adapter, ControllerError};
use gaugeblock_controllers::Narrowed;
use gaugeblock_controllers::Production;
use gaugeblock_controllers::Reference;
use gaugeblock_linuxcnc::LinuxCnc;
use gaugeblock_linuxcnc::Rs274;
use gaugeblock_offline::Offline;
use gaugeblock_suite::{Edition, Suite};
use gaugeblock_vocabulary::{Language, Options, Scenario};

use super::Refused;

/// The names, as the help tells them.
pub(super) const NAMES: &str = "reference: the specification itself; production: the interpreter of this project for embedding; rs274: LinuxCNC's stand-alone interpreter, or rs274:PATH for its binary; linuxcnc: LinuxCNC's whole controller with a simulated machine; exec:COMMAND: any controller behind an adapter (`gaugeblock adapter --help`); tcp:HOST:PORT: one whose adapter listens there; offline:DIR: a control that was asked on paper (`gaugeblock suite --help`)";

/// The controller of a name.
pub(super) fn controller(name: &str) -> Result<Box<dyn Adapter>, Refused> {
    controller_within(name, Limits::default(), Options::default())
}

/// The controller of a name; where it is behind an adapter, within these limits, and told no options that have these
/// defaults.
pub(super) fn controller_within(
    name: &str,
    limits: Limits,
    defaults: Options,
) -> Result<Box<dyn Adapter>, Refused> {
    if let Some(behind) = behind(name, limits) {
        return Ok(Box::new(behind?.assuming(defaults)));
    }
    match name.split_once(':') {
        None if name == "reference" => Ok(Box::new(Reference::default())),
        None if name == "production" => Ok(Box::new(Production::default())),
        None if name == "rs274" => rs274(None),
        Some(("rs274", path)) => rs274(Some(Path::new(path))),
        None if name == "linuxcnc" => Ok(Box::new(linuxcnc()?)),
        Some(("faulty", fault)) => faulty(fault),
        Some(("offline", folder)) => Ok(Box::new(offline(Path::new(folder))?)),
        None if Path::new(name).is_file() => Err(Refused::wrong(
            format!("there is no controller `{name}`, but a file"),
            format!(
                "an adapter is named by the command that starts it, as in \"exec:./{name}\" or \"exec:python3 {name}\""
            ),
        )),
        _ => Err(Refused::wrong(
            format!("there is no controller `{name}`"),
            format!("one of {NAMES}"),
        )),
    }
}

#[cfg(feature = "faulty")]
fn faulty(fault: &str) -> Result<Box<dyn Adapter>, Refused> {
    use gaugeblock_controllers::faulty::{Faulty, named};
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

/// A controller behind an adapter, where this names one.
pub(super) fn behind(name: &str, limits: Limits) -> Option<Result<Exec, Refused>> {
    match name.split_once(':')? {
        ("exec", command) => Some(exec(command, limits)),
        ("tcp", address) => Some(tcp(address, limits)),
        _ => None,
    }
}

/// A controller behind a command.
pub(super) fn exec(command: &str, limits: Limits) -> Result<Exec, Refused> {
    if command.trim().is_empty() {
        return Err(Refused::wrong(
            "`exec:` names no command",
            "as in exec:./my-adapter, or \"exec:python3 adapter.py\"",
        ));
    }
    Exec::start(command, limits).map_err(|error| {
        Refused::unfinished(
            format!("exec:{command}: {error}"),
            "`gaugeblock adapter vocabulary` lists the words of a declaration, `gaugeblock adapter protocol` tells the rest",
        )
    })
}

/// A controller whose adapter listens at an address.
fn tcp(address: &str, limits: Limits) -> Result<Exec, Refused> {
    let port = address.rsplit_once(':').and_then(|(_, port)| port.parse::<u16>().ok());
    if port.is_none() {
        return Err(Refused::wrong(
            format!("`tcp:{address}` names no host and port"),
            "as in tcp:127.0.0.1:4100",
        ));
    }
    Exec::connect(address, limits).map_err(|error| {
        Refused::unfinished(
            format!("tcp:{address}: {error}"),
            "start the adapter there first; one of ours: gaugeblock serve production --tcp HOST:PORT",
        )
    })
}

/// A control that was asked on paper.
fn offline(folder: &Path) -> Result<Offline, Refused> {
    Offline::open(folder).map_err(super::suite::not_a_campaign)
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

/// A controller that shows no more than the named one, and runs no more than that one can.
pub(super) fn narrowed(
    controller: Box<dyn Adapter>,
    like: &str,
) -> Result<Box<dyn Adapter>, Refused> {
    Ok(Box::new(Narrowed::new(controller, self::controller(like)?)))
}

/// Refuses what was asked by another suite or edition than the one that it would be held to.
pub(super) fn belongs(
    controller: &dyn Adapter,
    suite: &Suite,
    edition: &Edition,
) -> Result<(), Refused> {
    let Some((digest, asked)) = controller.belongs_to() else { return Ok(()) };
    let name = &controller.capabilities().name;
    if asked != edition.id {
        return Err(Refused::wrong(
            format!("{name} was asked by {asked}, and cannot be held to {}", edition.id),
            "leave --edition out, or export again for the other edition",
        ));
    }
    if digest != suite.digest {
        return Err(Refused::wrong(
            format!(
                "{name} was asked by another suite than this one: digest {digest}, not {}",
                suite.digest
            ),
            "judge it with the gaugeblock that exported it (and its --suite), or export again",
        ));
    }
    Ok(())
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

/// Refuses options that a controller declares and that are none.
pub(super) fn declared_options(controller: &dyn Adapter, suite: &Suite) -> Result<(), Refused> {
    let declared = controller.options();
    let unknown = declared.0.iter().find(|(id, option)| {
        let mut choices = suite.choices.iter().filter(|choice| choice.id == **id);
        !choices.any(|choice| choice.options.iter().any(|known| known.name == **option))
    });
    match unknown {
        None => Ok(()),
        Some((id, option)) => Err(Refused::unfinished(
            format!(
                "{} declares an option that there is not: {id} = {option}",
                controller.capabilities().name
            ),
            "`gaugeblock rules --choices` lists them",
        )),
    }
}

/// Refuses an edition in another language than the controller's: of such programs each would be unsupported, which is
/// no certificate.
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
pub(super) fn own_edition(controller: &dyn Adapter) -> &str {
    controller.own_edition().unwrap_or(gaugeblock_suite::DEFAULT_EDITION)
}

/// Refuses a controller whose departures are said to be those of an edition that the suite does not have.
pub(super) fn observed(controller: &dyn Adapter, suite: &Suite) -> Result<(), Refused> {
    controller.observed_edition().map_or(Ok(()), |id| super::edition(suite, id).map(|_| ()))
}
