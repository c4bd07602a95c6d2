//! Consistency check of remedies: sections that commands ask for are those of the body at hand.

use crate::prelude::*;

fn parse(name: &str, further: &str) -> Case {
    case_of(shipped(name), &(fs::read_to_string(shipped(name)).unwrap() + further), AS_IT_IS)
}

#[test]
fn sections_that_commands_ask_for_are_taken() {
    let others = ["sliding-block.toml", "tread-block.toml", "polycarbonate-610rpm.toml"];
    for name in [&["brake.toml", "ring-on-layer.toml"], &others[..]].concat() {
        let case = parse(name, "");
        let asked = [
            case.require_sweep().err(),
            case.require_uncertainty().err(),
            case.require_fit().err(),
            case.require_convergence().err(),
            case.require_basin().err().filter(|errors| errors.to_string().contains("add\n")),
        ];
        for errors in asked.into_iter().flatten() {
            let help = errors.diagnostics[0].help.clone().unwrap();
            let section = help.strip_prefix("add\n").unwrap_or_else(|| panic!("{name}: {help}"));
            let given = parse(name, &format!("\n{section}\n"));
            if section == "[basin]" {
                given.require_basin().unwrap();
            }
        }
    }
    assert_eq!(parse("brake.toml", "").speed_key(), "motion.Disc_Disc_iron.rotation_speed_rpm");
}
