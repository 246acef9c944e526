//! A comparison as one self-contained page, with its filters in the address.

use minijinja::Environment;
use minijinja::value::Serde;
use serde::Serialize;

use super::document::{CellVerdict, Comparison};
use crate::escape_text;
use crate::html::STYLE;

const PAGE: &str = include_str!("page.html");

#[derive(Debug, Serialize)]
struct Page<'a> {
    style: &'static str,
    #[serde(flatten)]
    comparison: &'a Comparison,
    verdicts: Vec<&'static str>,
}

/// The comparison as HTML.
///
/// # Errors
/// The template does not fit: a fault of this program.
pub fn html(comparison: &Comparison) -> Result<String, String> {
    let verdicts = CellVerdict::ALL.map(CellVerdict::word).to_vec();
    let page = Page { style: STYLE, comparison, verdicts };
    let render = || {
        let mut environment = Environment::new();
        environment.add_filter("share", share);
        environment.add_filter("class", class);
        environment.add_template("page.html", PAGE)?;
        environment.get_template("page.html")?.render(Serde(page))
    };
    let page = render().map_err(|error: minijinja::Error| format!("{error:#}"))?;
    Ok(escape_text(&page).into_owned())
}

/// A part of a whole in percent, rounded down: only the whole is 100.
fn share(part: u32, whole: u32) -> u32 {
    (100 * part).checked_div(whole).unwrap_or_default()
}

/// The style of a verdict.
fn class(word: &str) -> String {
    word.replace(' ', "-")
}
