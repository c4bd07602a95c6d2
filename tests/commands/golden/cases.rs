//! The runs that are held: every command on a shipped case, coarsened where it would take more than a second or two.

/// One run.
pub struct Case {
    /// Its folder, and its name in `frozen.json`.
    pub name: &'static str,
    /// Subcommand.
    pub command: &'static str,
    /// Files: shipped cases, or results of an earlier run.
    pub inputs: &'static [&'static str],
    /// Further options.
    pub options: &'static [&'static str],
    /// Whether the command takes `--simd`.
    pub has_simd: bool,
    /// Whether it runs only where `GOLDEN_SLOW` is set.
    pub is_slow: bool,
}

const COARSE: &str = "mesh.circumferential_elements=60";

/// A run of a case file.
const fn case(
    name: &'static str,
    command: &'static str,
    inputs: &'static [&'static str],
    options: &'static [&'static str],
) -> Case {
    Case { name, command, inputs, options, has_simd: true, is_slow: false }
}

/// A run on a table.
const fn table(
    name: &'static str,
    command: &'static str,
    inputs: &'static [&'static str],
    options: &'static [&'static str],
) -> Case {
    Case { has_simd: false, ..case(name, command, inputs, options) }
}

/// A run at full size.
const fn slow(
    name: &'static str,
    command: &'static str,
    inputs: &'static [&'static str],
    options: &'static [&'static str],
) -> Case {
    Case { is_slow: true, ..case(name, command, inputs, options) }
}

const DISC: &[&str] = &["cases/polycarbonate-disc.toml"];
const FAST: &[&str] = &["cases/polycarbonate-610rpm.toml"];
const SLOW: &[&str] = &["cases/polycarbonate-70rpm.toml"];
const CYCLE: &[&str] = &["cases/limit-cycle.toml"];

/// All runs, in order: later ones read tables of earlier ones.
pub const CASES: &[Case] = &[
    case("cea", "cea", DISC, &["--no-figures", "--set", "cea.shapes_at=[0.3]"]),
    case(
        "cea-sparse",
        "cea",
        FAST,
        &[
            "--no-figures",
            "--set",
            COARSE,
            "--set",
            "mesh.radial_elements=12",
            "--set",
            "cea.method=\"sparse\"",
            "--set",
            "cea.friction_coefficients=[0.0,0.15,0.3]",
            "--set",
            "output.probes=[196]",
        ],
    ),
    case("mesh", "mesh", FAST, &["--no-figures"]),
    case(
        "frf",
        "frf",
        &["cases/hammer-test.toml"],
        &["--no-figures", "--set", "frf.frequencies_hz={from=4000,to=10000,count=1501}"],
    ),
    table("identify", "identify", &["frf/frf.csv"], &["--no-figures"]),
    case(
        "transient",
        "transient",
        FAST,
        &[
            "--no-figures",
            "--set",
            COARSE,
            "--set",
            "mesh.radial_elements=12",
            "--set",
            "transient.duration=0.01",
            "--set",
            "output.probes=[196]",
            "--set",
            "output.snapshots=[0.005]",
        ],
    ),
    table("signal", "signal", &["transient/probe-196.csv"], &["--no-figures"]),
    case(
        "cycle",
        "cycle",
        CYCLE,
        &[
            "--no-figures",
            "--set",
            "mesh.circumferential_elements=90",
            "--set",
            "mesh.radial_elements=18",
            "--set",
            "cycle.continuation.count=3",
            "--set",
            "cycle.continuation.from=300",
            "--set",
            "cycle.continuation.to=1000",
            "--set",
            "cycle.stability=\"none\"",
        ],
    ),
    case(
        "convergence",
        "convergence",
        &["cases/convergence.toml"],
        &[
            "--no-figures",
            "--set",
            "mesh.circumferential_elements=48",
            "--set",
            "mesh.radial_elements=10",
            "--set",
            "transient.duration=0.002",
            "--set",
            "convergence.factors=[1,1.5,2]",
        ],
    ),
    case(
        "sweep-transient",
        "sweep",
        &["cases/speed-friction-study.toml"],
        &[
            "--no-figures",
            "--set",
            "mesh.circumferential_elements=36",
            "--set",
            "mesh.radial_elements=7",
            "--set",
            "transient.duration=0.006",
            "--set",
            "sweep.\"contact.rotation_speed_rpm\"=[50,3000]",
            "--set",
            "output.probes=[100]",
        ],
    ),
    case(
        "sweep-cea",
        "sweep",
        DISC,
        &[
            "--no-figures",
            "--set",
            COARSE,
            "--set",
            "mesh.radial_elements=12",
            "--set",
            "sweep.\"geometry.inner_radius\"=[0.012,0.0205,0.03]",
        ],
    ),
    slow("transient-610rpm", "transient", FAST, &["--no-figures"]),
    slow("transient-70rpm", "transient", SLOW, &["--no-figures"]),
    slow(
        "cycle-180x35",
        "cycle",
        CYCLE,
        &[
            "--no-figures",
            "--set",
            "cycle.continuation.count=5",
            "--set",
            "cycle.stability=\"none\"",
        ],
    ),
];
