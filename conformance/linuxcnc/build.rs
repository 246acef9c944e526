//! Builds the library that has a controller fork.

use std::path::Path;
use std::{env, fs};

/// The source of the library.
const FORK_SERVER: &str = "src/rs274/fork/server.c";

fn main() {
    println!("cargo::rerun-if-changed={FORK_SERVER}");
    let folder = env::var_os("OUT_DIR").expect("cargo names a folder for what is built");
    let library = Path::new(&folder).join("fork-server.so");
    let for_linux = env::var("CARGO_CFG_TARGET_OS").is_ok_and(|system| system == "linux");
    let built = if for_linux { build(&library) } else { Err("not for Linux".to_owned()) };
    if let Err(why) = built {
        // Without it there is nothing to fork, and every run is a start.
        println!("cargo::warning=rs274 will be slow: no library to fork it ({why})");
        fs::write(&library, "").expect("the folder for what is built can be written");
    }
}

fn build(library: &Path) -> Result<(), String> {
    let compiler = cc::Build::new().warnings(true).extra_warnings(true).try_get_compiler();
    let mut command = compiler.map_err(|error| error.to_string())?.to_command();
    command.args(["-std=gnu11", "-shared", "-fPIC", FORK_SERVER, "-o"]).arg(library);
    match command.status() {
        Ok(status) if status.success() => Ok(()),
        Ok(status) => Err(status.to_string()),
        Err(error) => Err(error.to_string()),
    }
}
