//! Reads `src/` with a Rust parser: which file names what of which other file.

use std::collections::BTreeMap;
use std::path::Path;

use syn::visit::{self, Visit};
use syn::{Item, ItemMod, UseTree};

/// A module: its file, what it defines, and the paths that it hands on by `pub use`.
#[derive(Default)]
struct Module {
    file: String,
    /// Types, traits and aliases.
    types: Vec<String>,
    /// Everything that has a name.
    names: Vec<String>,
    handed_on: BTreeMap<String, Vec<String>>,
    /// Absolute paths that the module names, besides what it hands on.
    paths: Vec<Vec<String>>,
}

/// All modules of the crate by their path, such as `crate::mind::motor`; tests are left out.
pub struct House {
    modules: BTreeMap<String, Module>,
    arrows: Vec<(String, String, String)>,
}

/// Reads the crate in which this test stands.
pub fn read_house() -> House {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut modules = BTreeMap::new();
    read_module(&root, &root.join("lib.rs"), "crate", &mut modules);
    let arrows = modules.values().flat_map(|module: &Module| {
        module.paths.iter().filter_map(|path| {
            let (file, name) = find(&modules, path, 0)?;
            (file != module.file).then(|| (module.file.clone(), file.to_owned(), name.to_owned()))
        })
    });
    let arrows = arrows.collect();
    House { modules, arrows }
}

impl House {
    /// Who imports from whom, and what: two files of `src/` and a name.
    pub fn arrows(&self) -> impl Iterator<Item = (&str, &str, &str)> {
        self.arrows.iter().map(|(from, to, name)| (from.as_str(), to.as_str(), name.as_str()))
    }

    /// Every path that a file names, written from the crate's root or from another crate's.
    pub fn paths(&self) -> impl Iterator<Item = (&str, String)> {
        let of = |module: &'_ Module| module.paths.iter().map(|path| path.join("::")).collect::<Vec<_>>();
        self.modules
            .values()
            .flat_map(move |module| of(module).into_iter().map(|path| (module.file.as_str(), path)))
    }

    /// Every type, trait and alias, with its file.
    pub fn types(&self) -> impl Iterator<Item = (&str, &str)> {
        (self.modules.values())
            .flat_map(|module| module.types.iter().map(|name| (module.file.as_str(), name.as_str())))
    }

    /// The room of a file: the first folder, or the file's own name; nothing for `lib.rs`.
    pub fn room(file: &str) -> &str {
        match file.split_once('/') {
            Some((room, _)) => room,
            None if file == "lib.rs" => "",
            None => file.trim_end_matches(".rs"),
        }
    }
}

fn read_module(root: &Path, file: &Path, path: &str, modules: &mut BTreeMap<String, Module>) {
    let text = std::fs::read_to_string(file).expect("a module's file can be read");
    let parsed = syn::parse_file(&text).expect("a module's file is Rust");
    let name = file.strip_prefix(root).expect("it lies in src").to_string_lossy().replace('\\', "/");
    read_items(root, file, path, &name, &parsed.items, modules);
}

fn read_items(
    root: &Path,
    file: &Path,
    path: &str,
    name: &str,
    items: &[Item],
    modules: &mut BTreeMap<String, Module>,
) {
    let mut reader = Reader {
        at: path.split("::").map(str::to_owned).collect(),
        module: Module::default(),
        locals: BTreeMap::new(),
    };
    reader.module.file = name.to_owned();
    let children: Vec<&ItemMod> = items.iter().filter_map(as_module).collect();
    for child in &children {
        reader
            .locals
            .insert(child.ident.to_string(), [reader.at.clone(), vec![child.ident.to_string()]].concat());
    }
    for item in items.iter().filter(|item| !is_for_tests(attributes(item))) {
        if let Item::Use(item) = item {
            reader.read_use(item);
        }
    }
    for item in items.iter().filter(|item| !is_for_tests(attributes(item))) {
        if !matches!(item, Item::Use(_) | Item::Mod(_)) {
            reader.note_name(item);
            reader.visit_item(item);
        }
    }
    for child in children {
        let inner = format!("{path}::{}", child.ident);
        match &child.content {
            Some((_, items)) => read_items(root, file, &inner, name, items, modules),
            None => {
                let folder = match file.file_stem().and_then(|stem| stem.to_str()) {
                    Some("mod" | "lib") => file.parent().expect("it lies in a folder").to_owned(),
                    _ => file.with_extension(""),
                };
                let beside = folder.join(format!("{}.rs", child.ident));
                let below = folder.join(child.ident.to_string()).join("mod.rs");
                read_module(root, if beside.exists() { &beside } else { &below }, &inner, modules);
            }
        }
    }
    modules.insert(path.to_owned(), reader.module);
}

/// A module that is not for tests.
fn as_module(item: &Item) -> Option<&ItemMod> {
    match item {
        Item::Mod(module) if !is_for_tests(&module.attrs) => Some(module),
        _ => None,
    }
}

