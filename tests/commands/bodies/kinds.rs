//! The kinds of bodies, coarse.

use crate::prelude::*;

pub struct Kind {
    pub name: &'static str,
    pub case: String,
    pub mesh: Option<Vec<u8>>,
    /// The kind that is the same body described otherwise.
    pub twin: Option<&'static str>,
}

const AROUND: usize = 32;
const ACROSS: usize = 6;
const POLYCARBONATE: &str = "young_modulus = 2.5e9\npoisson_ratio = 0.3805\ndensity = 1228.0\n";
/// Stiffer around than outwards; axes about the disc's own.
const LINING: &str = "young_moduli = [2e9, 5e9, 1.5e9]\npoisson_ratios = [0.2, 0.3, 0.25]\n\
    shear_moduli = [1.2e9, 0.8e9, 0.9e9]\naxes = \"cylindrical\"\ndensity = 1700.0\n";
const STEEL: &str = "young_modulus = 2.1e11\npoisson_ratio = 0.3\ndensity = 7850.0\n";
const ANALYSES: &str = "[damping]\nmass_coefficient = 40.0\nstiffness_coefficient = 4.5e-7\n
[cea]\nfriction_coefficients = [0.0, 0.15, 0.3]\nmodes = 8\ngeometric_stiffness = false\n
[transient]\nduration = 3e-4\nexpansion_time = 1e-4\n";

/// A case of its geometry and mesh, its material, what the contact has beside friction, and further sections.
fn case(geometry: &str, contact: &str, further: &str) -> String {
    format!(
        "title = \"A kind of body\"\n[geometry]\nthickness = 0.009\n{geometry}\n[material]\n{POLYCARBONATE}
[contact]\nfriction_coefficient = 0.3\n{contact}\n{further}\n{ANALYSES}"
    )
}

fn annulus(geometry: &str, contact: &str, further: &str) -> String {
    let geometry = format!(
        "inner_radius = 0.0205\nouter_radius = 0.0905\n{geometry}\n\
         [mesh]\ncircumferential_elements = {AROUND}\nradial_elements = {ACROSS}"
    );
    let contact = format!("interference = 25e-6\nrotation_speed_rpm = 610.0\n{contact}");
    case(&geometry, &contact, further)
}

fn imported(contact: &str, further: &str) -> String {
    let contact = format!("interference = 25e-6\nrotation_speed_rpm = 610.0\n{contact}");
    let further = format!("[boundaries.outer]\ncondition = \"clamped\"\n{further}");
    case("[mesh]\nfile = \"body.msh\"", &contact, &further)
}

fn disc<'a>(region_of_layer: &'a dyn Fn(usize) -> &'a str) -> Grid<'a> {
    ring_grid([0.0205, 0.0905], [AROUND, ACROSS], ["inner", "outer"], region_of_layer)
}

/// Disc and shaft in one file, the shaft of `around` elements.
fn two_bodies(around: usize) -> Vec<u8> {
    let shaft = ring_grid([0.006, 0.0205], [around, 2], ["bore", "journal"], &|_| "shaft");
    grids(&[disc(&|_| "disc"), shaft])
}

/// A slab that turns about a far axis, a lining pressed on it, and a backplate glued to the lining, whose meshes do not match: on
/// springs against the slab as `contact` says, held at a side of the plate by springs of `support` Pa/m.
fn solids(contact: &str, support: &str, counts: [[usize; 3]; 3]) -> (String, Vec<u8>) {
    let block = |name, bottom, height, counts| {
        brick(name, [0.0, 0.0, bottom], [0.04, 0.035, height], counts)
    };
    let blocks = [
        block("slab", -0.035, 0.02, counts[0]),
        block("lining", -0.015, 0.01, counts[1]),
        block("plate", -0.005, 0.005, counts[2]),
    ];
    let mesh = file_of(&blocks, |point| point);
    let case = format!(
        "title = \"A kind of body\"\n[mesh]\nfile = \"body.msh\"\n[material]\n{POLYCARBONATE}
[boundaries.slab_z0]\ncondition = \"clamped\"
[boundaries.plate_z1]\ncondition = \"pressure\"\npressure = 1e5
[boundaries.plate_x0]\ncondition = \"support\"\nnormal_stiffness = {support}\ntangential_stiffness = {support}
[motion.slab]\naxis = [0.0, 0.0, 1.0]\ncenter = [0.5, 0.1, 0.0]\nrotation_speed_rpm = 100.0
[contacts.pad]\nsurface = \"lining_z0\"\ncounter = \"slab_z1\"\nfriction_coefficient = 0.3\n{contact}
[ties.glue]\nsurface = \"lining_z1\"\ncounter = \"plate_z0\"\n{ANALYSES}"
    );
    (case, mesh)
}

/// One sector of a ring around a cylinder, whose body is its six copies; its own friction lies above the onset at 0.12.
fn sectors() -> (String, Vec<u8>) {
    let sector = brick("ring", [0.0205, 0.0, 0.0], [0.07, TAU / 6.0, 0.009], [3, 2, 1]);
    let mesh = file_of(&[sector], polar);
    let case = format!(
        "title = \"A kind of body\"\n[mesh]\nfile = \"body.msh\"\nsectors = 6\n[material]\n{POLYCARBONATE}
[boundaries.ring_x1]\ncondition = \"clamped\"\n[boundaries.ring_z0]\ncondition = \"guide\"
[contact]\nboundary = \"ring_x0\"\ncounterface = \"cylinder\"\ninterference = 25e-6
rotation_speed_rpm = 610.0\nfriction_coefficient = 0.3\n{ANALYSES}"
    );
    (case, mesh)
}

