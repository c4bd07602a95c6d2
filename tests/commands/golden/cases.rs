//! The runs that are held: every command on a shipped case, coarsened where it would take more than a second or two.

/// Its name, in `frozen.json` too, the command, a shipped case or a result of an earlier run, and changes of values.
pub type Case = [&'static str; 4];

const DISC: &str = "cases/polycarbonate-disc.toml";
const FAST: &str = "cases/polycarbonate-610rpm.toml";
const CYCLE: &str = "cases/limit-cycle.toml";

/// All runs, in order: later ones read tables of earlier ones.
pub const CASES: &[Case] = &[
    ["cea", "cea", DISC, "cea.shapes_at=[0.3]"],
    [
        "cea-sparse",
        "cea",
        FAST,
        "mesh.circumferential_elements=60 ; mesh.radial_elements=12 ; cea.method=\"sparse\" ; \
         cea.friction_coefficients=[0.0,0.15,0.3] ; output.probes=[196]",
    ],
    ["mesh", "mesh", FAST, ""],
    ["frf", "frf", "cases/hammer-test.toml", "frf.frequencies_hz={from=4000,to=10000,count=1501}"],
    ["identify", "identify", "frf/frf.csv", ""],
    [
        "transient",
        "transient",
        FAST,
        "mesh.circumferential_elements=60 ; mesh.radial_elements=12 ; transient.duration=0.01 ; \
         output.probes=[196] ; output.snapshots=[0.005]",
    ],
    ["signal", "signal", "transient/probe-196.csv", ""],
    [
        "cycle",
        "cycle",
        CYCLE,
        "mesh.circumferential_elements=90 ; mesh.radial_elements=18 ; cycle.continuation.count=3 ; \
         cycle.continuation.from=300 ; cycle.continuation.to=1000 ; cycle.stability=\"none\"",
    ],
    [
        "convergence",
        "convergence",
        "cases/convergence.toml",
        "mesh.circumferential_elements=48 ; mesh.radial_elements=10 ; transient.duration=0.002 ; \
         convergence.factors=[1,1.5,2]",
    ],
    [
        "sweep-transient",
        "sweep",
        "cases/speed-friction-study.toml",
        "mesh.circumferential_elements=36 ; mesh.radial_elements=7 ; transient.duration=0.006 ; \
         sweep.\"contact.rotation_speed_rpm\"=[50,3000] ; output.probes=[100]",
    ],
    [
        "sweep-cea",
        "sweep",
        DISC,
        "mesh.circumferential_elements=60 ; mesh.radial_elements=12 ; \
         sweep.\"geometry.inner_radius\"=[0.012,0.0205,0.03]",
    ],
];

/// Runs at full size, where `GOLDEN_SLOW` is set.
pub const SLOW: &[Case] = &[
    ["transient-610rpm", "transient", FAST, ""],
    ["transient-70rpm", "transient", "cases/polycarbonate-70rpm.toml", ""],
    ["cycle-180x35", "cycle", CYCLE, "cycle.continuation.count=5 ; cycle.stability=\"none\""],
];
