//! Straight probing: G38.2 to G38.5 (11.5.24).

use gaugeblock_vocabulary::{Compensation, Effect, FaultKind};

use crate::canon::{Reply, Sink};
use crate::faults::{PlantedFault, planted};
use crate::parameters::Numbered;
use crate::probe_move::ProbeMove;
use crate::words::Words;

use super::Modal;
use super::coordinates::Coordinates;
use super::letters::{A, B, C};
use super::modes::Modes;
use super::motion_codes::mode_of;
use super::offsets;
use super::refusal::{Refusal, refuse};

impl Modal {
    /// A straight move until the probe changes. Where it did, or else the programmed point, goes into 5061 to 5069,
    /// and into 5070 whether it did.
    pub(super) fn probe<K: Sink>(
        &mut self,
        words: &Words,
        code: u16,
        numbered: &mut Numbered,
        sink: &mut K,
    ) -> Result<(), Refusal> {
        if self.active.now().compensation != Compensation::Off {
            return refuse(FaultKind::CompensationActive, "probing under cutter compensation");
        }
        if !(matches!(code, 384 | 385) && planted(PlantedFault::AwayWithoutFeed)) {
            self.check_feed_rate()?;
        }
        if self.choices.probe_turning {
            self.check_turning()?;
        }
        let end = self.polar_end_point(words)?;
        let linear = end.taking(A | B | C, self.position);
        let still = linear == self.position && planted(PlantedFault::RotaryProbeRefused);
        // Quirk rs274.probe-same-point.
        let anywhere = self.emulates_rs274 && matches!(code, 383 | 385);
        if still || end == self.position && !anywhere {
            return refuse(FaultKind::Probe, "the probe is at the programmed point already");
        }
        self.motion = mode_of(code);
        let effect = Effect::StraightProbe { end: end.position(), contact: None };
        let now = *self.active.now();
        let to_machine = self.active_to_machine();
        let probing = ProbeMove {
            toward: matches!(code, 382 | 383) || planted(PlantedFault::TowardOnly),
            from: now.machine_of(self.position).converted(to_machine),
            to: now.machine_of(end).converted(to_machine),
            modes: now,
            stored_to_active: self.machine_to_active(),
        };
        // Only the sink can see that the probe is in the target state already; it refuses then.
        self.report(words.line, sink);
        let reply = sink.probe(words.line, &effect, &probing);
        match reply {
            Reply::Stop => self.stop_asked = true,
            Reply::Failed(kind) => return refuse(kind, "refused from outside"),
            Reply::Aborted | Reply::ReadOnly => return Err(Refusal::Aborted),
            Reply::Done | Reply::Contact(_) | Reply::Input(_) | Reply::Tool(_) => {}
        }
        let contact = if let Reply::Contact(Some(contact)) = reply { Some(contact) } else { None };
        if contact.is_none()
            && matches!(code, 382 | 384)
            && reply != Reply::Stop
            && !planted(PlantedFault::MissAccepted)
        {
            // The parameters hold the same after an unsuccessful probe, whichever code it is.
            self.position = end;
            offsets::store_probe(numbered, end, false);
            return Err(Refusal::Missed);
        }
        let start = self.position;
        self.position = contact.map_or(end, Into::into);
        let changed = contact.is_some() && !planted(PlantedFault::NoProbeResult);
        let stale = contact.is_none() && planted(PlantedFault::MissKeepsFlag);
        let changed = changed || stale && offsets::probe_succeeded(numbered);
        let kept = contact.is_none() && planted(PlantedFault::MissKeepsPoint);
        let found = if kept { offsets::probed(numbered) } else { self.position };
        let found = if contact.is_some() && planted(PlantedFault::ProbeWithoutLocal) {
            let frame = Modes { g92_offset: Coordinates::default(), ..now };
            frame.program_of(now.machine_of(found))
        } else {
            found
        };
        // The stand-alone program has no probe that it could ask.
        offsets::store_probe(numbered, found, changed && !self.emulates_rs274);
        if self.emulates_rs274 {
            self.position = self.after_probe(start, self.position);
        }
        Ok(())
    }
}
