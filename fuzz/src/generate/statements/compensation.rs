//! Cutter compensation, and the moves under it, which end a run as unsupported.

use super::super::kind::StatementKind;
use super::super::state::State;
use super::super::writer::Statement;

pub(in super::super) const STATEMENTS: &[Statement] = &[
    Statement::when("compensation.move", StatementKind::CompensatedMove, 40, State::has_xy, |w| {
        w.block("g17 g90 g94 f100 g40 g0 x-20 y0");
        let code = *w.entropy.pick(&["g41.1 d2", "g42.1 d2", "g41.1 d3.5"]);
        w.block(code);
        w.block("g1 x0 y0");
        w.block("x20");
        w.block("y20");
        w.block("g40");
        w.block("g0 x40 y40");
        w.moves(true);
    }),
    Statement::when(
        "compensation.without-move",
        StatementKind::Compensation,
        13,
        |s| s.io > 0 && s.xy_plane,
        |w| {
            // Without a move in between there is no path to compensate.
            w.block("g17 g40");
            let tools = w.state.tools.clone();
            let of_tool = w.entropy.chance(30) && !tools.is_empty();
            let code = if of_tool {
                format!("{} d{}", w.entropy.pick(&["g41", "g42"]), w.entropy.pick(&tools))
            } else {
                (*w.entropy.pick(&["g41.1 d2", "g42.1 d1"])).to_owned()
            };
            w.block(code);
            let tool = if tools.is_empty() { 0 } else { *w.entropy.pick(&tools) };
            let words = match w.entropy.below(24) {
                0 => "m66 p0".to_owned(),
                1 => (*w.entropy.pick(&["m62 p0", "m65 p0", "m68 e0 q1"])).to_owned(),
                2 => (*w.entropy.pick(&["g43.1 z1", "g49"])).to_owned(),
                3 => "g18".to_owned(),
                4 => "g10 l2 p1 x1".to_owned(),
                5 => format!("t{tool} m6"),
                6 => format!("g43 h{tool}"),
                // Most choices of the documents refuse the words above.
                _ => (*w.entropy.pick(&["m8", "g4 p0.1", "f100", "s100", "g61"])).to_owned(),
            };
            w.block(&words);
            w.block("g40");
            w.state.xy_plane = words != "g18";
        },
    ),
];
