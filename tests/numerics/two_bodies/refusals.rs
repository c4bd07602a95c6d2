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
    let read = |mesh: &str, contact: &str| {
        let text = format!(
            "[mesh]\nfile = \"{mesh}\"\n[material]\nyoung_modulus = 2.5e9\npoisson_ratio = 0.3\ndensity = 1228.0\n\
             [boundaries.floor]\ncondition = \"clamped\"\n[boundaries.top]\ncondition = \"support\"\n\
             normal_stiffness = 1e11\ntangential_stiffness = 1e11\n[contact]\nboundary = \"sole\"\n\
             friction_coefficient = 0.3\ninterference = 1e-5\nspeed = 1.0\n{contact}\n"
        );
        read_case(folder.join("case.toml"), &text, AS_IT_IS).map(|_| ())
    };
    let body = "counterface = \"body\"\ncounter_boundary = \"track\"";
    read("good.msh", body).unwrap();
    for (mesh, contact, message, remedy) in [
        ("deep.msh", body, "the bodies overlap", "contact.interference"),
        ("apart.msh", body, "no point of \"sole\"", "check the curves"),
        (
            "good.msh",
            "counterface = \"body\"\ncounter_boundary = \"sole\"",
            "are both \"sole\"",
            "name the curve of the other body",
        ),
        (
            "good.msh",
            "counterface = \"body\"",
            "needs contact.counter_boundary",
            "name the physical curve",
        ),
        (
            "good.msh",
            "counterface = \"plane\"\ncounter_boundary = \"track\"",
            "contact.counter_boundary is for two bodies",
            "set contact.counterface = \"body\"",
        ),
    ] {
        let error = read(mesh, contact).unwrap_err();
        assert!(error.contains(message) && error.contains(remedy), "{error}");
    }
}
