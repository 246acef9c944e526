//! The guide: Markdown pages of the repository as pages of the site.

use pulldown_cmark::{CowStr, Event, HeadingLevel, Options, Parser, Tag, TagEnd, html};
use serde::Serialize;

use super::address::anchor;
use super::contents::{Book, Guide};
use super::site::{Link, Links, Listing, Site};

macro_rules! page {
    ($name:literal) => {
        Guide { path: concat!("docs/", $name), text: include_str!(concat!("../guide/", $name)) }
    };
}

/// The pages of the guide, in reading order.
pub const GUIDE: [Guide; 16] = [
    page!("tutorial.md"),
    page!("programs.md"),
    page!("adapters.md"),
    page!("ci.md"),
    page!("profiles.md"),
    page!("certificate.md"),
    page!("scale.md"),
    page!("grbl.md"),
    page!("nist.md"),
    page!("documents.md"),
    page!("compensation.md"),
    page!("planner.md"),
    page!("performance.md"),
    page!("glossary.md"),
    page!("dependencies.md"),
    page!("README.md"),
];

#[derive(Debug, Serialize)]
struct GuidePage {
    html: String,
}

pub(super) fn add(book: &Book<'_>, site: &mut Site) -> Result<(), String> {
    let mut links = Vec::new();
    for guide in book.guide {
        let title = guide.title();
        links.push(Link {
            address: address(guide.path),
            name: title.clone(),
            sentence: String::new(),
        });
        let page = GuidePage { html: rendered(guide, book) };
        site.add(&address(guide.path), "guide.html", ["guide", &title], page)?;
    }
    let about =
        "How to use it: for vendors, authors of adapters, CI engineers and embedders.".to_owned();
    let groups = vec![Links { title: String::new(), links }];
    let listing = Listing { about, groups };
    site.add("guide/index.html", "list.html", ["guide", "Guide"], listing)
}

/// The address of a page of the guide, by its path in the repository.
pub(super) fn address(path: &str) -> String {
    let name = path.rsplit('/').next().unwrap_or(path);
    format!("guide/{}.html", name.trim_end_matches(".md").to_ascii_lowercase())
}

impl Guide {
    /// The first heading.
    pub(super) fn title(&self) -> String {
        let heading = self.text.lines().find_map(|line| line.strip_prefix("# "));
        heading.unwrap_or(self.path).replace('`', "")
    }
}

/// The page as HTML. A link to a file of the repository leads to its page of the site, or else into the public
/// repository; without one its words stay.
fn rendered(guide: &Guide, book: &Book<'_>) -> String {
    let options = Options::ENABLE_TABLES | Options::ENABLE_STRIKETHROUGH;
    let events: Vec<Event<'_>> = Parser::new_ext(guide.text, options).collect();
    let mut is_dropped = false;
    let events = with_anchors(events).into_iter().filter_map(|event| {
        let Event::Start(Tag::Link { link_type, dest_url, title, id }) = event else {
            let is_end = event == Event::End(TagEnd::Link);
            return (!is_end || !is_dropped).then_some(event);
        };
        let target = target(&dest_url, guide.path, book);
        is_dropped = target.is_none();
        let dest_url = CowStr::from(target?);
        Some(Event::Start(Tag::Link { link_type, dest_url, title, id }))
    });
    let mut html = String::new();
    html::push_html(&mut html, events);
    // What scrolls can be reached with the keyboard.
    html.replace("<pre>", "<pre tabindex=\"0\">").replace("<table>", "<table tabindex=\"0\">")
}

/// Gives each heading the name of its words.
fn with_anchors(mut events: Vec<Event<'_>>) -> Vec<Event<'_>> {
    let starts: Vec<usize> = (0..events.len())
        .filter(|at| matches!(events[*at], Event::Start(Tag::Heading { .. })))
        .collect();
    for start in starts {
        let words = events[start..].iter().take_while(|it| !is_end_of_heading(it));
        let text: String = words
            .filter_map(|event| {
                if let Event::Text(text) | Event::Code(text) = event {
                    Some(text.as_ref())
                } else {
                    None
                }
            })
            .collect();
        if let Event::Start(Tag::Heading { id, level, .. }) = &mut events[start]
            && *level != HeadingLevel::H1
        {
            *id = Some(CowStr::from(anchor(&text)));
        }
    }
    events
}

fn is_end_of_heading(event: &Event<'_>) -> bool {
    matches!(event, Event::End(TagEnd::Heading(_)))
}

/// Where a link of a page leads; none if the file is not public.
fn target(url: &str, from: &str, book: &Book<'_>) -> Option<String> {
    if url.starts_with('#') || url.contains("://") || url.starts_with("mailto:") {
        return Some(url.to_owned());
    }
    let (path, fragment) = match url.split_once('#') {
        Some((path, fragment)) => (path, format!("#{fragment}")),
        None => (url, String::new()),
    };
    let path = resolved(from, path);
    match book.guide.iter().find(|guide| guide.path == path) {
        Some(guide) => Some(format!("../{}{fragment}", address(guide.path))),
        None => book.repository.map(|base| format!("{base}{path}{fragment}")),
    }
}

/// A path relative to a file of the repository, as one relative to the repository.
fn resolved(from: &str, path: &str) -> String {
    let mut parts: Vec<&str> = from.split('/').collect();
    parts.pop();
    for part in path.split('/') {
        match part {
            "." | "" => {}
            ".." => {
                parts.pop();
            }
            part => parts.push(part),
        }
    }
    parts.join("/")
}

#[cfg(test)]
mod tests {
    use gaugeblock_suite::Suite;

    use super::*;

    const GUIDES: [Guide; 2] = [
        Guide {
            path: "docs/tutorial.md",
            text: "# A tutorial\n\nSee [CI](ci.md#gate) and [code](../impl/x.rs).\n",
        },
        Guide { path: "docs/ci.md", text: "# CI\n\n## A `gate` in CI\n" },
    ];

    fn html_of(place: usize, repository: Option<&str>) -> String {
        let suite = Suite::read(&gaugeblock_embedded_suite::files().expect("the suite"));
        let suite = suite.expect("the suite");
        let book =
            Book { suite: &suite, ledgers: &[], comparison: None, guide: &GUIDES, repository };
        rendered(&GUIDES[place], &book)
    }

    #[test]
    fn link_leads_to_the_page_of_the_site_or_into_the_repository() {
        let html = html_of(0, Some("https://example.org/"));
        assert!(html.contains("href=\"../guide/ci.html#gate\""), "{html}");
        assert!(html.contains("href=\"https://example.org/impl/x.rs\""), "{html}");
        assert!(html_of(0, None).contains("and code."));
    }

    #[test]
    fn heading_has_the_name_of_its_words() {
        let html = html_of(1, None);
        assert!(html.contains("<h2 id=\"a-gate-in-ci\">"), "{html}");
    }
}
