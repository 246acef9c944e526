//! What a release has: the kit of the wheel, the image's folder and its entry point, the archive that the action takes;
//! and the jobs of other systems on docs/ci.md.

use std::path::Path;
use std::process::Command;

use super::{blocks, documents, folder, output, read, root};

const BINARY: &str = env!("CARGO_BIN_EXE_gaugeblock");

/// An adapter made with the kit of the wheel: it knows M2 and refuses G100.
const KIT_ADAPTER: &str = r#"
from gaugeblock import adapter

DECLARATION = adapter.declaration(
    "kit", "0.1", fields=["motion", "position"], effects=["straight_traverse"], moves_in_place=True)


def run(scenario):
    steps = []
    for line, text in enumerate(scenario["program"]["main"].lower().splitlines(), 1):
        if text == "m2":
            steps.append(adapter.step(line, state={"motion": "feed", "position": {}}))
            return adapter.outcome(steps, adapter.program_end())
        if text.startswith("g100"):
            return adapter.outcome(steps, adapter.fault("no such code", line=line))
        raise adapter.Unsupported(text)
    raise adapter.Unsupported("a program without M2")


adapter.serve(DECLARATION, run)
"#;

/// Runs a command in a folder; its standard output.
fn printed(folder: &Path, command: &mut Command) -> String {
    let output = output(command.current_dir(folder));
    let (stdout, stderr) =
        (String::from_utf8_lossy(&output.stdout), String::from_utf8_lossy(&output.stderr));
    assert!(output.status.success(), "{command:?}\n{stdout}\n{stderr}");
    stdout.into_owned()
}

fn bash(folder: &Path, script: &str) -> Command {
    let mut command = Command::new("bash");
    command.args(["--noprofile", "--norc", "-e", "-o", "pipefail", "-c", script]);
    command.current_dir(folder);
    command
}

#[test]
fn adapter_of_the_kit_in_the_wheel_speaks_the_protocol() {
    let folder = folder("kit");
    std::fs::write(folder.join("mill.py"), KIT_ADAPTER).expect("a file");
    let kit = root().join("deploy/wheel/python");
    let said = printed(
        &folder,
        Command::new(BINARY)
            .args(["certify", "--only", "modal-groups", "--controller", "exec:python3 mill.py"])
            .args(["--edition", "linuxcnc-2.9"])
            .env("PYTHONPATH", &kit),
    );
    assert!(said.contains(" 0 diverge"), "{said}");
    assert!(!said.contains(" 0 pass"), "{said}");
    // The adapter on the page of the wheel is complete, too.
    let page = read("deploy/wheel/README.md");
    let adapter = blocks(&page, "python").concat();
    std::fs::write(folder.join("page.py"), adapter).expect("a file");
    let check = output(
        Command::new(BINARY)
            .args(["run", "page.ngc", "--controller", "exec:python3 page.py"])
            .current_dir(&folder)
            .env("PYTHONPATH", &kit),
    );
    assert_eq!(check.status.code(), Some(2), "page.ngc is missing: {check:?}");
    std::fs::write(folder.join("page.ngc"), "g0 x1\nm2\n").expect("a file");
    let run = output(
        Command::new(BINARY)
            .args(["run", "page.ngc", "--controller", "exec:python3 page.py"])
            .current_dir(&folder)
            .env("PYTHONPATH", &kit),
    );
    let said = [run.stdout, run.stderr].concat();
    assert!(String::from_utf8_lossy(&said).contains("line 1: g0 x1"), "{:?}", run.status);
}

/// A folder as `.ci/release` makes it, with the command under test; its archive's name without `.tar.gz`.
fn release(folder: &Path) -> String {
    let machine = printed(folder, &mut bash(folder, "uname -m"));
    let name = format!("gaugeblock-0.0.0-{}-unknown-linux-musl", machine.trim());
    let script = format!(
        "mkdir -p dist/{name}; cp {BINARY} dist/{name}/gaugeblock; cd dist; \
         tar --create --gzip --file {name}.tar.gz {name}; sha256sum {name}.tar.gz > {name}.tar.gz.sha256"
    );
    printed(folder, &mut bash(folder, &script));
    name
}

