//! Every key a case can have: the one declaration that readers, messages, `frictionsim keys`, the
//! JSON schema and the commented template are made from.

use super::key::Bound::{AtLeast, Between, Finite, NotNegative, Positive};
use super::key::Default::{Otherwise, Required, RequiredUnless, Value};
use super::key::Kind::{
    Choice, Choices, Count, Counts, Directions, Flag, Node, Nodes, Number, NumberOr, Numbers,
    Parameter, Table, Text, Texts,
};
use super::key::{CaseKey, Default, Kind};
use super::range::Spacing;
use super::words::{
    Analysis, AxesWord, BaseContact, CeaMethod, Combination, ConditionWord, CounterfaceWord,
    FilePart, FrfMethod, HeldAxis, ModificationKind, NormalLawWord, OnsetChoice, StabilityChoice,
    UnitsWord, words,
};
use crate::fem::{MassKind, PlaneFormulation, RotationFrame};
use crate::frf::{Direction, FrfBoundary};
use crate::mesh::ElementKind;
use crate::prestress::BaseChoice;
use crate::signal::ResponseQuantity;
use crate::transient::{InitialState, OperatorChoice};
use std::borrow::Cow;
use std::sync::LazyLock;

/// A key that every command uses which reads its section.
const fn key(
    name: &'static str,
    kind: Kind,
    unit: &'static str,
    default: Default,
    example: &'static str,
    meaning: &'static str,
) -> CaseKey {
    CaseKey { name, kind, unit, default, example, meaning, of_waves: "", since: "0.1" }
}

impl CaseKey {
    /// This key, which rotating waves do not use: what holds of them instead.
    const fn of_waves(self, of_waves: &'static str) -> Self {
        Self { of_waves, ..self }
    }

    /// This key in a section. Bodies whose sections have names of their own have no rotating waves.
    fn within(self, section: &str) -> Self {
        let name = match section {
            "" => self.name,
            _ => format!("{section}.{}", self.name).leak(),
        };
        Self { name, of_waves: if section.contains('*') { "" } else { self.of_waves }, ..self }
    }
}

/// Keys that all of some sections have.
type Shared = (&'static [&'static str], &'static [CaseKey]);

/// The keys of sections, those of one section where its first one stands.
fn in_sections(rows: &[Shared]) -> Vec<CaseKey> {
    let pairs = rows.iter().flat_map(|(sections, keys)| {
        sections.iter().flat_map(|section| keys.iter().map(|key| key.within(section)))
    });
    let mut all: Vec<CaseKey> = pairs.collect();
    let order: Vec<&str> = all.iter().map(CaseKey::section).collect();
    all.sort_by_key(|key| order.iter().position(|section| *section == key.section()));
    all
}

/// All keys in the order of the documentation.
pub static KEYS: LazyLock<Vec<CaseKey>> = LazyLock::new(|| in_sections(SECTIONS));

/// Numbers of lists.
static ELEMENTS: LazyLock<Vec<CaseKey>> = LazyLock::new(|| in_sections(LISTS));

