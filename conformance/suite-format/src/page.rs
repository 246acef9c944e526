//! A rule page and a choice page as they stand in TOML.

use std::collections::BTreeMap;
use std::num::NonZero;

use gaugeblock_vocabulary::scenario::{
    Budget, Environment, Machine, OperatorEvent, Program, Scenario, Start,
};
use gaugeblock_vocabulary::{DeclaredLanguage, Language};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::motion::MotionCase;

/// Where a document says something.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Source {
    /// Document, such as `linuxcnc-2.8`.
    pub document: String,
    /// Section by its heading.
    pub section: String,
    /// Sentence, list item or table row within the section, from 1.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub ordinal: Option<u32>,
    /// What it says, in our own words, where the place is hard to find.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub says: Option<String>,
}

impl std::fmt::Display for Source {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}, {}", self.document, self.section)?;
        match self.ordinal {
            Some(ordinal) => write!(f, " ({ordinal})"),
            None => Ok(()),
        }
    }
}

/// One line for each section of the sources, with the ordinals of its sentences: `manual, 11.5.5 Arcs (35, 37–41)`.
pub fn sections(sources: &[Source]) -> Vec<String> {
    let mut sections: Vec<(&str, &str, Vec<u32>)> = Vec::new();
    for Source { document, section, ordinal, says: _ } in sources {
        let place = sections.iter().position(|(d, s, _)| d == document && s == section);
        let place = place.unwrap_or_else(|| {
            sections.push((document, section, Vec::new()));
            sections.len() - 1
        });
        sections[place].2.extend(ordinal);
    }
    let line = |(document, section, ordinals): (&str, &str, Vec<u32>)| match ordinals.as_slice() {
        [] => format!("{document}, {section}"),
        ordinals => format!("{document}, {section} ({})", ranges(ordinals)),
    };
    sections.into_iter().map(line).collect()
}

/// Numbers in ascending order, three or more that follow one another as a range.
fn ranges(numbers: &[u32]) -> String {
    let mut numbers = numbers.to_vec();
    numbers.sort_unstable();
    numbers.dedup();
    let runs = numbers.chunk_by(|one, next| one + 1 == *next);
    let texts = runs.flat_map(|run| match run {
        [first, _, .., last] => vec![format!("{first}–{last}")],
        _ => run.iter().map(u32::to_string).collect(),
    });
    texts.collect::<Vec<_>>().join(", ")
}

/// What a rule can say about a block.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum RuleOutcome {
    /// The block is allowed.
    Accepted,
    /// The block is refused.
    Refused,
}

/// A rule and its cases.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Rule {
    /// `<chapter>.<rule>`.
    pub id: String,
    /// The language of its programs.
    #[serde(default = "rs274")]
    pub language: Language,
    /// What it demands, in our own words.
    pub sentence: String,
    /// Which documents demand it.
    pub sources: Vec<Source>,
    /// The outcomes that it can have; none where it is about motion alone.
    #[serde(default)]
    pub outcomes: Vec<RuleOutcome>,
    /// The profile that its page names. It counts for another one where all lineages share it: [`Suite::profile_of`].
    ///
    /// [`Suite::profile_of`]: crate::Suite::profile_of
    pub profile: String,
    /// The choices and quirks on which its cases depend.
    #[serde(default)]
    pub options: Vec<String>,
    /// Editions in which it does not exist, and why.
    #[serde(default)]
    pub void: BTreeMap<String, String>,
    /// Its cases.
    #[serde(rename = "case", default)]
    pub cases: Vec<Case>,
    /// Templates of further cases; they are among the cases once the suite is read.
    #[serde(rename = "grid", default)]
    pub grids: Vec<Grid>,
    /// Its cases of motion.
    #[serde(default)]
    pub motion: Vec<MotionCase>,
}

/// The language of what names none.
fn rs274() -> Language {
    Language::Rs274
}

impl Rule {
    /// The chapter: the part of the id before the point.
    pub fn chapter(&self) -> &str {
        self.id.split('.').next().unwrap_or_default()
    }

    /// Whether an edition has the rule: it is in its language, and not void there.
    pub fn exists_in(&self, edition: &Edition) -> bool {
        self.language == edition.language && !self.void.contains_key(&edition.id)
    }

