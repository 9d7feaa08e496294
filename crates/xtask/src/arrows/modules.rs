//! The files of a crate as modules, and which of them use which.

use std::collections::{BTreeMap, BTreeSet};

use super::tokens::{self, Path};
use crate::sources::Source;

/// Maximum number of imports through which an import is followed; after that the path is ignored.
const HOPS: usize = 8;

/// The files of one crate below `src`, by the path of their module.
pub(super) struct Modules<'a> {
    by_path: BTreeMap<Path, Module<'a>>,
}

struct Module<'a> {
    file: &'a str,
    /// Names from `use`, including private ones, as a child module sees them.
    imports: BTreeMap<String, Path>,
    /// Paths that this file needs: private imports, and paths in its code, without re-exports.
    needs: Vec<Path>,
}

impl<'a> Modules<'a> {
    /// The code of a crate. Files that exist only for tests are left out.
    pub(super) fn of(crate_name: &str, sources: &'a [Source]) -> Self {
        let folder = format!("crates/{crate_name}/src/");
        let file = |source: &'a Source| {
            let file = source.path.strip_prefix(&folder)?.strip_suffix(".rs")?;
            (!source.is_test()).then(|| (module_path(file), module(source)))
        };
        Self { by_path: sources.iter().filter_map(file).collect() }
    }

    /// The arrows between files: the first uses something in the second.
    pub(super) fn arrows(&self) -> BTreeSet<(&'a str, &'a str)> {
        let targets = |(at, module): (&Path, &Module<'a>)| {
            let named = module.needs.iter().filter_map(|path| self.resolve(at, path, HOPS));
            let from = module.file;
            named.map(move |to| (from, to)).collect::<Vec<_>>()
        };
        self.by_path.iter().flat_map(targets).filter(|(from, to)| from != to).collect()
    }

    /// The file in which a path ends that is written in the module `at`; none if it is in another crate.
    fn resolve(&self, at: &Path, path: &[String], hops: usize) -> Option<&'a str> {
        let (mut module, rest) = self.start(at, path)?;
        for (done, name) in rest.iter().enumerate() {
            let child = [module.as_slice(), core::slice::from_ref(name)].concat();
            if self.by_path.contains_key(&child) {
                module = child;
            } else if let Some(import) = self.by_path.get(&module)?.imports.get(name).filter(|_| hops > 0) {
                let through = [import.as_slice(), &rest[done + 1..]].concat();
                return self.resolve(&module, &through, hops - 1);
            } else {
                break;
            }
        }
        self.by_path.get(&module).map(|module| module.file)
    }

    /// The module in which a path begins, and the rest of the path.
    fn start<'p>(&self, at: &Path, path: &'p [String]) -> Option<(Path, &'p [String])> {
        let (first, mut rest) = path.split_first()?;
        let mut module = match first.as_str() {
            "crate" => Vec::new(),
            "self" => at.clone(),
            "super" => parent(at)?,
            name => {
                let child = [at.as_slice(), &[name.to_string()]].concat();
                return self.by_path.contains_key(&child).then_some((child, rest));
            }
        };
        while let Some(("super", behind)) = rest.split_first().map(|(name, rest)| (name.as_str(), rest)) {
            (module, rest) = (parent(&module)?, behind);
        }
        Some((module, rest))
    }
}

fn parent(module: &Path) -> Option<Path> {
    module.split_last().map(|(_, parent)| parent.to_vec())
}

/// `lib` and `main` are the root, `a/mod` is `a`.
fn module_path(file: &str) -> Path {
    let mut path: Path = file.split('/').map(String::from).collect();
    if path.last().is_some_and(|last| ["lib", "main", "mod"].contains(&last.as_str())) {
        path.pop();
    }
    path
}

fn module(source: &Source) -> Module<'_> {
    let lines: Vec<&str> = source.code_lines().map(|(_, line)| line).collect();
    let code = lines.join("\n");
    let tokens = tokens::of(&code);
    let (mut imports, mut needs) = (BTreeMap::new(), Vec::new());
    let mut at = 0;
    while let Some(token) = tokens.get(at) {
        if *token == "use" {
            let mut found = Vec::new();
            let end = tokens::tree(&tokens, at + 1, &[], &mut found);
            if !tokens::is_public(&tokens[..at]) {
                needs.extend(found.iter().map(|(_, path)| path.clone()));
            }
            imports.extend(found);
            at = end;
        } else {
            let path = tokens::path(&tokens[at..]);
            at += (2 * path.len()).saturating_sub(1).max(1);
            if path.len() > 1 {
                needs.push(path);
            }
        }
    }
    Module { file: &source.path, imports, needs }
}
