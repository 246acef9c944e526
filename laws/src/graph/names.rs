//! What a module's code defines, imports and names.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use proc_macro2::{TokenStream, TokenTree};
use syn::visit::{self, Visit};
use syn::{Attribute, Expr, Item, Lit, Meta, UseTree, Visibility};

use super::modules::{File, Import, Module, Tree};
use crate::files;
use crate::workspace::{Crate, Target};

/// Reads the libraries and programs of all crates.
pub(super) fn read(crates: &BTreeMap<String, Crate>) -> Tree {
    let mut tree = Tree::default();
    for found in crates.values() {
        let is_read = |target: &&Target| ["lib", "bin"].contains(&target.kind.as_str());
        for target in found.targets.iter().filter(is_read) {
            let path = files::root().join(&target.source);
            let root = read_file(&mut tree, &found.name, &path, None);
            if target.kind == "lib" {
                tree.libraries.insert(target.name.clone(), root);
            }
        }
    }
    tree
}

/// Reads a file and the files of its children; its module's place.
fn read_file(tree: &mut Tree, package: &str, path: &Path, parent: Option<usize>) -> usize {
    let text =
        fs::read_to_string(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    let code = syn::parse_file(&text).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    tree.files.push(File {
        path: files::from_root(path),
        package: package.to_owned(),
        lines: text.lines().count(),
    });
    let folder = path.parent().expect("a file is in a folder");
    let is_folder = path.ends_with("mod.rs") || parent.is_none();
    let folder = match path.file_stem() {
        Some(stem) if !is_folder => folder.join(stem),
        _ => folder.to_owned(),
    };
    let module = tree.add(tree.files.len() - 1, parent, folder);
    Reader { tree, module }.visit_file(&code);
    module
}

/// Reads the code of one module into the tree.
struct Reader<'a> {
    tree: &'a mut Tree,
    module: usize,
}

impl Reader<'_> {
    fn here(&mut self) -> &mut Module {
        &mut self.tree.modules[self.module]
    }

    fn mention(&mut self, path: Vec<String>) {
        self.here().mentions.insert(path);
    }

    /// Names inside a macro call, where paths are tokens.
    fn read_tokens(&mut self, tokens: TokenStream) {
        let tokens: Vec<_> = tokens.into_iter().collect();
        let is = |place: usize, mark: char| match tokens.get(place) {
            Some(TokenTree::Punct(punct)) => punct.as_char() == mark,
            _ => false,
        };
        let mut place = 0;
        while place < tokens.len() {
            let mut path = Vec::new();
            let before = place.checked_sub(1);
            let is_member = before.is_some_and(|before| is(before, '.'));
            let is_variable = before.is_some_and(|before| is(before, '$'));
            match &tokens[place] {
                TokenTree::Group(group) => self.read_tokens(group.stream()),
                TokenTree::Ident(ident) => path.push(ident.to_string()),
                TokenTree::Punct(_) | TokenTree::Literal(_) => {}
            }
            place += 1;
            while !path.is_empty() && is(place, ':') && is(place + 1, ':') {
                let Some(TokenTree::Ident(ident)) = tokens.get(place + 2) else { break };
                path.push(ident.to_string());
                place += 3;
            }
            let is_name =
                !is_member && (!is_variable || path.first().is_some_and(|first| first == "crate"));
            if is_name && !path.is_empty() {
                self.mention(path);
            }
        }
    }

    fn read_use(&mut self, tree: &UseTree, before: &mut Vec<String>, is_reexport: bool) {
        match tree {
            UseTree::Path(part) => {
                before.push(part.ident.to_string());
                self.read_use(&part.tree, before, is_reexport);
                before.pop();
            }
            UseTree::Group(group) => {
                for tree in &group.items {
                    self.read_use(tree, before, is_reexport);
                }
            }
            UseTree::Glob(_) => self.import(None, before.clone(), true),
            UseTree::Name(last) => {
                let name = last.ident.to_string();
                self.import_as(&name, &name, before, is_reexport);
            }
            UseTree::Rename(last) => {
                self.import_as(
                    &last.rename.to_string(),
                    &last.ident.to_string(),
                    before,
                    is_reexport,
                );
            }
        }
    }

    fn import_as(&mut self, name: &str, last: &str, before: &[String], is_reexport: bool) {
        let mut path = before.to_vec();
        // `use a::b::{self}` imports `a::b`.
        let is_self = last == "self" && !path.is_empty();
        if !is_self {
            path.push(last.to_owned());
        }
        let name = if name == "self" { path.last().cloned() } else { Some(name.to_owned()) };
        self.import(name, path, is_reexport);
    }

    fn import(&mut self, name: Option<String>, path: Vec<String>, is_reexport: bool) {
        if !is_reexport {
            self.mention(path.clone());
        }
        self.here().imports.push(Import { name, path });
    }

    #[expect(
        clippy::wildcard_enum_match_arm,
        reason = "items without a name define none; syn may add kinds"
    )]
    fn define(&mut self, item: &Item) {
        let name = match item {
            Item::Const(item) => &item.ident,
            Item::Enum(item) => &item.ident,
            Item::Fn(item) => &item.sig.ident,
            Item::Static(item) => &item.ident,
            Item::Struct(item) => &item.ident,
            Item::Trait(item) => &item.ident,
            Item::TraitAlias(item) => &item.ident,
            Item::Type(item) => &item.ident,
            Item::Union(item) => &item.ident,
            Item::Macro(item) => {
                if let Some(name) = &item.ident {
                    let name = name.to_string();
                    self.here().macros.insert(name);
                }
                return;
            }
            _ => return,
        };
        let name = name.to_string();
        self.here().items.insert(name);
    }

    /// Reads a module that is a child of this one. Of two with one name, between which a feature chooses, other modules
    /// use the first.
    fn read_child(&mut self, child: &syn::ItemMod) {
        let name = child.ident.to_string();
        let (file, folder) = (self.here().file, self.here().folder.clone());
        let module = match &child.content {
            Some((_, items)) => {
                let module = self.tree.add(file, Some(self.module), folder.join(&name));
                let mut reader = Reader { tree: self.tree, module };
                for item in items {
                    reader.visit_item(item);
                }
                module
            }
            None => {
                let package = self.tree.files[file].package.clone();
                let path = path_of(child)
                    .map_or_else(|| child_path(folder.join(&name)), |path| folder.join(path));
                read_file(self.tree, &package, &path, Some(self.module))
            }
        };
        self.here().children.entry(name).or_insert(module);
    }
}

