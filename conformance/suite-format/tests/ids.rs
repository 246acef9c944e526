//! The ids that the model's compiler knows are those of the pages.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use gaugeblock_suite::Suite;
use gaugeblock_suite::files::of_folder;
use gaugeblock_suite::ids::{FOLDERS, differing};

#[test]
fn the_model_has_the_ids_of_the_pages() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let suite = Suite::read(&of_folder(&root.join("../suite")).expect("the folder of the suite"))
        .unwrap_or_else(|errors| panic!("{}", errors.join("\n")));
    let folder = root.join("../../reference-model/src");
    let mut found = BTreeMap::new();
    for ids in FOLDERS {
        for file in fs::read_dir(folder.join(ids)).expect("the folder of ids") {
            let path = file.expect("a file of the folder").path();
            let name = path.file_name().expect("a file has a name").to_string_lossy();
            let text = fs::read_to_string(&path).expect("a file of text");
            found.insert(format!("{ids}/{name}"), text);
        }
    }
    let differing = differing(&suite, &found);
    let hint = "`cargo run -p gaugeblock-suite --bin model-ids` writes them";
    assert!(differing.is_empty(), "{hint}: {}", differing.join(", "));
}
