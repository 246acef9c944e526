//! A control whose answers come on paper, read from the folder of a campaign ([`crate`]).
//!
//! What a sheet leaves empty is masked, and what has no sheet was not run: a claim is as large as what was written
//! down.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

use gaugeblock_adapter::{Adapter, HarnessError, MotionRequest, NoSamples};
use gaugeblock_compare::Capabilities;
use gaugeblock_filesystem::read_regular;
use gaugeblock_vocabulary::motion::Samples;
use gaugeblock_vocabulary::{
    BlockLocation, Bound, Effect, End, Event, Fault, Language, Outcome, Program, Rs274State,
    Scenario, Settings, State, Step,
};
use serde::Deserialize;

use crate::{
    Answer, BLOCKS, Blocks, CONTROL, ExportedProgram, FILE_BYTES_MAX, Manifest, SAMPLES, SHEET,
    Sheet, digest, digest_of_motion, read_blocks, read_file, read_file_if_there,
};

/// What a control says of itself.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Control {
    name: String,
    version: String,
    resolution: f64,
}

/// A program of the campaign, and what was read of its folder.
#[derive(Debug)]
struct Entry {
    exported: ExportedProgram,
    /// The answer, or what is wrong with it, with its place.
    answer: Result<SheetContent, (String, String)>,
}

/// What was written down.
#[derive(Debug)]
enum SheetContent {
    Blank,
    NotPossible(String),
    Answered(Box<Sheet>, Option<Blocks>),
}

/// A campaign's folder.
#[derive(Debug)]
pub struct Offline {
    folder: PathBuf,
    manifest: Manifest,
    entries: BTreeMap<String, Entry>,
    capabilities: Capabilities,
}

impl Offline {
    /// Reads a campaign's folder. A sheet that cannot be read is not judged, and no error.
    ///
    /// # Errors
    /// The folder is not a campaign, or does not name its control.
    pub fn open(folder: &Path) -> Result<Self, String> {
        let manifest = Manifest::read(folder)?;
        let path = folder.join(CONTROL);
        let name = path.display();
        let text = read_file(&path).map_err(|error| format!("{name}: {error}"))?;
        let control: Control = toml::from_str(&text)
            .map_err(|error| format!("{name}: {}", error.to_string().trim()))?;
        if control.name.trim().is_empty() || control.name.chars().any(char::is_control) {
            return Err(format!("{name}: `name` is empty or has a control character"));
        }
        let mut capabilities = no_observables(&control);
        capabilities.accuracy().check().map_err(|error| format!("{name}: {error}"))?;
        let mut entries = BTreeMap::new();
        for exported in &manifest.programs {
            let entry =
                Entry { exported: exported.clone(), answer: read_content(folder, exported) };
            if let Ok(SheetContent::Answered(sheet, blocks)) = &entry.answer {
                let observables =
                    observables_of_sheet(&no_observables(&control), sheet, blocks.as_ref());
                capabilities.fields.extend(observables.fields);
                capabilities.effects.extend(observables.effects);
                capabilities.final_parameters |= observables.final_parameters;
                capabilities.blocks |= observables.blocks;
                capabilities.faults_have_blocks |= observables.faults_have_blocks;
            }
            entries.insert(exported.scenario.clone(), entry);
        }
        Ok(Self { folder: folder.to_owned(), manifest, entries, capabilities })
    }

    fn entry(&self, scenario: &Scenario) -> Option<&Entry> {
        self.entries.get(&digest(scenario))
    }

    /// Checks that the program in the folder, if it was sent back, is the exported one.
    fn check_unmodified(&self, entry: &Entry, program: &Program) -> Result<(), HarnessError> {
        let mains = std::iter::once((Program::MAIN, &program.main));
        let files = program.files.iter().map(|(name, text)| (name.as_str(), text));
        for (name, text) in mains.chain(files) {
            let place = format!("{}/{name}", entry.exported.folder);
            let found = match read_regular(&self.folder.join(&place), FILE_BYTES_MAX) {
                Ok(found) => found,
                Err(error) if error.kind() == std::io::ErrorKind::NotFound => continue,
                Err(error) => {
                    return Err(HarnessError::Unreadable { what: place, line: error.to_string() });
                }
            };
            let plain = |bytes: &[u8]| String::from_utf8_lossy(bytes).replace("\r\n", "\n");
            if plain(&found) != plain(text.as_bytes()) {
                return Err(HarnessError::Unreadable {
                    what: place,
                    line: "the program has changed since the export".to_owned(),
                });
            }
        }
        Ok(())
    }
}

impl Adapter for Offline {
    fn capabilities(&self) -> &Capabilities {
        &self.capabilities
    }

