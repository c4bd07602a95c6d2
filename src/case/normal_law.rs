//! Keys of contact that stiffens with pressure.

use super::reader::Section;
use super::refuse;
use super::words::{NormalLawWord, word_of};
use crate::contact::{ContactStiffness, NormalLaw};

/// The keys of a contact's law of pressure, and which of them each law has.
const LAW_KEYS: [(&str, &[NormalLawWord]); 4] = [
    ("normal_stiffness", &[NormalLawWord::Linear, NormalLawWord::Cubic]),
    ("cubic_stiffness", &[NormalLawWord::Cubic]),
    ("reference_pressure", &[NormalLawWord::Exponential]),
    ("height", &[NormalLawWord::Exponential]),
];

/// How a contact stiffens with pressure, and its stiffness without.
pub(super) fn normal_law(
    section: &Section<'_>,
    stiffness: ContactStiffness,
) -> (Option<NormalLaw>, ContactStiffness) {
    let word: NormalLawWord = section.choice("normal_law");
    for (key, laws) in LAW_KEYS {
        if !laws.contains(&word) && section.has(key) {
            refuse!(section, key => "has no effect with normal_law = \"{}\"", word_of(word);
                "not a number of this law"; "leave it out, or give the law that it belongs to");
        }
        if laws.contains(&word) && word != NormalLawWord::Linear && !section.has(key) {
            section.missing(key);
        }
        if word == NormalLawWord::Cubic && section.is_text(key, "rigid") {
            refuse!(section, key =>
                "= \"rigid\" does not stiffen: normal_law = \"cubic\" is k g + c g^3, with k the \
                 normal stiffness";
                "needs a number"; "give k in Pa/m, or leave normal_law out");
        }
    }
    let number = |key: &str| section.optional_number(key);
    let law = match word {
        NormalLawWord::Linear => None,
        NormalLawWord::Cubic => stiffness
            .normal_stiffness
            .zip(number("cubic_stiffness"))
            .map(|(stiffness, cubic_stiffness)| NormalLaw::Cubic { stiffness, cubic_stiffness }),
        NormalLawWord::Exponential => number("reference_pressure").zip(number("height")).map(
            |(reference_pressure, height)| NormalLaw::Exponential { reference_pressure, height },
        ),
    };
    // What is asked for but unused is told above.
    let _ = (number("cubic_stiffness"), number("reference_pressure"), number("height"));
    let at_rest = law.map(|law| law.stiffness(0.0));
    let stiffness =
        ContactStiffness { normal_stiffness: at_rest.or(stiffness.normal_stiffness), ..stiffness };
    (law, stiffness)
}
