//! From a path that a module writes to the file that defines the item.

use super::modules::{Import, Module, Tree};

/// Imports that lead to imports: no chain in readable code is longer.
const CHAIN_MAX: usize = 40;

/// What a path leads to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Found {
    /// A module.
    Module(usize),
    /// An item that this module defines.
    Item(usize),
}

/// Edges between files (from, to, name), by their places in the tree; to the file itself included.
pub(super) fn edges(tree: &Tree) -> Vec<(usize, usize, String)> {
    let resolver = Resolver { tree };
    let mut found = Vec::new();
    for (place, module) in tree.modules.iter().enumerate() {
        let children = module.imports.iter().filter(|import| resolver.is_of_another(place, import));
        for path in module.mentions.iter().chain(children.map(|import| &import.path)) {
            if let Some(to) = resolver.definition(place, path) {
                found.push((module.file, tree.modules[to].file, plain(path)));
            }
        }
    }
    found
}

/// The name of the item that a path leads to: the first in capitals, since what follows belongs to it, or the last.
fn plain(path: &[String]) -> String {
    let item = path.iter().find(|name| name.starts_with(char::is_uppercase));
    item.or(path.last()).cloned().unwrap_or_default()
}

struct Resolver<'a> {
    tree: &'a Tree,
}

impl Resolver<'_> {
    fn module(&self, place: usize) -> &Module {
        &self.tree.modules[place]
    }

    /// Whether an import is no re-export of a child's item.
    fn is_of_another(&self, place: usize, import: &Import) -> bool {
        let first = import.path.iter().find(|name| *name != "self");
        let is_child = first.is_some_and(|first| self.module(place).children.contains_key(first));
        import.name.is_some() && !is_child
    }

    /// The module that defines what a path names; none for a module, or for an item of a foreign crate.
    fn definition(&self, from: usize, path: &[String]) -> Option<usize> {
        let mut path = path.to_vec();
        let called = path.last_mut().and_then(|last| last.ends_with('!').then(|| last.pop()));
        if called.is_some()
            && let [name] = path.as_slice()
            && let Some(place) = self.macro_place(from, name)
        {
            return Some(place);
        }
        match self.resolve(from, &path, 0)? {
            Found::Item(place) => Some(place),
            Found::Module(_) => None,
        }
    }

    /// The module of a `macro_rules!`, which is in scope by its place in the text.
    fn macro_place(&self, from: usize, name: &str) -> Option<usize> {
        let root = self.module(from).root;
        let modules = self.tree.modules.iter().enumerate();
        let mut with =
            modules.filter(|(_, module)| module.root == root && module.macros.contains(name));
        with.next().map(|(place, _)| place)
    }

    fn resolve(&self, from: usize, path: &[String], depth: usize) -> Option<Found> {
        let (first, rest) = path.split_first()?;
        let start = match first.as_str() {
            "crate" => Found::Module(self.module(from).root),
            "self" => Found::Module(from),
            "super" => Found::Module(self.module(from).parent?),
            name => self
                .lookup(from, name, rest.is_empty(), depth)
                .or_else(|| self.tree.libraries.get(name).copied().map(Found::Module))?,
        };
        self.follow(start, rest, depth)
    }

    /// Follows the rest of a path; what is beyond an item (a variant, a method) belongs to it.
    fn follow(&self, start: Found, rest: &[String], depth: usize) -> Option<Found> {
        let (Found::Module(module), Some((name, rest))) = (start, rest.split_first()) else {
            return Some(start);
        };
        let next = match name.as_str() {
            "super" => Found::Module(self.module(module).parent?),
            "self" => start,
            // What nothing defines in the text comes from a macro that is called there.
            name => {
                self.lookup(module, name, rest.is_empty(), depth).unwrap_or(Found::Item(module))
            }
        };
        self.follow(next, rest, depth)
    }

    /// What a name means inside a module.
    fn lookup(&self, place: usize, name: &str, is_last: bool, depth: usize) -> Option<Found> {
        if depth > CHAIN_MAX {
            return None;
        }
        let module = self.module(place);
        let child = module.children.get(name).copied().map(Found::Module);
        let item = module.items.contains(name).then_some(Found::Item(place));
        let own = if is_last { item.or(child) } else { child.or(item) };
        own.or_else(|| self.imported(place, name, depth)).or_else(|| {
            let library = self.tree.libraries.values().any(|library| *library == place);
            if library { self.macro_place(place, name).map(Found::Item) } else { None }
        })
    }

    fn imported(&self, place: usize, name: &str, depth: usize) -> Option<Found> {
        let imports = &self.module(place).imports;
        let named = imports.iter().filter(|import| import.name.as_deref() == Some(name));
        let mut named = named.filter_map(|import| self.resolve_import(place, import, name, depth));
        let globs = imports.iter().filter(|import| import.name.is_none());
        let mut globs =
            globs.filter_map(|import| match self.resolve_import(place, import, name, depth)? {
                Found::Module(module) if module != place => {
                    self.lookup(module, name, true, depth + 1)
                }
                Found::Module(_) | Found::Item(_) => None,
            });
        named.next().or_else(|| globs.next())
    }

    /// What an import leads to; `use name::…` means the crate of that name where the module has nothing else.
    fn resolve_import(
        &self,
        place: usize,
        import: &Import,
        name: &str,
        depth: usize,
    ) -> Option<Found> {
        let (first, rest) = import.path.split_first()?;
        let is_itself = first == name && !self.module(place).children.contains_key(name);
        if is_itself {
            let library = self.tree.libraries.get(first).copied().map(Found::Module)?;
            return self.follow(library, rest, depth + 1);
        }
        self.resolve(place, &import.path, depth + 1)
    }
}
