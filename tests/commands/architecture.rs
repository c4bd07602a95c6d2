//! Consistency check of the source tree: a module names only lower floors, siblings do not name each other, no files
//! name each other in a circle, and no room has more lines than its budget.

use crate::prelude::*;

/// Modules by floor, lowest first.
const FLOORS: [&[&str]; 11] = [
    &["order", "parallel"],
    &["mesh"],
    &["fem"],
    &["contact"],
    &["prestress"],
    &["cea", "transient", "frf"],
    &["cycle"],
    &["case", "results"],
    &["study"],
    &["app"],
    &["guide"],
];

fn floor_of(module: &str) -> Option<usize> {
    FLOORS.iter().position(|floor| floor.contains(&module))
}

/// Folder of the physics, which is a crate of its own.
const PHYSICS: &str = "crates/physics/src";
/// Folders of the tree of modules, and the module that each is: cases, results and studies are crates of their own.
const TREES: [(&str, &str); 5] = [
    ("src", ""),
    (PHYSICS, ""),
    ("crates/case/src", "case"),
    ("crates/results/src", "results"),
    ("crates/study/src", "study"),
];

/// Whether a module is a crate: `crate::` is what lies in it.
fn is_crate(module: &str) -> bool {
    TREES.iter().any(|(_, own)| *own == module)
}

/// The Rust files below a folder of the repository.
pub fn rust_files(folder: impl AsRef<Path>) -> Vec<PathBuf> {
    let mut files = files_below(&repository().join(folder));
    files.retain(|path| path.extension().is_some_and(|extension| extension == "rs"));
    files
}

/// Lines of Rust that each room may have, tests not counted: budgets only fall. A change that makes a room smaller lowers its line;
/// after a merge that conflicts here, the failure names the numbers to write.
const BUDGETS: &str = include_str!("budgets.txt");

/// Lines of a file before its unit tests.
fn lines_without_tests(path: &Path) -> usize {
    if path.file_stem().is_some_and(|name| name == "tests" || name == "fixtures") {
        return 0;
    }
    let code = fs::read_to_string(path).unwrap();
    let lines: Vec<&str> = code.lines().collect();
    let tests = lines.windows(2).position(|pair| {
        pair[0] == "#[cfg(test)]" && pair[1].starts_with("mod ") && pair[1].ends_with('{')
    });
    tests.unwrap_or(lines.len())
}

/// Lines of each room: a folder of `src`, of the physics or of `crates`, or a file of `src`.
fn lines_of_rooms() -> BTreeMap<String, usize> {
    let mut rooms = BTreeMap::new();
    for path in ["src", "crates"].into_iter().flat_map(rust_files) {
        let relative = path.strip_prefix(repository()).unwrap();
        let depth = if relative.starts_with(PHYSICS) { 4 } else { 2 };
        let room: PathBuf = relative.iter().take(depth).collect();
        let room = room.to_str().unwrap().replace('\\', "/");
        *rooms.entry(room).or_default() += lines_without_tests(&path);
    }
    rooms
}

#[test]
fn no_room_has_more_lines_than_its_budget() {
    let rooms = lines_of_rooms();
    let lines = BUDGETS.lines().map(|line| line.split_once(' ').unwrap());
    let budgets: BTreeMap<&str, usize> =
        lines.map(|(room, most)| (room, most.parse().unwrap())).collect();
    assert!(BUDGETS.lines().is_sorted(), "sort the rooms by name");
    assert_eq!(budgets.len(), BUDGETS.lines().count(), "a room has two budgets");
    let mut broken = Vec::new();
    for (room, &lines) in &rooms {
        let Some(&budget) = budgets.get(room.as_str()) else {
            broken.push(format!("{room} has {lines} lines and no budget: add `{room} {lines}`"));
            continue;
        };
        if lines > budget {
            broken.push(format!("{room} has {lines} lines, its budget is {budget}: shorten it"));
        }
        if lines + (budget / 50).max(20) < budget {
            broken.push(format!("{room} has {lines}: lower its budget of {budget} to {lines}"));
        }
    }
    let gone = budgets.keys().filter(|room| !rooms.contains_key(**room));
    broken.extend(gone.map(|room| format!("{room} is gone: delete its budget")));
    assert!(broken.is_empty(), "{}", broken.join("\n"));
}

