//! Surfaces that make no contact or tie.

/// Why two surfaces make no pair.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum PairError {
    /// A surface has no faces.
    #[error("surface \"{0}\" has no faces on the outside of the bodies")]
    NoFaces(String),
    /// They are too far from each other.
    #[error(
        "surfaces \"{surface}\" and \"{counter}\" face each other but stand {distance:.3e} m apart, more than half an element \
         ({reach:.3e} m): move the bodies together in the mesh, or name other surfaces"
    )]
    Apart {
        /// Own surface.
        surface: String,
        /// Counter surface.
        counter: String,
        /// Smallest distance along the normal, m.
        distance: f64,
        /// Largest that is bridged, m.
        reach: f64,
    },
    /// The outward normals point the same way.
    #[error(
        "surface \"{surface}\" faces away from \"{counter}\": where they lie over each other their outward normals point the \
         same way; name the surfaces that touch"
    )]
    FacesAway {
        /// Own surface.
        surface: String,
        /// Counter surface.
        counter: String,
    },
    /// Nothing lies over anything.
    #[error(
        "surfaces \"{surface}\" and \"{counter}\" never meet: along its normals no face of the one lies over a face of the other; \
         name the surfaces that touch"
    )]
    NeverMeets {
        /// Own surface.
        surface: String,
        /// Counter surface.
        counter: String,
    },
    /// A measured surface has no point near one of the contact's.
    #[error(
        "no measured point of {file} lies within {reach:.3e} m of ({:.6}, {:.6}, {:.6}) m on surface \"{surface}\"; the nearest is \
         {distance:.3e} m away: x, y, z are metres in the coordinates of the mesh, and the points cover the whole surface",
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
    /// The counter surface does not move relative to the surface.
    #[error(
        "nothing slides between surfaces \"{surface}\" and \"{counter}\": the motion given leaves them at rest to each other; \
         check the axis, the centre and the regions of [motion]"
    )]
    NoSliding {
        /// Own surface.
        surface: String,
        /// Counter surface.
        counter: String,
    },
}
