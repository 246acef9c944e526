//! The suite of this repository: `conformance/suite`.
//!
//! With debug assertions, as in development and in tests, it is read from the folder at run time, so that editing a
//! page rebuilds nothing. Without them, as in a release, the program contains it.

use gaugeblock_suite::Files;

/// All pages.
///
/// # Errors
/// The folder cannot be read, in a build that reads it.
pub fn files() -> Result<Files, String> {
    source::files()
}

/// The text of one page, by its path within the suite.
///
/// # Errors
/// There is no such page, or it cannot be read.
pub fn page(path: &str) -> Result<String, String> {
    source::page(path)
}

#[cfg(debug_assertions)]
mod source {
    use std::path::Path;

    use gaugeblock_suite::{Files, files::of_folder};

    const FOLDER: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/suite");

    pub(crate) fn files() -> Result<Files, String> {
        of_folder(Path::new(FOLDER))
    }

    pub(crate) fn page(path: &str) -> Result<String, String> {
        let file = Path::new(FOLDER).join(path);
        std::fs::read_to_string(&file).map_err(|error| format!("{}: {error}", file.display()))
    }
}

#[cfg(not(debug_assertions))]
mod source {
    use gaugeblock_suite::Files;
    use include_dir::{Dir, include_dir};

    static SUITE: Dir<'static> = include_dir!("$CARGO_MANIFEST_DIR/suite");

    pub(crate) fn files() -> Result<Files, String> {
        let mut files = Files::new();
        let mut folders = vec![&SUITE];
        while let Some(folder) = folders.pop() {
            folders.extend(folder.dirs());
            for file in folder.files() {
                let name = file.path().to_string_lossy().replace('\\', "/");
                if let (true, Some(text)) = (name.ends_with(".toml"), file.contents_utf8()) {
                    files.insert(name, text.to_owned());
                }
            }
        }
        Ok(files)
    }

    pub(crate) fn page(path: &str) -> Result<String, String> {
        let text = SUITE.get_file(path).and_then(include_dir::File::contents_utf8);
        text.map(str::to_owned).ok_or_else(|| format!("{path}: the suite has no such page"))
    }
}

#[cfg(test)]
mod tests {
    use gaugeblock_suite::Suite;

    use super::*;

    #[test]
    fn the_suite_is_in_its_form_and_each_page_is_found_by_its_path() {
        let files = files().expect("the suite");
        let suite = Suite::read(&files).unwrap_or_else(|errors| panic!("{}", errors.join("\n")));
        assert!(suite.rule("saved-state.feed").is_some());
        let path = &suite.paths["saved-state.feed"];
        assert_eq!(page(path).as_ref(), Ok(&files[path]));
        assert!(page("saved-state/no-such.toml").is_err());
    }
}
