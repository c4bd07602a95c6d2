//! Files and examples of the manual pages.

/// What the declarations of a subcommand do not say.
pub struct Page {
    /// The subcommand.
    pub command: &'static str,
    /// Name and contents of what it writes, relative to its output folder.
    pub files: &'static [(&'static str, &'static str)],
    /// Command lines and what they are for.
    pub examples: &'static [(&'static str, &'static str)],
}

/// Files and examples of each subcommand.
pub const PAGES: &[Page] = &[
    Page {
        command: "cea",
        files: &[
            (
                "eigenvalues.csv",
                "one row for each mode and friction value",
            ),
            (
                "stability.csv",
                "one row for each crossing into instability",
            ),
            (
                "sensitivities.csv",
                "derivatives of eigenvalues and onsets by parameters",
            ),
            (
                "prestress.csv, prestress.vtu",
                "steady sliding, node by node",
            ),
            (
                "modes.pvd, modes/*.vtu",
                "mode shapes, real and imaginary part",
            ),
            (
                "map.csv",
                "critical friction over a second parameter (cea.map)",
            ),
        ],
        examples: &[
            (
                "frictionsim cea disc.toml",
                "critical friction of every branch",
            ),
            (
                "frictionsim cea disc.toml --set contact.interference=30e-6 --json | jq .critical_frictions",
                "for scripts",
            ),
        ],
    },
    Page {
        command: "transient",
        files: &[
            ("probe-ID.csv", "motion of each probe over time"),
            ("energy.csv", "energies and powers, equations (8) to (12)"),
            (
                "contact.csv, contact.npz",
                "contact status: fractions, and node by node",
            ),
            (
                "harmonics.csv",
                "amplitudes of the nodal diameters over time",
            ),
            (
                "snapshots.pvd, snapshots/*.vtu",
                "fields at the times asked for",
            ),
            (
                "checkpoint.bin",
                "state of an interrupted run, for --resume",
            ),
            ("record.bin", "what the figures are drawn from"),
        ],
        examples: &[
            (
                "frictionsim transient run.toml",
                "from first expansion to limit cycle",
            ),
            (
                "frictionsim transient run.toml --resume",
                "go on after Ctrl-C",
            ),
        ],
    },
    Page {
        command: "sweep",
        files: &[
            ("points.csv", "one row for each point"),
            (
                "points/point-NNNNNN.json",
                "what came out of a point; the same bytes whoever ran it",
            ),
            ("points/clock-NNNNNN.json", "how long that took"),
        ],
        examples: &[
            ("frictionsim sweep study.toml", "all points on all cores"),
            (
                "frictionsim sweep study.toml --out study --shard 2/8",
                "one of eight processes",
            ),
            (
                "frictionsim sweep study.toml --resume",
                "go on after Ctrl-C",
            ),
        ],
    },
    Page {
        command: "collect",
        files: &[("points.csv", "one row for each finished point")],
        examples: &[(
            "frictionsim collect study",
            "gather what the shards have finished",
        )],
    },
    Page {
        command: "plot",
        files: &[("figures/*.svg, figures/*.png", "the figures, drawn again")],
        examples: &[("frictionsim plot results/disc/cea --dpi 300", "for print")],
    },
    Page {
        command: "cycle",
        files: &[
            (
                "cycle-nN.csv",
                "contact and motion of the edge along the phase",
            ),
            ("branch-nN.csv", "one row for each cycle of a branch"),
            ("stability-nN.csv", "exponents of perturbations"),
            ("cycles.pvd, cycle-nN.vtu", "fields over one period"),
            ("record.bin", "what the figures are drawn from"),
        ],
        examples: &[(
            "frictionsim cycle disc.toml",
            "the limit cycles of a case, without time stepping",
        )],
    },
    Page {
        command: "basin",
        files: &[("basin.csv", "one row for each transient of the search")],
        examples: &[(
            "frictionsim basin disc.toml",
            "which of two waves wins, by the ratio of their amplitudes at saturation",
        )],
    },
    Page {
        command: "convergence",
        files: &[
            ("convergence.csv", "one row for each quantity on each level"),
            ("record.bin", "what the figures are drawn from"),
        ],
        examples: &[(
            "frictionsim convergence disc.toml",
            "observed orders and extrapolated values",
        )],
    },
    Page {
        command: "mesh",
        files: &[("mesh.vtu", "nodes, elements, node numbers, edges")],
        examples: &[("frictionsim mesh disc.toml", "look at a mesh before a run")],
    },
    Page {
        command: "check",
        files: &[],
        examples: &[(
            "frictionsim check *.toml",
            "are these cases valid, and what do they cost?",
        )],
    },
    Page {
        command: "init",
        files: &[("TEMPLATE.toml", "the commented case")],
        examples: &[("frictionsim init transient", "write transient.toml")],
    },
    Page {
        command: "fit",
        files: &[
            (
                "fit.csv",
                "each measured line with its mode and their difference",
            ),
            ("modes.csv", "every mode of the fitted model"),
            (
                "fitted.toml",
                "sections with the fitted values to paste into a case",
            ),
        ],
        examples: &[(
            "frictionsim fit bench.toml squeal.csv",
            "which support explains the frequencies heard?",
        )],
    },
    Page {
        command: "uncertainty",
        files: &[
            ("samples.csv", "one row for each sample"),
            (
                "points/point-NNNNNN.json",
                "a block of samples, for --resume",
            ),
        ],
        examples: &[
            (
                "frictionsim uncertainty disc.toml",
                "how likely is squeal, and which parameter decides it?",
            ),
            (
                "frictionsim uncertainty disc.toml --robust contact.interference=1e-5:4e-5 --bound 0.05",
                "which design is silent with 95 % probability?",
            ),
        ],
    },
    Page {
        command: "frf",
        files: &[("frf.csv", "frequency, real and imaginary part")],
        examples: &[(
            "frictionsim frf hammer-test.toml",
            "response of the model between two nodes",
        )],
    },
    Page {
        command: "compare",
        files: &[("compare.csv", "every shared number, with differences")],
        examples: &[("frictionsim compare a/cea b/cea", "two runs side by side")],
    },
    Page {
        command: "identify",
        files: &[
            (
                "modes.csv, fit.csv",
                "frequencies and damping factors, and the fit through them",
            ),
            ("damping.toml", "a [damping] block to paste into a case"),
            ("record.bin", "what the figures are drawn from"),
        ],
        examples: &[(
            "frictionsim identify FRF.csv --json",
            "Rayleigh coefficients with intervals",
        )],
    },
    Page {
        command: "signal",
        files: &[
            ("peaks.csv", "main peaks of each channel"),
            ("spectrum-N.csv", "spectrum of each channel"),
            ("record.bin", "what the figures are drawn from"),
        ],
        examples: &[(
            "frictionsim signal microphone.csv --case disc.toml",
            "which mode squeals",
        )],
    },
];

/// Files that every command with an output folder writes.
pub const EVERYWHERE: [(&str, &str); 3] = [
    (
        "summary.json",
        "the results in short, and what they were made from",
    ),
    (
        "manifest.json",
        "case, overrides, version; names and checksums of all files",
    ),
    ("report.html, figures/", "tables and figures"),
];
