//! The command `gaugeblock`.

use std::process::ExitCode;

use mimalloc::MiMalloc;

/// Generated programs are short: to make and to drop what they leave is a quarter of their cost with the system's
/// allocator.
#[global_allocator]
static ALLOCATOR: MiMalloc = MiMalloc;

fn main() -> ExitCode {
    gaugeblock::main()
}
