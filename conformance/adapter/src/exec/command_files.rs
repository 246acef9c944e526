//! The files of a command: what identifies the controller that it starts.

use std::env;
use std::path::{Path, PathBuf};

/// The words of a shell command that name files. Where none does, the program that the search path has for its first
/// word.
pub(super) fn command_files(command: &str) -> Vec<PathBuf> {
    let words =
        command.split_whitespace().map(|word| word.trim_matches(['"', '\'', ';', '&', '|']));
    let words: Vec<&str> = words.filter(|word| !word.is_empty()).collect();
    let named: Vec<PathBuf> =
        words.iter().map(PathBuf::from).filter(|path| path.is_file()).collect();
    if named.is_empty() {
        return words.first().and_then(|word| on_search_path(word)).into_iter().collect();
    }
    named
}

fn on_search_path(program: &str) -> Option<PathBuf> {
    let paths = env::var_os("PATH").unwrap_or_default();
    let is_plain = Path::new(program).components().count() == 1;
    let mut places = env::split_paths(&paths).map(|folder| folder.join(program));
    places.find(|path| is_plain && path.is_file())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_that_are_files_come_before_the_search_path() {
        let own = file!().rsplit('/').next().unwrap();
        let source = format!("src/exec/{own}");
        assert_eq!(command_files(&format!("sh '{source}' --fast")), [PathBuf::from(&source)]);
        let [shell] = command_files("sh -c nothing").try_into().unwrap();
        assert!(shell.is_absolute() && shell.ends_with("sh"), "{}", shell.display());
        assert!(command_files("no-such-program here").is_empty());
        assert!(command_files("").is_empty());
    }
}
