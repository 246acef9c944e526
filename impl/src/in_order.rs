//! Options that are asked for in the order of their ids, which is that in which they are kept: one pass finds them all.

use alloc::collections::btree_map::Iter;
use alloc::string::String;
use core::cmp::Ordering;

use gaugeblock_trace::Options;

/// One pass through options.
pub(crate) struct InOrder<'a> {
    options: &'a Options,
    rest: Iter<'a, String, String>,
    /// The first option that has not been passed.
    next: Option<(&'a String, &'a String)>,
    /// The id that was asked for last.
    asked: &'static str,
}

impl<'a> InOrder<'a> {
    pub(crate) fn new(options: &'a Options) -> Self {
        let mut rest = options.0.iter();
        let next = rest.next();
        Self { options, rest, next, asked: "" }
    }

    /// The option of a choice; one that is asked for out of order is looked for as any other.
    pub(crate) fn get(&mut self, id: &'static str) -> Option<&'a str> {
        if id < self.asked {
            return self.options.get(id);
        }
        self.asked = id;
        while let Some((next, option)) = self.next {
            match next.as_str().cmp(id) {
                Ordering::Less => self.next = self.rest.next(),
                Ordering::Equal => return Some(option),
                Ordering::Greater => break,
            }
        }
        None
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_option_is_found_whenever_it_is_asked_for() {
        let options =
            [("b", "1"), ("d", "2"), ("f", "3")].map(|(id, option)| (id.into(), option.into()));
        let options = Options(options.into_iter().collect());
        let mut in_order = InOrder::new(&options);
        for (id, option) in [
            ("a", None),
            ("b", Some("1")),
            ("c", None),
            ("f", Some("3")),
            ("d", Some("2")),
            ("f", Some("3")),
            ("g", None),
        ] {
            assert_eq!(in_order.get(id), option, "{id}");
        }
    }
}
