//! Consistency checks of result files on a made-up spectrum, and of the output folder.

use crate::figures::synthetic;
use crate::prelude::*;
use flate2::read::ZlibDecoder;
use frictionsim::results::cea::{Solution, View, document, page, summary, write_fields};
use frictionsim::results::mesh::MeshStatistics;
use frictionsim::results::{EncodedMesh, Field, cartesian_vectors, write_summary, write_vtu};

fn annulus(element: ElementKind) -> AnnulusMesh {
    let even = crate::disc::ring([0.02, 0.09], element, 12, 3);
    AnnulusMesh::generate(&AnnulusSpecification { radial_grading: 1.2, ..even }).unwrap()
}

/// A mode whose numbers are easily told apart.
fn mode(real_hz: f64, frequency_hz: f64, harmonic: usize, direction: i8) -> ComplexMode {
    synthetic::mode(c64::new(TAU * real_hz, TAU * frequency_hz), harmonic, direction)
}

fn solution(mesh: &AnnulusMesh) -> Solution {
    let mut shaped = mode(12.5, 9900.0, 2, -1);
    // One travelling wave: cos and sin parts a quarter period apart.
    let wave = mesh.mesh.frame_angles().iter().flat_map(|angle| {
        let (sine, cosine) = (2.0 * angle).sin_cos();
        [c64::new(cosine, sine), c64::new(-sine, cosine)]
    });
    shaped.shape = Some(wave.collect());
    let point = |friction_coefficient: f64, modes: &[ComplexMode]| FrictionPoint {
        friction_coefficient,
        modes: modes.to_vec(),
        above: Vec::new(),
    };
    let stable = [mode(-20.0, 7600.0, 1, 1), mode(-30.0, 9890.0, 2, -1)];
    let sweep = FrictionSweep {
        points: vec![
            point(0.0, &stable),
            point(0.1, &stable),
            point(0.25, &[stable[0].clone(), mode(5.0, 9895.0, 2, -1)]),
            point(0.3, &[stable[0].clone(), shaped]),
        ],
        intervals: vec![UnstableInterval {
            restabilized: Some((0.9, 9950.0)),
            ..synthetic::onset((2, 0), 0.138_2, 9893.0)
        }],
        ..FrictionSweep::default()
    };
    let notes = vec!["harmonics above 6 do not exist on this mesh".to_owned()];
    Solution { notes, ..synthetic::solution(sweep) }
}

fn field(mesh: &AnnulusMesh) -> BaseField {
    let ContactInterface { nodes, angles, .. } = ContactInterface::of(&mesh.mesh);
    let angles: Vec<(u32, f64)> = nodes.into_iter().zip(angles).collect();
    let stress = vec![NodalStress::default(); mesh.mesh.node_count()];
    BaseField {
        displacement: vec![1e-6; 2 * mesh.mesh.node_count()],
        ..synthetic::field(&mesh.mesh, &angles, |_| [2.8e6, 0.84e6], stress)
    }
}

fn report<'a>(mesh: &'a AnnulusMesh, solution: &'a Solution) -> CeaReport<'a> {
    CeaReport {
        title: "made up",
        selection: "below 10000 Hz".to_owned(),
        // 0.25 was solved for its shapes alone, 0.3 is the case's own.
        friction_coefficients: &[0.0, 0.1],
        base: BaseState {
            slipping: 12,
            pressure_pa: [2.8e6, 2.83e6],
            shear_pa: [0.84e6, 0.849e6],
            ..synthetic::SLIDING
        },
        ..synthetic::report(&mesh.mesh, solution)
    }
}

fn manifest(hash: &str) -> Manifest {
    let (case_text, case_hash) = (format!("text {hash}"), hash.to_owned());
    Manifest { case_file: "case.toml".into(), case_text, case_hash, ..Manifest::new("cea") }
}

