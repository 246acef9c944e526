//! Where a circle can be cut.

use std::collections::{BTreeMap, BTreeSet};

/// Edges (user, used) without which a circle is none: few, though not always the fewest.
///
/// Nodes are put in an order, users first; edges against the order are the answer. A node that uses nothing more comes
/// last, one that nothing more uses comes first, else the one with the most uses over its users comes first
/// (the method of Eades, Lin and Smyth).
#[must_use]
pub fn cut<'a>(edges: &BTreeMap<(&'a str, &'a str), usize>) -> BTreeSet<(&'a str, &'a str)> {
    let mut left: BTreeSet<&str> = edges.keys().flat_map(|(from, to)| [*from, *to]).collect();
    let mut first = Vec::new();
    let mut last = Vec::new();
    while !left.is_empty() {
        let weight = |node: &str, is_user: bool| -> usize {
            let inside =
                edges.iter().filter(|((from, to), _)| left.contains(from) && left.contains(to));
            let of_node =
                inside.filter(|((from, to), _)| if is_user { *from == node } else { *to == node });
            of_node.map(|(_, names)| names).sum()
        };
        let weights: Vec<_> =
            left.iter().map(|node| (*node, weight(node, true), weight(node, false))).collect();
        let by_rank =
            |(_, uses, users): &&(&str, usize, usize)| uses.saturating_mul(1000) / (users + 1);
        if let Some((node, ..)) = weights.iter().find(|(_, uses, _)| *uses == 0) {
            last.push(*node);
            left.remove(node);
        } else if let Some((node, ..)) = weights.iter().max_by_key(by_rank) {
            first.push(*node);
            left.remove(node);
        }
    }
    let order: Vec<_> = first.into_iter().chain(last.into_iter().rev()).collect();
    let place = |node: &str| order.iter().position(|other| *other == node);
    edges.keys().filter(|(from, to)| place(from) > place(to)).copied().collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lighter_edge_of_a_pair_is_cut() {
        let edges = BTreeMap::from([(("a", "b"), 3), (("b", "a"), 1), (("b", "c"), 1)]);
        assert_eq!(cut(&edges), BTreeSet::from([("b", "a")]));
    }

    #[test]
    fn chain_needs_no_cut() {
        assert!(cut(&BTreeMap::from([(("a", "b"), 1), (("b", "c"), 1)])).is_empty());
    }
}