/// Sections and the keys that all of them have: name, values, unit, default, example, meaning.
#[rustfmt::skip]
const SECTIONS: &[Shared] = &[
    (&[""], &[key("title", Text, "", Otherwise("none"), "\"Polycarbonate disc\"", "a line that heads tables and figures")]),
    (&["geometry"], &[
        key("inner_radius", Number(Positive), "m", Required, "0.0205", "the radius of the contact edge"),
        key("outer_radius", Number(Positive), "m", Required, "0.0905", "the radius of the clamped edge"),
        key("shaft_inner_radius", Number(Positive), "m", Otherwise("the cylinder is rigid"), "0.006", "the bore of a deformable shaft, which reaches from there to the contact edge (its material: materials.shaft)"),
        key("thickness", Number(Positive), "m", Value("1.0"), "0.009", "the thickness of the disc, which scales forces, torque, power and energy")]),
    (&["mesh"], &[
        key("circumferential_elements", Count(3), "", Required, "180", "the number of elements around the disc"),
        key("radial_elements", Count(1), "", Required, "35", "the number of elements along a radius"),
        key("shaft_radial_elements", Count(1), "", Otherwise("needed by geometry.shaft_inner_radius"), "6", "the number of elements along a radius of the shaft"),
        key("axial_elements", Count(1), "", Otherwise("needed by formulation = \"three-dimensional\""), "4", "the number of elements over the thickness of a three-dimensional body"),
        key("radial_grading", Number(Positive), "", Value("1.0"), "1.0", "the size ratio of successive elements outwards (1 = uniform)"),
        key("element", Choice(words::<ElementKind>), "", Value("\"quad4\""), "\"quad4\"", "the element shape"),
        key("file", Text, "", Otherwise("an annulus is generated"), "\"rig.msh\"", "a mesh of the body, relative to the case, in place of radii and element counts. Read are Gmsh (MSH 2.2 or 4.1), Abaqus or CalculiX (.inp), Nastran bulk data (.bdf) and universal files (.unv)"),
        key("units", Choice(words::<UnitsWord>), "", Value("\"m-kg-s\""), "\"mm-t-s\"", "the units of that file: of its coordinates, materials, pressures and stiffnesses"),
        key("take", Choices(words::<FilePart>), "", Otherwise("all"), "[\"materials\", \"ties\"]", "what is taken from that file beside the mesh (sections of the case win)"),
        key("drop", Texts, "", Otherwise("nothing"), "[\"*COUPLING\", \"RBE2\"]", "what of that file may be left out though it holds, loads or joins parts and is not understood. Else it is an error: the answer would be that of another structure"),
        key("sectors", Count(2), "", Otherwise("the file has the whole body"), "21", "the number of equal sectors of which that file has one. The body is made of its copies about the axis of the contact or of the motion (else z). `cea` solves it harmonic by harmonic"),
        key("scale", Number(Positive), "", Value("1.0"), "0.001", "the factor on the coordinates of that file alone, in place of mesh.units")]),
    (&["superelements.*"], &[
        key("mass", Text, "", Required, "\"M.mtx\"", "the Matrix Market file of a mass matrix that another program made, relative to the case; the case then has no body"),
        key("damping", Text, "", Otherwise("no damping"), "\"C.mtx\"", "the file of its damping matrix"),
        key("stiffness", Text, "", Required, "\"K.mtx\"", "the file of its stiffness matrix")]),
    (&["boundaries.*"], &[
        key("condition", Choice(words::<ConditionWord>), "", Required, "\"support\"", "what holds the boundary (left out, `outer` of the annulus and the `bore` of its shaft are clamped, every other one free)"),
        key("directions", Choices(words::<HeldAxis>), "", Otherwise("needed by condition = \"fixed\""), "[\"x\", \"y\"]", "the directions in which a boundary of solid bodies is held"),
        key("normal_stiffness", Number(NotNegative), "Pa/m", Value("0.0"), "2e11", "the normal stiffness of a support"),
        key("tangential_stiffness", Number(NotNegative), "Pa/m", Value("0.0"), "2e11", "the tangential stiffness of a support"),
        key("axial_stiffness", Number(NotNegative), "Pa/m", Value("0.0"), "2e11", "the stiffness of a support along the axis, on the inner and outer face of a three-dimensional body"),
        key("loss_factor", Number(NotNegative), "", Value("0.0"), "0.1", "the structural damping eta of the springs of a support: k (1 + i eta) in `cea` and `frf`"),
        key("normal_damping", Number(NotNegative), "Pa s/m", Value("0.0"), "0.0", "the normal dashpot of a support"),
        key("tangential_damping", Number(NotNegative), "Pa s/m", Value("0.0"), "0.0", "the tangential dashpot of a support"),
        key("pressure", Number(Finite), "Pa", Otherwise("needed by condition = \"pressure\""), "1e5", "the pressure that pushes onto the body")]),
    (&["modifications.*"], &[
        key("at", Node, "", Otherwise("needed by mass, stiffness and damping"), "{ radius = 0.06, angle_deg = 90 }", "the node that a mass, a spring or a dashpot is attached to, by number or by place. A built-in annulus with modifications is solved on its whole mesh"),
        key("mass", Number(NotNegative), "kg", Value("0.0"), "0.005", "the mass that is added at that node (alpha_R acts on it too)"),
        key("stiffness", Number(NotNegative), "N/m", Value("0.0"), "1e6", "the stiffness of a spring from that node to the ground, unstressed before the bodies are pressed"),
        key("damping", Number(NotNegative), "N s/m", Value("0.0"), "50.0", "the dashpot from that node to the ground"),
        key("direction", Numbers(Finite), "", Otherwise("every direction"), "[1.0, 0.0]", "the direction of spring and dashpot"),
        key("center", Numbers(Finite), "m", Otherwise("needed by remove and damping coefficients"), "[0.0, 0.06]", "the centre of a circle (a sphere on solid bodies): the modification is of the elements whose middle lies in it"),
        key("radius", Number(Positive), "m", Otherwise("needed by remove and damping coefficients"), "0.005", "the radius of that circle"),
        key("remove", Flag, "", Value("false"), "true", "whether those elements are taken away"),
        key("mass_coefficient", Number(NotNegative), "1/s", Value("0.0"), "100.0", "the mass damping of those elements beside that of their material"),
        key("stiffness_coefficient", Number(NotNegative), "s", Value("0.0"), "1e-6", "the stiffness damping of those elements beside that of their material"),
        key("offset", Numbers(Finite), "m", Otherwise("as the mesh has it"), "[0.008, 0.0]", "the displacement of the hole of a plane body, with the cylinder in it; the mesh between it and the other curves follows")]),
    (&["material", "materials.*"], &[
        key("young_modulus", Number(Positive), "Pa", RequiredUnless("required, or young_moduli"), "2.5e9", "Young's modulus; [materials.NAME] is of a physical surface, or of the `shaft`"),
        key("poisson_ratio", Number(Between(-1.0, 0.5)), "", RequiredUnless("required, or poisson_ratios"), "0.3805", "Poisson's ratio"),
        key("young_moduli", Numbers(Positive), "Pa", Otherwise("isotropic"), "[8e9, 8e9, 1.5e9]", "Young's moduli of an orthotropic material along its axes 1, 2 and 3, in place of young_modulus; `young_moduli[3]` names the third alone"),
        key("poisson_ratios", Numbers(Finite), "", Otherwise("isotropic"), "[0.25, 0.1, 0.1]", "its Poisson's ratios nu_12, nu_13 and nu_23: nu_ij is the contraction along j under a stress along i"),
        key("shear_moduli", Numbers(Positive), "Pa", Otherwise("isotropic"), "[3e9, 1e9, 1e9]", "its shear moduli G_12, G_13 and G_23"),
        key("axes", Directions(words::<AxesWord>), "", Value("\"global\""), "\"cylindrical\"", "where its axes lie: along x, y, z, or radial, circumferential, axial about the axis of the motion. Two vectors give axis 1 and a direction in the plane of 1 and 2"),
        key("density", Number(Positive), "kg/m3", Required, "1228.0", "the density")]),
    (&["material"], &[
        key("loss_factor", Number(NotNegative), "", Value("0.0"), "0.01", "the structural damping eta of the material: stiffness K (1 + i eta) in `cea` and `frf`. `transient` has a Maxwell chain fitted over the band of cea.max_frequency_hz"),
        key("table", Text, "", Otherwise("one modulus at every frequency"), "\"lining.csv\"", "modulus and loss factor over frequency, as materials.*.table"),
        key("formulation", Choice(words::<PlaneFormulation>), "", Value("\"plane-strain\""), "\"plane-strain\"", "the out-of-plane assumption, or none")]),
    (&["materials.*"], &[
        key("loss_factor", Number(NotNegative), "", Value("0.0"), "0.05", "its structural damping eta (left out 0, also where [material] has one)"),
        key("table", Text, "", Otherwise("one modulus at every frequency"), "\"rubber.csv\"", "a file of columns frequency_hz, young_modulus (Pa) and loss_factor in place of those keys, linear between its rows. `cea` solves each mode at its own frequency, `frf` each line, and `transient` has a Maxwell chain fitted to it. The base state has the modulus of the lowest frequency"),
        key("mass_coefficient", Number(NotNegative), "1/s", Otherwise("[damping]"), "20.0", "Rayleigh's alpha of its own"),
        key("stiffness_coefficient", Number(NotNegative), "s", Otherwise("[damping]"), "1e-7", "Rayleigh's beta of its own")]),
    (&["damping"], &[
        key("mass_coefficient", Number(NotNegative), "1/s", Value("0.0"), "40.0", "Rayleigh's alpha"),
        key("stiffness_coefficient", Number(NotNegative), "s", Value("0.0"), "4.5e-7", "Rayleigh's beta"),
        key("include_contact", Flag, "", Value("true"), "true", "whether beta acts on contact and friction terms as well as on the body").of_waves("beta acts on the body alone")]),
    (&["contact"], &[
        key("friction_coefficient", Number(NotNegative), "", Required, "0.3", "Coulomb's friction coefficient"),
        key("interference", Number(NotNegative), "m", RequiredUnless("required, or normal_force"), "25e-6", "how far the counterface is pushed into the body: the radial expansion of the cylinder (0 only where a boundary pressure presses)"),
        key("normal_force", Number(Positive), "N", Otherwise("contact.interference presses"), "1000.0", "the normal force, without friction, that presses the counterface on in place of contact.interference (for each metre where geometry.thickness is left out)"),
        key("rotation_speed_rpm", Number(Finite), "1/min", Required, "610.0", "the rotation speed of the cylinder"),
        key("boundary", Text, "", Value("\"inner\""), "\"contact\"", "the physical curve of an imported mesh that touches the counterface; \"inner\" or \"top\" of a three-dimensional body"),
        key("ring_inner_radius", Number(Positive), "m", Otherwise("the whole face"), "0.075", "the smaller radius of a ring that presses on the top of a three-dimensional body"),
        key("ring_outer_radius", Number(Positive), "m", Otherwise("the whole face"), "0.110", "its larger radius"),
        key("counter_boundary", Text, "", Otherwise("needed by counterface = \"body\""), "\"rim\"", "the physical curve of the other body that the contact curve slides on; the meshes need not match"),
        key("counterface", Choice(words::<CounterfaceWord>), "", Value("\"cylinder\""), "\"cylinder\"", "what a body from a mesh file slides on: a rigid cylinder, plane or (solid elements) sphere, or another body of a plane mesh"),
        key("center", Numbers(Finite), "m", Value("[0.0, 0.0]"), "[0.0, 0.0]", "the axis of the cylinder; of solid elements a point of it, or the centre of the sphere, [x, y, z]"),
        key("axis", Numbers(Finite), "", Value("[0.0, 0.0, 1.0]"), "[0.0, 0.0, 1.0]", "of solid elements the axis of a cylinder, and of a counterface that turns"),
        key("radius", Number(Positive), "m", Otherwise("that of the contact curve"), "0.0205", "the radius of the cylinder or sphere where the contact curve or surface is not round"),
        key("direction", Numbers(Finite), "", Value("[1.0, 0.0]"), "[1.0, 0.0]", "the direction in which a plane slides, with the body on its left; of solid elements [x, y, z]"),
        key("speed", Number(Finite), "m/s", Otherwise("needed by counterface = \"plane\""), "1.5", "the speed of a plane, or of another body along a straight contact curve")]),
    (&["contacts.*"], &[
        key("surface", Text, "", Required, "\"lining\"", "the surface of solid bodies that slides, the finer and softer one"),
        key("counter", Text, "", RequiredUnless("required, or counterface"), "\"disc_face\"", "the surface that it slides on; the meshes need not match"),
        key("counterface", Choice(words::<CounterfaceWord>), "", Otherwise("the surface `counter`"), "\"plane\"", "a rigid counterface in place of that surface, as of contact; so are the keys that follow"),
        key("center", Numbers(Finite), "m", Value("[0.0, 0.0, 0.0]"), "[0.0, 0.0, 0.0]", "a point of its axis, or the centre of a sphere"),
        key("axis", Numbers(Finite), "", Value("[0.0, 0.0, 1.0]"), "[0.0, 0.0, 1.0]", "the axis of a cylinder, and of a counterface that turns"),
        key("radius", Number(Positive), "m", Otherwise("that of the surface"), "0.0205", "the radius of a cylinder or sphere where the surface is not round"),
        key("rotation_speed_rpm", Number(Finite), "1/min", Otherwise("it slides straight"), "120.0", "its rotation speed about that axis"),
        key("direction", Numbers(Finite), "", Otherwise("it turns"), "[1.0, 0.0, 0.0]", "the direction in which it slides straight"),
        key("speed", Number(Finite), "m/s", Otherwise("it turns"), "1.5", "its speed in that direction"),
        key("interference", Number(NotNegative), "m", Value("0.0"), "1e-6", "how far it is pushed into the body"),
        key("normal_force", Number(Positive), "N", Otherwise("contacts.NAME.interference presses"), "1000.0", "the force with which a rigid counterface is pressed on, in place of its interference"),
        key("friction_coefficient", Number(NotNegative), "", Required, "0.4", "its friction coefficient; a sweep varies that of the first contact, and the others keep their ratio to it")]),
    (&["contact", "contacts.*"], &[
        key("static_friction_ratio", Number(AtLeast(1.0)), "", Value("1.0"), "1.4", "static friction over kinetic: mu(v) = friction_coefficient (1 + (ratio - 1) exp(-|v| / decay_speed))"),
        key("decay_speed", Number(Positive), "m/s", Otherwise("friction is constant"), "0.2", "the slip speed over which friction falls from its static to its kinetic value"),
        key("normal_stiffness", NumberOr(Positive, "rigid"), "Pa/m", Otherwise("rigid"), "7.4e12", "the normal stiffness of the contact (left out or \"rigid\" = rigid)").of_waves("its contact is rigid"),
        key("normal_law", Choice(words::<NormalLawWord>), "", Value("\"linear\""), "\"exponential\"", "pressure over the approach g of the surfaces: k g; k g + c g^3; or p_r (exp(g / h) - 1). A law that stiffens carries the base state too"),
        key("cubic_stiffness", Number(Positive), "Pa/m3", Otherwise("needed by normal_law = \"cubic\""), "1e25", "the coefficient c of that law; k is normal_stiffness"),
        key("reference_pressure", Number(Positive), "Pa", Otherwise("needed by normal_law = \"exponential\""), "1e5", "the pressure p_r of that law"),
        key("height", Number(Positive), "m", Otherwise("needed by normal_law = \"exponential\""), "1e-6", "the height h of that law, of the roughness"),
        key("loss_factor", Number(NotNegative), "", Value("0.0"), "0.05", "the structural damping eta of the normal stiffness: k (1 + i eta) in `cea` and `frf`, which friction follows"),
        key("normal_damping", Number(NotNegative), "Pa s/m", Value("0.0"), "0.0", "a normal dashpot on the contact").of_waves("its contact is rigid"),
        key("tangential_damping", Number(NotNegative), "Pa s/m", Value("0.0"), "0.0", "a tangential dashpot on the contact").of_waves("Coulomb's law alone acts along its contact")]),
    (&["contact"], &[key("base_state", Choice(words::<BaseContact>), "", Value("\"rigid\""), "\"rigid\"", "whether normal_stiffness carries the base state of a three-dimensional body too")]),
    (&["contacts.*"], &[
        key("state", Choice(words::<BaseChoice>), "", Value("\"solved\""), "\"closed\"", "the base state: gap, pressure and opening from the loads, or all facing points closed and free of stress"),
        key("gap", Text, "", Otherwise("the gaps of the mesh"), "\"topography.csv\"", "a table of a measured or worn surface, x, y, z and gap in m. Its gap adds to that of the mesh, positive where material is missing")]),
    (&["motion.*"], &[
        key("axis", Numbers(Finite), "", Required, "[0.0, 0.0, 1.0]", "the axis about which the region of that name turns, counter-clockwise seen against it"),
        key("center", Numbers(Finite), "m", Value("[0.0, 0.0, 0.0]"), "[0.0, 0.0, 0.0]", "a point of that axis"),
        key("rotation_speed_rpm", Number(Finite), "1/min", Required, "120.0", "its rotation speed"),
        key("rotation_terms", Flag, "", Value("false"), "true", "whether the inertia of its rotation counts, as of a disc of revolution: Coriolis, transport and centrifugal terms"),
        key("frame", Choice(words::<RotationFrame>), "", Value("\"rest\""), "\"turning\"", "the frame of the modes of rotation_terms: \"rest\", through which a body of revolution passes, or \"turning\" with all bodies, of any shape")]),
    (&["ties.*"], &[
        key("surface", Text, "", Required, "\"backplate_glue\"", "a surface of solid bodies that is glued, the finer one"),
        key("counter", Text, "", Required, "\"lining_glue\"", "the surface that it is glued to; the meshes need not match")]),
    (&["cea"], &[
        key("friction_coefficients", Numbers(NotNegative), "", Otherwise("contact.friction_coefficient"), "{ from = 0.0, to = 1.0, count = 51 }", "the friction coefficients of the sweep"),
        key("max_frequency_hz", Number(Positive), "Hz", Otherwise("cea.modes decides"), "17500.0", "the frequency below which all modes are found"),
        key("modes", Count(1), "", Otherwise("cea.max_frequency_hz decides"), "28", "how many of the lowest modes are found"),
        key("method", Choice(words::<CeaMethod>), "", Value("\"auto\""), "\"auto\"", "the eigenvalue solver (auto = cyclic where the model has the symmetry)"),
        key("mass", Choice(words::<MassKind>), "", Value("\"consistent\""), "\"consistent\"", "the mass matrix"),
        key("geometric_stiffness", Flag, "", Otherwise("true; false for solid bodies of a mesh file"), "true", "whether the prestress enters the tangent stiffness, and contact forces turn with the surfaces"),
        key("shapes_at", Numbers(NotNegative), "", Otherwise("contact.friction_coefficient"), "[0.3]", "the friction coefficients whose mode shapes are written"),
        key("sensitivities", Flag, "", Otherwise("those of bodies solved harmonic by harmonic"), "true", "whether derivatives of eigenvalues and critical friction by the numbers of the case are computed"),
        key("count_modes", Flag, "", Value("false"), "true", "whether the modes of a whole mesh are counted by the argument principle under friction, too")]),
    (&["improve"], &[
        key("modifications", Choices(words::<ModificationKind>), "", Otherwise("all that the body can have"), "[\"mass\", \"removal\"]", "what `frictionsim improve` tries against the unstable modes at the contact's friction coefficient"),
        key("min_frequency_hz", Number(NotNegative), "Hz", Otherwise("no limit"), "9000.0", "the frequency above which modes are to be silenced"),
        key("max_frequency_hz", Number(Positive), "Hz", Otherwise("that of [cea]"), "12000.0", "the frequency below which modes are to be silenced"),
        key("mass", Number(Positive), "kg", Otherwise("a hundredth of the bodies'"), "0.005", "the mass that may be added at a node"),
        key("stiffness", Number(Positive), "N/m", Otherwise("omega^2 times that mass"), "1e6", "the stiffness of a spring to the ground"),
        key("damping", Number(Positive), "N s/m", Otherwise("a tenth of omega times that mass"), "50.0", "the dashpot to the ground"),
        key("patch_radius", Number(Positive), "m", Otherwise("a twentieth of half the bodies' size"), "0.005", "the radius of a patch that is damped or taken away"),
        key("patch_damping", Number(Positive), "s", Otherwise("0.1 / omega"), "1e-6", "the stiffness coefficient of the damping that a patch gets (0.1 / omega is a loss factor of 0.1)"),
        key("offset", Number(Positive), "m", Otherwise("a tenth of half the body's size"), "0.008", "the largest displacement of the hole of a plane body"),
        key("forbidden", Texts, "", Otherwise("nothing; surfaces in contact are never touched"), "[\"outer\"]", "regions and boundaries that nothing may be attached to, damped or taken from"),
        key("candidates", Count(1), "", Value("3"), "3", "how many places of each kind are listed"),
        key("confirm", Count(0), "", Value("4"), "4", "how many of the best candidates are run again as cases of their own")]),
    (&["transient"], &[
        key("duration", Number(Positive), "s", Required, "0.05", "the simulated time"),
        key("time_step", NumberOr(Positive, "auto"), "s", Value("\"auto\""), "\"auto\"", "the time step (\"auto\" = 0.95 of the stability limit, at most)"),
        key("expansion_time", Number(NotNegative), "s", Value("5e-4"), "5e-4", "the time over which the cylinder expands, linearly"),
        key("initial", Choice(words::<InitialState>), "", Value("\"rest\""), "\"rest\"", "the initial state"),
        key("limit_cycle_onset", Count(1), "", Value("1"), "1", "the onset of that harmonic, by rising friction, at which the limit cycle is born"),
        key("limit_cycle_harmonic", Count(1), "", Otherwise("needed by initial = \"limit-cycle\""), "2", "the harmonic of the limit cycle that `initial` names"),
        key("operator", Choice(words::<OperatorChoice>), "", Value("\"auto\""), "\"auto\"", "how the stiffness is applied"),
        key("stop_when_settled", Flag, "", Value("false"), "true", "whether the run ends where amplitude, frequency and status have settled")]),
    (&["transient.perturbation"], &[
        key("harmonics", Counts(0), "", Value("[]"), "[2]", "the circumferential harmonics of the initial velocity"),
        key("velocity", Numbers(NotNegative), "m/s", Value("[1e-3]"), "1e-3", "the velocity amplitude of the harmonics, one for all or one for each"),
        key("phase_deg", Numbers(Finite), "degrees", Value("[0.0]"), "[0.0, 90.0]", "the phase of the harmonics, one for all or one for each: a crest stands at phase / n"),
        key("relative", Flag, "", Value("false"), "true", "whether the velocities are in units of the slip speed Omega a"),
        key("noise", Number(NotNegative), "m/s", Value("0.0"), "1e-6", "the standard deviation of a random velocity of every node, in each direction"),
        key("noise_seed", Count(0), "", Value("1"), "1", "the seed of that random velocity"),
        key("at", Number(NotNegative), "s", Value("0.0"), "0.01", "when the velocity is added")]),
    (&["output"], &[
        key("probes", Nodes, "", Value("[]"), "[1621, { radius = 0.0605, angle_deg = 90 }]", "the nodes whose motion is written, by number (that of the mesh file, or from 1) or by place. A place, m, is about the cylinder's axis and stands for the nearest node"),
        key("sample_interval", Number(Positive), "s", Value("2e-6"), "2e-6", "the time between two samples"),
        key("contact_interval", Number(Positive), "s", Otherwise("every sample of a short run, every second, fourth ... of a longer one"), "2e-6", "the time between two frames of contact.npz"),
        key("raw_acceleration", Flag, "", Value("false"), "true", "whether probes have the acceleration of the sampled step beside its mean over the sample interval"),
        key("snapshots", Numbers(NotNegative), "s", Value("[]"), "[0.005, 0.03]", "the times of the field snapshots"),
        key("universal", Flag, "", Value("false"), "true", "whether `cea`, `frf` and `matrices` write universal files, too: mesh (datasets 2411, 2412), complex mode shapes (55), responses (58)"),
        key("checkpoint_interval", Number(Positive), "s", Value("600.0"), "600", "the wall time between two checkpoints")]),
    (&["sweep"], &[
        key("combine", Choice(words::<Combination>), "", Value("\"grid\""), "\"grid\"", "how several swept keys combine"),
        key("analyses", Choices(words::<Analysis>), "", Otherwise("every one that the case has a section for"), "[\"transient\"]", "what runs at each point")]),
    (&["basin"], &[
        key("harmonics", Counts(1), "", Value("[1, 2]"), "[1, 2]", "of the built-in disc the two harmonics that compete, the first and the second"),
        key("modes", Counts(1), "", Otherwise("the two that grow fastest"), "[13, 15]", "of all other bodies the two modes that compete, as `cycle` numbers them; one alone competes with steady sliding"),
        key("seed_ratio_from", Number(Positive), "", Value("0.02"), "0.02", "the smallest seed of the second one, in units of that of the first. Of one mode it is the smallest kick, in units of the one that makes a contact node stick"),
        key("seed_ratio_to", Number(Positive), "", Value("50.0"), "50.0", "the largest seed of the second one, or the largest kick, in the same units"),
        key("tolerance", Number(AtLeast(1.01)), "", Value("1.5"), "1.5", "the factor between the two bounds of the boundary at which the search ends"),
        key("periods", Count(50), "", Value("2000"), "2000", "the most periods of the slower wave that one transient takes")]),
    (&["cycle"], &[
        key("harmonics", Counts(1), "", Otherwise("those that are unstable"), "[1, 2]", "the harmonics whose limit cycle is sought"),
        key("onsets", Choice(words::<OnsetChoice>), "", Value("\"all\""), "\"lowest\"", "the losses of stability of each harmonic whose limit cycles are sought (left out = all below the friction)"),
        key("phases", Count(31), "", Otherwise("as the mesh asks for"), "171", "the number of phases along the wave"),
        key("harmonic_count", Count(1), "", Otherwise("as many as leave a thousandth of the motion"), "12", "the harmonics in which the motion of a body without symmetry is told"),
        key("frames", Count(1), "", Value("1"), "24", "the times over one period at which the whole field is written"),
        key("confirmation_periods", Count(0), "", Value("20"), "20", "the periods of the transient that puts each cycle to the test (0 = none)"),
        key("stability", Choice(words::<StabilityChoice>), "", Value("\"point\""), "\"point\"", "the cycles whose stability is worked out"),
        key("two_frequencies", Flag, "", Value("false"), "true", "whether the motion of two frequencies is sought where a rotating wave loses its stability to another")]),
    (&["cycle.continuation"], &[
        key("key", Parameter, "", Required, "\"contact.rotation_speed_rpm\"", "the parameter along which a cycle is followed"),
        key("from", Number(Finite), "", Required, "10", "the first value of that parameter"),
        key("to", Number(Finite), "", Required, "6000", "the last value of that parameter"),
        key("count", Count(2), "", Value("61"), "61", "how many values from first to last are reported"),
        key("spacing", Choice(words::<Spacing>), "", Value("\"linear\""), "\"log\"", "how they are spaced")]),
    (&["frf"], &[
        key("boundary", Choice(words::<FrfBoundary>), "", Value("\"free\""), "\"free\"", "how the disc is held while it is excited"),
        key("force_node", Node, "", Required, "36", "the node that is struck, by number or by place"),
        key("force_direction", Choice(words::<Direction>), "", Value("\"radial\""), "\"radial\"", "the direction of the force; \"axial\" in three dimensions, \"x\", \"y\", \"z\" on bodies from a file"),
        key("response_node", Node, "", Otherwise("frf.force_node"), "36", "the node observed, by number or by place"),
        key("response_direction", Choice(words::<Direction>), "", Value("\"radial\""), "\"radial\"", "the direction observed; the same choices"),
        key("frequencies_hz", Numbers(Positive), "Hz", Required, "{ from = 1.0, to = 10000.0, count = 10000 }", "the frequencies of the response"),
        key("quantity", Choice(words::<ResponseQuantity>), "", Value("\"accelerance\""), "\"accelerance\"", "what is observed for each unit of force"),
        key("method", Choice(words::<FrfMethod>), "", Value("\"auto\""), "\"auto\"", "how the response is computed (auto = cyclic)"),
        key("mass", Choice(words::<MassKind>), "", Value("\"consistent\""), "\"consistent\"", "the mass matrix"),
        key("noise", Number(NotNegative), "", Value("0.0"), "0.01", "Gaussian noise added to real and imaginary part, relative to the magnitude"),
        key("noise_seed", Count(0), "", Value("1"), "1", "the seed of that noise")]),
    (&["convergence"], &[
        key("factors", Numbers(Positive), "", Value("[1, 1.5, 2.25]"), "[1, 1.5, 2.25]", "the refinements of the mesh: factors on both element counts. On an imported mesh they are powers of two ([1, 2, 4] where left out). Each splits plane elements into four, solid ones into eight"),
        key("time_step_factors", Numbers(Positive), "", Otherwise("no such study"), "[1, 0.5, 0.25]", "the factors on the transient's time step, on the case's own mesh"),
        key("analyses", Choices(words::<Analysis>), "", Otherwise("every one that the case has a section for"), "[\"cea\", \"transient\"]", "what is studied")]),
    (&["fit"], &[
        key("parameters", Table("table of case keys, each with its bounds [from, to] or { from, to, scale, also }"), "", Required, "{ \"material.poisson_ratio\" = [0.3, 0.45] }", "what is fitted to measured modes, and the bounds between which it is sought. Scale \"log\" fits the logarithm; `also` names keys that take the same value"),
        key("shape_weight", Number(Positive), "", Value("0.1"), "0.1", "with measured shapes (--shapes): a shape with MAC 0 costs as much as a relative frequency error of this size"),
        key("starts", Count(1), "", Value("16"), "16", "at how many points within the bounds the search looks first; it goes on from the best few")]),
    (&["uncertainty"], &[
        key("samples", Count(2), "", Value("1024"), "4096", "the number of samples: points of a scrambled Sobol sequence, best a power of two"),
        key("index_samples", Count(0), "", Otherwise("a quarter of them"), "1024", "the number of samples that give Sobol's indices, each of which costs one run more than there are parameters (0 = no indices)"),
        key("seed", Count(0), "", Value("1"), "1", "the seed of the samples"),
        key("distributions", Table("table of case keys, each { normal = [mean, deviation] }, { log_normal = [median, deviation of the logarithm] } or { uniform = [from, to] }, with also"), "", Required, "{ \"contact.normal_stiffness\" = { log_normal = [7.4e12, 0.3] } }", "what is uncertain, and how (also: keys that take the same value)")]),
];

