//! Finds a controller by its name on the command line.

use std::path::Path;

use gaugeblock_adapter::exec::{Exec, Limits};
use gaugeblock_adapter::{Adapter, ControllerError, HarnessError};
use gaugeblock_controllers::{Production, Reference, Restricted};
use gaugeblock_grbl::Grbl;
use gaugeblock_linuxcnc::{LinuxCnc, Rs274};
use gaugeblock_offline::Offline;
use gaugeblock_runner::language::check_program;
use gaugeblock_suite::{Edition, Suite};
use gaugeblock_vocabulary::{Language, Options, Scenario};

use crate::error::CliError;

/// The names of controllers, for the long help.
pub(crate) const NAMES: &str = "The controller:
  reference      the executable specification
  production     the production interpreter of this project
  rs274          LinuxCNC's stand-alone interpreter; rs274:PATH names its binary
  linuxcnc       the whole LinuxCNC controller with a simulated machine
  exec:COMMAND   a controller with an adapter (`gaugeblock adapter --help`)
  tcp:HOST:PORT  a controller whose adapter listens there
  grbl:DEVICE, grbl:HOST:PORT
                 Grbl 1.1 or grblHAL at a serial line or a socket, in check mode; add ?motion=real to move the machine
  offline:DIR    answer sheets of a control (`gaugeblock offline --help`)";

/// The forms of a controller's name.
const FORMS: [&str; 8] = [
    "reference",
    "production",
    "rs274",
    "linuxcnc",
    "exec:COMMAND",
    "tcp:HOST:PORT",
    "grbl:DEVICE",
    "offline:DIR",
];

/// The controller of a name.
pub(crate) fn controller(name: &str) -> Result<Box<dyn Adapter>, CliError> {
    controller_with_limits(name, Limits::default(), Options::default())
}

/// The controller of a name. One in another process gets these limits, and requests without options that have these
/// defaults.
pub(crate) fn controller_with_limits(
    name: &str,
    limits: Limits,
    defaults: Options,
) -> Result<Box<dyn Adapter>, CliError> {
    if let Some(behind) = external_controller(name, limits) {
        return Ok(Box::new(behind?.assume_options(defaults)));
    }
    match name.split_once(':') {
        None if name == "reference" => Ok(Box::new(Reference::default())),
        None if name == "production" => Ok(Box::new(Production::default())),
        None if name == "rs274" => rs274(None),
        Some(("rs274", path)) => rs274(Some(Path::new(path))),
        None if name == "linuxcnc" => Ok(Box::new(linuxcnc()?)),
        Some(("faulty", fault)) => faulty(fault),
        Some(("grbl", place)) => Ok(Box::new(super::grbl::open(place)?)),
        Some(("offline", folder)) => Ok(Box::new(offline(Path::new(folder))?)),
        None if Path::new(name).is_file() => Err(CliError::usage(
            format!("unknown controller `{name}`"),
            format!(
                "to run this file as an adapter write \"exec:./{name}\" or \"exec:python3 {name}\""
            ),
        )),
        _ => Err(CliError::usage(format!("unknown controller `{name}`"), unknown_controller(name))),
    }
}

/// The name that was probably meant, or all forms of a name.
fn unknown_controller(name: &str) -> String {
    let near = FORMS.iter().find(|form| {
        let form = form.split(':').next().unwrap_or_default();
        strsim::damerau_levenshtein(form, name.split(':').next().unwrap_or_default()) <= 2
    });
    match near {
        Some(form) => format!("did you mean `{form}`?"),
        None => format!("expected one of: {}", FORMS.join(", ")),
    }
}

#[cfg(feature = "faulty")]
fn faulty(fault: &str) -> Result<Box<dyn Adapter>, CliError> {
    use gaugeblock_controllers::faulty::{Faulty, named};
    let fault = named(fault).ok_or_else(|| {
        CliError::usage(
            format!("unknown planted fault `{fault}`"),
            "`gaugeblock suite faults` lists them",
        )
    })?;
    match Faulty::new(fault) {
        Some(faulty) => Ok(Box::new(faulty)),
        None => Err(CliError::usage(
            "only one planted fault can be active",
            "compare it with another controller",
        )),
    }
}

#[cfg(not(feature = "faulty"))]
fn faulty(fault: &str) -> Result<Box<dyn Adapter>, CliError> {
    Err(CliError::usage(
        format!("this build has no planted fault `{fault}`"),
        "build with planted faults: cargo build --release --features faulty",
    ))
}

