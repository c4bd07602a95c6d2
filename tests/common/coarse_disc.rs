//! The paper's disc on a coarse mesh as the text of a case, for commands that are run from end to end.

/// Geometry, material, damping and contact at friction coefficient 0.3, and the sections that a test adds.
pub fn coarse_disc(sections: &str) -> String {
    disc_of([36, 6], sections)
}

/// The same on so many elements around and across.
pub fn disc_of([around, across]: [usize; 2], sections: &str) -> String {
    format!(
        "title = \"Coarse disc\"
[geometry]\ninner_radius = 0.0205\nouter_radius = 0.0905\nthickness = 0.009
[mesh]\ncircumferential_elements = {around}\nradial_elements = {across}
[material]\nyoung_modulus = 2.5e9\npoisson_ratio = 0.3805\ndensity = 1228.0
[damping]\nmass_coefficient = 40.0\nstiffness_coefficient = 4.5e-7
[contact]\nfriction_coefficient = 0.3\ninterference = 25e-6\nrotation_speed_rpm = 610.0\n\
     {sections}"
    )
}
