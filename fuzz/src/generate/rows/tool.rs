//! Tools and their lengths.

use super::super::table::{Kind, Row};

pub(in super::super) const ROWS: &[Row] = &[
    Row::when(
        "tool.select",
        Kind::Tool,
        12,
        |s| !s.tools.is_empty(),
        |w| {
            let tools = w.state.tools.clone();
            let tool = *w.dice.pick(&tools);
            w.block(format!("t{tool}"));
            w.state.selected = true;
        },
    ),
    Row::any("tool.none", Kind::Tool, 3, |w| {
        w.block("t0");
        w.state.selected = true;
    }),
    Row::when(
        "tool.change",
        Kind::Tool,
        10,
        |s| s.selected && !s.compensated,
        |w| {
            w.block("m6");
            w.state.loaded = true;
            w.state.turning = false;
        },
    ),
    Row::when(
        "tool.select-and-change",
        Kind::Tool,
        12,
        |s| !s.tools.is_empty() && !s.compensated,
        |w| {
            let tools = w.state.tools.clone();
            let tool = *w.dice.pick(&tools);
            let more = *w.dice.pick(&["", "", " g43", " s500 m3"]);
            w.block(format!("t{tool} m6{more}"));
            w.state.loaded = true;
            w.state.selected = true;
            w.state.turning = false;
        },
    ),
    Row::when(
        "tool.set-number",
        Kind::Tool,
        6,
        |s| !s.tools.is_empty(),
        |w| {
            let tools = w.state.tools.clone();
            let tool = if w.dice.chance(20) { 0 } else { *w.dice.pick(&tools) };
            w.block(format!("m61 q{tool}"));
        },
    ),
    Row::when(
        "tool.length",
        Kind::Tool,
        8,
        |s| !s.tools.is_empty(),
        |w| {
            let tools = w.state.tools.clone();
            let tool = *w.dice.pick(&tools);
            w.block(format!("g43 h{tool}"));
        },
    ),
    Row::when("tool.length-of-loaded", Kind::Tool, 4, |s| s.loaded, |w| w.block("g43")),
    Row::any("tool.length-given", Kind::Tool, 6, |w| {
        let axes = w.axes(2);
        w.block(format!("g43.1{axes}"));
    }),
    Row::when(
        "tool.length-added",
        Kind::Tool,
        4,
        |s| !s.tools.is_empty(),
        |w| {
            let tools = w.state.tools.clone();
            let tool = *w.dice.pick(&tools);
            w.block(format!("g43.2 h{tool}"));
        },
    ),
    Row::any("tool.length-off", Kind::Tool, 8, |w| w.block("g49")),
];
