//! What runs elsewhere (the action, workflows, jobs of a cluster, fuzzing in containers) and the pages about it: each
//! is in its form, and calls this command as it can be called.

mod artifacts;
mod shell;

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use yaml_rust2::{Yaml, YamlLoader};

fn root() -> PathBuf {
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    here.ancestors().nth(2).expect("the crate lies two folders below the root").to_owned()
}

fn read(path: &str) -> String {
    std::fs::read_to_string(root().join(path)).unwrap_or_else(|error| panic!("{path}: {error}"))
}

/// Files of a folder by path from the root.
fn files(folder: &str, ending: &str) -> Vec<String> {
    let entries = std::fs::read_dir(root().join(folder)).expect("a folder");
    let names =
        entries.map(|entry| entry.expect("an entry").file_name().to_string_lossy().into_owned());
    let mut files: Vec<_> = names
        .filter(|name| name.ends_with(ending))
        .map(|name| format!("{folder}/{name}"))
        .collect();
    files.sort();
    assert!(!files.is_empty(), "{folder} has no {ending}");
    files
}

/// The blocks of a language on a page.
fn blocks(page: &str, language: &str) -> Vec<String> {
    let fence = format!("\n```{language}\n");
    let begun = page.split(&fence).skip(1);
    begun.map(|block| block.split("```").next().unwrap_or_default().to_owned()).collect()
}

fn pages() -> BTreeMap<String, String> {
    let mut pages = files("docs", ".md");
    pages.extend(["README.md", "conformance/adapter/PROTOCOL.md"].map(str::to_owned));
    pages.into_iter().map(|page| (page.clone(), read(&page))).collect()
}

/// Every text in YAML, by the place where it stands.
fn yaml() -> BTreeMap<String, String> {
    let mut found = BTreeMap::new();
    let mut paths = vec!["action.yml".to_owned()];
    for (folder, ending) in [
        (".github/workflows", ".yml"),
        (".clusterfuzzlite", ".yaml"),
        ("deploy/kubernetes", ".yaml"),
    ] {
        paths.extend(files(folder, ending));
    }
    for path in paths {
        let text = read(&path);
        found.insert(path, text);
    }
    for (page, text) in pages() {
        for (at, block) in blocks(&text, "yaml").into_iter().enumerate() {
            found.insert(format!("{page}, block {}", at + 1), block);
        }
    }
    found
}

fn documents(place: &str, text: &str) -> Vec<Yaml> {
    let documents =
        YamlLoader::load_from_str(text).unwrap_or_else(|error| panic!("{place}: {error}"));
    assert!(documents.iter().all(|document| document.is_hash()), "{place}: nothing is said");
    documents
}

/// The scripts of a document: what stands under `run` and `script`, and the arguments of `bash -c`.
fn scripts(yaml: &Yaml) -> Vec<String> {
    let mut found = Vec::new();
    if let Some(entries) = yaml.as_hash() {
        for (key, value) in entries {
            match (key.as_str(), value.as_str()) {
                (Some("run"), Some(script)) => found.push(script.to_owned()),
                (Some("args" | "script"), None) => {
                    found.extend(
                        value
                            .as_vec()
                            .into_iter()
                            .flatten()
                            .filter_map(Yaml::as_str)
                            .map(str::to_owned),
                    );
                }
                _ => found.extend(scripts(value)),
            }
        }
    }
    found.extend(yaml.as_vec().into_iter().flatten().flat_map(scripts));
    found
}

/// Every script, by the place where it stands.
fn all_scripts() -> Vec<(String, String)> {
    let of_file = |path: &str| (path.to_owned(), read(path));
    let mut all = vec![of_file(".ci/run"), of_file(".clusterfuzzlite/build.sh")];
    // Its function `run` calls us.
    let nightly = read(".ci/nightly").replace("\nrun ", "\ngaugeblock ");
    all.push((".ci/nightly".to_owned(), nightly.replace("  run ", "  gaugeblock ")));
    for (place, text) in yaml() {
        for document in documents(&place, &text) {
            all.extend(scripts(&document).into_iter().map(|script| (place.clone(), script)));
        }
    }
    for (page, text) in pages() {
        all.extend(blocks(&text, "sh").into_iter().map(|script| (page.clone(), script)));
    }
    all
}

fn output(command: &mut Command) -> Output {
    command.output().unwrap_or_else(|error| panic!("{command:?}: {error}"))
}

#[test]
fn every_call_in_a_script_is_one_of_ours() {
    let mut found = 0;
    for (place, script) in all_scripts() {
        for call in shell::calls(&script) {
            let understood = gaugeblock::understands(&call);
            assert_eq!(understood, Ok(()), "{place}: gaugeblock {}", call.join(" "));
            found += 1;
        }
    }
    assert!(found >= 25, "{found} calls");
    let wrong = ["certify", "--no-such-option"].map(str::to_owned);
    assert!(gaugeblock::understands(&wrong).is_err());
}

#[test]
fn every_script_is_one() {
    for (place, script) in all_scripts() {
        let output = output(Command::new("bash").args(["-n", "-c", &script]));
        assert!(output.status.success(), "{place}: {}", String::from_utf8_lossy(&output.stderr));
        assert!(
            !script.contains("${{"),
            "{place}: an expression of GitHub's stands within a script"
        );
    }
}

