//! The cases that come with the program, each with the meshes and tables that it reads.

use include_dir::{Dir, File, include_dir};

/// The folder of the shipped cases, inside the program.
static CASES: Dir<'static> = include_dir!("$CARGO_MANIFEST_DIR/cases");

/// A shipped case.
#[derive(Clone, Copy, Debug)]
pub struct ShippedCase {
    /// Its file in the folder of the shipped cases.
    pub file: &'static str,
    /// Its text.
    pub text: &'static str,
}

/// A shipped file: its path from the folder of the shipped cases on, and its bytes.
pub type ShippedFile = (&'static str, &'static [u8]);

impl ShippedCase {
    /// The file name without its extension.
    pub fn name(&self) -> &'static str {
        self.file.strip_suffix(".toml").unwrap_or(self.file)
    }

    /// Its title.
    pub fn title(&self) -> &'static str {
        let mut lines = self.text.lines();
        let title = lines.find_map(|line| line.strip_prefix("title = "));
        title.unwrap_or_default().trim().trim_matches('"')
    }

    /// The files that the case or its commands read, named in its text, and what their meshes are made from.
    pub fn files(&self) -> Vec<ShippedFile> {
        let all = all_files();
        let is_named = |path: &str| self.text.contains(path.rsplit('/').next().unwrap_or(path));
        let stem = |&(path, _): &ShippedFile| path.strip_suffix(".msh").filter(|_| is_named(path));
        let stems: Vec<&str> = all.iter().filter_map(stem).collect();
        let is_kept = |(path, _): &ShippedFile| {
            let of_case = |stem: &str| is_named(path) || stems.contains(&stem);
            let parts = path.rsplit_once('.');
            parts.is_some_and(|(stem, end)| end != "toml" && end != "md" && of_case(stem))
        };
        all.into_iter().filter(is_kept).collect()
    }

    /// The case as a file of this name, beside the files that it reads; comments name both.
    pub fn named(&self, name: &str) -> String {
        let text = self.text.replace(&format!("cases/{}", self.file), name);
        let files = self.files().into_iter();
        files.fold(text, |text, (file, _)| text.replace(&format!("cases/{file}"), file))
    }
}

/// Every shipped case, by name.
pub fn all_cases() -> Vec<ShippedCase> {
    let files = all_files().into_iter();
    let cases = files.filter(|(path, _)| path.ends_with(".toml") && !path.contains('/'));
    let cases = cases.filter_map(|(file, bytes)| {
        let text = std::str::from_utf8(bytes).ok()?;
        Some(ShippedCase { file, text })
    });
    cases.collect()
}

/// Every shipped file, by path.
pub fn all_files() -> Vec<ShippedFile> {
    fn walk(folder: &'static Dir<'static>, found: &mut Vec<ShippedFile>) {
        let named = |file: &'static File<'static>| Some((file.path().to_str()?, file.contents()));
        found.extend(folder.files().filter_map(named));
        folder.dirs().for_each(|inner| walk(inner, found));
    }
    let mut found = Vec::new();
    walk(&CASES, &mut found);
    found.sort_by_key(|(path, _)| *path);
    found
}