/// The keys of a range, which stands for a list of numbers.
#[rustfmt::skip]
pub(super) const RANGE: &[CaseKey] = &[
    key("from", Number(Finite), "", Required, "0.0", "the first value"),
    key("to", Number(Finite), "", Required, "1.0", "the last value"),
    key("count", Count(1), "", Required, "11", "how many values, both ends included"),
    key("spacing", Choice(words::<Spacing>), "", Value("\"linear\""), "\"log\"", "how they are spaced"),
];

/// The keys of a place, which stands for the node nearest to it.
#[rustfmt::skip]
pub(super) const PLACE: &[CaseKey] = &[
    key("x", Number(Finite), "m", Otherwise("radius and angle_deg"), "0.0", "the distance from the origin to the right"),
    key("y", Number(Finite), "m", Otherwise("radius and angle_deg"), "0.042", "the distance from the origin upwards"),
    key("z", Number(Finite), "m", Otherwise("0, and the top face of a body of revolution"), "0.005", "the distance from the origin along z, of solid bodies"),
    key("radius", Number(NotNegative), "m", Otherwise("x and y"), "0.0425", "the distance from the cylinder's axis (from the origin where there is none)"),
    key("angle_deg", Number(Finite), "degrees", Otherwise("x and y"), "90.0", "the angle about that axis from +x"),
];