    fn observables(&self, scenario: &Scenario) -> Capabilities {
        let plain = Capabilities { blocks: false, ..self.capabilities.clone() };
        match self.entry(scenario).map(|entry| &entry.answer) {
            Some(Ok(SheetContent::Answered(sheet, blocks))) => {
                observables_of_sheet(&plain, sheet, blocks.as_ref())
            }
            _ => plain,
        }
    }

    fn observables_vary(&self) -> bool {
        true
    }

    fn pending(&self, scenario: &Scenario) -> Option<String> {
        let entry = self.entry(scenario)?;
        matches!(entry.answer, Ok(SheetContent::Blank))
            .then(|| format!("{}/{SHEET} is not filled in", entry.exported.folder))
    }

    fn supports(&self, scenario: &Scenario) -> Result<(), String> {
        match self.entry(scenario).map(|entry| &entry.answer) {
            None => Err("it is not among the exported programs".to_owned()),
            Some(Ok(SheetContent::NotPossible(why))) => Err(why.clone()),
            Some(Ok(SheetContent::Blank | SheetContent::Answered(..)) | Err(_)) => Ok(()),
        }
    }

    fn notes(&self) -> Vec<String> {
        let has_samples = |entry: &Entry| {
            entry.exported.samples
                && self.folder.join(&entry.exported.folder).join(SAMPLES).exists()
        };
        let is_told =
            |entry: &&Entry| !matches!(entry.answer, Ok(SheetContent::Blank)) || has_samples(entry);
        let answered = self.entries.values().filter(is_told).count();
        let left_out: usize = self.manifest.left_out.values().sum();
        vec![format!(
            "{answered} of {} programs have answers; {left_out} cases cannot be run from paper",
            self.entries.len()
        )]
    }

    fn run(&self, scenario: &Scenario) -> Result<Outcome, HarnessError> {
        let Some(entry) = self.entry(scenario) else {
            return Err(HarnessError::NotRun("it is not among the exported programs".to_owned()));
        };
        match &entry.answer {
            Err((place, why)) => {
                Err(HarnessError::Unreadable { what: place.clone(), line: why.clone() })
            }
            Ok(SheetContent::Blank) => Err(HarnessError::NotRun("nothing is filled in".to_owned())),
            Ok(SheetContent::NotPossible(why)) => Err(HarnessError::NotRun(why.clone())),
            Ok(SheetContent::Answered(sheet, blocks)) => {
                self.check_unmodified(entry, &scenario.program)?;
                outcome_of_sheet(sheet, blocks.as_ref())
            }
        }
    }

    fn record_motion(&self, motion: &MotionRequest<'_>) -> Result<Samples, NoSamples> {
        let unsupported = |why: &str| Err(NoSamples::Unsupported(why.to_owned()));
        let failed = |error: HarnessError| Err(NoSamples::Failed(error));
        let unreadable = |what: &str, why: &str| {
            failed(HarnessError::Unreadable { what: what.to_owned(), line: why.to_owned() })
        };
        let is_plain = motion.script.events.is_empty();
        let key = digest_of_motion(motion.scenario, motion.limits);
        let Some(entry) = self.entries.get(&key).filter(|_| is_plain) else {
            return unsupported("it is not among the exported programs");
        };
        match &entry.answer {
            Ok(SheetContent::NotPossible(why)) => return unsupported(why),
            Err((place, why)) => return unreadable(place, why),
            Ok(SheetContent::Blank | SheetContent::Answered(..)) => {}
        }
        let place = format!("{}/{SAMPLES}", entry.exported.folder);
        if let Err(error) = self.check_unmodified(entry, &motion.scenario.program) {
            return failed(error);
        }
        match read_file(&self.folder.join(&place)) {
            Ok(text) => {
                Samples::from_csv(&text).or_else(|error| unreadable(&place, &error.to_string()))
            }
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => {
                failed(HarnessError::Absent(format!("{place} is not there")))
            }
            Err(error) => unreadable(&place, &error.to_string()),
        }
    }

    fn own_edition(&self) -> Option<&str> {
        Some(&self.manifest.edition)
    }

    fn exported_from(&self) -> Option<(&str, &str)> {
        Some((&self.manifest.suite, &self.manifest.edition))
    }
}

