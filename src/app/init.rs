//! `frictionsim init`: a commented case to start from.

use super::profile::{Profile, Redraw};
use super::{Failure, terminal};
use crate::case::{case_from, reference};
use clap::{Args, ValueHint};
use std::fmt::Write as _;
use std::io::Write;
use std::path::{Path, PathBuf};

/// A case to start from.
struct Template {
    name: &'static str,
    meaning: &'static str,
    /// The shipped case that it is.
    case: &'static str,
    text: &'static str,
    /// Files that the case or its command reads, from the folder of the case on.
    files: &'static [(&'static str, &'static [u8])],
}

/// A template made of a shipped case and the files that belong to it.
macro_rules! template {
    ($name:literal, $case:literal, [$($file:literal),*], $meaning:literal) => {
        Template {
            name: $name,
            meaning: $meaning,
            case: $case,
            text: include_str!(concat!("../../cases/", $case)),
            files: &[$(($file, include_bytes!(concat!("../../cases/", $file)))),*],
        }
    };
}

const TEMPLATES: &[Template] = &[
    template!(
        "cea",
        "polycarbonate-disc.toml",
        [],
        "complex eigenvalues of a disc over the friction coefficient"
    ),
    template!(
        "transient",
        "polycarbonate-610rpm.toml",
        [],
        "contact transient from first expansion to limit cycle"
    ),
    template!(
        "sweep",
        "speed-friction-study.toml",
        [],
        "transients over rotation speed and friction"
    ),
    template!(
        "convergence",
        "convergence.toml",
        [],
        "eigenvalues, a transient and a limit cycle over mesh and time step"
    ),
    template!(
        "cycle",
        "limit-cycle.toml",
        [],
        "limit cycles over the rotation speed, without time stepping"
    ),
    template!(
        "basin",
        "basin.toml",
        [],
        "which of two stable limit cycles a transient ends on"
    ),
    template!(
        "frf",
        "hammer-test.toml",
        [],
        "frequency response of a free disc, as in a hammer test"
    ),
    template!(
        "fit",
        "fit-table-1.toml",
        ["table-1.csv"],
        "material and contact stiffness from measured modes"
    ),
    template!(
        "uncertainty",
        "squeal-probability.toml",
        [],
        "probability of squeal where parameters scatter"
    ),
    template!(
        "mesh",
        "sliding-block.toml",
        ["meshes/block.msh", "meshes/block.geo"],
        "a part of your own from a Gmsh mesh, on a moving plane"
    ),
    template!(
        "two-bodies",
        "pad-on-disc.toml",
        ["meshes/pad.msh", "meshes/pad.py"],
        "a pad on a disc from a mesh, both deformable"
    ),
    template!(
        "three-dimensions",
        "ring-on-disc.toml",
        [],
        "a disc in three dimensions under a rotating ring"
    ),
];

/// The template that is made from the declarations of the keys.
const REFERENCE: &str = "reference";

/// Other names of templates.
const SYNONYMS: &[(&str, &str)] = &[
    ("3d", "three-dimensions"),
    ("block", "mesh"),
    ("brake", "two-bodies"),
    ("disc", "cea"),
    ("eigenvalues", "cea"),
    ("pad", "two-bodies"),
];

/// Write a commented case to start from
#[derive(Args)]
pub struct Arguments {
    /// Template; see --list
    #[arg(default_value = "cea")]
    template: String,
    /// Mesh file to start from: an input file of Abaqus or CalculiX, Nastran bulk data, a universal file or a Gmsh mesh; the case
    /// has everything that the file holds
    #[arg(long, value_name = "MESH", value_hint = ValueHint::FilePath, conflicts_with = "template")]
    from: Option<PathBuf>,
    /// File to write, `-` for stdout [default: <TEMPLATE>.toml]; meshes and tables of the template go beside it
    #[arg(long, short, value_name = "FILE", value_hint = ValueHint::FilePath)]
    out: Option<PathBuf>,
    /// List the templates
    #[arg(long)]
    list: bool,
    /// Replace existing files
    #[arg(long)]
    force: bool,
}

/// What the rest of the program asks of this command.
pub const PROFILE: Profile = Profile {
    files: &[
        ("TEMPLATE.toml", "the commented case"),
        ("meshes/*, *.csv", "the mesh or table that it needs, if any"),
    ],
    examples: &[
        ("frictionsim init transient", "write transient.toml"),
        (
            "frictionsim init mesh -o part.toml",
            "a part of your own: part.toml and its mesh",
        ),
        (
            "frictionsim init --from brake.inp",
            "brake.toml with the materials, ties, contacts and conditions of brake.inp",
        ),
    ],
    redraw: Redraw::Nothing,
};