/// One number of a list, `KEY[2]` or `KEY.2` counted from 1, of lists whose places mean something.
#[rustfmt::skip]
const LISTS: &[Shared] = &[
    (&["material", "materials.*"], &[
        key("young_moduli.*", Number(Positive), "Pa", Required, "8e9", "one of Young's moduli"),
        key("poisson_ratios.*", Number(Finite), "", Required, "0.25", "one of Poisson's ratios"),
        key("shear_moduli.*", Number(Positive), "Pa", Required, "3e9", "one of the shear moduli")]),
];

/// A dotted name with places in lists as parts of it: `KEY[2]` as `KEY.2`.
pub(super) fn dotted(name: &str) -> Cow<'_, str> {
    let mut parts = name.split('[');
    let first = parts.next().unwrap_or_default();
    let mut with_parts = first.to_owned();
    for part in parts {
        let digits = part.split_once(']').filter(|(place, _)| {
            !place.is_empty() && place.bytes().all(|byte| byte.is_ascii_digit())
        });
        match digits {
            Some((place, rest)) => with_parts += &format!(".{place}{rest}"),
            None => with_parts += &format!("[{part}"),
        }
    }
    match with_parts == name {
        true => Cow::Borrowed(name),
        false => Cow::Owned(with_parts),
    }
}

/// The place in a list, from 0, that the last part of a dotted name gives counted from 1.
pub(super) fn list_place(part: &str) -> Option<usize> {
    part.parse::<usize>().ok()?.checked_sub(1)
}

/// The entry of a dotted key, of a number in a list, or of a key of a range.
pub fn find(name: &str) -> Option<&'static CaseKey> {
    let known = KEYS.iter().find(|key| key.is_named(name));
    known.or_else(|| {
        let name = dotted(name);
        list_place(name.rsplit('.').next()?).filter(|place| *place < 3)?;
        ELEMENTS.iter().find(|key| key.is_named(&name))
    })
}

/// Whether a dotted name is that of a key or of a section.
pub(super) fn is_key_or_section(name: &str) -> bool {
    find(name).is_some() || is_section(name)
}

/// Whether a dotted name is that of a section, or the beginning of one's; `*` stands for any one name.
pub(super) fn is_section(name: &str) -> bool {
    KEYS.iter().any(|key| {
        let mut parts = key.name.split('.');
        let fits = |given: &str| parts.next().is_some_and(|part| part == "*" || part == given);
        name.split('.').all(fits) && parts.next().is_some()
    })
}
