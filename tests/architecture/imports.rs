//! No import circles: which file uses names of which file, and no way back.
//!
//! Every `use` and every path in the code is resolved to the file that defines the name. A re-export
//! (`pub use`, of any visibility) passes names on without depending on them: who uses a re-exported name
//! depends on the file that defines it, not on the file that re-exports it. A file that uses in its own code
//! a name it re-exports depends on it as on any other. `mod x;` and a path that ends at a module are no
//! dependency; neither are methods, which are found by the compiler through their type.

use std::collections::{BTreeMap, BTreeSet, VecDeque};

use super::{Source, crate_of, sources};

/// One name brought into a module: under which name (`*` for all), the path, and whether it is re-exported.
struct Import {
    name: String,
    path: Vec<String>,
    exported: bool,
}

/// What one file declares and uses. Paths of modules start with the crate: `rotordyn_…`, or `lib` and `main` of the root.
struct Module {
    file: usize,
    items: BTreeSet<String>,
    imports: Vec<Import>,
    paths: Vec<Vec<String>>,
}

/// Identifiers, `::` and single punctuation characters; comments, strings and numbers are left out.
fn tokens(text: &str) -> Vec<String> {
    let chars: Vec<char> = text.chars().collect();
    let at = |k: usize| chars.get(k).copied().unwrap_or('\0');
    let is_name = |c: char| c.is_alphanumeric() || c == '_';
    let mut found = Vec::new();
    let mut k = 0;
    while k < chars.len() {
        let c = chars[k];
        let raw_at = k + usize::from(c == 'b');
        let hashes = chars[(raw_at + 1).min(chars.len())..].iter().take_while(|&&c| c == '#').count();
        if c == '/' && at(k + 1) == '/' {
            k += chars[k..].iter().take_while(|&&c| c != '\n').count();
        } else if c == '/' && at(k + 1) == '*' {
            k += 2 + (k + 2..chars.len()).take_while(|&j| !(at(j) == '*' && at(j + 1) == '/')).count() + 2;
        } else if (c == 'r' || c == 'b') && at(raw_at) == 'r' && at(raw_at + 1 + hashes) == '"' {
            let ends = |j: usize| at(j) == '"' && (1..=hashes).all(|h| at(j + h) == '#');
            k = raw_at + hashes + 2;
            k += (k..chars.len()).take_while(|&j| !ends(j)).count() + 1 + hashes;
        } else if c == '"' {
            k += 1;
            while k < chars.len() && chars[k] != '"' {
                k += if chars[k] == '\\' { 2 } else { 1 };
            }
            k += 1;
        } else if c == '\'' && at(k + 1) == '\\' {
            k += 3 + (k + 3..chars.len()).take_while(|&j| at(j) != '\'').count() + 1;
        } else if c == '\'' && at(k + 2) == '\'' {
            k += 3;
        } else if c.is_alphanumeric() || c == '_' {
            let name: String = chars[k..].iter().take_while(|&&c| is_name(c)).collect();
            k += name.chars().count();
            found.push(name);
        } else if c == ':' && at(k + 1) == ':' {
            found.push("::".into());
            k += 2;
        } else {
            if !c.is_whitespace() {
                found.push(c.to_string());
            }
            k += 1;
        }
    }
    found
}

fn is_identifier(token: &str) -> bool {
    token.starts_with(|c: char| c.is_alphabetic() || c == '_')
}

