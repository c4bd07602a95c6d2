//! What is refused or warned of: `refusals.txt` has the changes to shipped cases and the words that are said of them.

use crate::prelude::*;

/// The path of a shipped case, or of one that is here to be refused.
fn place_of(name: &str) -> String {
    let own = format!("{}/tests/commands/refused/{name}", env!("CARGO_MANIFEST_DIR"));
    if fs::exists(&own).unwrap() { own } else { shipped(name) }
}

/// A text with one part replaced, or all of it where that is `*`.
fn edited(text: &str, change: &str) -> String {
    let (old, new) = change.split_once(" -> ").unwrap();
    let [old, new] = [old, new].map(|part| part.replace("\\n", "\n"));
    assert!(old == "*" || text.contains(&old), "{old}");
    if old == "*" { new } else { text.replace(&old, &new) }
}

/// A case with changes: its text, its overrides, the number of the line where an error must stand, and the files beside it that change.
type Changed = (String, Vec<String>, Option<usize>, BTreeMap<String, String>);

fn changed(name: &str, changes: &str) -> Changed {
    let mut text = fs::read_to_string(place_of(name)).unwrap();
    let (mut overrides, mut place, mut files) = (Vec::new(), None, BTreeMap::new());
    let is_file = |(file, _): &(&str, &str)| Path::new(&place_of(file)).is_file();
    for change in changes.split(" ; ").filter(|change| !["", "(none)"].contains(change)) {
        if let Some((file, change)) = change.split_once(": ").filter(is_file) {
            let own = || fs::read_to_string(place_of(file)).unwrap();
            let own = files.remove(file).unwrap_or_else(own);
            files.insert(file.to_owned(), edited(&own, change));
        } else if let Some((key, line)) = change.split_once(" := ") {
            let mut lines: Vec<&str> = text.lines().collect();
            let is_key = |text: &&str| text.split('=').next().map(str::trim) == Some(key);
            let at = lines.iter().position(is_key).expect(key);
            assert_eq!(lines.iter().filter(|line| is_key(line)).count(), 1, "{key}");
            lines[at] = line;
            (text, place) = (lines.join("\n"), Some(at + 1));
        } else if change.contains(" -> ") {
            text = edited(&text, change);
        } else {
            overrides.push(change.strip_prefix('-').map_or_else(|| change.to_owned(), unset));
        }
    }
    (text, overrides, place, files)
}

fn read(name: &str, changes: &str) -> (Result<Case, String>, Option<usize>) {
    let (text, overrides, place, files) = changed(name, changes);
    let (own, folder) = (PathBuf::from(place_of(name)), folder());
    // Beside files that change all of those that are there.
    for entry in fs::read_dir(own.parent().unwrap()).unwrap().filter(|_| !files.is_empty()) {
        let file = entry.unwrap().path();
        let _ = fs::copy(&file, folder.path().join(file.file_name().unwrap()));
    }
    for (file, text) in &files {
        fs::write(folder.path().join(file), text).unwrap();
    }
    let path = if files.is_empty() { own } else { folder.path().join(name) };
    let case = Case::parse(path.to_str().unwrap(), text.as_bytes(), &overrides);
    (case.map_err(|errors| errors.to_string()), place)
}

fn said(head: &[&str], changes: &str) -> Result<String, String> {
    let name = head[1];
    match head[0] {
        kind @ ("read" | "said" | "warned" | "first") => {
            let (case, place) = read(name, changes);
            let warnings = case.as_ref().map_or(Vec::new(), |case| {
                case.warnings.iter().map(ToString::to_string).collect::<Vec<_>>()
            });
            let errors = case.as_ref().map_or_else(Clone::clone, |_| String::new());
            let told: Vec<&str> = errors.split("\n\n").collect();
            if (1..told.len()).any(|k| told[..k].contains(&told[k])) {
                return Err(format!("is told twice: {errors}"));
            }
            if let Some(line) = place {
                let place = format!("{name}:{line}:");
                if !errors.contains(&place) || !errors.contains('^') {
                    return Err(format!("is not placed at {place}: {errors}"));
                }
            }
            match (kind, case, warnings.as_slice()) {
                ("read" | "said", Err(_), _) => Ok(errors),
                ("said", Ok(case), _) => Ok(case.deny_warnings(&[]).unwrap_err().to_string()),
                ("warned", Ok(_), [own]) | ("first", Ok(_), [own, ..]) => Ok(own.clone()),
                _ => Err(format!("is not {kind}: {errors} {warnings:?}")),
            }
        }
        _ => {
            let (late, head) = head.split_at(usize::from(head[0] == "late"));
            let folder = folder();
            let mut words: Vec<String> = head.iter().map(|word| (*word).to_owned()).collect();
            let (mut overrides, mut files) = (Vec::new(), 0);
            if let Some(at) = head.iter().position(|word| fs::exists(place_of(word)).unwrap()) {
                let (text, own, ..) = changed(head[at], changes);
                overrides = own;
                words[at] = place_of(head[at]);
                if text != fs::read_to_string(&words[at]).unwrap() {
                    fs::write(folder.path().join("case.toml"), text).unwrap();
                    (words[at], files) = ("case.toml".to_owned(), 1);
                }
            }
            let run = Run::new(&words).set(&overrides).within(folder.path()).end();
            let written = fs::read_dir(folder.path()).unwrap().count() - files;
            let is_refused = (run.code, run.stdout.as_str(), written) == (Some(2), "", late.len());
            let told = format!("{:?}, {written} written: {}", run.code, run.stdout);
            is_refused.then_some(run.stderr).ok_or(told)
        }
    }
}

/// Holds the rows of in-process or of command-line heads, and names every row that fails.
fn hold(is_read: bool) {
    let (mut head, mut wrong, mut rows) = (Vec::new(), String::new(), 0);
    for line in include_str!("refusals.txt").lines() {
        let words = line.strip_prefix('[').and_then(|line| line.strip_suffix(']'));
        if let Some(words) = words.filter(|_| !line.contains(" => ")) {
            head = words.split(' ').collect();
            continue;
        }
        if line.is_empty()
            || line.starts_with('#')
            || is_read != ["read", "said", "warned", "first"].contains(&head[0])
        {
            continue;
        }
        rows += 1;
        let mut fields = line.split(" => ");
        let (changes, parts) = (fields.next().unwrap(), fields.next().expect(line));
        match said(&head, changes) {
            Err(reason) => wrong += &format!("{head:?} {changes}: {reason}\n"),
            Ok(text) if text.is_empty() => wrong += &format!("{head:?} {changes}: nothing said\n"),
            Ok(text) => {
                for part in parts.split(" ; ") {
                    let (never, part) = part.strip_prefix('!').map_or((false, part), |p| (true, p));
                    if text.contains(part) == never {
                        wrong += &format!("{head:?} {changes}: {part:?}, never: {never}\n{text}\n");
                    }
                }
            }
        }
        if let Some(Err(errors)) = fields.next().map(|answer| read(head[1], answer).0) {
            wrong += &format!("{head:?} {changes}: the answer is refused: {errors}\n");
        }
    }
    assert!(rows > 30 && wrong.is_empty(), "{rows} rows\n{wrong}");
}

#[test]
fn cases_are_refused_or_warned_of_with_the_words_of_the_table_and_its_answers_are_taken() {
    hold(true);
}

#[test]
fn command_lines_are_refused_with_the_words_of_the_table_and_write_nothing() {
    hold(false);
}
