//! Circles: sets of nodes each of which reaches each other (strongly connected components).

use std::collections::{BTreeMap, BTreeSet};

/// Circles of two nodes or more, in order of their first node.
#[must_use]
pub fn circles<'a>(edges: impl IntoIterator<Item = (&'a str, &'a str)>) -> Vec<BTreeSet<String>> {
    let mut forward: BTreeMap<&str, Vec<&str>> = BTreeMap::new();
    let mut backward: BTreeMap<&str, Vec<&str>> = BTreeMap::new();
    for (from, to) in edges {
        forward.entry(from).or_default().push(to);
        forward.entry(to).or_default();
        backward.entry(to).or_default().push(from);
    }
    // Kosaraju's method: nodes in the order in which a search leaves them; then, last one first, all that reach a node.
    let mut left = Vec::new();
    let mut seen = BTreeSet::new();
    for node in forward.keys() {
        left_from(node, &forward, &mut seen, &mut left);
    }
    let mut found = Vec::new();
    let mut seen = BTreeSet::new();
    for node in left.iter().rev() {
        let mut circle = Vec::new();
        left_from(node, &backward, &mut seen, &mut circle);
        if circle.len() > 1 {
            found.push(circle.into_iter().map(str::to_owned).collect::<BTreeSet<_>>());
        }
    }
    found.sort();
    found
}

/// Searches in depth from a node and adds each new node when the search leaves it.
fn left_from<'a>(
    start: &'a str,
    edges: &BTreeMap<&'a str, Vec<&'a str>>,
    seen: &mut BTreeSet<&'a str>,
    left: &mut Vec<&'a str>,
) {
    if !seen.insert(start) {
        return;
    }
    let mut open = vec![(start, 0)];
    while let Some((node, next)) = open.pop() {
        match edges.get(node).and_then(|edges| edges.get(next)) {
            Some(other) => {
                open.push((node, next + 1));
                if seen.insert(*other) {
                    open.push((*other, 0));
                }
            }
            None => left.push(node),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn found(edges: &[(&str, &str)]) -> Vec<String> {
        let name = |circle: BTreeSet<String>| circle.into_iter().collect::<Vec<_>>().concat();
        circles(edges.iter().copied()).into_iter().map(name).collect()
    }

    #[test]
    fn chain_and_diamond_have_no_circle() {
        assert!(found(&[("a", "b"), ("b", "c"), ("a", "c"), ("a", "d"), ("d", "c")]).is_empty());
    }

    #[test]
    fn circles_with_a_common_node_are_one() {
        assert_eq!(found(&[("a", "b"), ("b", "a"), ("b", "c"), ("c", "b"), ("c", "d")]), ["abc"]);
    }

    #[test]
    fn circles_joined_one_way_are_two() {
        let edges = [("a", "b"), ("b", "a"), ("b", "c"), ("c", "d"), ("d", "c")];
        assert_eq!(found(&edges), ["ab", "cd"]);
    }
}