#[test]
fn repeated_versions_and_numbers_agree() {
    let value = |path: &str, key: &str| {
        let text = read(path);
        let value = text.lines().find_map(|line| line.strip_prefix(key));
        value.expect("a Rust version").trim_matches('"').to_owned()
    };
    let channel = value("rust-toolchain.toml", "channel = ");
    let version = channel.strip_suffix(".0").expect("the first release of a version");
    let oldest = value("Cargo.toml", "rust-version = ");
    let action = read("action.yml");
    assert!(action.contains(&format!("toolchain install {version} ")));
    assert!(action.contains(&format!("cargo +{version} ")));
    for (path, with_oldest) in [
        ("deploy/Dockerfile", 0),
        (".github/workflows/ci.yml", 1),
        (".github/workflows/nightly.yml", 0),
    ] {
        let text = read(path);
        let count = |image: &str| text.matches(image).count();
        assert!(count("rust:") > with_oldest, "{path}");
        assert_eq!(count(&format!("rust:{oldest}-bookworm")), with_oldest, "{path}");
        assert_eq!(
            count("rust:"),
            count(&format!("rust:{version}-bookworm")) + with_oldest,
            "{path}"
        );
    }
    let job = read("deploy/kubernetes/certify-indexed-job.yaml");
    let job = documents("the job", &job);
    let shards = job[0]["data"]["SHARDS"].as_str().expect("SHARDS");
    let spec = &job[2]["spec"];
    assert_eq!(spec["completions"].as_i64(), shards.parse().ok());
    assert_eq!(spec["maxFailedIndexes"].as_i64(), shards.parse().ok());
}

#[test]
fn every_input_of_the_action_is_used_and_documented() {
    let action = read("action.yml");
    let document = documents("action.yml", &action).remove(0);
    let told = read("docs/ci.md");
    let inputs = document["inputs"].as_hash().expect("inputs");
    for (name, input) in inputs {
        let name = name.as_str().expect("a name");
        assert!(input["description"].as_str().is_some_and(|text| text.ends_with('.')), "{name}");
        assert!(action.contains(&format!("inputs.{name}")), "{name} is not used");
        assert!(told.contains(&format!("| `{name}` |")), "{name} is not told in docs/ci.md");
    }
}

/// A folder of its own, anew.
fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("deployment").join(name);
    let _fresh = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).expect("a folder for the test");
    folder
}

/// The step of the action that judges, run as GitHub runs it; its output and its summary.
fn certified(folder: &Path, inputs: &[(&str, &str)]) -> (String, String) {
    let document = documents("action.yml", &read("action.yml")).remove(0);
    let steps = document["runs"]["steps"].as_vec().expect("steps");
    let step = steps.iter().find(|step| step["id"].as_str() == Some("certify")).expect("the step");
    let (said, summary) = (folder.join("output"), folder.join("summary"));
    let mut command = Command::new("bash");
    command
        .args(["--noprofile", "--norc", "-e", "-o", "pipefail", "-c"])
        .arg(step["run"].as_str().expect("a script"))
        .current_dir(folder)
        .env("GITHUB_OUTPUT", &said)
        .env("GITHUB_STEP_SUMMARY", &summary);
    for name in step["env"].as_hash().expect("an environment").keys() {
        command.env(name.as_str().expect("a name"), "");
    }
    command.env("GAUGEBLOCK", env!("CARGO_BIN_EXE_gaugeblock")).env("SHARD", "1/1");
    command.env("TIME_LIMIT", "10").env("REPORT", "report").envs(inputs.iter().copied());
    let output = output(&mut command);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let read = |path| std::fs::read_to_string(path).unwrap_or_default();
    (read(said), read(summary))
}

#[test]
fn action_judges_and_reports() {
    let folder = folder("action");
    let only = ("ONLY", "saved-state.feed\n saved-state.units");
    let (said, summary) =
        certified(&folder, &[("CONTROLLER", "production"), ("EDITION", "linuxcnc-2.9"), only]);
    assert_eq!(said, "status=0\n");
    assert!(summary.contains("It does what the documents say"), "{summary}");
    let template =
        std::fs::read_to_string(root().join("conformance/adapter/templates/template.py"))
            .expect("it");
    std::fs::write(folder.join("adapter.py"), template).expect("a file");
    // A baseline that is not there yet is none; one that is there makes old divergences pass.
    let controller = ("CONTROLLER", "exec:python3 adapter.py");
    let only = ("ONLY", "modal-groups.repeated-letter");
    let baseline = ("BASELINE", "kept/report.json");
    let (said, summary) = certified(&folder, &[controller, only, baseline]);
    assert!(said.ends_with("status=1\n"), "{said}");
    assert!(summary.contains("It diverges from its documents."), "{summary}");
    std::fs::rename(folder.join("report"), folder.join("kept")).expect("a folder");
    let (said, summary) = certified(&folder, &[controller, only, baseline]);
    assert!(said.ends_with("status=0\n"), "{said}");
    assert!(summary.contains("0 new, 0 changed"), "{summary}");
    let (said, _) = certified(&folder, &[("CONTROLLER", "no; such * $(thing)")]);
    assert!(said.ends_with("status=2\n"), "{said}");
}

#[test]
fn every_target_is_built_for_fuzzing_elsewhere() {
    let build = read(".clusterfuzzlite/build.sh");
    assert!(build.contains("fuzz/targets/fuzz_targets/*.rs"));
    for source in files("fuzz/targets/fuzz_targets", ".rs") {
        let name = Path::new(&source).file_stem().expect("a name").to_string_lossy().into_owned();
        let corpus = root().join("fuzz/targets/corpus").join(&name);
        assert!(corpus.is_dir(), "{name} has no corpus");
    }
}
