//! Meshes written as Gmsh files: what the reader is held to.

use frictionsim::mesh::{BodySpecification, BoundaryCondition, CounterfaceSpecification, Mesh};
use std::fmt::{Debug, Display};
use std::io::Write;

/// A plane body of a mesh file in metres.
pub fn plane_body(
    contact: &str,
    counterface: CounterfaceSpecification,
    opposite: Option<&str>,
    conditions: &[(&str, BoundaryCondition)],
) -> BodySpecification {
    let conditions = conditions.iter().map(|&(name, own)| (name.to_owned(), own)).collect();
    let (contact, opposite) = (contact.to_owned(), opposite.map(str::to_owned));
    BodySpecification { scale: 1.0, contact, counterface, opposite, conditions }
}

pub const CYLINDER: CounterfaceSpecification =
    CounterfaceSpecification::Cylinder { center: [0.0; 2], radius: None };

/// A plane that slides along x.
pub const ALONG_X: CounterfaceSpecification =
    CounterfaceSpecification::Plane { direction: Some([1.0, 0.0]) };

#[derive(Clone, Copy, Debug)]
pub struct Form {
    pub is_new: bool,
    pub is_binary: bool,
}

pub const FORMS: [Form; 4] =
    [form(false, false), form(false, true), form(true, false), form(true, true)];

const fn form(is_new: bool, is_binary: bool) -> Form {
    Form { is_new, is_binary }
}

/// A file and its form: numbers as text or bytes.
struct Out(Vec<u8>, Form);

impl Out {
    fn line(&mut self, text: impl Display) {
        writeln!(self.0, "{text}").unwrap();
    }
    fn ints(&mut self, values: &[i32]) {
        values.iter().for_each(|value| self.put(&value.to_le_bytes(), value));
    }
    fn sizes(&mut self, values: &[usize]) {
        values.iter().for_each(|value| self.put(&(*value as u64).to_le_bytes(), value));
    }
    fn numbers(&mut self, values: &[f64]) {
        values.iter().for_each(|value| self.put(&value.to_le_bytes(), value));
    }
    fn put(&mut self, bytes: &[u8], value: &dyn Debug) {
        let text = format!("{value:?} ");
        self.0.extend(if self.1.is_binary { bytes } else { text.as_bytes() });
    }
}

/// `mesh` with boundaries and regions as physical groups; node `i` has the number `numbers[i]`, or `i + 1`, and the place `place(x, y)`.
pub fn write_msh(
    mesh: &Mesh,
    form: Form,
    numbers: &[usize],
    place: impl Fn([f64; 2]) -> [f64; 2],
) -> Vec<u8> {
    let mut out = Out(Vec::new(), form);
    let [curves, regions] = [mesh.boundaries.len(), mesh.regions.len()];
    let version = if form.is_new { "4.1" } else { "2.2" };
    out.line(format_args!("$MeshFormat\n{version} {} 8", u8::from(form.is_binary)));
    if form.is_binary {
        out.ints(&[1]);
        out.line("");
    }
    out.line(format_args!("$EndMeshFormat\n$PhysicalNames\n{}", curves + regions));
    for (boundary, b) in mesh.boundaries.iter().zip(1..) {
        out.line(format_args!("1 {b} \"{}\"", boundary.name));
    }
    for (region, r) in mesh.regions.iter().zip(1..) {
        out.line(format_args!("2 {r} \"{region}\""));
    }
    out.line("$EndPhysicalNames");
    if form.is_new {
        out.line("$Entities");
        out.sizes(&[0, curves, regions, 0]);
        for tag in (1..=curves).chain(1..=regions) {
            out.ints(&[tag as i32]);
            out.numbers(&[0.0; 6]);
            out.sizes(&[1]);
            out.ints(&[tag as i32]);
            out.sizes(&[0]);
        }
        out.line("\n$EndEntities");
    }
    let plain: Vec<usize> = (1..=mesh.node_count()).collect();
    let numbers = if numbers.is_empty() { &plain } else { numbers };
    write_nodes(&mut out, mesh, numbers, place);
    write_elements(&mut out, mesh, numbers);
    out.0
}

fn write_nodes(
    out: &mut Out,
    mesh: &Mesh,
    numbers: &[usize],
    place: impl Fn([f64; 2]) -> [f64; 2],
) {
    let count = mesh.node_count();
    // Files list their nodes by number.
    let mut order: Vec<usize> = (0..count).collect();
    order.sort_by_key(|&node| numbers[node]);
    out.line("$Nodes");
    if out.1.is_new {
        out.sizes(&[1, count, 1, count]);
        out.ints(&[2, 1, 0]);
        out.sizes(&[count]);
        order.iter().for_each(|&node| out.sizes(&[numbers[node]]));
    } else {
        out.line(count);
    }
    for &node in &order {
        if !out.1.is_new {
            out.ints(&[numbers[node] as i32]);
        }
        let [x, y] = place(mesh.plane_node(node));
        out.numbers(&[x, y, 0.0]);
    }
    out.line("\n$EndNodes");
}

fn write_elements(out: &mut Out, mesh: &Mesh, numbers: &[usize]) {
    let mut all: Vec<(i32, i32, Vec<usize>)> = Vec::new();
    let number = |node: u32| numbers[node as usize];
    for (boundary, tag) in mesh.boundaries.iter().zip(1..) {
        let is_own = |node: &u32| boundary.nodes.contains(node);
        for &(p, q, middle) in mesh.outline_edges().iter().filter(|e| is_own(&e.0) && is_own(&e.1))
        {
            let nodes = [p, q].into_iter().chain(middle).map(number).collect();
            all.push((if middle.is_some() { 8 } else { 1 }, tag, nodes));
        }
    }
    for e in 0..mesh.element_count() {
        let nodes = mesh.element_nodes(e).iter().map(|&node| number(node)).collect();
        all.push((mesh.element_kind(e).gmsh_type() as i32, mesh.region(e) as i32 + 1, nodes));
    }
    out.line("$Elements");
    match out.1.is_new {
        true => out.sizes(&[all.len(), all.len(), 1, all.len()]),
        false => out.line(all.len()),
    }
    for (&(kind, tag, ref nodes), label) in all.iter().zip(1..) {
        if out.1.is_new {
            out.ints(&[if matches!(kind, 1 | 8) { 1 } else { 2 }, tag, kind]);
            out.sizes(&[1, label]);
            out.sizes(nodes);
        } else {
            let label = label as i32;
            let head: &[i32] =
                if out.1.is_binary { &[kind, 1, 2, label] } else { &[label, kind, 2] };
            out.ints(head);
            out.ints(&[tag, tag]);
            nodes.iter().for_each(|&node| out.ints(&[node as i32]));
        }
    }
    out.line("\n$EndElements");
}
