//! G28 and G30, axis offsets, and the offsets and tools that G10 writes.

use super::super::kind::StatementKind;
use super::super::writer::Statement;

pub(in super::super) const STATEMENTS: &[Statement] = &[
    Statement::any("predefined.go", StatementKind::Predefined, 8, |w| {
        let code = *w.entropy.pick(&["g28", "g30"]);
        let axes = if w.entropy.chance(50) { w.axes(2) } else { String::new() };
        w.block(format!("{code}{axes}"));
    }),
    Statement::any("predefined.set", StatementKind::Predefined, 8, |w| {
        let code = *w.entropy.pick(&["g28.1", "g30.1"]);
        w.block(code);
    }),
    Statement::any("axis-offset.set", StatementKind::AxisOffset, 14, |w| {
        let (code, axes) = (*w.entropy.pick(&["g92", "g52"]), w.axes(3));
        w.block(format!("{code}{axes}"));
    }),
    Statement::any("axis-offset.cancel", StatementKind::AxisOffset, 8, |w| {
        let code = *w.entropy.pick(&["g92.1", "g92.2", "g92.3"]);
        w.block(code);
    }),
    Statement::when(
        "tool-table",
        StatementKind::ToolTable,
        8,
        |s| !s.tools.is_empty(),
        |w| {
            let tools = w.state.tools.clone();
            let (kind, tool) = (*w.entropy.pick(&["1", "10", "11"]), *w.entropy.pick(&tools));
            if w.entropy.chance(20) {
                w.block(format!("g10 l1 p{tool}"));
                return;
            }
            let axes = w.axes(2);
            let radius = if w.entropy.chance(30) { " r2" } else { "" };
            w.block(format!("g10 l{kind} p{tool}{axes}{radius}"));
        },
    ),
    Statement::any("offset.calculated", StatementKind::ToolTable, 8, |w| {
        let (system, axes) = (w.whole(0, 9), w.axes(3));
        w.block(format!("g10 l20 p{system}{axes}"));
    }),
];
