//! Writes the ids of the suite's pages into the reference model: `cargo run -p gaugeblock-suite --bin model-ids`.

use std::fs;
use std::path::{Path, PathBuf};

use gaugeblock_suite::Suite;
use gaugeblock_suite::files::of_folder;
use gaugeblock_suite::ids::{FOLDERS, model_ids};

fn main() -> Result<(), String> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let suite = of_folder(&root.join("../suite"))?;
    let suite = Suite::read(&suite).map_err(|errors| errors.join("\n"))?;
    let folder = root.join("../../reference-model/src");
    for ids in FOLDERS {
        let ids = folder.join(ids);
        if ids.exists() {
            fs::remove_dir_all(&ids).map_err(of(&ids))?;
        }
        fs::create_dir_all(&ids).map_err(of(&ids))?;
    }
    for (path, text) in model_ids(&suite) {
        let path = folder.join(path);
        fs::write(&path, text).map_err(of(&path))?;
    }
    Ok(())
}

/// What could not be done with a path.
fn of(path: &Path) -> impl Fn(std::io::Error) -> String {
    let path: PathBuf = path.to_owned();
    move |error| format!("{}: {error}", path.display())
}
