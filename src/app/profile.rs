//! A subcommand: what it writes, its examples, and its run.

use super::Failure;

/// What the declarations of a subcommand do not say.
pub struct Profile {
    /// Name and contents of what it writes, relative to its output folder.
    pub files: &'static [(&'static str, &'static str)],
    /// Command lines and what they are for.
    pub examples: &'static [(&'static str, &'static str)],
}

impl Profile {
    /// Of a command that tells everything in its help.
    pub const NONE: Self = Self { files: &[], examples: &[] };
}

/// A subcommand, by the arguments that it takes.
pub trait Run {
    /// What the rest of the program asks of it.
    const PROFILE: Profile;

    /// Runs it.
    ///
    /// # Errors
    /// What it is asked for in vain: arguments, a case or a folder (exit code 2); a run that fails (1).
    fn run(&self) -> Result<(), Failure>;
}