    /// The names of its cases of both kinds.
    pub fn case_names(&self) -> impl Iterator<Item = &str> {
        let names = self.cases.iter().map(|case| case.name.as_str());
        names.chain(self.motion.iter().map(|case| case.name.as_str()))
    }
}

/// A program and what must be observed of it.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Case {
    /// Its name within the rule.
    pub name: String,
    /// Why it is there, where the name does not say it.
    #[serde(default)]
    pub why: String,
    /// The main program.
    pub program: String,
    /// What must be observed, by hand, from the sentence.
    #[serde(rename = "assert")]
    pub assertions: Vec<String>,
    /// The whole outcome in text form, blessed from the model.
    #[serde(default)]
    pub golden: Option<String>,
    /// Only in these editions; all when empty. Reading the suite applies `needs`.
    #[serde(default)]
    pub editions: Vec<String>,
    /// Only in editions with this option, `choice = option`.
    #[serde(default)]
    pub needs: Option<String>,
    /// The place of the grid that it is from, from 0; none if the page has it as it is.
    #[serde(skip)]
    pub grid: Option<usize>,
    /// Editions whose language has less than its program needs.
    #[serde(skip)]
    pub beyond: Vec<String>,
    /// What else the run depends on.
    #[serde(flatten)]
    pub setup: Setup,
}

/// What a run depends on besides its main program.
#[derive(Clone, Debug, Default, PartialEq, Deserialize)]
#[serde(default)]
pub struct Setup {
    /// Subroutine files.
    pub files: BTreeMap<String, String>,
    /// The machine.
    pub machine: Machine,
    /// How the outside answers.
    pub environment: Environment,
    /// What a person does.
    pub operator: Vec<OperatorEvent>,
    /// When to stop.
    pub budget: Budget,
    /// Whether blocks that begin with a slash are skipped.
    pub block_delete: bool,
    /// Whether the main program is run, or each of its lines entered by hand.
    pub start: Start,
}

impl Case {
    /// Whether an edition has the case, if it has its rule.
    pub fn runs_in(&self, edition: &Edition) -> bool {
        let is_named = self.editions.is_empty() || self.editions.contains(&edition.id);
        is_named && !self.beyond.contains(&edition.id)
    }
}

impl Setup {
    /// The scenario of a main program; options are those of the edition.
    pub fn scenario(&self, program: &str, options: &gaugeblock_vocabulary::Options) -> Scenario {
        Scenario {
            program: Program {
                main: program.to_owned(),
                files: self.files.clone(),
                block_delete: self.block_delete,
                start: self.start,
                ..Program::default()
            },
            options: options.clone(),
            machine: self.machine.clone(),
            environment: self.environment.clone(),
            operator: self.operator.clone(),
            budget: self.budget,
        }
    }
}

/// An item of a list: its texts. Each has the text `name`.
pub type GridItem = BTreeMap<String, String>;

/// The lists that grids of all pages can name, by their names.
pub type GridLists = BTreeMap<String, Vec<GridItem>>;

/// A template of cases.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Grid {
    /// The name of each case.
    pub name: String,
    /// Why they are there.
    #[serde(default)]
    pub why: String,
    /// The lists whose combinations are the cases.
    pub each: BTreeMap<String, GridList>,
    /// Combinations that are left out: the names of the items of some of the lists.
    #[serde(default)]
    pub except: Vec<BTreeMap<String, String>>,
    /// Number of cases that each item must be in; all combinations when absent.
    #[serde(default)]
    pub cover: Option<NonZero<usize>>,
    /// The main program.
    pub program: String,
    /// What must be observed.
    #[serde(rename = "assert")]
    pub assertions: Vec<String>,
    /// Only in these editions; all when empty.
    #[serde(default)]
    pub editions: Vec<String>,
    /// Only in editions with this option. The text `needs` of an item replaces it.
    #[serde(default)]
    pub needs: Option<String>,
    /// What else the runs depend on.
    #[serde(flatten)]
    pub setup: Setup,
}

/// A list of a grid.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(untagged)]
pub enum GridList {
    /// A list of the suite's file `lists.toml`.
    Named(String),
    /// Its own items.
    Items(Vec<GridItem>),
}

/// Whether documents differ, or a controller departs from its own.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum ChoiceKind {
    /// Documents differ or leave it open.
    Choice,
    /// A controller departs from its own document.
    Quirk,
}

