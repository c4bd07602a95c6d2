//! Description of a subcommand: what it writes, and its examples.

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
