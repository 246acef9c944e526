//! The pages as they are collected, and the templates that they are made from.

use minijinja::value::Serde;
use minijinja::{Environment, Error, Output, State, Value, escape_formatter};
use serde::Serialize;

use super::contents::Page;

const TEMPLATES: [(&str, &str); 12] = [
    ("base.html", include_str!("../templates/base.html")),
    ("parts.html", include_str!("../templates/parts.html")),
    ("case.html", include_str!("../templates/case.html")),
    ("home.html", include_str!("../templates/home.html")),
    ("chapter.html", include_str!("../templates/chapter.html")),
    ("rule.html", include_str!("../templates/rule.html")),
    ("choice.html", include_str!("../templates/choice.html")),
    ("code.html", include_str!("../templates/code.html")),
    ("document.html", include_str!("../templates/document.html")),
    ("edition.html", include_str!("../templates/edition.html")),
    ("list.html", include_str!("../templates/list.html")),
    ("guide.html", include_str!("../templates/guide.html")),
];

/// Files that are the same in every book.
const FIXED: [(&str, &str); 2] = [
    ("style.css", include_str!("../templates/style.css")),
    ("search.js", include_str!("../templates/search.js")),
];

/// A site in the making.
pub(super) struct Site {
    environment: Environment<'static>,
    /// The beginning of the digest of the suite, which each page prints.
    suite: String,
    pages: Vec<Page>,
}

/// What a template reads.
#[derive(Serialize)]
struct Values<'a, T> {
    /// The way up to the first page.
    root: String,
    section: &'a str,
    title: &'a str,
    path: &'a str,
    suite: &'a str,
    page: T,
}

impl Site {
    pub(super) fn new(digest: &str) -> Result<Self, String> {
        let mut environment = Environment::new();
        environment.set_formatter(escaped);
        for (name, text) in TEMPLATES {
            environment.add_template(name, text).map_err(|error| format!("{error:#}"))?;
        }
        let fixed =
            |(path, text): (&str, &str)| Page { path: path.to_owned(), text: text.to_owned() };
        let pages = FIXED.into_iter().map(fixed).collect();
        let suite = digest.chars().take(12).collect();
        Ok(Self { environment, suite, pages })
    }

    /// Adds a page. `section` is the entry of the navigation that it belongs to.
    pub(super) fn add<T: Serialize>(
        &mut self,
        path: &str,
        template: &str,
        [section, title]: [&str; 2],
        content: T,
    ) -> Result<(), String> {
        let root = "../".repeat(path.matches('/').count());
        let values = Values { root, section, title, path, suite: &self.suite, page: content };
        let render = || self.environment.get_template(template)?.render(Serde(values));
        let text = render().map_err(|error: Error| format!("{path}: {error:#}"))?;
        self.pages.push(Page { path: path.to_owned(), text });
        Ok(())
    }

    /// Adds a file that is made without a template.
    pub(super) fn add_file(&mut self, path: &str, text: String) {
        self.pages.push(Page { path: path.to_owned(), text });
    }

    /// All files, ordered by path.
    pub(super) fn into_pages(mut self) -> Vec<Page> {
        self.pages.sort_by(|a, b| a.path.cmp(&b.path));
        self.pages
    }
}

/// Writes a value of a page. Texts are escaped as far as HTML requires; the slashes of addresses stay.
fn escaped(out: &mut Output<'_>, state: &mut State<'_, '_>, value: &Value) -> Result<(), Error> {
    let Some(text) = value.as_str().filter(|_| !value.is_safe()) else {
        return escape_formatter(out, state, value);
    };
    let mut rest = text;
    while let Some(at) = rest.find(['&', '<', '>', '"', '\'']) {
        out.write_str(&rest[..at])?;
        out.write_str(match &rest[at..=at] {
            "&" => "&amp;",
            "<" => "&lt;",
            ">" => "&gt;",
            "\"" => "&quot;",
            _ => "&#39;",
        })?;
        rest = &rest[at + 1..];
    }
    Ok(out.write_str(rest)?)
}

/// A link to a page, with the sentence that explains it.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Link {
    pub(super) address: String,
    pub(super) name: String,
    pub(super) sentence: String,
}

/// A list of links under a title.
#[derive(Debug, Serialize)]
pub(super) struct Links {
    pub(super) title: String,
    pub(super) links: Vec<Link>,
}

/// A page that lists pages.
#[derive(Debug, Serialize)]
pub(super) struct Listing {
    pub(super) about: String,
    pub(super) groups: Vec<Links>,
}
