//! How `run`, `compare`, `shrink`, `plan` and `motion check` make a scenario of a program file and of their options.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use clap::Args;
use gaugeblock_adapter::Adapter;
use gaugeblock_suite::{DEFAULT_EDITION, Suite};
use gaugeblock_vocabulary::scenario::Environment;
use gaugeblock_vocabulary::{Language, Options, Program, Scenario};

use super::called_files;
use super::machine_files::{MachineFiles, fit_to};
use super::own_name::TOOLPATH;
use crate::command::controller::{self, named_edition};
use crate::command::user_files;
use crate::documents;
use crate::error::CliError;
use crate::streams::write_error;

/// How programs are run.
#[derive(Debug, Args)]
pub(crate) struct RunSetup {
    /// Edition of the documents [default: the controller's own: linuxcnc-2.9 for rs274 and linuxcnc, grbl-1.1 for grbl,
    /// else linuxcnc-2.8; gpp2 for a program *.gpp, nct-99m for *.nct]
    #[arg(long, value_name = "EDITION")]
    edition: Option<String>,
    /// Set the option of a choice or quirk; may be repeated
    #[arg(long, value_name = "CHOICE=OPTION")]
    option: Vec<String>,
    /// TOML file with machine, environment, operator, budget, options and further files (`gaugeblock schema scenario`)
    #[arg(long, value_name = "FILE")]
    scenario: Option<PathBuf>,
    #[command(flatten)]
    machine_files: MachineFiles,
    /// Skip blocks that begin with a slash
    #[arg(long)]
    block_delete: bool,
}

impl RunSetup {
    /// The scenario of a program file, with the subroutine files of its folder that its calls can reach. The first of
    /// the controllers that has an edition of its own decides which one is the default.
    pub(crate) fn scenario(
        &self,
        suite: &Suite,
        file: &Path,
        controllers: &[&dyn Adapter],
    ) -> Result<Scenario, CliError> {
        let own = controllers.iter().find_map(|controller| named_edition(*controller, suite));
        let by_default = edition_by_name(file).or(own).unwrap_or(DEFAULT_EDITION);
        let edition = documents::edition(suite, self.edition.as_deref().unwrap_or(by_default))?;
        if edition.language != Language::Rs274 && self.edition.is_none() {
            write_error(&format!(
                "note: {}: using edition {} because of the file extension",
                file.display(),
                edition.id
            ));
        }
        let mut scenario = match &self.scenario {
            Some(path) => {
                let hint = "`gaugeblock schema scenario` prints the form";
                user_files::read_form(path, "scenario (--scenario)", hint, Scenario::from_text)?
            }
            None => Scenario::default(),
        };
        self.machine_files.apply(&mut scenario.machine)?;
        scenario.program = Program {
            main: user_files::read_program(file)?,
            language: edition.language,
            files: match edition.language {
                Language::Rs274 => std::mem::take(&mut scenario.program.files),
                Language::Gpp => toolpath(file, &scenario.program)?,
                Language::Nct => BTreeMap::new(),
            },
            block_delete: self.block_delete || scenario.program.block_delete,
            ..scenario.program
        };
        if edition.language == Language::Rs274 {
            let folder = called_files::folder_of(file);
            called_files::add_called_files(&mut scenario.program, folder, &scenario.operator);
        }
        // The command line overrides the scenario, which overrides the controllers, and they the edition.
        let mut named = Vec::new();
        for controller in controllers.iter().rev() {
            controller::declared_options(*controller, suite)?;
            named.extend(assignments(&controller.options()));
        }
        named.extend(assignments(&scenario.options));
        named.extend(self.option.iter().cloned());
        scenario.options = documents::options_with(suite, edition, &named)?;
        if scenario.environment == Environment::default() {
            scenario.environment.name.clone_from(&edition.environment);
        }
        fit_to(scenario, file, controllers)
    }

    /// The files that a program's scenario was read from.
    pub(crate) fn inputs(&self, file: &Path, scenario: &Scenario) -> Vec<PathBuf> {
        let named = [file.to_path_buf(), file.with_extension(TOOLPATH)];
        let called = called_files::paths(&scenario.program, called_files::folder_of(file));
        let machine = self.scenario.clone().into_iter().chain(self.machine_files.paths());
        named.into_iter().chain(machine).chain(called).collect()
    }
}

/// Options in the form of --option.
fn assignments(options: &Options) -> impl Iterator<Item = String> {
    options.0.iter().map(|(id, option)| format!("{id}={option}"))
}

/// The edition that a file's name selects.
fn edition_by_name(file: &Path) -> Option<&'static str> {
    match file.extension()?.to_str()? {
        "gpp" => Some("gpp2"),
        "nct" => Some("nct-99m"),
        _ => None,
    }
}

/// The toolpath next to a post-processor program, or else that of the scenario's file.
fn toolpath(file: &Path, program: &Program) -> Result<BTreeMap<String, String>, CliError> {
    let beside = file.with_extension(TOOLPATH);
    if !beside.exists() {
        return Ok(program.files.clone());
    }
    Ok(BTreeMap::from([(TOOLPATH.to_owned(), user_files::read_text(&beside, "toolpath")?)]))
}