fn rs274(path: Option<&Path>) -> Result<Box<dyn Adapter>, CliError> {
    match Rs274::find(path) {
        Ok(found) => Ok(Box::new(found)),
        Err(error @ ControllerError::Missing { .. }) => Err(CliError::failure(
            error.to_string(),
            "install it (Debian: apt-get install linuxcnc-uspace), or give the path of its binary: rs274:PATH",
        )),
        Err(error @ ControllerError::WrongVersion { .. }) => Err(CliError::failure(
            error.to_string(),
            "this edition documents version 2.9; results of another version would be compared with the wrong manual",
        )),
        Err(error @ ControllerError::Broken(_)) => {
            Err(CliError::failure(error.to_string(), "run it by hand: rs274 -g FILE"))
        }
    }
}

/// A controller in another process, if the name has that form.
pub(crate) fn external_controller(name: &str, limits: Limits) -> Option<Result<Exec, CliError>> {
    match name.split_once(':')? {
        ("exec", command) => Some(exec(command, limits)),
        ("tcp", address) => Some(tcp(address, limits)),
        _ => None,
    }
}

/// What to do about an adapter that does not start or answer.
pub(crate) const START_HINT: &str =
    "run the command by hand, and type a request; `gaugeblock adapter protocol` describes them";

/// A controller that a command starts.
pub(crate) fn exec(command: &str, limits: Limits) -> Result<Exec, CliError> {
    if command.trim().is_empty() {
        return Err(CliError::usage(
            "missing command after `exec:`",
            "for example exec:./my-adapter or \"exec:python3 adapter.py\"",
        ));
    }
    let started = Exec::start(command, limits).map(|exec| exec.check_language_by(check_program));
    started.map_err(|error| {
        if let ControllerError::Broken(HarnessError::TimedOut { seconds }) = error {
            let message = format!("exec:{command}: no answer to `hello` within {seconds} s");
            return CliError::failure(message, START_HINT);
        }
        let error = error.to_string();
        let by_shell = error.rsplit_once("exec: ").filter(|_| error.contains("exit status 127"));
        if let Some((_, why)) = by_shell {
            return CliError::failure(
                format!("exec:{command}: the command cannot be started: {}", why.trim_end()),
                "check the path of the command; `gaugeblock adapter new` writes a template of an adapter",
            );
        }
        CliError::failure(
            format!("exec:{command}: {error}"),
            "`gaugeblock adapter check` finds errors of an adapter; `gaugeblock adapter protocol` prints the protocol",
        )
    })
}

/// A controller whose adapter listens at an address.
fn tcp(address: &str, limits: Limits) -> Result<Exec, CliError> {
    let port = address.rsplit_once(':').and_then(|(_, port)| port.parse::<u16>().ok());
    if port.is_none() {
        return Err(CliError::usage(
            format!("invalid controller `tcp:{address}`: expected tcp:HOST:PORT"),
            "for example tcp:127.0.0.1:4100",
        ));
    }
    let connected =
        Exec::connect(address, limits).map(|exec| exec.check_language_by(check_program));
    connected.map_err(|error| {
        CliError::failure(
            format!("tcp:{address}: {error}"),
            "start the adapter first, for example: gaugeblock serve --controller production --tcp HOST:PORT",
        )
    })
}

/// A control whose answer sheets are in a folder.
fn offline(folder: &Path) -> Result<Offline, CliError> {
    Offline::open(folder).map_err(not_a_campaign)
}

/// LinuxCNC's whole controller.
pub(crate) fn linuxcnc() -> Result<LinuxCnc, CliError> {
    match LinuxCnc::find() {
        Ok(found) => Ok(found),
        Err(error @ ControllerError::Missing { .. }) => Err(CliError::failure(
            error.to_string(),
            "install it (Debian: apt-get install linuxcnc-uspace)",
        )),
        Err(error @ ControllerError::WrongVersion { .. }) => Err(CliError::failure(
            error.to_string(),
            "this edition documents version 2.9; results of another version would be compared with the wrong manual",
        )),
        Err(error @ ControllerError::Broken(_)) => Err(CliError::failure(
            error.to_string(),
            "it needs process, mount, network and IPC namespaces: run as root, or allow user namespaces",
        )),
    }
}

