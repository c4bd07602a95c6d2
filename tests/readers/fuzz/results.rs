//! What the program writes and reads again: manifests, summaries, records, points, checkpoints.

use crate::prelude::*;
use flate2::{Compression, read::DeflateDecoder, write::DeflateEncoder};
use frictionsim::app::plot::redraw;
use frictionsim::results::sweep::{Found, SweepFolder};
use frictionsim::results::transient::{CHECKPOINT, read_checkpoint, write_checkpoint};
use frictionsim::results::{read_manifest, read_record};

/// One finished run of a command with the files that `plot` reads, which takes moments.
fn finished(command: &str) -> Answer {
    let (name, changes) = match command {
        "mesh" => ("polycarbonate-disc", "mesh.radial_elements=4"),
        "cea" => ("polycarbonate-disc", "cea.friction_coefficients=[0.0, 0.3]"),
        "transient" => (
            "polycarbonate-610rpm",
            "transient.duration=1e-3 ; output.snapshots=[5e-4, 1e-3] ; output.probes=[1, 3]",
        ),
        "cycle" => (
            "limit-cycle",
            "cycle.harmonics=[2] ; cycle.stability=\"none\" ; cycle.confirmation_periods=0 ; \
             cycle.continuation.count=2 ; mesh.circumferential_elements=36 ; mesh.radial_elements=8",
        ),
        "convergence" => ("convergence", "convergence.analyses=[\"cea\"]"),
        "sweep" => ("polycarbonate-disc", "sweep.\"contact.interference\"=[2e-5, 3e-5]"),
        other => panic!("{other}"),
    };
    // Without the transient of the study of the mesh, which takes seconds.
    let text = fs::read_to_string(shipped(&format!("{name}.toml"))).unwrap();
    let lines = text.lines().filter(|line| !line.starts_with("time_step_factors"));
    let case = lines.collect::<Vec<&str>>().join("\n");
    let run = Run::new(&[command, "case.toml", "--format=svg", "-qq"]);
    let small = "mesh.circumferential_elements=24 ; mesh.radial_elements=4";
    run.beside(&[("case.toml", case)]).set(&[small, changes]).out(command).done()
}

/// Gives a framed file the checksum and length of its changed contents, so that only what they say can refuse it.
fn with_right_checksum(mut bytes: Vec<u8>) -> Vec<u8> {
    if bytes.len() >= 24 {
        let checksum = crc32fast::hash(&bytes[24..]);
        let length = (bytes.len() - 24) as u64;
        bytes[12..16].copy_from_slice(&checksum.to_le_bytes());
        bytes[16..24].copy_from_slice(&length.to_le_bytes());
    }
    bytes
}

/// The figures with changed contents, deflated as they were.
fn figures_of(random: &mut Random, original: &[u8]) -> Vec<u8> {
    let (_, deflated): (u64, &[u8]) = postcard::from_bytes(&original[24..]).unwrap();
    let mut bytes = Vec::new();
    DeflateDecoder::new(deflated).read_to_end(&mut bytes).unwrap();
    let changed = binary(random, &bytes);
    let mut deflated = DeflateEncoder::new(Vec::new(), Compression::fast());
    deflated.write_all(&changed).unwrap();
    let payload = postcard::to_stdvec(&(changed.len() as u64, deflated.finish().unwrap())).unwrap();
    with_right_checksum([&original[..24], &payload].concat())
}

/// A changed record: header whole, and checksum right three times out of four.
fn record_of(random: &mut Random, original: &[u8]) -> Vec<u8> {
    let (header, payload) = original.split_at(24);
    let changed = [header, &binary(random, payload)].concat();
    if random.below(4) == 0 { changed } else { with_right_checksum(changed) }
}

fn plot(folder: &Path) -> bool {
    let manifest = read_manifest(folder);
    let coarse = DrawingOptions { dots_per_inch: 20.0, width_mm: None, formats: vec![Format::Svg] };
    manifest.is_ok_and(|manifest| redraw(folder, &manifest, &coarse).is_ok())
}

#[test]
fn no_figures_of_transients_and_limit_cycles_make_plot_panic() {
    for command in ["transient", "cycle"] {
        let run = finished(command);
        let original = run.bytes("figures.bin");
        assert!(plot(&run.out), "{command}: the folder as it was written");
        let make = |random: &mut Random| match random.below(4) {
            0 => record_of(random, &original),
            _ => figures_of(random, &original),
        };
        hold(&format!("figures-{command}"), make, |bytes| {
            fs::write(run.path("figures.bin"), bytes).unwrap();
            plot(&run.out);
        });
    }
}

#[test]
fn no_checkpoint_makes_its_reader_panic() {
    let scratch = folder();
    let folder = &scratch.path().join("run");
    let file = folder.join(CHECKPOINT);
    let manifest = Manifest::new("transient");
    // What stands in it is a record of a run; a state without fields is enough for the reader.
    let record: Recorder = read_record(&finished("transient").out).unwrap();
    let state = TransientState {
        step: 1,
        displacement: vec![0.0; 4],
        velocity: vec![0.0; 4],
        elastic: vec![0.0; 4],
        elastic_rate: vec![0.0; 4],
        relaxation: vec![vec![0.0; 2]; 2],
        account: EnergyAccount::default(),
    };
    let output = OutputFolder::open(folder, &manifest, Replace::Anything).unwrap();
    write_checkpoint(&output, "hash", &state, Some(&record)).unwrap();
    let read = || read_checkpoint(folder, "hash", &manifest.simd);
    let original = fs::read(&file).unwrap();
    assert!(read().unwrap().is_some());
    let make = |random: &mut Random| record_of(random, &original);
    hold("checkpoint", make, |bytes| {
        fs::write(&file, bytes).unwrap();
        if let Some(record) = read().ok().flatten().and_then(|own| own.record) {
            drop(TransientAnalysis::of(&record, &[2]));
        }
    });
}

/// Whether a changed file holds the value of the one that was written.
fn says_the_same(bytes: &[u8], original: &[u8]) -> bool {
    let [own, before] = [bytes, original].map(|own| serde_json::from_slice::<Value>(own).ok());
    own == before
}

#[test]
fn a_damaged_manifest_or_summary_is_never_used() {
    let [mesh, convergence] = ["mesh", "convergence"].map(finished);
    let files = [(&mesh, "manifest.json"), (&mesh, "summary.json"), (&convergence, "summary.json")];
    for (run, name) in files {
        let original = run.bytes(name);
        let make = |random: &mut Random| text(random, std::slice::from_ref(&original));
        hold(name, make, |bytes| {
            fs::write(run.path(name), bytes).unwrap();
            let is_same = says_the_same(bytes, &original);
            assert!(is_same || !plot(&run.out), "used although it was changed");
        });
        fs::write(run.path(name), &original).unwrap();
        assert!(plot(&run.out));
    }
}

#[test]
fn a_damaged_point_counts_as_missing() {
    let run = finished("sweep");
    let folder = SweepFolder::find(&run.out, "sweep").unwrap();
    let file = folder.point_path(1);
    let original = fs::read(&file).unwrap();
    let make = |random: &mut Random| text(random, std::slice::from_ref(&original));
    hold("point", make, |bytes| {
        fs::write(&file, bytes).unwrap();
        let is_used = matches!(folder.read(1).unwrap(), Found::Point(_));
        assert!(!is_used || says_the_same(bytes, &original));
    });
}
