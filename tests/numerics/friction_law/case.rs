//! The shipped case, on a coarse mesh.

use assert_cmd::Command;
use std::fs;
use std::path::Path;

/// Consistency: where friction falls with speed, less of it is enough at low speed, and the sensitivities name the law.
#[test]
fn the_critical_friction_of_the_shipped_case_rises_with_speed() {
    let folder = tempfile::tempdir().unwrap();
    let case = Path::new(env!("CARGO_MANIFEST_DIR")).join("cases/falling-friction.toml");
    let run = |name: &str, further: &[&str]| {
        let mut command = Command::cargo_bin("frictionsim").unwrap();
        command.arg(name).arg(&case).arg("--out").arg(folder.path().join(name));
        let coarse = [
            "mesh.circumferential_elements=45",
            "mesh.radial_elements=9",
            "output.probes=[]",
            "cea.friction_coefficients=[0.0, 0.3]",
        ];
        for change in coarse.iter().chain(further) {
            command.args(["--set", change]);
        }
        command.arg("--no-figures").assert().success();
    };
    run("cea", &[]);
    run(
        "sweep",
        &["sweep={\"contact.rotation_speed_rpm\"=[30.0, 300.0, 3000.0], analyses=[\"cea\"]}"],
    );
    let map = fs::read_to_string(folder.path().join("sweep/stability.csv")).unwrap();
    let critical: Vec<f64> = ["30.0", "300.0", "3000.0"]
        .iter()
        .map(|speed| {
            let mut rows = map.lines().filter(|row| row.starts_with(&format!("{speed},1,1,")));
            rows.next().unwrap().split(',').nth(4).unwrap().parse().unwrap()
        })
        .collect();
    assert!(critical[0] < 0.7 * critical[2] && critical[1] < 0.95 * critical[2], "{critical:?}");
    let table = fs::read_to_string(folder.path().join("cea/sensitivities.csv")).unwrap();
    let head = table.lines().next().unwrap();
    assert!(head.contains("growth_rate_per_decay_speed,frequency_hz_per_decay_speed"));
}
