//! Tests that run the command `gaugeblock`.

mod any_answer;
mod by_protocol;
mod command;
mod command_line;
mod deployment;
mod explain;
mod extensions;
mod fuzz;
mod known_issues;
mod language;
mod linuxcnc;
mod motion;
mod not_a_report;
mod offline;
mod prefetch;
mod printed;
mod programs;
mod protocol;
mod recorded;
mod report;
mod rs274;
mod rs274_by_protocol;
mod scenario_encoding;
mod shards;
mod template;
mod tutorial;
