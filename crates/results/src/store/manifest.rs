//! Manifest of a result: program, case and inputs.

use crate::prelude::*;

keys! {
    /// Everything needed to make a result again; part of every summary and of the output folder.
    ///
    /// Holds no time of day: the same run writes the same manifest.
    #[derive(Default, Eq, Deserialize)]
    Manifest {
        program: String = "program name";
        version: String = "program version";
        command: String = "subcommand";
        case_file: String = "case file as the user named it";
        case_text: String = "text of the case file";
        case_hash: String = "SHA-256 of the effective case, overrides included";
        overrides: Vec<String> = "overrides `KEY=VALUE` in the order given";
        #[serde(default)]
        arguments: Vec<String> = "other arguments that the results depend on, as given";
        threads: usize = "worker threads";
        simd: String = "SIMD level that the kernels ran with";
    }
}

impl Manifest {
    /// A manifest of this program's version.
    pub fn new(command: &str) -> Self {
        Self {
            program: "frictionsim".to_owned(),
            version: env!("CARGO_PKG_VERSION").to_owned(),
            command: command.to_owned(),
            threads: 1,
            simd: "scalar".to_owned(),
            ..Self::default()
        }
    }

    /// Overrides and other arguments in words.
    pub fn overrides_text(&self) -> String {
        let all = [&self.overrides[..], &self.arguments].concat();
        if all.is_empty() { "none".to_owned() } else { all.join(", ") }
    }

    /// The command that has made the results, for a shell.
    pub fn command_line(&self) -> String {
        let is_plain = |c: char| c.is_alphanumeric() || "=.,:+-_/".contains(c);
        let given = self.overrides.iter().map(|text| match text.strip_prefix("unset ") {
            Some(key) => format!("--unset {key}"),
            None if text.chars().all(is_plain) => format!("--set {text}"),
            None => format!("--set '{text}'"),
        });
        let words = self.arguments.iter().cloned().chain(given).map(|own| format!(" {own}"));
        format!("frictionsim {} {}{}", self.command, self.case_file, words.collect::<String>())
    }
}
