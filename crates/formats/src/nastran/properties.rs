//! `PSOLID`, `MAT1` and `MAT9`: the material of each region.

use super::Reader;
use super::card::Card;
use super::coordinates::Kind;
use crate::prelude::*;

impl Reader<'_, '_> {
    /// Materials of the regions that have elements.
    pub(super) fn read_properties(&mut self) -> Result<()> {
        for card in self.cards_of("PSOLID") {
            let property = card.number(0)?;
            let number = card.number(1)?;
            let region = self.region(property); // Of no elements that are read there is no region.
            if self.file.elements.iter().all(|element| *element.region != *region) {
                continue;
            }
            // CORDM says along which axes MAT9 has its stiffness.
            let axes = match card.optional_int(2)?.unwrap_or(0) {
                0 => MaterialAxes::Global,
                system if system > 0 => {
                    let system = self.coordinates.system(system as usize, card.place)?;
                    if system.kind != Kind::Rectangular {
                        let reason = "a material system that is not rectangular: give axes = \"cylindrical\" in the case";
                        self.leave_out("PSOLID with CORDM", card.place, (reason, false));
                    }
                    let column = |axis: usize| system.axes.column(axis).into_owned().into();
                    MaterialAxes::Vectors([column(0), column(1)])
                }
                _ => {
                    let reason = "axes along the edges of elements";
                    self.leave_out("PSOLID with CORDM = -1", card.place, (reason, false));
                    MaterialAxes::Global
                }
            };
            // MID is the number of its material.
            let is_meant = |card: &&Card<'_>| {
                matches!(card.name.as_str(), "MAT1" | "MAT9") && card.field(0).parse() == Ok(number)
            };
            let material = found!(self.cards.iter().find(is_meant); card;
                "PSOLID {property} names material {number}, which is no MAT1 or MAT9 of the file");
            // Density and structural damping stand in fields of their own.
            let (elasticity, [density, damping]) = match material.name.as_str() {
                "MAT1" => (isotropic(material)?, [4, 7]),
                _ => (anisotropic(material, axes)?, [22, 30]),
            };
            let damping = material.optional_real(damping)?;
            self.file.model.materials.push(FileMaterial {
                region,
                name: format!("{}_{}", material.name, material.field(0)),
                elasticity: Some(elasticity),
                density: material.optional_real(density)?,
                loss_factor: damping.filter(|&damping| damping != 0.0),
                place: self.deck.name(material.place),
                ..FileMaterial::default()
            });
        }
        Ok(())
    }
}

fn isotropic(card: &Card<'_>) -> Result<FileElasticity> {
    let [e, g, nu] = [card.optional_real(1)?, card.optional_real(2)?, card.optional_real(3)?];
    // Two of the three give the third: E = 2 G (1 + nu).
    let (young_modulus, poisson_ratio) = match (e, g, nu) {
        (Some(e), _, Some(nu)) => (e, nu),
        (Some(e), Some(g), None) if g != 0.0 => (e, e / (2.0 * g) - 1.0),
        (None, Some(g), Some(nu)) => (2.0 * g * (1.0 + nu), nu),
        _ => refuse!(card; "MAT1 {}: two of E, G and NU are needed", card.field(0)),
    };
    Ok(FileElasticity::Isotropic { young_modulus, poisson_ratio })
}

fn anisotropic(card: &Card<'_>, axes: MaterialAxes) -> Result<FileElasticity> {
    // The upper triangle by rows, over x, y, z, xy, yz, zx.
    let mut stiffness = [[0.0; 6]; 6];
    let mut places = (0..6).flat_map(|row| (row..6).map(move |column| (row, column)));
    for (field, (row, column)) in (1..).zip(places.clone()) {
        stiffness[row][column] = card.real(field)?;
    }
    let is_coupled =
        |(row, column): (usize, usize)| column > row.max(2) && stiffness[row][column] != 0.0;
    ensure!(!places.any(is_coupled); card;
        "MAT9 {}: only orthotropic materials are supported, their axes those of the material", card.field(0));
    let [a, b, c] = [stiffness[0], stiffness[1], stiffness[2]];
    let normal = Matrix3::new(a[0], a[1], a[2], a[1], b[1], b[2], a[2], b[2], c[2]);
    let shear_moduli = [stiffness[3][3], stiffness[5][5], stiffness[4][4]];
    let constants = FileElasticity::of_stiffness(normal, shear_moduli, axes);
    Ok(found!(constants; card; "MAT9 {}: its stiffness is singular", card.field(0)))
}
