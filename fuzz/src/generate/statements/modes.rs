//! Units, planes, distance modes, feed, work coordinate systems, saved modes.

use super::super::kind::StatementKind;
use super::super::writer::Statement;

pub(in super::super) const STATEMENTS: &[Statement] = &[
    Statement::any("mode.units", StatementKind::Mode, 14, |w| {
        let code = *w.entropy.pick(&["g20", "g21"]);
        w.block(code);
    }),
    Statement::any("mode.plane", StatementKind::Mode, 10, |w| {
        let code = *w.entropy.pick(&["g17", "g18", "g19", "g17.1", "g18.1", "g19.1"]);
        w.block(code);
        w.state.xy_plane = code == "g17";
    }),
    Statement::any("mode.distance", StatementKind::Mode, 14, |w| {
        let code = *w.entropy.pick(&["g90", "g91", "g90.1", "g91.1"]);
        w.block(code);
    }),
    Statement::any("mode.retract", StatementKind::Mode, 4, |w| {
        let code = *w.entropy.pick(&["g98", "g99"]);
        w.block(code);
    }),
    Statement::any("mode.lathe", StatementKind::Mode, 5, |w| {
        let code = *w.entropy.pick(&["g7", "g8"]);
        w.block(code);
    }),
    Statement::any("mode.compensation-off", StatementKind::Mode, 3, |w| w.block("g40")),
    Statement::any("feed.set", StatementKind::Feed, 20, |w| {
        let feed = w.within(1, 3000);
        w.block(format!("f{feed}"));
        w.state.feed = true;
    }),
    Statement::any("feed.mode", StatementKind::Feed, 8, |w| {
        let code = *w.entropy.pick(&["g93", "g94", "g94", "g94", "g95", "g94"]);
        w.block(code);
        w.state.feed &= code == "g94" && w.state.per_minute;
        w.state.per_minute = code == "g94";
    }),
    Statement::any("offset.select", StatementKind::Offset, 14, |w| {
        let code =
            *w.entropy.pick(&["g54", "g55", "g56", "g57", "g58", "g59", "g59.1", "g59.2", "g59.3"]);
        w.block(code);
    }),
    Statement::any("offset.set", StatementKind::Offset, 14, |w| {
        let (system, axes) = (w.whole(0, 9), w.axes(3));
        let rotation =
            if w.entropy.chance(15) { format!(" r{}", w.within(0, 90)) } else { String::new() };
        w.block(format!("g10 l2 p{system}{axes}{rotation}"));
    }),
    Statement::any("offset.parameter", StatementKind::Offset, 3, |w| {
        let place = 5221 + 20 * w.entropy.below(9) + w.entropy.below(6);
        let number = w.number();
        w.block(format!("#{place} = {number}"));
    }),
    Statement::any("saved.save", StatementKind::Saved, 14, |w| {
        w.block("m70");
        w.state.saved = true;
    }),
    Statement::when(
        "saved.restore",
        StatementKind::Saved,
        14,
        |s| s.saved,
        |w| {
            w.block("m72");
            w.state.forget_modes();
            w.state.per_minute = false;
        },
    ),
    Statement::when(
        "saved.invalidate",
        StatementKind::Saved,
        3,
        |s| s.saved,
        |w| {
            w.block("m71");
            w.state.saved = false;
        },
    ),
    Statement::any("saved.around", StatementKind::Saved, 8, |w| {
        w.block("m70");
        w.body(3);
        w.block("m72");
        w.state.forget_modes();
        w.state.per_minute = false;
        w.state.saved = true;
    }),
    Statement::when(
        "saved.autorestore",
        StatementKind::Saved,
        6,
        |s| s.in_sub,
        |w| {
            w.block("m73");
            w.state.saved = true;
        },
    ),
    Statement::any("crowded.m-words", StatementKind::Crowded, 2, |w| {
        // Some controllers have saving in the group of the spindle.
        let saves = w.entropy.chance(50);
        let (first, other) = if saves { ("m70", "m5") } else { ("m5", "m70") };
        let third = if w.entropy.chance(5) { other } else { "m48" };
        let rest = if w.entropy.chance(5) { " m61 q0" } else { "" };
        w.block(format!("{first} m9 {third} m64 p0{rest}"));
        w.state.saved |= saves;
        w.state.turning &= saves;
    }),
    Statement::any("crowded.modes", StatementKind::Crowded, 25, |w| {
        let mut words = Vec::new();
        for group in [
            &["g17", "g18", "g19"][..],
            &["g20", "g21"],
            &["g90", "g91"],
            &["g90.1", "g91.1"],
            &["g61", "g61.1", "g64"],
            &["g54", "g55", "g59.3"],
            &["g98", "g99"],
            &["m3", "m4", "m5"],
            &["m7", "m8", "m9"],
            &["m48", "m49"],
            &["s1000", "s[100 + 50]"],
            &["#31 = 2", "#32 = #31"],
        ] {
            if w.entropy.chance(25) {
                words.push((*w.entropy.pick(group)).to_owned());
            }
        }
        if w.entropy.chance(40) {
            let axes = w.axes(2);
            words.push(format!("g0{axes}"));
            w.moves(true);
        }
        if w.entropy.chance(20) {
            let feed = w.within(1, 500);
            words.push(format!("f{feed}"));
            w.state.feed = w.state.feed || w.state.per_minute;
        }
        // The order of words means nothing.
        for place in 1..words.len() {
            let other = usize::try_from(w.entropy.below(u32::try_from(place + 1).unwrap_or(1)));
            words.swap(place, other.unwrap_or_default());
        }
        w.state.xy_plane = false;
        w.block(words.join(" "));
    }),
];