impl Kind {
    /// The same body as another kind.
    fn like(self, twin: &'static str) -> Self {
        Self { twin: Some(twin), ..self }
    }
}

pub fn kinds() -> Vec<Kind> {
    let kind = |name, case| Kind { name, case, mesh: None, twin: None };
    let of_file = |name, case, mesh| Kind { name, case, mesh: Some(mesh), twin: None };
    let shaft = format!("[materials.shaft]\n{STEEL}");
    let journal = "boundary = \"inner\"\ncounterface = \"body\"\ncounter_boundary = \"journal\"\n";
    let bore = format!("{shaft}[boundaries.bore]\ncondition = \"clamped\"\n");
    let springs = "normal_stiffness = 7.4e12\n";
    let support = "[boundaries.outer]\ncondition = \"support\"\nnormal_stiffness = 2e11\ntangential_stiffness = 2e11\n";
    let stiffening = "normal_law = \"exponential\"\nreference_pressure = 2e5\nheight = 2e-6\n";
    let falling = "static_friction_ratio = 1.2\ndecay_speed = 2.0\n";
    let block = case(
        "[mesh]\nfile = \"body.msh\"",
        "boundary = \"face\"\ncounterface = \"plane\"\ndirection = [1.0, 0.0]\nspeed = 1.5\ninterference = 1e-5\n",
        "[boundaries.back]\ncondition = \"support\"\nnormal_stiffness = 1e12\ntangential_stiffness = 1e12\n",
    );
    let solid = |contact: &str, further: &str| {
        annulus("", contact, further).replace(
            "[material]\n",
            "axial_elements = 1\n[material]\nformulation = \"three-dimensional\"\n",
        )
    };
    let coarse = [[2, 2, 1], [3, 2, 1], [2, 2, 1]];
    let small = [[[1, 2, 1], [2, 2, 1], [1, 2, 1]], [[1, 1, 1], [2, 1, 1], [1, 1, 1]]];
    let [slides, stiffens] = sized(small, [[[3, 2, 1], [4, 3, 1], [3, 3, 1]], coarse]);
    let (slides, slides_mesh) = solids("normal_stiffness = 1e12", "1e12", slides);
    // Its own friction lies above the onset at 0.2, which coarser meshes do not have.
    let (squeals, squeals_mesh) = solids("normal_stiffness = 1e11", "1e10", coarse);
    let (stiffens, stiffens_mesh) = solids(stiffening, "1e10", stiffens);
    let (of_sectors, sector) = sectors();
    vec![
        kind("annulus", annulus("", "", "")),
        kind("annulus, springs in the contact", annulus("", springs, "")),
        kind("annulus, stiffening contact", annulus("", stiffening, "")),
        of_file(
            "annulus from a file, stiffening contact",
            imported(stiffening, ""),
            grids(&[disc(&|_| "disc")]),
        )
        .like("annulus, stiffening contact"),
        kind("annulus, supported", annulus("", "", support)),
        kind("annulus, falling friction", annulus("", falling, "")),
        kind("annulus and shaft", {
            let text = annulus("shaft_inner_radius = 0.006", "", &shaft);
            text.replace("radial_elements = 6", "radial_elements = 6\nshaft_radial_elements = 2")
        }),
        of_file("annulus from a file", imported("", ""), grids(&[disc(&|_| "disc")]))
            .like("annulus"),
        kind("orthotropic annulus", annulus("", "", "").replace(POLYCARBONATE, LINING)),
        of_file(
            "orthotropic annulus from a file",
            imported("", "").replace(POLYCARBONATE, LINING),
            grids(&[disc(&|_| "disc")]),
        )
        .like("orthotropic annulus"),
        of_file(
            "triangles from a file",
            imported("", ""),
            grids(&[Grid { is_cut: true, ..disc(&|_| "disc") }]),
        ),
        of_file(
            "two materials",
            imported(
                "",
                &format!(
                    "[materials.rim]\n{STEEL}mass_coefficient = 40.0\nstiffness_coefficient = 1e-8\n"
                ),
            ),
            grids(&[disc(&|layer| if layer < 4 { "disc" } else { "rim" })]),
        ),
        of_file(
            "block, contact opens in part",
            block,
            quadrilaterals(&even(0.04, 10), &even(0.06, 10), ["face", "back", "block"], |x, y| {
                [x, y]
            }),
        ),
        of_file("two bodies, matching", imported(journal, &bore), two_bodies(AROUND))
            .like("annulus and shaft"),
        of_file("two bodies, not matching", imported(journal, &bore), two_bodies(24)),
        kind("body of revolution, contact on the edge", solid("", "")),
        kind(
            "body of revolution, contact on a face",
            solid(
                "boundary = \"top\"\nring_inner_radius = 0.04\nring_outer_radius = 0.07\nnormal_stiffness = 1e12\n",
                "[boundaries.bottom]\ncondition = \"guide\"\n",
            ),
        ),
        of_file("solid bodies, tied and sliding", slides, slides_mesh),
        of_file("solid bodies, squealing", squeals, squeals_mesh),
        of_file("solid bodies, stiffening contact", stiffens, stiffens_mesh),
        of_file("solid of sectors", of_sectors, sector),
    ]
}