/// What was written down of a program.
fn read_content(
    folder: &Path,
    exported: &ExportedProgram,
) -> Result<SheetContent, (String, String)> {
    let read = |file: &str| {
        let place = format!("{}/{file}", exported.folder);
        match read_file_if_there(&folder.join(&place)) {
            Ok(text) => Ok((place, text)),
            Err(error) => Err((place, error.to_string())),
        }
    };
    let (place, text) = read(SHEET)?;
    let answer = Answer::read(&text, exported).map_err(|why| (place.clone(), why))?;
    let (of_blocks, text) = read(BLOCKS)?;
    let blocks = read_blocks(&text, &exported.axes).map_err(|why| (of_blocks.clone(), why))?;
    match answer {
        Answer::Blank if blocks.is_some() => {
            Err((place, "`ended` is empty, but blocks were written down".to_owned()))
        }
        Answer::Blank => Ok(SheetContent::Blank),
        Answer::NotPossible(why) => Ok(SheetContent::NotPossible(why)),
        Answer::Ran(sheet) => Ok(SheetContent::Answered(sheet, blocks)),
    }
}

/// A control of which nothing is known but its name.
fn no_observables(control: &Control) -> Capabilities {
    Capabilities {
        name: control.name.trim().to_owned(),
        version: control.version.trim().to_owned(),
        resolution: control.resolution,
        relative_resolution: 0.0,
        unconverted_lengths: BTreeMap::new(),
        fields: BTreeSet::new(),
        fields_at_effects: BTreeSet::new(),
        reports_all_fields: false,
        effects: BTreeSet::new(),
        moves_in_place: true,
        blocks: false,
        refuses: true,
        faults_have_blocks: false,
        faults_have_kinds: false,
        final_parameters: false,
        hidden_parameters: Vec::new(),
        pins: BTreeSet::new(),
        pin_period: 0.0,
    }
}

/// What a sheet exposes: the fields that are filled in.
fn observables_of_sheet(
    plain: &Capabilities,
    sheet: &Sheet,
    blocks: Option<&Blocks>,
) -> Capabilities {
    let position = sheet.position.is_some() || blocks.is_some();
    let mut fields = sheet.modes.clone();
    fields.extend(position.then(|| "position".to_owned()));
    let effects = sheet.messages.as_ref().map(|_| "message".to_owned()).into_iter().collect();
    let mut hidden = Vec::new();
    let mut next = 0;
    for number in sheet.variables.keys() {
        hidden.extend((next < *number).then(|| next..=number - 1));
        next = number + 1;
    }
    hidden.push(next..=u32::MAX);
    Capabilities {
        fields,
        effects,
        blocks: blocks.is_some(),
        faults_have_blocks: sheet.block.is_some(),
        final_parameters: !sheet.variables.is_empty(),
        hidden_parameters: hidden,
        ..plain.clone()
    }
}

/// What a sheet says, as an outcome.
fn outcome_of_sheet(sheet: &Sheet, blocks: Option<&Blocks>) -> Result<Outcome, HarnessError> {
    let end = match sheet.ended.as_str() {
        "program end" => End::ProgramEnd,
        "percent sign" => End::PercentEnd,
        "alarm" => End::Fault(Fault {
            kind: None,
            block: sheet.block.clone(),
            span: None,
            message: sheet.alarm.clone(),
        }),
        "waiting" => End::Paused,
        "aborted" => End::Aborted,
        "endless" => End::Endless,
        "did not end" => End::BudgetExhausted { bound: Bound::Time },
        _ => {
            return Err(HarnessError::Crashed {
                status: "as its sheet says".to_owned(),
                stderr: sheet.alarm.clone(),
            });
        }
    };
    let mut steps: Vec<Step> = Vec::new();
    for (block, position) in blocks.into_iter().flatten() {
        let state = position.map(|position| {
            State::Rs274(Rs274State { position: Some(position), ..Rs274State::default() })
        });
        steps.push(Step { block: block.clone(), events: Vec::new(), state });
    }
    let mut events = Vec::new();
    if sheet.settings != Settings::default() {
        events.push(Event::Set(sheet.settings.clone().into()));
    }
    for (channel, text) in sheet.messages.iter().flatten() {
        events.push(Event::Do(Effect::Message { channel: *channel, text: text.clone() }));
    }
    let last = sheet.last_state();
    match steps.iter_mut().rev().find(|step| step.state.is_some()) {
        Some(step) => {
            step.events = events;
            if let (Some(state), Some(last)) = (&mut step.state, &last) {
                state.overlay(last);
            }
        }
        // No block is told: this is no line of a program.
        None => steps.push(Step { block: BlockLocation::new("", 0), events, state: last }),
    }
    Ok(Outcome {
        language: Language::Rs274,
        start: Settings::default(),
        steps,
        end,
        parameters: (!sheet.variables.is_empty())
            .then(|| sheet.variables.clone().into_iter().collect()),
        pins: Vec::new(),
        samples: Vec::new(),
    })
}
