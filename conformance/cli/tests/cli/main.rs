//! Tests that run the command `gaugeblock`.

mod ahead;
mod behind;
mod command;
mod command_line;
mod deployment;
mod fuzz;
mod known_issues;
mod linuxcnc;
mod motion;
mod not_a_report;
mod offers;
mod offline;
mod printed;
mod protocol;
mod recorded;
mod report;
mod rs274;
mod rs274_door;
mod shards;
mod template;
mod told;
mod tutorial;
