//! Element kinds in mesh files: their numbers or names, and the order of their nodes and faces.

/// Elements of a kind in one format.
pub(crate) struct Listing<T: 'static> {
    /// Its numbers or names in the format; none where the format has no such element. Of kinds that share one the first in
    /// [`super::ElementKind::ALL`] is read.
    pub names: &'static [T],
    /// For each node of the kind its place in the file; empty where the order is the same.
    pub order: &'static [usize],
}

impl<T> Listing<T> {
    /// The nodes of an element in the order of its kind, from that of the file.
    pub fn arranged(&self, listed: &[u32]) -> Vec<u32> {
        match self.order {
            [] => listed.to_vec(),
            order => order.iter().map(|&place| listed[place]).collect(),
        }
    }
}

/// A kind in every format.
pub(crate) struct Formats {
    /// Cell type of VTK, which numbers its nodes as [`super::ElementKind`] does.
    pub vtk: u8,
    /// Element types of Gmsh's MSH format.
    pub gmsh: Listing<u32>,
    /// Descriptors of dataset 2412 of universal files, where corners and middles take turns around each face.
    pub universal: Listing<usize>,
    /// Cards of Nastran, where middles along the height come before those of the top.
    pub nastran: Listing<&'static str>,
    /// Element types of Abaqus and CalculiX behind `C3D`, or `CPE` and `CPS` in the plane, with what differs here from what
    /// the name asks for, empty for nothing.
    pub abaqus: &'static [(&'static [&'static str], &'static str)],
}

const FULL: &str = "fully integrated here";
const DISPLACEMENTS: &str = "by displacements alone here";
const BRICK: &str = "integrated with incompatible modes here";

/// The same order as here.
const fn listed<T>(names: &'static [T]) -> Listing<T> {
    Listing { names, order: &[] }
}

pub(super) const TRI3: Formats = Formats {
    vtk: 5,
    gmsh: listed(&[2]),
    universal: listed(&[41, 51, 91]),
    nastran: listed(&[]),
    abaqus: &[(&["3", "3H"], "")],
};
pub(super) const TRI6: Formats = Formats {
    vtk: 22,
    gmsh: listed(&[9]),
    universal: Listing { names: &[42, 52, 92], order: &[0, 2, 4, 1, 3, 5] },
    abaqus: &[(&["6"], ""), (&["6M", "6H", "6MH"], DISPLACEMENTS)],
    ..TRI3
};
pub(super) const QUAD4: Formats = Formats {
    vtk: 9,
    gmsh: listed(&[3]),
    universal: listed(&[44, 54, 94]),
    nastran: listed(&[]),
    abaqus: &[(&["4"], ""), (&["4R", "4I", "4H", "4RH", "4IH"], FULL)],
};
pub(super) const QUAD8: Formats = Formats {
    vtk: 23,
    gmsh: listed(&[16]),
    universal: Listing { names: &[45, 55, 95], order: &[0, 2, 4, 6, 1, 3, 5, 7] },
    abaqus: &[(&["8"], ""), (&["8R", "8H", "8RH"], FULL)],
    ..QUAD4
};
pub(super) const TET4: Formats = Formats {
    vtk: 10,
    gmsh: listed(&[4]),
    universal: listed(&[111]),
    nastran: listed(&["CTETRA"]),
    abaqus: &[(&["4"], ""), (&["4H"], DISPLACEMENTS)],
};
pub(super) const TET10: Formats = Formats {
    vtk: 24,
    gmsh: Listing { names: &[11], order: &[0, 1, 2, 3, 4, 5, 6, 7, 9, 8] },
    universal: Listing { names: &[118], order: &[0, 2, 4, 9, 1, 3, 5, 6, 7, 8] },
    abaqus: &[(&["10"], ""), (&["10H", "10HS", "10M", "10MH", "10I", "10T"], DISPLACEMENTS)],
    ..TET4
};
pub(super) const HEX8: Formats = Formats {
    vtk: 12,
    gmsh: listed(&[5]),
    universal: listed(&[115]),
    nastran: listed(&["CHEXA"]),
    abaqus: &[(&["8", "8R", "8H", "8RH"], BRICK), (&["8I", "8IH"], "")],
};
pub(super) const HEX20: Formats = Formats {
    vtk: 25,
    gmsh: Listing {
        names: &[17],
        order: &[0, 1, 2, 3, 4, 5, 6, 7, 8, 11, 13, 9, 16, 18, 19, 17, 10, 12, 14, 15],
    },
    universal: Listing {
        names: &[116],
        order: &[0, 2, 4, 6, 12, 14, 16, 18, 1, 3, 5, 7, 13, 15, 17, 19, 8, 9, 10, 11],
    },
    nastran: Listing {
        names: &["CHEXA"],
        order: &[0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 16, 17, 18, 19, 12, 13, 14, 15],
    },
    abaqus: &[(&["20"], ""), (&["20H"], FULL)],
};
pub(super) const HEX20R: Formats =
    Formats { abaqus: &[(&["20R"], ""), (&["20RH"], DISPLACEMENTS)], ..HEX20 };
pub(super) const WEDGE6: Formats = Formats {
    vtk: 13,
    gmsh: listed(&[6]),
    universal: listed(&[112]),
    nastran: listed(&["CPENTA"]),
    abaqus: &[(&["6"], ""), (&["6R", "6H"], FULL)],
};
pub(super) const WEDGE15: Formats = Formats {
    vtk: 26,
    gmsh: Listing { names: &[18], order: &[0, 1, 2, 3, 4, 5, 6, 9, 7, 12, 14, 13, 8, 10, 11] },
    universal: Listing {
        names: &[113],
        order: &[0, 2, 4, 9, 11, 13, 1, 3, 5, 10, 12, 14, 6, 7, 8],
    },
    nastran: Listing {
        names: &["CPENTA"],
        order: &[0, 1, 2, 3, 4, 5, 6, 7, 8, 12, 13, 14, 9, 10, 11],
    },
    abaqus: &[(&["15"], ""), (&["15H"], FULL)],
};
pub(super) const PYRAMID5: Formats = Formats {
    vtk: 14,
    gmsh: listed(&[7]),
    universal: listed(&[]),
    nastran: listed(&["CPYRAM", "CPYRA"]),
    abaqus: &[(&["5"], ""), (&["5H"], DISPLACEMENTS)],
};
pub(super) const PYRAMID13: Formats = Formats {
    vtk: 27,
    gmsh: Listing { names: &[19], order: &[0, 1, 2, 3, 4, 5, 8, 10, 6, 7, 9, 11, 12] },
    abaqus: &[(&["13"], ""), (&["13H"], DISPLACEMENTS)],
    ..PYRAMID5
};
