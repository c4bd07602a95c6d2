//! The paper's disc on a coarse mesh as the text of a case, for commands that are run from end to end.

/// Geometry, material, damping and contact at friction coefficient 0.3, and the sections that a test adds.
pub fn coarse_disc(sections: &str) -> String {
    format!(
        r#"
title = "Coarse disc"
[geometry]
inner_radius = 0.0205
outer_radius = 0.0905
thickness = 0.009
[mesh]
circumferential_elements = 36
radial_elements = 6
[material]
young_modulus = 2.5e9
poisson_ratio = 0.3805
density = 1228.0
[damping]
mass_coefficient = 40.0
stiffness_coefficient = 4.5e-7
[contact]
friction_coefficient = 0.3
interference = 25e-6
rotation_speed_rpm = 610.0
{sections}"#
    )
}
