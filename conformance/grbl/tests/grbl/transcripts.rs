//! Transcripts, replayed at a pseudo-terminal.

use gaugeblock_adapter::Adapter as _;
use gaugeblock_vocabulary::{End, FaultKind, Indexed, LengthUnit, Position, SpindleTurn, Switch};

use crate::simulator::{Running, Transcript};
use crate::{last, opened, outcome};

#[test]
fn session_with_grbl_is_understood() {
    let transcript = Transcript::new(include_str!("transcripts/grbl-1.1h.txt"));
    let running = Running::at_terminal(transcript);
    let grbl = opened(&running, "");
    assert_eq!(grbl.capabilities().version, "1.1h.20190825");
    let first = outcome(&grbl, "g20 g91 f10 g1 x1\nm3 s1000 m8 t2\nm2\nnot sent\n");
    assert_eq!(first.end, End::ProgramEnd);
    let (settings, _) = last(&first);
    assert_eq!(settings.units, Some(LengthUnit::Inch));
    assert_eq!(settings.feed_rate, Some(10.0));
    assert_eq!(settings.spindle, Some(Indexed::one(0, SpindleTurn::Stopped)));
    let second = outcome(&grbl, "g18\ng1 x1\ng17\n");
    let End::Fault(fault) = second.end else { panic!("{:?}", second.end) };
    assert_eq!(fault.kind, Some(FaultKind::ZeroFeed));
}

#[test]
fn session_with_grblhal_is_understood() {
    let transcript = Transcript::new(include_str!("transcripts/grblhal-1.1f.txt"));
    let running = Running::at_terminal(transcript);
    let grbl = opened(&running, "");
    let fields = &grbl.capabilities().fields;
    assert!(fields.contains("tool_offset") && !fields.contains("g5x_offset"));
    let found = outcome(&grbl, "g43.1 z5\ng0 x[1/0]\nm2\n");
    let (settings, _) = last(&found);
    assert_eq!(settings.tool_length, Some(Switch::On));
    assert_eq!(settings.tool_offset, Some(Position { z: 5.0, ..Position::default() }));
    let End::Fault(fault) = found.end else { panic!("{:?}", found.end) };
    assert_eq!(fault.kind, Some(FaultKind::DivideByZero));
}
