//! `*MATERIAL`, `*SOLID SECTION` and `*ORIENTATION`: the material of each region.

use super::Reader;
use super::block::Block;
use crate::prelude::*;

impl Reader<'_, '_> {
    /// Reads materials and sections: each element gets its region, each region its material.
    pub(super) fn read_materials(&mut self) -> Result<()> {
        let definitions = self.definitions()?;
        let orientations = self.orientations()?;
        let mut is_sectioned = vec![false; self.file.elements.len()];
        for block in self.blocks_of("SOLID SECTION") {
            let name = block.required("ELSET")?;
            let set = self.elements.sets.get(&self.key(block.scope, name)).cloned();
            let set = set.ok_or_else(|| self.unknown(block.place, "element set", name))?;
            // The set is the region of its elements, each of which has one section.
            let region: Arc<str> = set.name.as_str().into();
            for &element in &set.items.iter().copied().collect::<BTreeSet<usize>>() {
                let known = &mut self.file.elements[element];
                ensure!(!std::mem::replace(&mut is_sectioned[element], true); block;
                    "element {} has two sections, the second by element set {name}", known.label);
                known.region = Arc::clone(&region);
            }
            // Its material by name, in any case of letters.
            let Some(material) = block.parameter("MATERIAL") else {
                self.leave_out("*SOLID SECTION without MATERIAL", block.place, "");
                continue;
            };
            let definition = definitions.get(&material.to_uppercase());
            let definition =
                definition.ok_or_else(|| self.unknown(block.place, "material", material))?;
            // Without an orientation the axes are the global ones, which an instance does not turn.
            let axes = match block.parameter("ORIENTATION").filter(|name| !name.is_empty()) {
                None => MaterialAxes::Global,
                Some(name) => {
                    let own = orientations.get(&self.key(block.scope, name));
                    let found = own.or_else(|| orientations.get(&(0, name.to_uppercase())));
                    *found.ok_or_else(|| self.unknown(block.place, "orientation", name))?
                }
            };
            if set.items.is_empty() && !self.elements.skipped.is_empty() {
                let keyword = format!("*SOLID SECTION of {name}");
                self.lose_part(&keyword, block.place, "its elements are not read");
            }
            if !set.items.is_empty() {
                let mut material = FileMaterial { region: set.name, ..definition.clone() };
                if let Some(FileElasticity::Orthotropic { axes: own, .. }) =
                    &mut material.elasticity
                {
                    *own = axes;
                }
                self.file.model.materials.push(material);
            }
        }
        Ok(())
    }

    /// Materials by name, of no region yet.
    fn definitions(&mut self) -> Result<BTreeMap<String, FileMaterial>> {
        let mut definitions: BTreeMap<String, FileMaterial> = BTreeMap::new();
        let mut current: Option<String> = None;
        for block in self.blocks {
            let keyword = block.keyword.as_str();
            if keyword == "MATERIAL" {
                let name = block.required("NAME")?.to_owned();
                let key = name.to_uppercase();
                let place = self.deck.name(block.place);
                ensure!(!definitions.contains_key(&key); block; "material {name} is defined twice");
                let definition = FileMaterial { name, place, ..FileMaterial::default() };
                definitions.insert(key.clone(), definition);
                current = Some(key);
                continue;
            }
            if !matches!(keyword, "ELASTIC" | "DENSITY" | "DAMPING") {
                continue;
            }
            let known = current.as_ref().and_then(|name| definitions.get_mut(name));
            let definition = found!(known; block; "*{keyword} stands behind no *MATERIAL");
            match keyword {
                "ELASTIC" => {
                    let is_table = elastic(block, definition)?;
                    if is_table {
                        let reason = "the first line is taken, others (temperatures) are not";
                        self.leave_out("*ELASTIC with more than one line", block.place, reason);
                    }
                }
                "DENSITY" => definition.density = block.numbers(1)?.first().copied(),
                _ => damping(block, definition)?,
            }
        }
        Ok(definitions)
    }

