//! Surfaces that make no contact or tie.

/// Why two surfaces make no pair.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum PairError {
    /// A surface has no faces.
    #[error("surface \"{0}\" has no faces on the outside of the bodies")]
    NoFaces(String),
    /// They are too far from each other.
    #[error(
        "surfaces \"{}\" and \"{}\" face each other but stand {distance:.3e} m \
         apart, more than half an element ({reach:.3e} m). Move the bodies together in the mesh, \
         or name other surfaces", names[0], names[1]
    )]
    Apart {
        /// Own and counter surface.
        names: [String; 2],
        /// Smallest distance along the normal, m.
        distance: f64,
        /// Largest that is bridged, m.
        reach: f64,
    },
    /// The outward normals of own and counter surface point the same way.
    #[error(
        "surface \"{}\" faces away from \"{}\": where they lie over each other their \
         outward normals point the same way. Name the surfaces that touch",
        .0[0], .0[1]
    )]
    FacesAway([String; 2]),
    /// Nothing of the own surface lies over anything of the counter surface.
    #[error(
        "surfaces \"{}\" and \"{}\" never meet: along its normals no face of the one \
         lies over a face of the other. Name the surfaces that touch", .0[0], .0[1]
    )]
    NeverMeets([String; 2]),
    /// A measured surface has no point near one of the contact's.
    #[error(
        "no measured point of {file} lies within {reach:.3e} m of ({:.6}, {:.6}, {:.6}) m on \
         surface \"{surface}\". The nearest is {distance:.3e} m away. Give x, y, z in metres, in \
         the coordinates of the mesh, and points over the whole surface",
        position[0], position[1], position[2]
    )]
    NotMeasured {
        /// Own surface.
        surface: String,
        /// File of the measurement.
        file: String,
        /// The contact point, m.
        position: [f64; 3],
        /// How far the nearest measured point is from it, m.
        distance: f64,
        /// Distance within which one is needed, m.
        reach: f64,
    },
    /// The counter surface does not move relative to the own one.
    #[error(
        "nothing slides between surfaces \"{}\" and \"{}\": the motion given leaves \
         them at rest to each other. Check the axis, the centre and the regions of [motion]",
        .0[0], .0[1]
    )]
    NoSliding([String; 2]),
    /// A rigid counterface does not move, or along its normal alone.
    #[error(
        "nothing slides over surface \"{0}\": its rigid counterface is at rest, or moves along its normal; check its speed, \
         direction and axis"
    )]
    AtRest(String),
    /// Nothing of a surface can move.
    #[error(
        "all of surface \"{0}\" is held: nothing of it can give way to the rigid counterface; name another surface, or hold less"
    )]
    AllHeld(String),
    /// A surface that is no part of a cylinder or sphere, about which nothing else says how large that is.
    #[error(
        "surface \"{surface}\" is not round about the axis or centre of its counterface: node \
         {node} lies {distance:.6e} m away, the mean is {mean:.6e} m. Correct `center` and `axis`, \
         or give its `radius`"
    )]
    NotRound {
        /// Own surface.
        surface: String,
        /// Number of the node in the mesh file.
        node: usize,
        /// Its distance from the axis or the centre, m.
        distance: f64,
        /// The mean distance, m.
        mean: f64,
    },
    /// A rigid plane that would move out of itself.
    #[error(
        "the rigid plane under surface \"{surface}\" has the normal ({:.6}, {:.6}, {:.6}) and would {}: {}",
        normal[0], normal[1], normal[2],
        if *is_turning { "tilt" } else { "move along it" },
        if *is_turning { "give that normal as `axis`" } else { "correct `direction`" }
    )]
    LeavesPlane {
        /// Own surface.
        surface: String,
        /// Normal of the plane.
        normal: [f64; 3],
        /// Whether it turns about an axis.
        is_turning: bool,
    },
}