#[test]
fn tables_hold_one_row_for_each_mode_of_a_tabulated_friction_value() {
    let (mesh, folder) = (annulus(Quad4), folder());
    let solution = solution(&mesh);
    let output = OutputFolder::open(folder.path(), &manifest("a"), Replace::SameCase).unwrap();
    let report = report(&mesh, &solution);
    write_tables(&output, &page(&report, &field(&mesh))).unwrap();
    let head = Head::of(report.title, report.wall_s);
    let summary = write_summary(&output, head, &summary(&report)).unwrap();
    let eigenvalues = fs::read_to_string(folder.path().join("eigenvalues.csv")).unwrap();
    let mut lines = eigenvalues.lines();
    assert_eq!(
        lines.next().unwrap(),
        "friction_coefficient,mode,real_hz,frequency_hz,damping_factor,growth_rate_per_s,harmonic,\
         branch,direction,unstable,residual,contact_share,mesh_error"
    );
    let rows: Vec<Vec<&str>> = lines.map(|line| line.split(',').collect()).collect();
    assert_eq!(rows.len(), 6);
    let last = &rows[5];
    assert_eq!((last[0], last[1], last[6], last[8], last[9]), ("0.3", "2", "2", "-1", "true"));
    let number = |cell: &str| cell.parse::<f64>().unwrap();
    // zeta = -Re / |lambda|, and growth rate = 2 pi Re.
    assert!((number(last[4]) + 12.5 / 12.5f64.hypot(9900.0)).abs() < 1e-15);
    assert!((number(last[5]) / (TAU * 12.5) - 1.0).abs() < 1e-15);
    let stability = fs::read_to_string(folder.path().join("stability.csv")).unwrap();
    assert_eq!(
        stability.lines().collect::<Vec<_>>(),
        [
            "harmonic,branch,direction,critical_friction,frequency_hz,restabilized_friction,\
             restabilized_frequency_hz,unstable_from_start,lost_after,mesh_error",
            "2,0,-1,0.1382,9893.0,0.9,9950.0,false,,"
        ]
    );
    assert_eq!(summary["critical_frictions"][0]["critical_friction"], 0.1382);
    assert_eq!(summary["largest_residual"], 1e-13);
    assert_eq!(summary["unstable_counts"][2]["unstable"], 1);
    assert_eq!(summary["unstable_modes"][0]["friction_coefficient"], 0.3);
    let prestress = fs::read_to_string(folder.path().join("prestress.csv")).unwrap();
    assert!(prestress.starts_with("node,angle_degrees,pressure_pa,shear_pa,status\n"));
    assert_eq!(summary["manifest"]["case_hash"], "a");
}

#[test]
fn the_printed_table_tells_stable_ranges_from_unstable_modes() {
    let mesh = annulus(Quad4);
    let solution = solution(&mesh);
    let text = document(&report(&mesh, &solution), View::Whole).to_text();
    let said = "friction 0: stable up to 0.1 ; 9900.00 ; 0.138200 ; 0.900000 ; 9950.00 ; \
         2 modes (below 10000 Hz) at 3 friction values ; \
         12 contact nodes slipping, 0 sticking, 0 open ; \
         pressure 2.8000 to 2.8300 MPa; torque 20.15 N m ; harmonics above 6";
    let short = document(&report(&mesh, &solution), View::Short).to_text();
    has(&short, &["friction 0.3: 2 modes, 1 unstable ; !stable up to"]);
    // The answer stands last; 0.25 was solved for its shapes alone.
    has(short.lines().last().unwrap(), &["0.138200"]);
    has(&text, &[said, "!0.25 "]);
}

fn attribute<'a>(tag: &'a str, name: &str) -> &'a str {
    let start = tag.find(&format!("{name}=\"")).unwrap() + name.len() + 2;
    &tag[start..start + tag[start..].find('"').unwrap()]
}

/// Decodes the appended arrays of a VTU file by name, from the format's description alone.
fn decode(bytes: &[u8], name: &str) -> Vec<u8> {
    let marker = b"<AppendedData encoding=\"raw\">\n_";
    let split = bytes.windows(marker.len()).position(|window| window == marker).unwrap();
    let head = std::str::from_utf8(&bytes[..split]).unwrap();
    let tag =
        head.split("<DataArray").find(|tag| tag.contains(&format!("Name=\"{name}\""))).unwrap();
    let offset: usize = attribute(tag, "offset").parse().unwrap();
    let data = &bytes[split + marker.len() + offset..];
    let word = |i: usize| u64::from_le_bytes(data[8 * i..8 * i + 8].try_into().unwrap()) as usize;
    let (blocks, size, last) = (word(0), word(1), word(2));
    let mut start = 8 * (3 + blocks);
    let mut out = Vec::new();
    for block in 0..blocks {
        let end = start + word(3 + block);
        ZlibDecoder::new(&data[start..end]).read_to_end(&mut out).unwrap();
        start = end;
    }
    let expected = if last == 0 { blocks * size } else { (blocks - 1) * size + last };
    assert_eq!(out.len(), expected);
    out
}

fn floats(bytes: &[u8]) -> Vec<f64> {
    bytes.as_chunks().0.iter().map(|word| f64::from_le_bytes(*word)).collect()
}