/// Runs the subcommand.
///
/// # Errors
/// An unknown template, an existing file without `--force`, a file that cannot be written.
pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    if arguments.list {
        let mut text = String::new();
        for template in TEMPLATES {
            let _ = writeln!(text, "{:<18}{}", template.name, template.meaning);
        }
        let _ = writeln!(
            text,
            "{REFERENCE:<18}every key of a case with its default and meaning"
        );
        return terminal::print(&text);
    }
    if let Some(mesh) = &arguments.from {
        return start_from(mesh, arguments);
    }
    let template = match arguments.template.as_str() {
        REFERENCE => None,
        name => Some(find(name)?),
    };
    let name = template.map_or(REFERENCE, |template| template.name);
    let path = match &arguments.out {
        Some(path) => path.clone(),
        None => PathBuf::from(format!("{name}.toml")),
    };
    let is_stdout = path == Path::new("-");
    let shown = match path.file_name() {
        Some(name) if !is_stdout => name.to_string_lossy().into_owned(),
        _ => format!("{name}.toml"),
    };
    let text = match template {
        Some(template) => template.case_named(&shown),
        None => reference::template(),
    };
    if is_stdout {
        return terminal::print(&text);
    }
    let folder = path.parent().map(Path::to_path_buf).unwrap_or_default();
    let beside = template.map_or(&[][..], |template| template.files);
    let beside = beside
        .iter()
        .map(|(name, bytes)| (folder.join(name), *bytes));
    let mut files = vec![(path, text.as_bytes())];
    // What is there already, as it would be written, need not be replaced.
    files
        .extend(beside.filter(|(path, bytes)| std::fs::read(path).ok().as_deref() != Some(*bytes)));
    if !arguments.force
        && let Some((path, _)) = files
            .iter()
            .find(|(path, _)| path.symlink_metadata().is_ok())
    {
        return Err(exists(path));
    }
    let mut written = String::new();
    for (path, bytes) in &files {
        write(path, bytes, arguments.force)?;
        let _ = writeln!(written, "{}", path.display());
    }
    terminal::print(&written)
}

/// Writes the case that a mesh file suggests, beside it unless told otherwise.
fn start_from(mesh: &Path, arguments: &Arguments) -> Result<(), Failure> {
    let path = match &arguments.out {
        Some(path) => path.clone(),
        None => mesh.with_extension("toml"),
    };
    let is_stdout = path == Path::new("-");
    // The case names the mesh as seen from its own folder.
    let folder = path.parent().unwrap_or(Path::new(""));
    let shown = match mesh.strip_prefix(folder) {
        Ok(inside) if !is_stdout => inside.to_path_buf(),
        _ if is_stdout || folder.as_os_str().is_empty() => mesh.to_path_buf(),
        _ => std::path::absolute(mesh).unwrap_or_else(|_| mesh.to_path_buf()),
    };
    let text = case_from(mesh, &shown.display().to_string()).map_err(Failure::usage)?;
    if is_stdout {
        return terminal::print(&text);
    }
    write(&path, text.as_bytes(), arguments.force)?;
    terminal::print(&format!("{}\n", path.display()))
}

impl Template {
    /// The case as a file of this name, beside the files that it reads; comments name both.
    fn case_named(&self, name: &str) -> String {
        let own = format!("cases/{}", self.case);
        let text = self.text.replace(&own, name);
        let files = self.files.iter();
        files.fold(text, |text, (file, _)| {
            text.replace(&format!("cases/{file}"), file)
        })
    }
}

fn find(name: &str) -> Result<&'static Template, Failure> {
    let synonym = SYNONYMS.iter().find(|pair| pair.0 == name);
    let name = synonym.map_or(name, |pair| pair.1);
    let found = TEMPLATES.iter().find(|template| template.name == name);
    found.ok_or_else(|| {
        let names = TEMPLATES.iter().map(|template| template.name);
        let names: Vec<&str> = names.chain([REFERENCE]).collect();
        Failure::usage(format!(
            "no template \"{name}\": choose one of {}",
            names.join(", ")
        ))
    })
}

fn exists(path: &Path) -> Failure {
    Failure::usage(format!(
        "{} exists: replace it with --force, or name another file with --out",
        path.display()
    ))
}

fn write(path: &Path, bytes: &[u8], force: bool) -> Result<(), Failure> {
    let failed = |error| Failure::run(format!("cannot write {}: {error}", path.display()));
    if let Some(folder) = path
        .parent()
        .filter(|folder| !folder.as_os_str().is_empty())
    {
        std::fs::create_dir_all(folder).map_err(failed)?;
    }
    let mut options = std::fs::OpenOptions::new();
    options.write(true);
    if force {
        options.create(true).truncate(true);
    } else {
        options.create_new(true);
    }
    let result = options
        .open(path)
        .and_then(|mut file| file.write_all(bytes));
    result.map_err(|error| match error.kind() {
        std::io::ErrorKind::AlreadyExists => exists(path),
        _ => failed(error),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::case::Case;

    #[test]
    fn every_template_is_a_valid_case_beside_its_files() {
        let folder = tempfile::tempdir().unwrap();
        for template in TEMPLATES {
            for (name, bytes) in template.files {
                write(&folder.path().join(name), bytes, true).unwrap();
            }
            let text = template.case_named("case.toml");
            assert!(!text.contains("cases/"), "{}", template.name);
            let path = folder.path().join("case.toml").display().to_string();
            let case = Case::parse(&path, text.as_bytes(), &[]);
            assert!(case.is_ok(), "{}", case.unwrap_err());
        }
        let case = Case::parse(REFERENCE, reference::template().as_bytes(), &[]);
        assert!(case.is_ok(), "{}", case.unwrap_err());
    }

    #[test]
    fn other_names_lead_to_templates() {
        assert!(SYNONYMS.iter().all(|(other, _)| find(other).is_ok()));
        assert!(find("nothing").is_err());
    }
}
