//! Meshes written as Gmsh files: what the reader is held to.

use frictionsim::mesh::{BodySpecification, BoundaryCondition, CounterfaceSpecification, Mesh};

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

struct Out(Vec<u8>, bool);

impl Out {
    fn line(&mut self, text: &str) {
        self.0.extend(text.as_bytes());
        self.0.push(b'\n');
    }
    fn int(&mut self, value: i32) {
        self.put(&value.to_le_bytes(), value.to_string());
    }
    fn size(&mut self, value: usize) {
        self.put(&(value as u64).to_le_bytes(), value.to_string());
    }
    fn number(&mut self, value: f64) {
        self.put(&value.to_le_bytes(), format!("{value:?}"));
    }
    fn put(&mut self, bytes: &[u8], text: String) {
        if self.1 {
            self.0.extend(bytes);
        } else {
            self.0.extend(text.as_bytes());
            self.0.push(b' ');
        }
    }
    fn end(&mut self) {
        self.0.push(b'\n');
    }
}

/// `mesh` with its boundaries and its regions as physical groups; node `i` gets the number `numbers[i]`, or `i + 1`, and the place
/// `place(x, y)`.
pub fn write_msh(
    mesh: &Mesh,
    form: Form,
    numbers: &[usize],
    place: impl Fn([f64; 2]) -> [f64; 2],
) -> Vec<u8> {
    let mut out = Out(Vec::new(), form.is_binary);
    let version = if form.is_new { "4.1" } else { "2.2" };
    out.line("$MeshFormat");
    out.line(&format!("{version} {} 8", u8::from(form.is_binary)));
    if form.is_binary {
        out.int(1);
        out.end();
    }
    out.line("$EndMeshFormat");
    let curves = mesh.boundaries.len();
    out.line("$PhysicalNames");
    out.line(&(curves + mesh.regions.len()).to_string());
    for (b, boundary) in mesh.boundaries.iter().enumerate() {
        out.line(&format!("1 {} \"{}\"", b + 1, boundary.name));
    }
    for (r, region) in mesh.regions.iter().enumerate() {
        out.line(&format!("2 {} \"{region}\"", r + 1));
    }
    out.line("$EndPhysicalNames");
    if form.is_new {
        out.line("$Entities");
        for count in [0, curves, mesh.regions.len(), 0] {
            out.size(count);
        }
        for count in [curves, mesh.regions.len()] {
            for tag in 1..=count as i32 {
                out.int(tag);
                (0..6).for_each(|_| out.number(0.0));
                out.size(1);
                out.int(tag);
                out.size(0);
            }
        }
        out.end();
        out.line("$EndEntities");
    }
    let plain: Vec<usize> = (1..=mesh.node_count()).collect();
    let numbers = if numbers.is_empty() { &plain } else { numbers };
    write_nodes(&mut out, mesh, form, numbers, place);
    write_elements(&mut out, mesh, form, numbers);
    out.0
}

fn write_nodes(
    out: &mut Out,
    mesh: &Mesh,
    form: Form,
    numbers: &[usize],
    place: impl Fn([f64; 2]) -> [f64; 2],
) {
    let count = mesh.node_count();
    // Files list their nodes by number.
    let mut order: Vec<usize> = (0..count).collect();
    order.sort_by_key(|&node| numbers[node]);
    out.line("$Nodes");
    if form.is_new {
        for value in [1, count, 1, count] {
            out.size(value);
        }
        out.int(2);
        out.int(1);
        out.int(0);
        out.size(count);
        order.iter().for_each(|&node| out.size(numbers[node]));
    } else {
        out.line(&count.to_string());
    }
    for &node in &order {
        if !form.is_new {
            out.int(numbers[node] as i32);
        }
        let [x, y] = place(mesh.plane_node(node));
        [x, y, 0.0].into_iter().for_each(|value| out.number(value));
    }
    out.end();
    out.line("$EndNodes");
}

fn write_elements(out: &mut Out, mesh: &Mesh, form: Form, numbers: &[usize]) {
    let mut all: Vec<(i32, i32, Vec<usize>)> = Vec::new();
    let number = |node: u32| numbers[node as usize];
    let outline = mesh.outline_edges();
    for (b, boundary) in mesh.boundaries.iter().enumerate() {
        for &(p, q, middle) in &outline {
            if boundary.nodes.contains(&p) && boundary.nodes.contains(&q) {
                let nodes = [p, q].into_iter().chain(middle).map(number).collect();
                all.push((if middle.is_some() { 8 } else { 1 }, b as i32 + 1, nodes));
            }
        }
    }
    for e in 0..mesh.element_count() {
        let nodes = mesh.element_nodes(e).iter().map(|&node| number(node)).collect();
        let kind = mesh.element_kind(e).gmsh_type() as i32;
        all.push((kind, mesh.region(e) as i32 + 1, nodes));
    }
    out.line("$Elements");
    if form.is_new {
        for value in [all.len(), all.len(), 1, all.len()] {
            out.size(value);
        }
    } else {
        out.line(&all.len().to_string());
    }
    for (i, (kind, tag, nodes)) in all.iter().enumerate() {
        match (form.is_new, form.is_binary) {
            (true, _) => {
                out.int(if matches!(kind, 1 | 8) { 1 } else { 2 });
                out.int(*tag);
                out.int(*kind);
                out.size(1);
                out.size(i + 1);
                nodes.iter().for_each(|&node| out.size(node));
            }
            (false, is_binary) => {
                if is_binary {
                    [*kind, 1, 2, i as i32 + 1].into_iter().for_each(|value| out.int(value));
                } else {
                    [i as i32 + 1, *kind, 2].into_iter().for_each(|value| out.int(value));
                }
                out.int(*tag);
                out.int(*tag);
                nodes.iter().for_each(|&node| out.int(node as i32));
            }
        }
    }
    out.end();
    out.line("$EndElements");
}
