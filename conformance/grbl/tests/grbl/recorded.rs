//! Sessions with the real firmware, replayed: the adapter still makes the same of them, and the model agrees.

use std::env;
use std::path::Path;

use gaugeblock_adapter::Adapter as _;
use gaugeblock_compare::compare;
use gaugeblock_compare::observe::Observed;
use gaugeblock_grbl::Grbl;
use gaugeblock_suite::Suite;
use gaugeblock_vocabulary::Scenario;

use crate::simulator::{Running, Transcript};
use crate::{opened, opened_at};

/// Programs that both firmwares run, each with another part of what the adapter reads.
const PROGRAMS: [&str; 14] = [
    "g20 g91 f10 g1 x1\nm3 s1000 m8\ng90 g21\nm2\n",
    "g18\ng1 x1\ng17\n",
    "g10 l2 p2 x1 y-2.5 z0.125\ng55\ng54\nm30\n",
    "g92 x3\ng92.1 x1\nm2\n",
    "g10 l20 p1 x7.5\ng10 l2 p6 y0.0001\ng59\nm2\n",
    "g43.1 z5\ng49\nm2\n",
    "f100 g2 x2 i1\ng3 x0 r1\nm2\n",
    "f100 g2 x5 i1\nm2\n",
    "g0 x1 g1 x2\nm2\n",
    "g93 g1 x1 f2\nx2\nm2\n",
    "m3 s500\nm4 s600\nm5\nm9\nm2\n",
    "t0.5\nn10000000 g4 p0\nm2\n",
    "x\nm2\n",
    "g80\nx1\nm2\n",
];

/// Runs the programs and compares each outcome with the model's. With a device in this variable of the environment the
/// session is recorded there first, and its transcript is written over.
fn check(name: &str, variable: &str, edition: &str) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/grbl/transcripts").join(name);
    if let Some(device) = env::var_os(variable) {
        let device = device.to_str().expect("a device");
        let options = format!("eeprom=restore&transcript={}", path.display());
        agrees(&opened_at(device, &options), edition);
    }
    let text = std::fs::read_to_string(&path).expect("a transcript");
    let running = Running::at_terminal(Transcript::new(&text));
    agrees(&opened(&running, "eeprom=restore"), edition);
}

fn agrees(grbl: &Grbl, edition: &str) {
    let suite = Suite::read(&gaugeblock_embedded_suite::files().expect("the suite")).expect("it");
    let options = suite.options(suite.edition(edition).expect("an edition"));
    for program in PROGRAMS {
        let scenario = Scenario { options: options.clone(), ..Scenario::of(program) };
        let found = grbl.run(&scenario).unwrap_or_else(|error| panic!("{program}: {error}"));
        let (expected, _) = gaugeblock_reference::run(&scenario);
        let observables = grbl.observables(&scenario);
        let (expected, found) = (Observed::of(&expected), Observed::of(&found));
        let comparison = compare(&expected, &found, &observables);
        assert!(comparison.is_equal(), "{program}: {:?}", comparison.divergence);
    }
}

#[test]
fn session_with_grbl_1_1h() {
    check("grbl-1.1h.recorded.txt", "GAUGEBLOCK_GRBL", Grbl::OBSERVED);
}

#[test]
fn session_with_grblhal() {
    check("grblhal.recorded.txt", "GAUGEBLOCK_GRBLHAL", Grbl::HAL_OBSERVED);
}