/// File of a module that is declared without a body.
fn child_path(place: PathBuf) -> PathBuf {
    let file = place.with_extension("rs");
    if file.exists() { file } else { place.join("mod.rs") }
}

/// What `#[path = "…"]` says.
fn path_of(child: &syn::ItemMod) -> Option<String> {
    child.attrs.iter().find_map(|attribute| {
        let Meta::NameValue(pair) = &attribute.meta else { return None };
        let Expr::Lit(value) = &pair.value else { return None };
        let Lit::Str(value) = &value.lit else { return None };
        pair.path.is_ident("path").then(|| value.value())
    })
}

/// Whether an item is there in tests alone.
pub(crate) fn is_test(attributes: &[Attribute]) -> bool {
    attributes.iter().any(|attribute| match &attribute.meta {
        Meta::List(list) => list.path.is_ident("cfg") && list.tokens.to_string() == "test",
        Meta::Path(path) => path.is_ident("test"),
        Meta::NameValue(_) => false,
    })
}

/// Attributes of an item of a module.
#[expect(clippy::wildcard_enum_match_arm, reason = "other kinds define nothing; syn may add some")]
pub(crate) fn attributes(item: &Item) -> &[Attribute] {
    match item {
        Item::Const(item) => &item.attrs,
        Item::Enum(item) => &item.attrs,
        Item::Fn(item) => &item.attrs,
        Item::Impl(item) => &item.attrs,
        Item::Macro(item) => &item.attrs,
        Item::Mod(item) => &item.attrs,
        Item::Static(item) => &item.attrs,
        Item::Struct(item) => &item.attrs,
        Item::Trait(item) => &item.attrs,
        Item::Type(item) => &item.attrs,
        Item::Use(item) => &item.attrs,
        _ => &[],
    }
}

impl<'ast> Visit<'ast> for Reader<'_> {
    fn visit_item(&mut self, item: &'ast Item) {
        if is_test(attributes(item)) {
            return;
        }
        self.define(item);
        visit::visit_item(self, item);
    }

    fn visit_item_mod(&mut self, item: &'ast syn::ItemMod) {
        self.read_child(item);
    }

    fn visit_item_use(&mut self, item: &'ast syn::ItemUse) {
        let is_reexport = !matches!(item.vis, Visibility::Inherited);
        self.read_use(&item.tree, &mut Vec::new(), is_reexport);
    }

    fn visit_path(&mut self, path: &'ast syn::Path) {
        let names = path.segments.iter().map(|segment| segment.ident.to_string());
        self.mention(names.collect());
        visit::visit_path(self, path);
    }

    fn visit_visibility(&mut self, _visibility: &'ast Visibility) {}

    fn visit_attribute(&mut self, attribute: &'ast Attribute) {
        if let Meta::List(list) = &attribute.meta
            && !["cfg", "cfg_attr", "derive", "expect"].iter().any(|name| list.path.is_ident(name))
        {
            self.read_tokens(list.tokens.clone());
        }
    }

    fn visit_macro(&mut self, call: &'ast syn::Macro) {
        let mut path: Vec<_> =
            call.path.segments.iter().map(|segment| segment.ident.to_string()).collect();
        if let Some(name) = path.last_mut() {
            name.push('!');
        }
        self.mention(path);
        self.read_tokens(call.tokens.clone());
    }
}