    /// `*ORIENTATION` by scope and name.
    fn orientations(&mut self) -> Result<BTreeMap<(usize, String), MaterialAxes>> {
        let mut found = BTreeMap::new();
        for block in self.blocks_of("ORIENTATION") {
            let name = block.required("NAME")?;
            let definition = block.parameter("DEFINITION").unwrap_or("COORDINATES");
            ensure!(definition.eq_ignore_ascii_case("COORDINATES"); block;
                "*ORIENTATION {name}: only DEFINITION=COORDINATES is supported");
            let numbers = block.numbers(1)?; // Two points a and b; a third, the origin, is zero where it is not given.
            let &[a, b, c, d, e, f] = found!(numbers.first_chunk(); block;
                "*ORIENTATION {name}: six numbers expected: two points");
            let [p, q] = [Vector3::new(a, b, c), Vector3::new(d, e, f)];
            let system = block.parameter("SYSTEM").unwrap_or("RECTANGULAR").to_uppercase();
            // The second line turns about one of the axes.
            let extra = block.rows().nth(1).into_iter();
            let extra: Vec<f64> = extra.flat_map(|row| row.fields().filter_map(real)).collect();
            let scope = &self.scopes[block.scope];
            let turned = |v: Vector3<f64>| -> [f64; 3] {
                let [from, to] =
                    [[0.0; 3], v.into()].map(|point| Vector3::from(scope.place(point)));
                (to - from).into()
            };
            // Axes turn with the instance.
            let axes = match system.as_str() {
                "RECTANGULAR" | "R" => {
                    let axes = found!(turned_axes(p, q, &extra); block;
                        "*ORIENTATION {name}: its points lie on one line");
                    MaterialAxes::Vectors(axes.map(turned))
                }
                "CYLINDRICAL" | "C" if extra.get(1).is_none_or(|angle| *angle == 0.0) => {
                    ensure!(p != q; block; "*ORIENTATION {name}: the two points of its axis are one");
                    MaterialAxes::Cylindrical([p, q].map(|point| scope.place(point.into())))
                }
                _ => refuse!(block;
                    "*ORIENTATION {name}: only rectangular and cylindrical systems are supported"),
            };
            found.insert((block.scope, name.to_uppercase()), axes);
        }
        Ok(found)
    }
}

/// First and second axis of a rectangular system: the first along `a`, the second in its plane with `b`; then turned about axis
/// `extra[0]` by `extra[1]` degrees.
fn turned_axes(a: Vector3<f64>, b: Vector3<f64>, extra: &[f64]) -> Option<[Vector3<f64>; 2]> {
    let first = a.try_normalize(0.0)?;
    let third = first.cross(&b).try_normalize(1e-12 * b.norm())?;
    let axes = Matrix3::from_columns(&[first, third.cross(&first), third]);
    let turn = match extra {
        [axis @ (1.0 | 2.0 | 3.0), angle, ..] => {
            let about = axes.column(*axis as usize - 1).into_owned();
            Rotation3::from_axis_angle(&Unit::new_normalize(about), angle.to_radians())
        }
        _ => Rotation3::identity(),
    };
    Some([turn * axes.column(0), turn * axes.column(1)])
}

/// `*ELASTIC`; whether it has lines for other temperatures.
fn elastic(block: &Block<'_>, definition: &mut FileMaterial) -> Result<bool> {
    let kind = block.parameter("TYPE").unwrap_or("ISOTROPIC").to_uppercase();
    let numbers = block.numbers(usize::MAX)?;
    let what = format!("*ELASTIC, TYPE={kind} of material {}", definition.name);
    // What one temperature takes: one line, or two of more than eight numbers.
    let (count, lines) = match kind.as_str() {
        "ISOTROPIC" | "ISO" => (2, 1),
        "ENGINEERING CONSTANTS" | "ORTHOTROPIC" | "ORTHO" => (9, 2),
        _ => refuse!(block; "{what} is not supported: give ENGINEERING CONSTANTS"),
    };
    let elasticity = match numbers.get(..count) {
        Some(&[young_modulus, poisson_ratio]) => {
            Some(FileElasticity::Isotropic { young_modulus, poisson_ratio })
        }
        // E1, E2, E3, nu12, nu13, nu23, G12, G13, G23.
        Some(&[e1, e2, e3, n12, n13, n23, g12, g13, g23]) if kind == "ENGINEERING CONSTANTS" => {
            Some(FileElasticity::Orthotropic {
                young_moduli: [e1, e2, e3],
                poisson_ratios: [n12, n13, n23],
                shear_moduli: [g12, g13, g23],
                axes: MaterialAxes::Global,
            })
        }
        // D1111, D1122, D2222, D1133, D2233, D3333, D1212, D1313, D2323.
        Some(&[d11, d12, d22, d13, d23, d33, g12, g13, g23]) => {
            let normal = Matrix3::new(d11, d12, d13, d12, d22, d23, d13, d23, d33);
            FileElasticity::of_stiffness(normal, [g12, g13, g23], MaterialAxes::Global)
        }
        _ => refuse!(block; "{what} needs {count} numbers"),
    };
    let elasticity = found!(elasticity; block; "{what} is no stiffness: it is singular");
    definition.elasticity = Some(elasticity); // Further lines are of other temperatures.
    Ok(block.data.len() > lines)
}

/// `*DAMPING`, its values parameters.
fn damping(block: &Block<'_>, definition: &mut FileMaterial) -> Result<()> {
    for (name, value) in &block.parameters {
        let slot = match name.as_str() {
            "ALPHA" => &mut definition.mass_coefficient,
            "BETA" => &mut definition.stiffness_coefficient,
            "STRUCTURAL" => &mut definition.loss_factor,
            _ => {
                refuse!(block; "*DAMPING, {name} is not supported: ALPHA, BETA and STRUCTURAL are")
            }
        };
        *slot = Some(found!(real(value); block; "*DAMPING, {name}= needs a number"));
    }
    Ok(())
}
