//! Cases in three dimensions that cannot be: each message names key and remedy.

use super::{assert_reports, report};

const RING: &str = include_str!("../../../cases/ring-on-layer.toml");

#[test]
fn bodies_without_thickness_rings_beside_the_face_and_contact_at_rest_are_refused_with_the_key() {
    let cases: [(&[&str], [&str; 2]); 6] = [
        (
            &["contact.ring_inner_radius=0.01"],
            ["contact.ring_inner_radius = 0.01 lies outside the face", "0.0205 to 0.0905"],
        ),
        (
            &["contact.ring_outer_radius=0.1"],
            ["contact.ring_outer_radius = 0.1 lies outside the face", "geometry.outer_radius"],
        ),
        (
            &["contact.ring_inner_radius=0.07", "contact.ring_outer_radius=0.03"],
            ["must be above contact.ring_inner_radius", "are they swapped?"],
        ),
        (&["contact.rotation_speed_rpm=0"], ["contact.rotation_speed_rpm = 0", "infinite dashpot"]),
        (
            &["contact.normal_stiffness=rigid", "contact.base_state=compliant"],
            [
                "contact.base_state = \"compliant\" needs contact.normal_stiffness",
                "leave base_state out",
            ],
        ),
        (
            &["material.formulation=plane-stress"],
            ["mesh.axial_elements has no effect on a plane body", "leave mesh.axial_elements out"],
        ),
    ];
    for (overrides, parts) in &cases {
        assert_reports(&report(RING, overrides), parts);
    }
    let disc = include_str!("../../../cases/disc-three-dimensions.toml");
    let outer =
        "boundaries.outer={condition=\"support\",normal_stiffness=1e12,tangential_stiffness=1e12}";
    let parts = ["nothing holds the body along its axis", "axial_stiffness above 0"];
    assert_reports(&report(disc, &[outer]), &parts);
    let flat = RING.replace("thickness = 0.009\n", "");
    assert_ne!(flat, RING);
    let parts = ["geometry.thickness is missing", "for example thickness = 0.009"];
    assert_reports(&report(&flat, &[]), &parts);
}

#[test]
fn axial_forces_on_plane_bodies_are_refused_with_the_key() {
    let disc = include_str!("../../../cases/hammer-test.toml");
    for key in ["force_direction", "response_direction"] {
        let set = format!("frf.{key}=\"axial\"");
        let found = format!("frf.{key} = \"axial\": a plane body does not move along its axis");
        let parts = [found.as_str(), "use \"radial\" or \"tangential\""];
        assert_reports(&report(disc, &[&set]), &parts);
    }
}