/// A named point where documents differ or leave open, or where a controller departs from its own.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Choice {
    /// Its id.
    pub id: String,
    /// Choice or quirk.
    pub kind: ChoiceKind,
    /// The language of its program.
    #[serde(default = "rs274")]
    pub language: Language,
    /// What is chosen.
    pub sentence: String,
    /// Where the documents differ or are silent.
    pub sources: Vec<Source>,
    /// A program that tells the options apart.
    pub program: String,
    /// Documents among its sources that decide it, although they do so in the same way in all editions that have them.
    #[serde(default)]
    pub decided_by: Vec<String>,
    /// Options of other choices under which alone it does.
    #[serde(default)]
    pub under: BTreeMap<String, String>,
    /// The options; the first is the default.
    #[serde(rename = "option")]
    pub options: Vec<ChoiceOption>,
    /// What else the run depends on.
    #[serde(flatten)]
    pub setup: Setup,
}

/// One way to read the documents.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ChoiceOption {
    /// Its name.
    pub name: String,
    /// What it means.
    pub means: String,
    /// What must be observed of the program under it.
    #[serde(rename = "assert")]
    pub assertions: Vec<String>,
}

/// A named point of motion that the documents leave open, and samples of which the laws say something else under each
/// option.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MotionChoice {
    /// Its id.
    pub id: String,
    /// What is chosen.
    pub sentence: String,
    /// Where the documents differ or are silent.
    pub sources: Vec<Source>,
    /// Samples that tell the options apart.
    pub motion: MotionCase,
    /// The options; the first is the default.
    #[serde(rename = "option")]
    pub options: Vec<MotionChoiceOption>,
}

/// One way to read the documents.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MotionChoiceOption {
    /// Its name.
    pub name: String,
    /// What it means.
    pub means: String,
    /// What the laws decide about the samples under it.
    #[serde(rename = "assert")]
    pub assertions: Vec<String>,
}

/// A set of documents with an option for each choice.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Edition {
    /// Its id.
    pub id: String,
    /// What it is.
    pub sentence: String,
    /// The language that its documents are about.
    #[serde(default = "rs274")]
    pub language: Language,
    /// Its documents, its own first.
    pub documents: Vec<String>,
    /// The edition whose options it takes over.
    #[serde(default)]
    pub base: Option<String>,
    /// Named environment that it is run on.
    #[serde(default)]
    pub environment: Option<String>,
    /// Options that differ from its base's.
    #[serde(default)]
    pub options: BTreeMap<String, String>,
    /// Whether a rule exists only if one of its sources is in one of the documents; so too if its base says so.
    #[serde(default)]
    pub documented_only: bool,
    /// The part of the language that its documents have, or else its base's; no case needs more.
    #[serde(default)]
    pub has: Option<DeclaredLanguage>,
}

impl Edition {
    /// Whether one of these sources is in one of its documents.
    pub fn cites(&self, sources: &[Source]) -> bool {
        sources.iter().any(|source| self.documents.contains(&source.document))
    }

    /// Those of these sources that are in its documents; all where none is.
    pub fn cited(&self, sources: &[Source]) -> Vec<Source> {
        let cites_any = self.cites(sources);
        let is_cited = |it: &&Source| !cites_any || self.documents.contains(&it.document);
        sources.iter().filter(is_cited).cloned().collect()
    }
}

/// A named and versioned list of rules that a vendor can claim: those whose pages name it, or those that every lineage
/// of controllers shares.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Profile {
    /// Its id.
    pub id: String,
    /// Counts up when the list of a released profile changes; 0 until it is released.
    pub version: u32,
    /// What it comprises.
    pub sentence: String,
    /// An edition of each lineage. Where there are any, the profile has the rules that the documents of each of them
    /// require.
    #[serde(default)]
    pub lineages: Vec<String>,
    /// The profiles from which it takes these rules.
    #[serde(default)]
    pub drawn_from: Vec<String>,
}

#[cfg(test)]
mod tests {
    use super::ranges;

    #[test]
    fn three_or_more_sentences_in_a_row_are_a_range() {
        assert_eq!(ranges(&[35, 37, 38, 40, 39, 41]), "35, 37–41");
        assert_eq!(ranges(&[2, 1, 4]), "1, 2, 4");
    }
}
