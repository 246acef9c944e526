//! Workloads: programs that are measured, written here so that model, production and peers run the same.

mod budgets;
mod long;

use gaugeblock_vocabulary::Scenario;
use gaugeblock_vocabulary::scenario::Budget;

pub use budgets::budgets;
pub use long::{LONG_PROGRAMS, LongProgram, long_program};

/// A program to be measured.
#[derive(Clone, Debug)]
pub struct Workload {
    /// Name in reports.
    pub name: &'static str,
    /// The program, under defaults and a budget that lets it end.
    pub scenario: Scenario,
}

/// All workloads, by what they stress.
pub fn workloads() -> Vec<Workload> {
    let workload = |name, program: &str| {
        let budget = Budget { steps: 1_000_000, effects: 1_000_000, time: 1e9 };
        Workload { name, scenario: Scenario { budget, ..Scenario::of(program) } }
    };
    vec![
        workload("loop", LOOP),
        workload("call", CALL),
        workload("saved-state", SAVED_STATE),
        workload(
            "feed",
            &format!("g21 g90 f1000\n{}m2\n", "g1 x1.5 y2.5\nx2.5 y1.5\n".repeat(500)),
        ),
    ]
}

const LOOP: &str = "\
g21 g90 f1000
#1 = 0
o100 while [#1 lt 250]
#1 = [#1 + 1]
g1 x[#1 * 0.1] y[sin[#1] * 5]
o100 endwhile
m2
";

const CALL: &str = "\
o100 sub
#2 = [#1 + 1]
o100 endsub [#2]
#10 = 0
o101 repeat [200]
o100 call [#10]
#10 = #<_value>
o101 endrepeat
m2
";

const SAVED_STATE: &str = "\
g21 g90 f1000
o100 sub
m73
g20 g91 f5 s300
o100 endsub
o101 repeat [200]
o100 call
o101 endrepeat
m2
";