#[test]
fn a_vtu_file_gives_back_mesh_and_fields_bit_for_bit() {
    // Enough nodes for arrays of several compressed blocks.
    for (element, kind, count) in [(Quad4, 9u8, 200), (Quad8, 23, 5)] {
        let mut spec = annulus(element).specification;
        (spec.circumferential_elements, spec.radial_elements) = (count, count / 2);
        let mesh = AnnulusMesh::generate(&spec).unwrap().mesh;
        let field: Vec<f64> = (0..mesh.node_count()).map(|i| (i as f64).sin()).collect();
        let mut bytes = Vec::new();
        let fields = [Field::scalars("a < b", field.clone())];
        let whole = [("time_s", 6250.0 * 2e-6)];
        write_vtu(&mut bytes, &EncodedMesh::new(&mesh).unwrap(), &whole, &fields, &[]).unwrap();
        let head = String::from_utf8_lossy(&bytes[..400]).into_owned();
        has(&head, &["Name=\"time_s\" NumberOfTuples=\"1\" format=\"ascii\">0.0125 </"]);
        assert_eq!(floats(&decode(&bytes, "a &lt; b")), field);
        let flat: Vec<f64> = mesh.nodes.iter().flat_map(|p| [p[0], p[1], 0.0]).collect();
        assert_eq!(floats(&decode(&bytes, "Points")), flat);
        assert_eq!(decode(&bytes, "types"), vec![kind; mesh.element_count()]);
        assert_eq!(decode(&bytes, "connectivity").len(), 8 * mesh.elements.len());
        let offsets = decode(&bytes, "offsets");
        let end = i64::from_le_bytes(offsets[offsets.len() - 8..].try_into().unwrap());
        assert_eq!(end as usize, mesh.elements.len());
    }
}

#[test]
fn a_field_of_the_wrong_length_is_not_written() {
    let mesh = annulus(Quad4).mesh;
    let fields = [Field::scalars("short", vec![0.0; 3])];
    let encoded = EncodedMesh::new(&mesh).unwrap();
    assert!(write_vtu(&mut Vec::new(), &encoded, &[], &fields, &[]).is_err());
}

#[test]
fn a_rigid_translation_is_one_cartesian_vector_at_every_node() {
    let mesh = annulus(Quad8).mesh;
    let polar = mesh.frame_angles().iter().map(|angle| angle.sin_cos());
    let polar: Vec<f64> = polar.flat_map(|(s, c)| [c + 2.0 * s, 2.0 * c - s]).collect();
    for vector in cartesian_vectors(&mesh, &polar).chunks_exact(3) {
        assert!((vector[0] - 1.0).abs() < 1e-15 && (vector[1] - 2.0).abs() < 1e-15);
        assert_eq!(vector[2], 0.0);
    }
}

#[test]
fn shapes_come_as_real_and_imaginary_fields_in_a_collection() {
    let (mesh, folder) = (annulus(Quad8), folder());
    let solution = solution(&mesh);
    let output = OutputFolder::open(folder.path(), &manifest("a"), Replace::SameCase).unwrap();
    write_fields(&output, &report(&mesh, &solution), &field(&mesh)).unwrap();
    let collection = fs::read_to_string(folder.path().join("modes.pvd")).unwrap();
    let entries: Vec<_> = collection.lines().filter(|line| line.contains("<DataSet")).collect();
    let bytes = fs::read(folder.path().join(attribute(entries[0], "file"))).unwrap();
    // ParaView animates modes by time: the frequency, no two the same.
    let times: Vec<&str> = entries.iter().map(|line| attribute(line, "timestep")).collect();
    let mode = &solution.sweep.points[3].modes[1];
    let ratio = times[0].parse::<f64>().unwrap() / mode.frequency_hz();
    assert!((ratio - 1.0).abs() <= 1e-10, "{times:?} {ratio}");
    assert_eq!(BTreeSet::from_iter(&times).len(), times.len());
    let real: Vec<f64> = mode.shape.as_deref().unwrap_or_default().iter().map(|u| u.re).collect();
    assert_eq!(floats(&decode(&bytes, "displacement_real")), cartesian_vectors(&mesh.mesh, &real));
    for amplitude in floats(&decode(&bytes, "amplitude")) {
        assert!((amplitude - 2f64.sqrt()).abs() < 1e-15);
    }
}

#[test]
fn the_area_of_a_quadratic_mesh_converges_with_the_fourth_power() {
    let error = |element: ElementKind, count: usize| {
        let mut spec = annulus(element).specification;
        spec.circumferential_elements = count;
        let annulus = AnnulusMesh::generate(&spec).unwrap();
        MeshStatistics::new(&annulus.mesh, Some(&annulus), None).area_error.unwrap()
    };
    // A parabola through three points of a circle is off by the fourth power of the angle.
    for (element, order) in [(Quad4, 2.0), (Quad8, 4.0)] {
        let slope = (error(element, 12) / error(element, 24)).log2();
        assert!((slope - order).abs() < 0.1, "{element:?} {slope}");
    }
}

