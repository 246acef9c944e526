//! Texts in a Rust source: help, messages, documentation comments.

use std::collections::BTreeSet;

use proc_macro2::{TokenStream, TokenTree};
use syn::visit::{self, Visit};
use syn::{Attribute, Expr, Item, Lit, LitStr, Meta};

use super::text::{Kind, Text, without_code};
use crate::graph::{attributes, is_test};

/// Traits of clap whose derivation makes help of documentation comments.
const HELP: &[&str] = &["Parser", "Args", "Subcommand", "ValueEnum"];

/// Fewest words of a string that is a message.
const MESSAGE_WORDS_MIN: usize = 3;

/// Texts of a source file; tests are left out.
pub(super) fn texts(path: &str, source: &str) -> Vec<Text> {
    let code = syn::parse_file(source).unwrap_or_else(|error| panic!("{path}: {error}"));
    let mut reader = Reader { path, is_help: false, comment: Vec::new(), texts: Vec::new() };
    reader.visit_file(&code);
    reader.end_comment();
    reader.texts
}

/// Numbers of the lines of a source that a literal is on.
///
/// # Panics
///
/// When the source is not Rust.
#[must_use]
pub fn literal_lines(source: &str) -> BTreeSet<usize> {
    let mut lines = BTreeSet::new();
    let mut open = vec![source.parse::<TokenStream>().expect("a source is Rust")];
    while let Some(tokens) = open.pop() {
        for token in tokens {
            match token {
                TokenTree::Group(group) => open.push(group.stream()),
                TokenTree::Literal(literal) => {
                    let span = literal.span();
                    lines.extend(span.start().line..=span.end().line);
                }
                TokenTree::Ident(_) | TokenTree::Punct(_) => {}
            }
        }
    }
    lines
}

struct Reader<'a> {
    path: &'a str,
    /// Whether documentation comments are help.
    is_help: bool,
    /// Lines of the documentation comment that is being read, each with its number.
    comment: Vec<(usize, String)>,
    texts: Vec<Text>,
}

impl Reader<'_> {
    fn add(&mut self, kind: Kind, line: usize, text: &str) {
        self.texts.push(Text { kind, path: self.path.to_owned(), line, text: without_code(text) });
    }

    fn read_string(&mut self, string: &LitStr) {
        let text = string.value();
        if text.split_whitespace().count() >= MESSAGE_WORDS_MIN {
            self.add(Kind::Message, string.span().start().line, &text);
        }
    }

    fn read_tokens(&mut self, tokens: TokenStream) {
        for token in tokens {
            match token {
                TokenTree::Group(group) => self.read_tokens(group.stream()),
                TokenTree::Literal(literal) => {
                    if let Lit::Str(string) = Lit::new(literal) {
                        self.read_string(&string);
                    }
                }
                TokenTree::Ident(_) | TokenTree::Punct(_) => {}
            }
        }
    }

    /// Adds the comment that has been read, if any.
    fn end_comment(&mut self) {
        let lines = std::mem::take(&mut self.comment);
        if let Some((first, _)) = lines.first().cloned() {
            let text: Vec<_> = lines.into_iter().map(|(_, line)| line).collect();
            let kind = if self.is_help { Kind::Help } else { Kind::Comment };
            self.add(kind, first, &text.join("\n"));
        }
    }
}

fn derives_help(attributes: &[Attribute]) -> bool {
    attributes.iter().any(|attribute| match &attribute.meta {
        Meta::List(list) if list.path.is_ident("derive") => {
            let names = list.tokens.to_string();
            HELP.iter().any(|name| {
                names.split(|letter: char| !letter.is_alphanumeric()).any(|word| word == *name)
            })
        }
        Meta::List(_) | Meta::Path(_) | Meta::NameValue(_) => false,
    })
}

impl<'ast> Visit<'ast> for Reader<'_> {
    fn visit_item(&mut self, item: &'ast Item) {
        if is_test(attributes(item)) {
            return;
        }
        self.end_comment();
        let before = self.is_help;
        self.is_help = derives_help(attributes(item));
        visit::visit_item(self, item);
        self.end_comment();
        self.is_help = before;
    }

    fn visit_attribute(&mut self, attribute: &'ast Attribute) {
        match &attribute.meta {
            Meta::NameValue(pair) if pair.path.is_ident("doc") => {
                if let Expr::Lit(value) = &pair.value
                    && let Lit::Str(line) = &value.lit
                {
                    let number = line.span().start().line;
                    if self.comment.last().is_some_and(|(last, _)| last + 1 != number) {
                        self.end_comment();
                    }
                    self.comment.push((number, line.value()));
                }
            }
            Meta::List(list) if !list.path.is_ident("expect") => {
                self.read_tokens(list.tokens.clone());
            }
            Meta::List(_) | Meta::Path(_) | Meta::NameValue(_) => {}
        }
    }

    fn visit_lit_str(&mut self, string: &'ast LitStr) {
        self.read_string(string);
    }

    fn visit_macro(&mut self, call: &'ast syn::Macro) {
        self.read_tokens(call.tokens.clone());
    }
}