/// The imports of one `use` tree that starts at token `k` with `prefix` before it; the index after it.
fn use_tree(
    tokens: &[String],
    mut k: usize,
    prefix: &[String],
    exported: bool,
    into: &mut Vec<Import>,
) -> usize {
    let mut path = prefix.to_vec();
    loop {
        match tokens[k].as_str() {
            "::" => k += 1,
            "{" => {
                k += 1;
                while tokens[k] != "}" {
                    k = use_tree(tokens, k, &path, exported, into);
                    k += usize::from(tokens[k] == ",");
                }
                return k + 1;
            }
            "*" => {
                into.push(Import { name: "*".into(), path, exported });
                return k + 1;
            }
            name => {
                if name != "self" || path.is_empty() {
                    path.push(name.into());
                }
                k += 1;
                if tokens[k] != "::" {
                    let renamed = tokens[k] == "as";
                    let name = if renamed { &tokens[k + 1] } else { &path[path.len() - 1] };
                    into.push(Import { name: name.clone(), path: path.clone(), exported });
                    return k + 2 * usize::from(renamed);
                }
            }
        }
    }
}

impl Module {
    /// Reads the items, imports and used paths of a file. The unit tests in it are part of it.
    fn read(file: usize, text: &str) -> Self {
        let mut tokens = tokens(text);
        // `super` inside the inline test module is the file itself.
        if let Some(start) = tokens.windows(3).position(|w| w[0] == "mod" && w[1] == "tests" && w[2] == "{") {
            for k in start..tokens.len() - 1 {
                if tokens[k] == "super" && tokens[k - 1] != "::" {
                    tokens[k] = "self".into();
                }
            }
        }
        let mut module = Self { file, items: BTreeSet::new(), imports: Vec::new(), paths: Vec::new() };
        let (mut depth, mut k) = (0, 0);
        while k < tokens.len() {
            let before = if k > 0 { tokens[k - 1].as_str() } else { "" };
            match tokens[k].as_str() {
                "{" => depth += 1,
                "}" => depth -= 1,
                "use" => {
                    let exported = before == "pub" || before == ")";
                    k = use_tree(&tokens, k + 1, &[], exported, &mut module.imports);
                    continue;
                }
                "fn" | "struct" | "enum" | "trait" | "const" | "static" | "type" if depth == 0 => {
                    module.items.insert(tokens[k + 1].clone());
                }
                name if is_identifier(name) && ![".", "::", "mod"].contains(&before) => {
                    let mut path = vec![name.to_string()];
                    while k + 2 < tokens.len() && tokens[k + 1] == "::" && is_identifier(&tokens[k + 2]) {
                        path.push(tokens[k + 2].clone());
                        k += 2;
                    }
                    module.paths.push(path);
                }
                _ => {}
            }
            k += 1;
        }
        module
    }
}

/// All modules by their path.
struct Modules(BTreeMap<Vec<String>, Module>);

/// What a path leads to.
enum Target {
    Module,
    Item(usize),
}

impl Modules {
    fn read(sources: &[Source]) -> Self {
        let path = |file: &str| {
            let (name, file) = crate_of(file);
            let stem = file.trim_end_matches(".rs").trim_end_matches("/mod");
            let root = match name {
                "" if stem == "main" || stem.starts_with("cli") => "main".into(),
                "" => "lib".into(),
                name => name.replace('-', "_"),
            };
            let below = if ["main", "lib"].contains(&stem) { "" } else { stem };
            let modules = below.split('/').filter(|s| !s.is_empty()).map(String::from);
            std::iter::once(root).chain(modules).collect()
        };
        let read = |(k, source): (usize, &Source)| (path(&source.path), Module::read(k, &source.text));
        Self(sources.iter().enumerate().map(read).collect())
    }

    /// Where `path`, written in the module `from`, leads to; nothing for names of other crates and locals.
    fn resolve(
        &self,
        from: &[String],
        path: &[String],
        seen: &mut Vec<(Vec<String>, String)>,
    ) -> Option<Target> {
        let mut at = from.to_vec();
        let mut rest = path;
        while let Some((first, others)) = rest.split_first() {
            match first.as_str() {
                "crate" => at.truncate(1),
                "rotordyn" => at = vec!["lib".into()],
                "super" => at.truncate(at.len() - 1),
                "self" => {}
                name if self.0.contains_key(&[name.to_string()][..]) => at = vec![name.into()],
                name => return self.find(&at, name, others, seen),
            }
            rest = others;
        }
        Some(Target::Module)
    }

