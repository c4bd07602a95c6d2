//! The shipped case, on a coarse mesh.

use crate::prelude::*;

/// Consistency: where friction falls with speed, less of it is enough at low speed, and the sensitivities name the law.
#[test]
fn the_critical_friction_of_the_shipped_case_rises_with_speed() {
    let folder = folder();
    let run = |name: &str, further: &[&str]| {
        let coarse =
            ["mesh.circumferential_elements=45 ; mesh.radial_elements=9 ; output.probes=[] ; \
             cea.friction_coefficients=[0.0, 0.3]"];
        let run = Run::of(name, shipped("falling-friction.toml")).out(folder.path().join(name));
        run.set(&coarse).set(further).done()
    };
    let speeds = "sweep={\"contact.rotation_speed_rpm\"=[30.0, 300.0, 3000.0], analyses=[\"cea\"]}";
    let map = run("sweep", &[speeds]).text("stability.csv");
    let critical = ["30", "300", "3000"].map(|speed| {
        let mut rows = map.lines().filter(|row| row.starts_with(&format!("{speed},1,1,")));
        rows.next().unwrap().split(',').nth(4).unwrap().parse::<f64>().unwrap()
    });
    assert!(critical[0] < 0.7 * critical[2] && critical[1] < 0.95 * critical[2], "{critical:?}");
    let head = run("cea", &[]).header("sensitivities.csv");
    assert!(head.contains("growth_rate_per_decay_speed,frequency_hz_per_decay_speed"));
}
