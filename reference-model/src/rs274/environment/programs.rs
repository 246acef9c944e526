//! Programs of user-defined M codes, as data: nothing runs.

use gaugeblock_vocabulary::scenario::{Folder, UserProgram};

use super::EnvironmentState;

/// Why there is no program for a user-defined M code.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Missing {
    /// No file has anything to do with the code.
    NoFile,
    /// Its file is not executable.
    NotExecutable,
    /// Its file was not yet there when the controller started.
    AddedLater,
    /// Its file is in no folder that is looked through.
    Elsewhere,
    /// A file has its name with an extension.
    Extension,
    /// A file has its name with a small m.
    LowerCase,
    /// A file has its number in another form, such as `M0101`.
    OtherForm,
}

impl EnvironmentState {
    /// The program of a user-defined M code: the first executable one, in the folder of programs before the search
    /// path.
    ///
    /// # Errors
    /// Why there is none.
    pub(crate) fn user_program(
        &self,
        code: u32,
        with_search_path: bool,
    ) -> Result<&UserProgram, Missing> {
        let files = &self.scenario.user_programs;
        let folders: &[Folder] = if with_search_path {
            &[Folder::ProgramPrefix, Folder::SearchPath]
        } else {
            &[Folder::ProgramPrefix]
        };
        let name = format!("M{code}");
        let mut named: Vec<&UserProgram> = files.iter().filter(|file| file.file == name).collect();
        if named.is_empty() {
            return Err(misnamed(code, files));
        }
        named.retain(|file| folders.contains(&file.folder));
        if named.is_empty() {
            return Err(Missing::Elsewhere);
        }
        named.retain(|file| file.at_start);
        if named.is_empty() {
            return Err(Missing::AddedLater);
        }
        named.retain(|file| file.executable);
        let of_folder =
            |folder: &Folder| named.iter().copied().find(move |file| file.folder == *folder);
        folders.iter().find_map(of_folder).ok_or(Missing::NotExecutable)
    }
}

/// What is wrong with the names of files that a person may have meant for a code.
fn misnamed(code: u32, files: &[UserProgram]) -> Missing {
    let name = format!("M{code}");
    let with_extension = format!("{name}.");
    let any = |fits: &dyn Fn(&str) -> bool| files.iter().any(|file| fits(&file.file));
    let number = |file: &str| file.strip_prefix('M').and_then(|rest| rest.parse::<u32>().ok());
    if any(&|file| file.starts_with(&with_extension)) {
        Missing::Extension
    } else if any(&|file| file == name.to_lowercase()) {
        Missing::LowerCase
    } else if any(&|file| number(file) == Some(code)) {
        Missing::OtherForm
    } else {
        Missing::NoFile
    }
}
