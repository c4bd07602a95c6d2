//! Cases of two bodies that are refused.

use crate::prelude::*;
use crate::two_bodies::model::{blocks_of, rectangle};

#[test]
fn bodies_that_do_not_meet_are_refused_with_a_remedy() {
    let folder = kept("two_bodies");
    let block = |y: f64, x: f64| {
        let lower = rectangle([-0.01, -0.02], [0.06, 0.02], [6, 2]);
        blocks_of([lower, rectangle([x, y], [0.04, 0.03], [4, 3])])
    };
    fs::write(folder.join("good.msh"), block(0.0, 0.0)).unwrap();
    fs::write(folder.join("deep.msh"), block(-1e-4, 0.0)).unwrap();
    fs::write(folder.join("apart.msh"), block(0.0, 0.5)).unwrap();
    let read = |mesh: &str, changes: &[&str]| {
        let text = include_str!("../../cases/plane-block-on-a-block.toml");
        let mesh = format!("mesh.file={mesh:?}");
        read_case(folder.join("case.toml"), text, &[&[mesh.as_str()], changes].concat()).map(|_| ())
    };
    read("good.msh", &[]).unwrap();
    let without = unset("contact.counter_boundary");
    let [sole, plane] = ["contact.counter_boundary=sole", "contact.counterface=plane"];
    for (mesh, changes, said) in [
        ("deep.msh", &[][..], "the bodies overlap ; contact.interference"),
        ("apart.msh", &[], "no point of \"sole\" ; check the curves"),
        ("good.msh", &[sole], "are both \"sole\" ; name the curve of the other body"),
        ("good.msh", &[&without], "needs contact.counter_boundary ; name the physical curve"),
        ("good.msh", &[plane], "contact.counter_boundary is for two bodies"),
        ("good.msh", &[plane], "set contact.counterface = \"body\""),
    ] {
        has(&read(mesh, changes).unwrap_err(), &[said]);
    }
}