    fn find(
        &self,
        at: &[String],
        name: &str,
        others: &[String],
        seen: &mut Vec<(Vec<String>, String)>,
    ) -> Option<Target> {
        let child = [at, &[name.to_string()]].concat();
        let is_module = self.0.contains_key(&child);
        if let (true, Some((next, others))) = (is_module, others.split_first()) {
            return self.find(&child, next, others, seen);
        }
        let key = (at.to_vec(), name.to_string());
        if seen.contains(&key) {
            return None;
        }
        let module = &self.0[at];
        if module.items.contains(name) {
            return Some(Target::Item(module.file));
        }
        seen.push(key);
        let named = module.imports.iter().filter(|i| i.name == name).map(|i| [&i.path[..], others].concat());
        let all = module.imports.iter().filter(|i| i.name == "*");
        let all = all.map(|i| [&i.path[..], &[name.to_string()], others].concat());
        let found = named.chain(all).find_map(|path| self.resolve(at, &path, seen));
        seen.pop();
        // A module and a function may share a name.
        found.or(is_module.then_some(Target::Module))
    }

    /// The files each file depends on.
    fn edges(&self) -> Vec<BTreeSet<usize>> {
        let mut edges = vec![BTreeSet::new(); self.0.len()];
        for (at, module) in &self.0 {
            let imports = module.imports.iter().filter(|i| !i.exported && i.name != "*").map(|i| &i.path);
            for path in imports.chain(&module.paths) {
                if let Some(Target::Item(file)) = self.resolve(at, path, &mut Vec::new()) {
                    edges[module.file].insert(file);
                }
            }
            edges[module.file].remove(&module.file);
        }
        edges
    }
}

/// The shortest way along `edges` from `start` back to it.
fn way_round(edges: &[BTreeSet<usize>], start: usize) -> Option<Vec<usize>> {
    let mut before = BTreeMap::new();
    let mut queue = VecDeque::from([start]);
    while let Some(at) = queue.pop_front() {
        for &next in &edges[at] {
            if next == start {
                let mut way = vec![start, at];
                while way[way.len() - 1] != start {
                    way.push(before[&way[way.len() - 1]]);
                }
                way.reverse();
                return Some(way);
            }
            before.entry(next).or_insert_with(|| {
                queue.push_back(next);
                at
            });
        }
    }
    None
}

/// The files reachable from `start`.
fn reachable(edges: &[BTreeSet<usize>], start: usize) -> BTreeSet<usize> {
    let mut found = BTreeSet::new();
    let mut stack = vec![start];
    while let Some(at) = stack.pop() {
        stack.extend(edges[at].iter().filter(|&&next| found.insert(next)));
    }
    found
}

/// Each circle: the files that reach each other, and one shortest way round.
fn circles(edges: &[BTreeSet<usize>]) -> Vec<(Vec<usize>, Vec<usize>)> {
    let from: Vec<_> = (0..edges.len()).map(|k| reachable(edges, k)).collect();
    let mut found: Vec<(Vec<usize>, Vec<usize>)> = Vec::new();
    for start in 0..edges.len() {
        if from[start].contains(&start) && !found.iter().any(|(files, _)| files.contains(&start)) {
            let files: Vec<_> = from[start].iter().copied().filter(|&k| from[k].contains(&start)).collect();
            let ways = files.iter().filter_map(|&k| way_round(edges, k));
            found.push((files.clone(), ways.min_by_key(Vec::len).unwrap_or_default()));
        }
    }
    found
}

fn report(sources: &[Source]) -> Vec<String> {
    let name = |k: &usize| sources[*k].path.as_str();
    let line = |(files, way): &(Vec<usize>, Vec<usize>)| {
        let names: Vec<_> = files.iter().map(name).collect();
        let way: Vec<_> = way.iter().map(name).collect();
        format!("{} files: {}\n    {}", files.len(), names.join(", "), way.join(" -> "))
    };
    circles(&Modules::read(sources).edges()).iter().map(line).collect()
}

