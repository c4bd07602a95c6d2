//! `frictionsim init`: a commented case to start from.

use super::profile::{Profile, Redraw};
use super::{Failure, terminal};
use crate::case::reference;
use clap::{Args, ValueHint};
use std::fmt::Write as _;
use std::io::Write;
use std::path::{Path, PathBuf};

/// A case to start from.
struct Template {
    name: &'static str,
    meaning: &'static str,
    text: &'static str,
}

const TEMPLATES: &[Template] = &[
    Template {
        name: "cea",
        meaning: "complex eigenvalues of a disc over the friction coefficient",
        text: include_str!("../../cases/polycarbonate-disc.toml"),
    },
    Template {
        name: "transient",
        meaning: "contact transient from first expansion to limit cycle",
        text: include_str!("../../cases/polycarbonate-610rpm.toml"),
    },
    Template {
        name: "sweep",
        meaning: "transients over rotation speed and friction",
        text: include_str!("../../cases/speed-friction-study.toml"),
    },
    Template {
        name: "convergence",
        meaning: "eigenvalues, a transient and a limit cycle over mesh and time step",
        text: include_str!("../../cases/convergence.toml"),
    },
    Template {
        name: "cycle",
        meaning: "limit cycles over the rotation speed, without time stepping",
        text: include_str!("../../cases/limit-cycle.toml"),
    },
    Template {
        name: "frf",
        meaning: "frequency response of a free disc, as in a hammer test",
        text: include_str!("../../cases/hammer-test.toml"),
    },
];

/// The template that is made from the declarations of the keys.
const REFERENCE: &str = "reference";

/// Write a commented case to start from
#[derive(Args)]
pub struct Arguments {
    /// Template; see --list
    #[arg(default_value = "cea")]
    template: String,
    /// File to write, `-` for stdout [default: <TEMPLATE>.toml]
    #[arg(long, value_name = "FILE", value_hint = ValueHint::FilePath)]
    out: Option<PathBuf>,
    /// List the templates
    #[arg(long)]
    list: bool,
    /// Replace an existing file
    #[arg(long)]
    force: bool,
}

/// What the rest of the program asks of this command.
pub const PROFILE: Profile = Profile {
    files: &[("TEMPLATE.toml", "the commented case")],
    examples: &[("frictionsim init transient", "write transient.toml")],
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
            let _ = writeln!(text, "{:<12}{}", template.name, template.meaning);
        }
        let _ = writeln!(
            text,
            "{REFERENCE:<12}every key of a case with its default and meaning"
        );
        return terminal::print(&text);
    }
    if arguments.template == REFERENCE {
        return place(arguments, REFERENCE, &reference::template());
    }
    let template = find(&arguments.template)?;
    place(arguments, template.name, template.text)
}

/// Writes a case to where the arguments want it.
fn place(arguments: &Arguments, name: &str, text: &str) -> Result<(), Failure> {
    let path = match &arguments.out {
        Some(path) => path.clone(),
        None => PathBuf::from(format!("{name}.toml")),
    };
    if path == Path::new("-") {
        return terminal::print(text);
    }
    write(&path, text, arguments.force)?;
    terminal::print(&format!("{}\n", path.display()))
}

fn find(name: &str) -> Result<&'static Template, Failure> {
    // The case's own name works as well as what it is for.
    let name = if name == "disc" { "cea" } else { name };
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

fn write(path: &Path, text: &str, force: bool) -> Result<(), Failure> {
    let mut options = std::fs::OpenOptions::new();
    options.write(true);
    if force {
        options.create(true).truncate(true);
    } else {
        options.create_new(true);
    }
    let result = options
        .open(path)
        .and_then(|mut file| file.write_all(text.as_bytes()));
    result.map_err(|error| match error.kind() {
        std::io::ErrorKind::AlreadyExists => Failure::usage(format!(
            "{} exists: replace it with --force, or name another file with --out",
            path.display()
        )),
        _ => Failure::run(format!("cannot write {}: {error}", path.display())),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::case::Case;

    #[test]
    fn every_template_is_a_valid_case() {
        for template in TEMPLATES {
            let case = Case::parse(template.name, template.text.as_bytes(), &[]);
            assert!(case.is_ok(), "{}", case.unwrap_err());
        }
        let case = Case::parse(REFERENCE, reference::template().as_bytes(), &[]);
        assert!(case.is_ok(), "{}", case.unwrap_err());
    }
}
