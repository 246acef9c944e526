//! The graph of crates or of files as text, and as a drawing takes it.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write as _;

use crate::graph::{self, FileGraph};
use crate::workspace;

/// A graph to be drawn: its arrows go from a user to what it uses, and have no circle.
#[derive(Debug, Clone, Default)]
pub struct Drawing {
    /// What it is a drawing of.
    pub title: String,
    /// Nodes by name.
    pub nodes: BTreeMap<String, Node>,
    /// What each node uses.
    pub edges: BTreeMap<String, BTreeSet<String>>,
}

/// A box of a drawing.
#[derive(Debug, Clone, Default)]
pub struct Node {
    /// Lines of text in it.
    pub lines: Vec<String>,
    /// Nodes of a group have one colour.
    pub group: String,
    /// Whether it is a circle of files.
    pub is_circle: bool,
}

/// Crates of the workspace, or files of one crate; a circle of files is one node.
///
/// # Errors
///
/// When there is no such crate.
pub fn graph(of: &[&str]) -> Result<Drawing, String> {
    let crates = workspace::crates();
    let files = graph::of_files(&crates);
    match of {
        [] => {
            let mut drawing = Drawing {
                title:
                    "Crates of this workspace: an arrow goes from a crate to one that it builds on"
                        .to_owned(),
                edges: graph::of_crates(&crates),
                ..Drawing::default()
            };
            for found in crates.values() {
                let size = files.get(&found.name).map_or_else(String::new, size);
                let lines = vec![found.name.clone(), format!("{}/", found.folder), size];
                let group = found.folder.split('/').next().unwrap_or_default().to_owned();
                drawing.nodes.insert(found.name.clone(), Node { lines, group, is_circle: false });
            }
            Ok(drawing)
        }
        [name] => Ok(of_files(name, known(&files, name)?)),
        _ => Err("more than one crate".to_owned()),
    }
}

fn size(graph: &FileGraph) -> String {
    format!("{} files, {} lines", graph.files.len(), graph.lines)
}

fn known<'a>(files: &'a BTreeMap<String, FileGraph>, name: &str) -> Result<&'a FileGraph, String> {
    let names: Vec<_> = files.keys().map(String::as_str).collect();
    files
        .get(name)
        .ok_or_else(|| format!("no crate is called {name}; expected {}", names.join(", ")))
}

/// Circles of the files of a crate.
#[must_use]
pub fn circles(graph: &FileGraph) -> Vec<BTreeSet<String>> {
    graph::circles(graph.edges.keys().map(|(from, to)| (from.as_str(), to.as_str())))
}

fn of_files(name: &str, graph: &FileGraph) -> Drawing {
    let circles = circles(graph);
    let node = |file: &str| {
        let circle = circles.iter().find(|circle| circle.contains(file));
        circle.and_then(|circle| circle.first().cloned()).unwrap_or_else(|| file.to_owned())
    };
    let title = format!(
        "Files of {name}: an arrow goes from a file to one that it uses; a circle is one box"
    );
    let mut drawing = Drawing { title, ..Drawing::default() };
    for file in &graph.files {
        let of = drawing.nodes.entry(node(file)).or_default();
        of.is_circle = !of.lines.is_empty();
        of.group = group(&short(file));
        of.lines.push(short(file));
        drawing.edges.entry(node(file)).or_default();
    }
    for (from, to) in graph.edges.keys() {
        let (from, to) = (node(from), node(to));
        if from != to {
            drawing.edges.entry(from).or_default().insert(to);
        }
    }
    drawing
}

/// Folder of a file directly below the sources of its crate.
fn group(short: &str) -> String {
    short.split_once('/').map_or("", |(folder, _)| folder).to_owned()
}

/// A file's path within the sources of its crate.
fn short(file: &str) -> String {
    file.split_once("/src/").map_or(file, |(_, file)| file).to_owned()
}

/// Layers of nodes: the lowest uses none, each other one is above all that it uses.
///
/// # Panics
///
/// When the graph has a circle.
#[must_use]
pub fn layers(edges: &BTreeMap<String, BTreeSet<String>>) -> Vec<Vec<String>> {
    let mut layers: Vec<Vec<String>> = Vec::new();
    let mut done: BTreeSet<&String> = BTreeSet::new();
    while done.len() < edges.len() {
        let is_next = |(name, on): &(&String, &BTreeSet<String>)| {
            !done.contains(name) && on.iter().all(|other| done.contains(other))
        };
        let layer: Vec<_> = edges.iter().filter(is_next).map(|(name, _)| name).collect();
        assert!(!layer.is_empty(), "the graph has a circle");
        done.extend(&layer);
        layers.push(layer.into_iter().cloned().collect());
    }
    layers
}