/// A controller that exposes and runs no more than the named one.
pub(crate) fn restricted(
    controller: Box<dyn Adapter>,
    like: &str,
) -> Result<Box<dyn Adapter>, CliError> {
    Ok(Box::new(Restricted::new(controller, self::controller(like)?)))
}

/// Refuses answers that were exported from another suite or edition.
pub(crate) fn check_exported_from(
    controller: &dyn Adapter,
    suite: &Suite,
    edition: &Edition,
) -> Result<(), CliError> {
    let Some((digest, answered)) = controller.exported_from() else { return Ok(()) };
    let name = &controller.capabilities().name;
    if answered != edition.id {
        return Err(CliError::usage(
            format!("{name}: the answers are for edition {answered}, not {}", edition.id),
            "remove --edition, or export again for the other edition",
        ));
    }
    if digest != suite.digest {
        return Err(CliError::usage(
            format!(
                "{name}: the answers were exported from another suite (digest {digest}, this suite {})",
                suite.digest
            ),
            "use the gaugeblock (and --suite) that exported them, or export again",
        ));
    }
    Ok(())
}

/// Refuses an edition that the controller does not accept, before anything runs.
pub(crate) fn check_options(controller: &dyn Adapter, options: &Options) -> Result<(), CliError> {
    controller.accepts_options(options).map_err(|why| {
        let name = &controller.capabilities().name;
        CliError::usage(
            format!("{name} does not support this edition: {why}"),
            "an edition that ends in -observed describes one real controller; choose an edition of documents",
        )
    })
}

/// Refuses options that a controller declares and that are none.
pub(crate) fn declared_options(controller: &dyn Adapter, suite: &Suite) -> Result<(), CliError> {
    let declared = controller.options();
    let unknown = declared.0.iter().find(|(id, option)| {
        let mut choices = suite.choices.iter().filter(|choice| choice.id == **id);
        !choices.any(|choice| choice.options.iter().any(|known| known.name == **option))
    });
    match unknown {
        None => Ok(()),
        Some((id, option)) => Err(CliError::failure(
            format!(
                "{} declares an unknown option `{option}` for choice `{id}`",
                controller.capabilities().name
            ),
            "`gaugeblock choices` lists them",
        )),
    }
}

/// Refuses an edition in another language than the controller's: every program would be unsupported, which certifies
/// nothing.
pub(crate) fn check_language(controller: &dyn Adapter, edition: &Edition) -> Result<(), CliError> {
    if edition.language == Language::Rs274 {
        return Ok(());
    }
    let mut scenario = Scenario::default();
    scenario.program.language = edition.language;
    controller.supports(&scenario).map_err(|why| {
        let name = &controller.capabilities().name;
        CliError::failure(
            format!("unsupported: {name} does not run edition {}: {why}", edition.id),
            "no program was run; `--controller reference` supports this language",
        )
    })
}

/// The default edition of a controller.
pub(crate) fn own_edition<'a>(controller: &'a dyn Adapter, suite: &Suite) -> &'a str {
    named_edition(controller, suite).unwrap_or(gaugeblock_suite::DEFAULT_EDITION)
}

/// The edition that a controller names. Another suite than the built-in one may be without that of the Grbl family.
pub(crate) fn named_edition<'a>(controller: &'a dyn Adapter, suite: &Suite) -> Option<&'a str> {
    let is_there =
        |id: &&str| ![Grbl::EDITION, Grbl::HAL_EDITION].contains(id) || suite.edition(id).is_some();
    controller.own_edition().filter(is_there)
}

/// Refuses a controller that names an observed edition which the suite does not have.
pub(crate) fn check_observed_edition(
    controller: &dyn Adapter,
    suite: &Suite,
) -> Result<(), CliError> {
    controller
        .observed_edition()
        .map_or(Ok(()), |id| crate::documents::any_edition(suite, id).map(|_| ()))
}

/// Refuses a folder that holds no campaign.
pub(crate) fn not_a_campaign(why: String) -> CliError {
    let is_of_control = why.contains(&format!("{}: ", gaugeblock_offline::CONTROL));
    let hint = if is_of_control {
        "complete control.toml: `name`, `version` and `resolution` of the control"
    } else {
        "`gaugeblock offline export` writes such a folder"
    };
    CliError::usage(why, hint)
}