#[test]
fn files_do_not_import_each_other_in_circles() {
    let found = report(&sources());
    assert!(found.is_empty(), "{} import circles:\n{}", found.len(), found.join("\n"));
}

/// The circles of made-up sources, each given as path and text.
fn circles_of(files: &[(&str, &str)]) -> Vec<String> {
    let source = |&(path, text): &(&str, &str)| Source::new(path.into(), text.into());
    report(&files.iter().map(source).collect::<Vec<_>>())
}

#[test]
fn circles_are_found_through_every_kind_of_path() {
    let ways_back = [
        "use crate::a::A;",
        "use crate::{a::{self, A as B}};",
        "fn f() { crate::a::A::new() }",
        "use super::a; fn f(x: &[a::A]) {}",
        "use super::a::*; fn f(x: A) {}",
        "use super::A;",
        "mod tests { use super::super::a::A; }",
        "fn f() { let s = \"/*\"; let c = '\"'; super::a::A } // \"",
    ];
    for way in ways_back {
        let files = [
            ("lib.rs", "pub mod a; pub mod b; pub use a::A;"),
            ("a.rs", "use crate::b::B; pub struct A;"),
            ("b.rs", &format!("{way}\n pub struct B;")),
        ];
        assert_eq!(circles_of(&files), ["2 files: a.rs, b.rs\n    a.rs -> b.rs -> a.rs"], "{way}");
    }
    // Through another crate's root and its re-exports.
    let crates = [
        ("lib.rs", "pub use rotordyn_b::b;"),
        ("rotordyn-b/lib.rs", "pub mod b; mod c; pub use c::C;"),
        ("rotordyn-b/b.rs", "use crate::C; pub struct B;"),
        ("rotordyn-b/c.rs", "fn f(_: rotordyn_b::b::B) {} pub struct C;"),
    ];
    assert_eq!(circles_of(&crates).len(), 1);
    // Through a function named as the module that it is in.
    let namesake = [
        ("lib.rs", "pub mod dot; mod b; pub use dot::dot;"),
        ("dot.rs", "use crate::b::B; pub fn dot() {}"),
        ("b.rs", "use crate::dot; pub struct B;"),
    ];
    assert_eq!(circles_of(&namesake).len(), 1);
    // Between a folder's mod.rs and a file in it, and between the binary and the library's names.
    let hub =
        [("lib.rs", ""), ("a/mod.rs", "mod c; use c::C; struct A;"), ("a/c.rs", "use super::A; struct C;")];
    assert_eq!(circles_of(&hub).len(), 1);
    let binary = [
        ("lib.rs", "pub struct L;"),
        ("main.rs", "mod cli;"),
        ("cli/mod.rs", "mod x; use rotordyn::L; pub struct F; fn f() { x::X }"),
        ("cli/x.rs", "use super::F; pub struct X;"),
    ];
    assert_eq!(circles_of(&binary).len(), 1);
}

#[test]
fn downward_imports_and_re_exports_are_no_circles() {
    let texts = [
        // Re-exports resolve to the file that defines the name.
        ("a/mod.rs", "mod c; mod d; pub use c::C; pub(crate) use d::D;"),
        ("a/c.rs", "use super::D; /// See [`super::A`].\n pub struct C;"),
        // Comments, strings, fields and methods are no imports.
        (
            "a/d.rs",
            "pub struct D { x: &'static str } // crate::a::C \n fn f(d: D) { d.C(); \"crate::a::C\" }",
        ),
        ("lib.rs", "pub mod a; pub mod e;"),
        ("e.rs", "use crate::a::{C, D}; mod tests { use super::E; } struct E;"),
    ];
    assert_eq!(circles_of(&texts), [""; 0]);
}
