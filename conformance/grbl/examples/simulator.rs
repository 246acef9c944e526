//! Simulates a controller at a pseudo-terminal and prints the name of it, to try the adapter without a machine.
#![expect(clippy::print_stdout, reason = "the name of the device is its output")]

#[path = "../tests/grbl/simulator/mod.rs"]
#[expect(dead_code, unused_imports, reason = "tests use the rest")]
mod simulator;

use simulator::{Controller, Member, Running};

fn main() {
    let running = Running::at_terminal(Controller::new(Member::Grbl));
    println!("grbl:{}", running.address);
    // It runs until the process is ended.
    loop {
        std::thread::park();
    }
}
