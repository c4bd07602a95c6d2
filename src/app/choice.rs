//! Options that take one of a few words.

use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};

/// A word, what it stands for, and what the help says of it.
pub type Choice<T> = (&'static str, T, &'static str);

/// Takes one of the words for what it stands for.
pub fn one_of<T: Copy + Send + Sync>(
    choices: &'static [Choice<T>],
) -> impl TypedValueParser<Value = T> {
    let words = choices.iter().map(|choice| PossibleValue::new(choice.0).help(choice.2));
    PossibleValuesParser::new(words).try_map(|given| {
        let found = choices.iter().find(|choice| choice.0 == given);
        found.map(|choice| choice.1).ok_or("none of these words")
    })
}