/// Texts and comments too, which the formatter leaves as they are.
#[test]
fn lines_of_the_upper_rooms_have_120_columns_at_most() {
    let crates = ["case", "chart", "output", "results", "signal", "study"];
    let rooms = crates.map(|name| format!("crates/{name}")).into_iter().chain(["src/app".into()]);
    for path in rooms.flat_map(rust_files) {
        let code = fs::read_to_string(&path).unwrap();
        let long = code.lines().position(|line| line.chars().count() > 120);
        assert_eq!(long, None, "{}, counted from 0", path.display());
    }
}

/// Code without its line comments.
fn without_comments(code: &str) -> String {
    code.lines().map(|line| line.split("//").next().unwrap_or("")).collect::<Vec<_>>().join("\n")
}

#[test]
fn every_module_names_only_lower_floors() {
    let modules = modules();
    assert!(modules.len() > 10, "the source tree was not found");
    let mut broken = Vec::new();
    // What a crate names stands in its `Cargo.toml`.
    for (module, code) in modules.iter().filter(|(module, _)| !is_crate(&module[0])) {
        let home = floor_of(&module[0]);
        let home = home.unwrap_or_else(|| panic!("{} stands on no floor", module.join("::")));
        for path in named_paths(code, module) {
            let floor = path.first().filter(|own| **own != module[0]).and_then(|own| floor_of(own));
            if floor.is_some_and(|floor| floor >= home) {
                broken.push(format!("{} names {}", module.join("::"), path.join("::")));
            }
        }
    }
    assert!(broken.is_empty(), "{}", broken.join("\n"));
}

/// The producers of eigenproblems stand side by side on one theory, which knows neither; faer is the affair of `linalg`.
#[test]
fn the_eigenvalue_theory_names_none_of_its_producers_and_they_not_each_other() {
    let home = repository().join(PHYSICS).join("cea");
    for path in rust_files(&home) {
        let place = path.strip_prefix(&home).unwrap().to_str().unwrap();
        let code = without_comments(&fs::read_to_string(&path).unwrap());
        let forbidden: &[&str] = match place {
            "mod.rs" => &["faer::"],
            _ if place.starts_with("sparse") => &["faer::", "cyclic::"],
            _ if place.starts_with("cyclic") => &["faer::", "sparse::"],
            _ => &["faer::", "sparse::", "cyclic::"],
        };
        for name in forbidden {
            assert!(!code.contains(name), "{place} names {name}");
        }
    }
}

#[test]
fn every_way_to_name_a_module_is_seen() {
    let code = "use crate::cea::{A, B}; // crate::app\nuse crate::{fem::{X, y}, mesh};\ncrate::linalg::z()";
    let named = named_paths(&without_comments(code), &["frf".to_owned()]);
    let named: Vec<String> = named.iter().map(|path| path.join("::")).collect();
    assert_eq!(named, ["cea::A", "cea::B", "fem::X", "fem::y", "mesh", "linalg::z"]);
}

/// A path in the module tree: `["results", "cea", "Branch"]`.
type Names = Vec<String>;

/// Paths that code names through `crate::`, `super::` and `self::` from a module, brace groups included.
fn named_paths(code: &str, module: &[String]) -> Vec<Names> {
    let is_word = |c: char| c.is_alphanumeric() || c == '_';
    let mut paths = Vec::new();
    let root = usize::from(is_crate(&module[0]));
    for (root, of) in [("crate::", root), ("super::", module.len() - 1), ("self::", module.len())] {
        for (at, _) in code.match_indices(root) {
            // `super::super::` is found at its first word, and the end of a longer word is none.
            if code[..at].chars().next_back().is_none_or(|c| !is_word(c) && c != ':') {
                paths_of(&code[at + root.len()..], module[..of].to_vec(), &mut paths);
            }
        }
    }
    paths
}