fn open(path: &Path, hash: &str, replace: Replace) -> Result<OutputFolder, FolderError> {
    OutputFolder::open(path, &manifest(hash), replace)
}

#[cfg(unix)]
#[test]
fn files_beyond_a_linked_subfolder_stay_as_they_are() {
    let (folder, elsewhere) = (folder(), folder());
    let first = open(folder.path(), "a", Replace::SameCase).unwrap();
    first.write("a.csv", |out| out.write_all(b"1")).unwrap();
    first.finish().unwrap();
    fs::write(elsewhere.path().join("old.svg"), "mine").unwrap();
    std::os::unix::fs::symlink(elsewhere.path(), folder.path().join("figures")).unwrap();
    for replace in [Replace::SameCase, Replace::Continued, Replace::Anything] {
        let refused = open(folder.path(), "a", replace).unwrap_err();
        assert!(refused.is_usage() && refused.to_string().contains("figures"), "{refused}");
    }
    assert_eq!(fs::read(elsewhere.path().join("old.svg")).unwrap(), b"mine");
}

#[cfg(unix)]
#[test]
fn a_file_that_cannot_be_removed_is_named() {
    use std::os::unix::fs::PermissionsExt;
    let folder = folder();
    let output = open(folder.path(), "a", Replace::SameCase).unwrap();
    output.write("steps/1.bin", |out| out.write_all(b"1")).unwrap();
    let steps = folder.path().join("steps");
    let allow = |mode| fs::set_permissions(&steps, fs::Permissions::from_mode(mode)).unwrap();
    allow(0o555);
    // Whoever may write everywhere removes it all the same.
    let is_refused = fs::File::create(steps.join("probe")).is_err();
    let found = output.discard("steps/1.bin");
    allow(0o755);
    assert_eq!(found.is_err(), is_refused);
    assert!(found.map_or_else(|error| error.to_string().contains("steps/1.bin"), |()| true));
}

#[test]
fn a_complete_run_leaves_no_file_of_an_earlier_one() {
    let folder = folder();
    for names in [["a.csv", "b.csv"], ["a.csv", "c.csv"]] {
        let output = open(folder.path(), "a", Replace::SameCase).unwrap();
        for name in names {
            output.write(name, |out| out.write_all(name.as_bytes())).unwrap();
        }
        output.finish().unwrap();
    }
    assert_eq!(names_in(folder.path()), [".lock", "a.csv", "c.csv", "manifest.json"]);
}

#[test]
fn what_a_killed_run_left_does_not_survive_another_case() {
    let folder = folder();
    let killed = open(folder.path(), "a", Replace::SameCase).unwrap();
    killed.write("figures/early.svg", |out| out.write_all(b"1")).unwrap();
    // The process dies: no end of the run, and a temporary file half written.
    drop(killed);
    fs::write(folder.path().join("figures/.writing-x"), "half").unwrap();
    open(folder.path(), "b", Replace::Anything).unwrap().finish().unwrap();
    assert!(!folder.path().join("figures/early.svg").exists());
}

#[test]
fn a_run_interrupted_before_its_first_file_leaves_its_folder_to_any_case() {
    let folder = folder();
    drop(open(folder.path(), "a", Replace::SameCase).unwrap());
    assert!(folder.path().join("manifest.json").exists());
    OutputFolder::may_open(folder.path(), &manifest("b"), Replace::SameCase).unwrap();
    let second = open(folder.path(), "b", Replace::SameCase).unwrap();
    second.write("mesh.msh", |out| out.write_all(b"1")).unwrap();
    drop(second);
    // So does one that failed after its mesh was written.
    let second = open(folder.path(), "c", Replace::SameCase).unwrap();
    second.write("a.csv", |out| out.write_all(b"1")).unwrap();
    drop(second);
    // One that has written a result keeps its folder.
    let refused = open(folder.path(), "d", Replace::SameCase).unwrap_err();
    assert!(matches!(refused, FolderError::OtherCase { .. }));
}

#[test]
fn a_failed_write_leaves_the_earlier_file_whole() {
    let folder = folder();
    let output = open(folder.path(), "a", Replace::SameCase).unwrap();
    output.write("table.csv", |out| out.write_all(b"whole")).unwrap();
    let error = output.write("table.csv", |out| {
        out.write_all(b"half")?;
        Err(std::io::ErrorKind::StorageFull.into())
    });
    let error = error.unwrap_err();
    assert!(matches!(error, FolderError::DiskFull(_)), "{error}");
    has(&error.to_string(), &["table.csv"]);
    assert_eq!(fs::read(folder.path().join("table.csv")).unwrap(), b"whole");
    assert_eq!(names_in(folder.path()), [".lock", ".written", "manifest.json", "table.csv"]);
}