/// Edges without those that follow from longer ways.
///
/// # Panics
///
/// When the graph has a circle.
#[must_use]
pub fn reduced(edges: &BTreeMap<String, BTreeSet<String>>) -> BTreeMap<String, BTreeSet<String>> {
    let mut below: BTreeMap<&String, BTreeSet<&String>> = BTreeMap::new();
    for name in layers(edges).iter().flatten() {
        let (name, on) = edges.get_key_value(name).expect("a layer has nodes of the graph");
        let deeper = on.iter().flat_map(|other| below[other].iter().copied());
        let all = deeper.chain(on).collect();
        below.insert(name, all);
    }
    let direct = |on: &BTreeSet<String>| -> BTreeSet<String> {
        let is_direct = |name: &&String| !on.iter().any(|other| below[other].contains(name));
        on.iter().filter(is_direct).cloned().collect()
    };
    edges.iter().map(|(name, on)| (name.clone(), direct(on))).collect()
}

/// A graph in the language of Graphviz.
///
/// # Panics
///
/// When the graph has a circle.
#[must_use]
pub fn dot(drawing: &Drawing) -> String {
    let mut text = format!("digraph {{\n  label = {:?};\n  node [shape = box];\n", drawing.title);
    for (name, node) in &drawing.nodes {
        writeln!(text, "  {name:?} [label = {:?}];", node.lines.join("\n"))
            .expect("a string takes text");
    }
    for (name, on) in reduced(&drawing.edges) {
        for other in on {
            writeln!(text, "  {name:?} -> {other:?};").expect("a string takes text");
        }
    }
    text + "}\n"
}

/// Crates of the workspace with all circles of files, or the files of one crate with its circles.
///
/// # Errors
///
/// When there is no such crate.
pub fn text(of: &[&str]) -> Result<String, String> {
    let crates = workspace::crates();
    let files = graph::of_files(&crates);
    let mut text = String::new();
    match of {
        [] => {
            let edges = graph::of_crates(&crates);
            list(&mut text, &edges, |name| files.get(name).map_or_else(String::new, size));
            for (name, graph) in &files {
                write_circles(&mut text, name, graph);
            }
        }
        [name] => {
            let graph = known(&files, name)?;
            list(&mut text, &of_files(name, graph).edges, |_| String::new());
            write_circles(&mut text, name, graph);
        }
        _ => return Err("more than one crate".to_owned()),
    }
    Ok(text)
}

/// Writes the nodes layer by layer, from the bottom up, each with what it uses.
fn list(
    text: &mut String,
    edges: &BTreeMap<String, BTreeSet<String>>,
    note: impl Fn(&str) -> String,
) {
    let direct = reduced(edges);
    for (number, layer) in layers(edges).iter().enumerate() {
        writeln!(text, "layer {}", number + 1).expect("a string takes text");
        for name in layer {
            let on: Vec<_> = direct[name].iter().map(String::as_str).collect();
            let on = if on.is_empty() { String::new() } else { format!(" -> {}", on.join(", ")) };
            let note = note(name);
            let note = if note.is_empty() { note } else { format!(" ({note})") };
            writeln!(text, "  {name}{note}{on}").expect("a string takes text");
        }
    }
}

fn write_circles(text: &mut String, name: &str, graph: &FileGraph) {
    for circle in circles(graph) {
        let inside = graph
            .edges
            .iter()
            .filter(|((from, to), _)| circle.contains(from) && circle.contains(to));
        let weights = inside
            .clone()
            .map(|((from, to), names)| ((from.as_str(), to.as_str()), names.len()))
            .collect();
        let cut = graph::cut(&weights);
        let count = circle.len();
        writeln!(
            text,
            "\ncircle of {count} files in {name}; without the edges marked * it is none"
        )
        .expect("a string takes text");
        for ((from, to), names) in inside {
            let mark = if cut.contains(&(from.as_str(), to.as_str())) { '*' } else { ' ' };
            let names: Vec<_> = names.iter().map(String::as_str).collect();
            let (from, to) = (short(from), short(to));
            writeln!(text, "{mark} {from} -> {to}: {}", names.join(", "))
                .expect("a string takes text");
        }
    }
}