/// The paths of a `use` tree behind its prefix; gives what follows the tree.
fn paths_of<'a>(tree: &'a str, mut prefix: Names, paths: &mut Vec<Names>) -> &'a str {
    let mut rest = tree.trim_start();
    if rest.starts_with('{') {
        while let Some(item) = rest.strip_prefix(['{', ',']).map(str::trim_start) {
            let is_end = item.is_empty() || item.starts_with('}');
            rest = if is_end { item } else { paths_of(item, prefix.clone(), paths) };
            rest = &rest[rest.find([',', '}']).unwrap_or(rest.len())..];
        }
        return rest.strip_prefix('}').unwrap_or(rest);
    }
    let end = rest.find(|c: char| !c.is_alphanumeric() && c != '_');
    let (name, rest) = rest.split_at(end.unwrap_or(rest.len()));
    match name {
        "super" => drop(prefix.pop()),
        "self" | "" => {}
        name => prefix.push(name.to_owned()),
    }
    if let Some(rest) = rest.strip_prefix("::") {
        return paths_of(rest, prefix, paths);
    }
    paths.push(prefix);
    rest
}

/// The modules of the tree, each with its code; the roots are none.
fn modules() -> BTreeMap<Names, String> {
    let mut all = BTreeMap::new();
    for (tree, module) in TREES {
        for path in rust_files(tree) {
            let relative = path.strip_prefix(repository().join(tree)).unwrap();
            let relative = Path::new(module).join(relative).with_extension("");
            let names = relative.iter().map(|name| name.to_str().unwrap().to_owned());
            let names: Names = names.filter(|n| !["mod", "lib", "main"].contains(&&**n)).collect();
            all.insert(names, without_comments(&fs::read_to_string(path).unwrap()));
        }
    }
    all.remove(&Names::new());
    all
}

/// The module that defines what a path names, through what the faces of folders hand on, by name or all (`*`).
fn home_of(path: &[String], modules: &BTreeMap<Names, String>) -> Option<Names> {
    let depth = (1..=path.len()).rev().find(|&n| modules.contains_key(&path[..n]))?;
    let (module, item) = (&path[..depth], path.get(depth));
    let Some(item) = item else { return Some(module.to_vec()) };
    // What a module declares it has the word for, and does not import.
    let declares = |path: &Names| {
        modules.get(path).is_some_and(|code| {
            let named = named_paths(code, path);
            code.contains(item) && named.iter().all(|own| own.last() != Some(item))
        })
    };
    let handed_on = ["pub use ", "pub(super) use ", "pub(crate) use "];
    for exported in handed_on.iter().flat_map(|word| modules[module].split(word).skip(1)) {
        let mut found = Vec::new();
        let tree = exported.split(';').next().unwrap_or("");
        paths_of(tree, module.to_vec(), &mut found);
        // A macro is handed on under its own path.
        let is_own = |own: &&Names| match tree.ends_with("::*") {
            true => declares(own),
            false => own.last() == Some(item) && own[..] != *path,
        };
        if let Some(target) = found.iter().find(is_own) {
            return home_of(target, modules);
        }
    }
    Some(module.to_vec())
}

/// A file may be read before those that build on it. The faces of folders (`mod.rs`) stand aside: they hand names on.
#[test]
fn no_files_name_each_other_in_a_circle() {
    let modules = modules();
    let is_face = |name: &Names| {
        modules.keys().any(|other| other.len() > name.len() && other.starts_with(name))
    };
    let mut named: BTreeMap<&Names, BTreeSet<Names>> = BTreeMap::new();
    for (module, code) in modules.iter().filter(|(module, _)| !is_face(module)) {
        let paths = named_paths(code, module).into_iter();
        let homes = paths.filter_map(|path| home_of(&path, &modules));
        named.insert(module, homes.filter(|home| home != module && !is_face(home)).collect());
    }
    assert!(named.values().map(BTreeSet::len).sum::<usize>() > 500, "imports were not found");
    // What names nothing that is left, and what nothing left names, is taken away until only circles and ways between them are.
    let is_end = |named: &BTreeMap<&Names, BTreeSet<Names>>, module: &Names| {
        !named[module].iter().any(|to| named.contains_key(to))
            || !named.values().any(|to| to.contains(module))
    };
    while let Some(end) = named.keys().copied().find(|module| is_end(&named, module)) {
        named.remove(end);
    }
    let left: Vec<String> = named
        .iter()
        .map(|(module, to)| {
            let to = to.iter().filter(|t| named.contains_key(t)).map(|t| t.join("::"));
            format!("{} names {}", module.join("::"), to.collect::<Vec<_>>().join(", "))
        })
        .collect();
    assert!(left.is_empty(), "circles, and what stands on them:\n{}", left.join("\n"));
}
