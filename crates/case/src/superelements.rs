//! `[superelements.*]`: systems that other programs have reduced to matrices.

use super::{Findings, ModeLimit, cea::mode_selection};
use crate::*;
use frictionsim_bounds::{MATRIX, SUPERELEMENT_UNKNOWNS};
use frictionsim_physics::linalg::MarketMatrix;
use sha2::{Digest, Sha256};

/// The matrices of a superelement, in the order of their keys.
const MATRICES: [&str; 3] = ["mass", "damping", "stiffness"];

/// The matrices of a reduced system.
#[derive(Clone, Debug, PartialEq)]
pub struct Superelement {
    /// Its name in the case.
    pub name: String,
    /// Mass `M`.
    pub mass: MarketMatrix,
    /// Damping `C`; zero where the case gives none.
    pub damping: MarketMatrix,
    /// Stiffness `K`.
    pub stiffness: MarketMatrix,
}

/// A case of one superelement that stands free: `(lambda^2 M + lambda C + K) x = 0`.
#[derive(Clone, Debug, PartialEq)]
pub struct FreeSystem {
    /// Title.
    pub title: String,
    /// Its matrices.
    pub superelement: Superelement,
    /// Modes wanted.
    pub modes: ModeLimit,
    /// The case as it is written.
    pub raw: RawCase,
    /// SHA-256 of the effective case and of the files of its matrices, in hexadecimal.
    pub hash: String,
}

impl FreeSystem {
    /// Whether a case describes superelements and no body.
    pub fn is_described_by(raw: &RawCase) -> bool {
        let has = |section: &str| raw.root.contains_key(section);
        has("superelements") && !has("geometry") && !has("mesh")
    }

    /// Reads the matrices of a case, whose files are relative to it.
    ///
    /// # Errors
    /// [`CaseErrors`]: several superelements, a file that is not readable or no matrix, sizes that differ, an unknown
    /// without entries, a key that means nothing here.
    pub fn read(raw: RawCase) -> Result<Self, CaseErrors> {
        let findings = Findings::of(&raw.root);
        let root = Section::root(&findings, &raw.root, raw.end());
        let title = root.optional_text("title").unwrap_or_default();
        let all = root.section("superelements", true);
        let names: Vec<&str> = all.remaining().into_iter().map(|(name, _)| name).collect();
        refuse_if!(names.len() > 1; all, names[1],
            "several superelements without a body have nothing in common"; "the second one";
            "give each a case of its own");
        let mut digest = Sha256::new_with_prefix(raw.canonical());
        let read = names.first().and_then(|name| {
            all.section(name, true).closed(|own| superelement(own, name, &raw, &mut digest))
        });
        names.iter().skip(1).for_each(|name| _ = all.section(name, false));
        all.close();
        let unknowns = read.as_ref().map_or(0, |own| own.mass.rows as u128);
        let modes = root.section("cea", true).closed(|own| mode_selection(own, unknowns));
        root.close();
        let (errors, _) = findings.into_parts();
        let hash = format!("{:x}", digest.finalize());
        match read {
            Some(superelement) if errors.is_empty() => {
                Ok(Self { title, superelement, modes, hash, raw })
            }
            _ => Err(raw.errors(errors)),
        }
    }
}

/// Refuses superelements where a body is read.
pub(super) fn refuse_body(raw: &RawCase) -> Result<(), CaseErrors> {
    if !raw.root.contains_key("superelements") {
        return Ok(());
    }
    let at = raw.place("superelements");
    let error = match FreeSystem::is_described_by(raw) {
        true => placed!(at, "superelements have eigenvalues alone: `frictionsim cea` lists them, \
            `frictionsim check` reads them. They have no mesh, contact or friction"; "no body";
            "for any other command describe the body itself, with [mesh], [material], [contact]"),
        false => placed!(at, "superelements are solved free-standing; joining them to a mesh at \
            interface nodes is not supported"; "beside a body";
            "leave [geometry] and [mesh] out, or solve the superelement in a case of its own"),
    };
    Err(raw.errors(vec![error]))
}

/// One superelement; `None` where something is wrong with it, which is reported.
fn superelement(
    section: &Section<'_>,
    name: &str,
    raw: &RawCase,
    digest: &mut Sha256,
) -> Option<Superelement> {
    section.needs("mass");
    section.needs("stiffness");
    let [mass, damping, stiffness] = MATRICES.map(|key| {
        let file = section.optional_text(key)?;
        Some(matrix(section, key, &raw.beside(&file), digest))
    });
    let (mass, stiffness) = (mass??, stiffness??);
    let none = MarketMatrix { entries: Vec::new(), ..mass.clone() };
    let damping = damping.unwrap_or(Some(none))?;
    let size = mass.rows;
    for (key, own) in MATRICES.iter().zip([&mass, &damping, &stiffness]) {
        if [own.rows, own.columns] != [size, size] {
            refuse!(section, key => "is {} x {}, {} has {size} rows", own.rows, own.columns,
                section.name("mass"); "another size";
                "all matrices of a superelement are square and of one size");
            return None;
        }
    }
    if size == 0 || size > SUPERELEMENT_UNKNOWNS {
        refuse!(section, "mass" => "has {size} unknowns";
            "1 to {SUPERELEMENT_UNKNOWNS} unknowns"; "reduce the system further");
        return None;
    }
    // Every unknown must be part of some equation.
    let mut is_met = vec![false; size];
    for &(_, column, value) in
        [&mass, &damping, &stiffness].into_iter().flat_map(|own| &own.entries)
    {
        is_met[column] |= value != 0.0;
    }
    if let Some(unknown) = is_met.iter().position(|met| !met) {
        refuse!(section, "stiffness",
            "unknown {} of superelement {name} has no entry in any of its matrices: nothing holds \
             it and it has no mass", unknown + 1;
            "an empty column"; "remove its row and column from every matrix");
        return None;
    }
    Some(Superelement { name: name.to_owned(), mass, damping, stiffness })
}

/// The matrix of a file.
fn matrix(own: &Section<'_>, key: &str, path: &Path, digest: &mut Sha256) -> Option<MarketMatrix> {
    let reject = |what: String, label: &str| {
        refuse!(own, key, "{}: {}: {what}", own.name(key), path.display(); "{label}";
            "a real matrix in the Matrix Market format, as scipy.io.mmwrite writes it");
    };
    let bytes = frictionsim_bounds::read(path, MATRIX);
    let bytes = bytes.map_err(|refusal| reject(refusal.to_string(), "not readable")).ok()?;
    digest.update(&bytes);
    let matrix = MarketMatrix::read(&String::from_utf8_lossy(&bytes), SUPERELEMENT_UNKNOWNS);
    matrix.map_err(|error| reject(error.to_string(), "no such matrix")).ok()
}
