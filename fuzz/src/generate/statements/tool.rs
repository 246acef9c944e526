//! Tools and their lengths.

use super::super::kind::StatementKind;
use super::super::writer::Statement;

pub(in super::super) const STATEMENTS: &[Statement] = &[
    Statement::when(
        "tool.select",
        StatementKind::Tool,
        12,
        |s| !s.tools.is_empty(),
        |w| {
            let tools = w.state.tools.clone();
            let tool = *w.entropy.pick(&tools);
            w.block(format!("t{tool}"));
            w.state.selected = true;
        },
    ),
    Statement::any("tool.none", StatementKind::Tool, 3, |w| {
        w.block("t0");
        w.state.selected = true;
    }),
    Statement::when(
        "tool.change",
        StatementKind::Tool,
        10,
        |s| s.selected,
        |w| {
            w.block("m6");
            w.state.loaded = true;
            w.state.turning = false;
        },
    ),
    Statement::when(
        "tool.select-and-change",
        StatementKind::Tool,
        12,
        |s| !s.tools.is_empty(),
        |w| {
            let tools = w.state.tools.clone();
            let tool = *w.entropy.pick(&tools);
            let more = *w.entropy.pick(&["", "", " g43", " s500 m3"]);
            w.block(format!("t{tool} m6{more}"));
            w.state.loaded = true;
            w.state.selected = true;
            w.state.turning = false;
        },
    ),
    Statement::when(
        "tool.set-number",
        StatementKind::Tool,
        6,
        |s| !s.tools.is_empty(),
        |w| {
            let tools = w.state.tools.clone();
            let tool = if w.entropy.chance(20) { 0 } else { *w.entropy.pick(&tools) };
            w.block(format!("m61 q{tool}"));
        },
    ),
    Statement::when(
        "tool.length",
        StatementKind::Tool,
        8,
        |s| !s.tools.is_empty(),
        |w| {
            let tools = w.state.tools.clone();
            let tool = *w.entropy.pick(&tools);
            w.block(format!("g43 h{tool}"));
        },
    ),
    Statement::when(
        "tool.length-of-loaded",
        StatementKind::Tool,
        4,
        |s| s.loaded,
        |w| w.block("g43"),
    ),
    Statement::any("tool.length-given", StatementKind::Tool, 6, |w| {
        let axes = w.axes(2);
        w.block(format!("g43.1{axes}"));
    }),
    Statement::when(
        "tool.length-added",
        StatementKind::Tool,
        4,
        |s| !s.tools.is_empty(),
        |w| {
            let tools = w.state.tools.clone();
            let tool = *w.entropy.pick(&tools);
            w.block(format!("g43.2 h{tool}"));
        },
    ),
    Statement::any("tool.length-off", StatementKind::Tool, 8, |w| w.block("g49")),
];