#[test]
fn image_runs_the_command_or_a_program_of_the_image() {
    let folder = folder("image");
    release(&folder);
    let context = root().join("deploy/image-context");
    printed(&folder, Command::new(&context).args(["dist", "context"]));
    let dockerfile = std::fs::read_to_string(folder.join("context/Dockerfile")).expect("it");
    assert!(dockerfile.contains("USER 65532"), "the image's user is root");
    let processors = [("x86_64", "amd64"), ("aarch64", "arm64")];
    let here = processors.iter().find(|(name, _)| *name == std::env::consts::ARCH).expect("one").1;
    let entrypoint = |arguments: &[&str]| {
        let path = std::env::var("PATH").unwrap_or_default();
        let path = format!("{}:{path}", folder.join("context").join(here).display());
        let mut command = Command::new(folder.join("context/entrypoint"));
        printed(&folder, command.args(arguments).env("PATH", path))
    };
    let version = entrypoint(&["--version"]);
    assert!(version.starts_with("gaugeblock "), "{version}");
    assert_eq!(entrypoint(&["gaugeblock", "--version"]), version);
    assert_eq!(entrypoint(&["sh", "-c", "echo a shell"]), "a shell\n");
    // A changed archive makes no image.
    let spoil = "echo more >> dist/*.tar.gz; rm -r context";
    printed(&folder, &mut bash(&folder, spoil));
    assert!(
        !output(Command::new(&context).args(["dist", "context"]).current_dir(&folder))
            .status
            .success()
    );
}

#[test]
fn action_takes_the_archive_of_a_release() {
    let folder = folder("download");
    let name = release(&folder);
    let served = folder.join("server/owner/gaugeblock/releases/download/v0.0.0");
    std::fs::create_dir_all(&served).expect("a folder");
    printed(&folder, &mut bash(&folder, &format!("cp dist/{name}.* {}", served.display())));
    let document = documents("action.yml", &read("action.yml")).remove(0);
    let steps = document["runs"]["steps"].as_vec().expect("steps");
    let is_it = |name: &str| name == "Download gaugeblock";
    let step =
        steps.iter().find(|step| step["name"].as_str().is_some_and(is_it)).expect("the step");
    let mut command = bash(&folder, step["run"].as_str().expect("a script"));
    command
        .env("SERVER", format!("file://{}", folder.join("server").display()))
        .env("REPOSITORY", "owner/gaugeblock")
        .env("VERSION", "0.0.0");
    printed(&folder, &mut command);
    let version = printed(&folder, Command::new("target/release/gaugeblock").arg("--version"));
    assert!(version.starts_with("gaugeblock "), "{version}");
    // An archive that is not the one of the checksum is not unpacked.
    printed(
        &folder,
        &mut bash(&folder, &format!("echo more >> {}/{name}.tar.gz", served.display())),
    );
    assert!(!output(&mut command).status.success());
}

#[test]
fn jobs_of_gitlab_and_jenkins_run_as_the_page_has_them() {
    let page = read("docs/ci.md");
    let gitlab = blocks(&page, "yaml").into_iter().find(|block| block.contains("junit:"));
    let gitlab = documents("docs/ci.md", &gitlab.expect("a job for GitLab")).remove(0);
    let script = gitlab["conformance"]["script"].as_vec().expect("a script");
    let gitlab = script.iter().filter_map(|line| line.as_str()).collect::<Vec<_>>().join("\n");
    let jenkins = blocks(&page, "groovy").concat();
    let jenkins =
        jenkins.lines().find_map(|line| line.trim().strip_prefix("sh '")?.strip_suffix('\''));
    for (name, script) in [("gitlab", gitlab.as_str()), ("jenkins", jenkins.expect("a step"))] {
        let folder = folder(name);
        std::fs::create_dir(folder.join("conformance")).expect("a folder");
        std::fs::write(folder.join("conformance/adapter.py"), KIT_ADAPTER).expect("a file");
        let path = std::env::var("PATH").unwrap_or_default();
        let bin = Path::new(BINARY).parent().expect("a folder").display();
        let mut command = bash(&folder, script);
        command.env("PATH", format!("{bin}:{path}"));
        command.env("PYTHONPATH", root().join("deploy/wheel/python"));
        printed(&folder, &mut command);
        assert!(folder.join("report/junit.xml").is_file(), "{name}: {script}");
    }
}
