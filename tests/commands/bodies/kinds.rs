//! The kinds of bodies, coarse.

use crate::prelude::*;

pub struct Kind {
    pub name: &'static str,
    pub case: String,
    pub mesh: Option<Vec<u8>>,
    /// The kind that is the same body described otherwise.
    pub twin: Option<&'static str>,
}

const ANNULUS: &str = include_str!("annulus.toml");
const FILE: &str = include_str!("file.toml");
const REVOLUTION: &str = include_str!("revolution.toml");
const POLYCARBONATE: &str = "young_modulus = 2.5e9\npoisson_ratio = 0.3805\ndensity = 1228.0\n";
/// Stiffer around than outwards; axes about the disc's own.
const LINING: &str = "young_moduli = [2e9, 5e9, 1.5e9]\npoisson_ratios = [0.2, 0.3, 0.25]
shear_moduli = [1.2e9, 0.8e9, 0.9e9]\naxes = \"cylindrical\"\ndensity = 1700.0\n";
const STEEL: &str = "young_modulus = 2.1e11\npoisson_ratio = 0.3\ndensity = 7850.0\n";
const FALLING: &str = "static_friction_ratio = 1.2\ndecay_speed = 2.0\n";
const STIFFENING: &str = "normal_law = \"exponential\"\nreference_pressure = 2e5\nheight = 2e-6\n";

/// A kind of the text of a case, to which it adds keys of the contact and further sections.
fn kind(name: &'static str, case: &str, further: &str) -> Kind {
    let case = format!("{case}{further}{}", include_str!("analyses.toml"));
    Kind { name, case, mesh: None, twin: None }
}

impl Kind {
    fn on(self, mesh: Vec<u8>) -> Self {
        Self { mesh: Some(mesh), ..self }
    }

    /// The same body as another kind.
    fn like(self, twin: &'static str) -> Self {
        Self { twin: Some(twin), ..self }
    }

    fn but(self, old: &str, new: &str) -> Self {
        Self { case: self.case.replace(old, new), ..self }
    }
}

/// A boundary on springs, Pa/m.
fn on_springs(boundary: &str, stiffness: &str) -> String {
    format!(
        "[boundaries.{boundary}]\ncondition = \"support\"\nnormal_stiffness = {stiffness}
tangential_stiffness = {stiffness}\n"
    )
}

fn disc<'a>(region_of_layer: &'a dyn Fn(usize) -> &'a str) -> Grid<'a> {
    ring_grid([0.0205, 0.0905], [32, 6], ["inner", "outer"], region_of_layer)
}

/// Disc and shaft in one file, the shaft of `around` elements.
fn two_bodies(around: usize) -> Vec<u8> {
    let shaft = ring_grid([0.006, 0.0205], [around, 2], ["bore", "journal"], &|_| "shaft");
    grids(&[disc(&|_| "disc"), shaft])
}

/// A slab that turns about a far axis, a lining pressed on it, and a backplate glued to the lining, whose meshes do not match: on
/// springs against the slab as `contact` says, held at a side of the plate by springs of `support` Pa/m.
fn solids(name: &'static str, contact: &str, support: &str, counts: [[usize; 3]; 3]) -> Kind {
    let block = |name, bottom, height, counts| {
        brick(name, [0.0, 0.0, bottom], [0.04, 0.035, height], counts)
    };
    let blocks = [
        block("slab", -0.035, 0.02, counts[0]),
        block("lining", -0.015, 0.01, counts[1]),
        block("plate", -0.005, 0.005, counts[2]),
    ];
    let further = contact.to_owned() + &on_springs("plate_x0", support);
    kind(name, include_str!("solids.toml"), &further).on(file_of(&blocks, |point| point))
}

/// The kinds, in the order of the table.
pub fn kinds() -> Vec<Kind> {
    let whole = || grids(&[disc(&|_| "disc")]);
    let opening = plane_block([0.04, 0.06], [10; 2], ["face", "back", "block"]);
    let shaft = format!("[materials.shaft]\n{STEEL}");
    let journal = format!(
        "boundary = \"inner\"\ncounterface = \"body\"\ncounter_boundary = \"journal\"\n{shaft}
[boundaries.bore]\ncondition = \"clamped\"\n"
    );
    let rim =
        format!("[materials.rim]\n{STEEL}mass_coefficient = 40.0\nstiffness_coefficient = 1e-8\n");
    let face = "boundary = \"top\"\nring_inner_radius = 0.04\nring_outer_radius = 0.07
normal_stiffness = 1e12\n[boundaries.bottom]\ncondition = \"guide\"\n";
    let coarse = [[2, 2, 1], [3, 2, 1], [2, 2, 1]];
    let small = [[[1, 2, 1], [2, 2, 1], [1, 2, 1]], [[1, 1, 1], [2, 1, 1], [1, 1, 1]]];
    let [slides, stiffens] = sized(small, [[[3, 2, 1], [4, 3, 1], [3, 3, 1]], coarse]);
    // One sector of a ring around a cylinder, whose body is its six copies; its own friction lies above the onset at 0.12.
    let sector = brick("ring", [0.0205, 0.0, 0.0], [0.07, TAU / 6.0, 0.009], [3, 2, 1]);
    vec![
        kind("annulus", ANNULUS, ""),
        kind("annulus, springs in the contact", ANNULUS, "normal_stiffness = 7.4e12\n"),
        kind("annulus, stiffening contact", ANNULUS, STIFFENING),
        kind("annulus from a file, stiffening contact", FILE, STIFFENING)
            .on(whole())
            .like("annulus, stiffening contact"),
        kind("annulus, supported", ANNULUS, &on_springs("outer", "2e11")),
        kind("annulus, falling friction", ANNULUS, FALLING),
        kind("annulus and shaft", ANNULUS, &shaft)
            .but("[mesh]\n", "shaft_inner_radius = 0.006\n[mesh]\nshaft_radial_elements = 2\n"),
        kind("annulus from a file", FILE, "").on(whole()).like("annulus"),
        kind("orthotropic annulus", ANNULUS, "").but(POLYCARBONATE, LINING),
        kind("orthotropic annulus from a file", FILE, "")
            .but(POLYCARBONATE, LINING)
            .on(whole())
            .like("orthotropic annulus"),
        kind("triangles from a file", FILE, "")
            .on(grids(&[Grid { is_cut: true, ..disc(&|_| "disc") }])),
        kind("two materials", FILE, &rim)
            .on(grids(&[disc(&|layer| if layer < 4 { "disc" } else { "rim" })])),
        kind("block, contact opens in part", include_str!("block.toml"), "").on(opening),
        kind("two bodies, matching", FILE, &journal).on(two_bodies(32)).like("annulus and shaft"),
        kind("two bodies, not matching", FILE, &journal).on(two_bodies(24)),
        kind("body of revolution, contact on the edge", REVOLUTION, ""),
        kind("body of revolution, contact on a face", REVOLUTION, face),
        solids("solid bodies, tied and sliding", "normal_stiffness = 1e12\n", "1e12", slides),
        // Its own friction lies above the onset at 0.2, which coarser meshes do not have.
        solids("solid bodies, squealing", "normal_stiffness = 1e11\n", "1e10", coarse),
        solids("solid bodies, stiffening contact", STIFFENING, "1e10", stiffens),
        kind("solid of sectors", include_str!("sectors.toml"), "").on(file_of(&[sector], polar)),
    ]
}
