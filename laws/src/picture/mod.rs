//! A graph as an SVG picture: layers of boxes, arrows downwards from a user to what it uses.

mod place;

use std::collections::BTreeMap;
use std::fmt::Write as _;

use crate::report::{Drawing, Node};
use place::{Box, Layout, count};

/// Fill colours of groups of nodes, in order of the groups' names.
const COLOURS: [&str; 8] =
    ["#e3eefb", "#fdf0d5", "#e2f3e4", "#f3e5f5", "#fde2df", "#e0f4f4", "#f1f1e0", "#ececec"];
/// Pixels of a line of text, and of a letter of it.
const LINE_HEIGHT: f64 = 16.0;
const LETTER_WIDTH: f64 = 7.5;
/// Pixels around the text of a box, and between its first line and its upper edge.
const PADDING: f64 = 12.0;
/// Pixels of the title above, and of the margin around the picture.
const TITLE_HEIGHT: f64 = 40.0;
const MARGIN: f64 = 24.0;

/// Draws a graph without circles. An arrow that follows from longer ways is left out.
#[must_use]
pub fn svg(drawing: &Drawing) -> String {
    let sizes = drawing.nodes.iter().map(|(name, node)| (name.as_str(), size(node))).collect();
    let layout = Layout::of(&drawing.edges, &sizes);
    let title_width = LETTER_WIDTH * count(drawing.title.chars().count());
    let width = layout.width.max(title_width) + 2.0 * MARGIN;
    let height = layout.height + TITLE_HEIGHT + 2.0 * MARGIN;
    let mut text = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width:.0}\" height=\"{height:.0}\" \
         viewBox=\"0 0 {width:.0} {height:.0}\" font-family=\"sans-serif\" font-size=\"12\">\n\
         <defs><marker id=\"arrow\" viewBox=\"0 0 8 8\" refX=\"7\" refY=\"4\" markerWidth=\"7\" markerHeight=\"7\" \
         orient=\"auto\"><path d=\"M0,0 L8,4 L0,8 z\" fill=\"#667\"/></marker></defs>\n\
         <rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n\
         <text x=\"{MARGIN}\" y=\"{:.0}\" font-size=\"14\" fill=\"#223\">{}</text>\n\
         <g transform=\"translate({MARGIN},{:.0})\">\n",
        MARGIN + 8.0,
        escaped(&drawing.title),
        MARGIN + TITLE_HEIGHT,
    );
    for way in &layout.ways {
        arrow(&mut text, way);
    }
    let colours = colours(drawing);
    for (name, node) in &drawing.nodes {
        node_box(&mut text, node, &layout.boxes[name], colours[node.group.as_str()]);
    }
    text + "</g>\n</svg>\n"
}

fn colours(drawing: &Drawing) -> BTreeMap<&str, &'static str> {
    let groups: BTreeMap<&str, ()> =
        drawing.nodes.values().map(|node| (node.group.as_str(), ())).collect();
    groups.into_keys().zip(COLOURS.iter().copied().cycle()).collect()
}

/// Width and height of a node's box.
fn size(node: &Node) -> (f64, f64) {
    let longest = node.lines.iter().map(|line| line.chars().count()).max().unwrap_or_default();
    let width = LETTER_WIDTH * count(longest) + 2.0 * PADDING;
    (width, LINE_HEIGHT * count(node.lines.len()) + PADDING)
}

fn node_box(text: &mut String, node: &Node, at: &Box, fill: &str) {
    let (left, top) = (at.centre - at.width / 2.0, at.top);
    let stroke =
        if node.is_circle { "stroke=\"#c33\" stroke-width=\"2\"" } else { "stroke=\"#889\"" };
    let (width, height) = (at.width, at.height);
    writeln!(
        text,
        "<rect x=\"{left:.1}\" y=\"{top:.1}\" width=\"{width:.1}\" height=\"{height:.1}\" rx=\"5\" fill=\"{fill}\" {stroke}/>"
    )
    .expect("a string takes text");
    for (number, line) in node.lines.iter().enumerate() {
        let baseline = top + PADDING / 2.0 + LINE_HEIGHT * (count(number) + 0.75);
        let style = match number {
            0 => "font-weight=\"bold\" fill=\"#112\"",
            _ => "font-size=\"11\" fill=\"#445\"",
        };
        let (centre, line) = (at.centre, escaped(line));
        writeln!(text, "<text x=\"{centre:.1}\" y=\"{baseline:.1}\" text-anchor=\"middle\" {style}>{line}</text>")
            .expect("a string takes text");
    }
}

/// A line through points from top to bottom, upright at each of them.
fn arrow(text: &mut String, way: &[(f64, f64)]) {
    let mut points = way.iter();
    let Some((mut x, mut y)) = points.next().copied() else { return };
    let mut path = format!("M{x:.1},{y:.1}");
    for (next_x, next_y) in points {
        let middle = f64::midpoint(y, *next_y);
        write!(path, " C{x:.1},{middle:.1} {next_x:.1},{middle:.1} {next_x:.1},{next_y:.1}")
            .expect("a string takes text");
        (x, y) = (*next_x, *next_y);
    }
    writeln!(text, "<path d=\"{path}\" fill=\"none\" stroke=\"#667\" marker-end=\"url(#arrow)\"/>")
        .expect("a string takes text");
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}