fn is_for_tests(attributes: &[syn::Attribute]) -> bool {
    attributes.iter().any(|attribute| {
        attribute.path().is_ident("cfg")
            && attribute.meta.require_list().is_ok_and(|list| list.tokens.to_string() == "test")
    })
}

fn attributes(item: &Item) -> &[syn::Attribute] {
    match item {
        Item::Use(item) => &item.attrs,
        Item::Mod(item) => &item.attrs,
        Item::Fn(item) => &item.attrs,
        Item::Impl(item) => &item.attrs,
        Item::Struct(item) => &item.attrs,
        Item::Enum(item) => &item.attrs,
        Item::Const(item) => &item.attrs,
        _ => &[],
    }
}

/// Collects what one module names.
struct Reader {
    at: Vec<String>,
    module: Module,
    /// What a first segment stands for: child modules and imports.
    locals: BTreeMap<String, Vec<String>>,
}

impl Reader {
    fn read_use(&mut self, item: &syn::ItemUse) {
        let hands_on = !matches!(item.vis, syn::Visibility::Inherited);
        let mut leaves = Vec::new();
        flatten(&item.tree, &mut Vec::new(), &mut leaves);
        for (path, name) in leaves {
            let path = self.absolute(path);
            if hands_on {
                self.module.handed_on.insert(name.clone(), path.clone());
            } else {
                self.module.paths.push(path.clone());
            }
            self.locals.insert(name, path);
        }
    }

    /// A path written from the root: of this crate, or of the crate that it begins with.
    fn absolute(&self, path: Vec<String>) -> Vec<String> {
        match path[0].as_str() {
            "crate" => path,
            "self" => [&self.at[..], &path[1..]].concat(),
            "super" => {
                let ups = path.iter().take_while(|segment| *segment == "super").count();
                [&self.at[..self.at.len().saturating_sub(ups)], &path[ups..]].concat()
            }
            first => match self.locals.get(first) {
                Some(stands_for) => [&stands_for[..], &path[1..]].concat(),
                None => path,
            },
        }
    }

    fn note_name(&mut self, item: &Item) {
        let (name, is_type) = match item {
            Item::Struct(item) => (&item.ident, true),
            Item::Enum(item) => (&item.ident, true),
            Item::Trait(item) => (&item.ident, true),
            Item::Type(item) => (&item.ident, true),
            Item::Fn(item) => (&item.sig.ident, false),
            Item::Const(item) => (&item.ident, false),
            Item::Static(item) => (&item.ident, false),
            _ => return,
        };
        self.module.names.push(name.to_string());
        if is_type {
            self.module.types.push(name.to_string());
        }
    }
}

impl<'ast> Visit<'ast> for Reader {
    fn visit_path(&mut self, path: &'ast syn::Path) {
        let segments: Vec<String> = path.segments.iter().map(|segment| segment.ident.to_string()).collect();
        let is_import = segments.len() == 1 && !self.locals.contains_key(&segments[0]);
        if !is_import {
            self.module.paths.push(self.absolute(segments));
        }
        visit::visit_path(self, path);
    }
}

/// The leaves of a tree of imports, each with the name that it gets.
fn flatten(tree: &UseTree, before: &mut Vec<String>, leaves: &mut Vec<(Vec<String>, String)>) {
    match tree {
        UseTree::Path(path) => {
            before.push(path.ident.to_string());
            flatten(&path.tree, before, leaves);
            before.pop();
        }
        UseTree::Name(name) if name.ident == "self" => {
            leaves.push((before.clone(), before.last().cloned().unwrap_or_default()));
        }
        UseTree::Name(name) => {
            leaves.push(([&before[..], &[name.ident.to_string()]].concat(), name.ident.to_string()));
        }
        UseTree::Rename(rename) => {
            leaves.push(([&before[..], &[rename.ident.to_string()]].concat(), rename.rename.to_string()));
        }
        UseTree::Glob(_) => leaves.push((before.clone(), "*".to_owned())),
        UseTree::Group(group) => group.items.iter().for_each(|tree| flatten(tree, before, leaves)),
    }
}

/// The file that defines what an absolute path names, and the name. Follows what modules hand on.
fn find<'a>(
    modules: &'a BTreeMap<String, Module>,
    path: &'a [String],
    depth: usize,
) -> Option<(&'a str, &'a str)> {
    if path.first().map(String::as_str) != Some("crate") || depth > 8 {
        return None;
    }
    let known = (1..=path.len()).rev().find(|end| modules.contains_key(&path[..*end].join("::")))?;
    let module = &modules[&path[..known].join("::")];
    let name = path.get(known)?;
    match module.handed_on.get(name) {
        Some(target) => find(modules, target, depth + 1),
        None if module.names.contains(name) => Some((&module.file, name)),
        None => None,
    }
}
