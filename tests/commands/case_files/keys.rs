//! Consistency checks of the declarations of keys: what readers, messages, schema and template make of them is one and the same.

use super::*;
use frictionsim::case::reference;

/// What makes of the run a case of every section.
const WHOLE: &str = "frf={ force_node = 36, frequencies_hz = [100] } ; convergence={} ; \
    cycle={ continuation = { key = \"contact.rotation_speed_rpm\", from = 10, to = 6000 } } ; \
    sweep={ \"contact.interference\" = 1e-5 }";

#[test]
fn the_guide_documents_every_key_as_it_is_declared() {
    crate::columns::guide_has("keys", &reference::markdown());
}

#[test]
fn a_default_written_out_changes_nothing() {
    let plain = valid(RUN, &[WHOLE]);
    for key in KEYS.iter() {
        let Some(value) = key.default_toml() else { continue };
        // What the case gives itself is no default, and a section that it lacks has none.
        let lacks_section = plain.raw.find(key.section()).is_none();
        if plain.raw.find(key.name).is_some() || lacks_section {
            continue;
        }
        let written = match parse(RUN, &[WHOLE, &format!("{}={value}", key.name)]) {
            Ok(written) => written,
            // A seed needs the noise that it is the seed of.
            Err(errors) => {
                has(&errors.to_string(), &["is given without"]);
                continue;
            }
        };
        // A seed without noise is said to be of no use.
        let Case { raw, title, warnings, .. } = plain.clone();
        assert_eq!(Case { raw, title, warnings, ..written }, plain, "{}", key.name);
    }
}

/// Keys that the schema requires of a table and that are missing there.
fn missing(schema: &Value, table: &toml::Table) -> Vec<String> {
    let required = schema["required"].as_array().into_iter().flatten().filter_map(Value::as_str);
    let own = required.filter(|key| !table.contains_key(*key)).map(str::to_owned);
    let below = table.iter().flat_map(|(key, value)| {
        let inner = schema["properties"].get(key).unwrap_or(&schema["additionalProperties"]);
        value.as_table().map_or_else(Vec::new, |table| missing(inner, table))
    });
    own.chain(below).collect()
}

#[test]
fn every_shipped_case_has_what_the_schema_requires() {
    let schema = reference::schema();
    for name in names_in(Path::new(&shipped(""))).iter().filter(|name| name.ends_with(".toml")) {
        let case = fs::read_to_string(shipped(name)).unwrap().parse().unwrap();
        assert_eq!(missing(&schema, &case), Vec::<String>::new(), "{name}");
    }
}

#[test]
fn every_key_stands_in_the_schema_once_with_its_meaning() {
    let schema = reference::schema();
    for key in KEYS.iter() {
        let parts = key.name.split('.').map(|part| match part {
            "*" => "/additionalProperties".to_owned(),
            part => format!("/properties/{part}"),
        });
        let pointer: String = parts.collect();
        let found = schema.pointer(&pointer).unwrap_or(&Value::Null);
        let description = found["description"].as_str().unwrap_or("");
        assert!(description.contains(key.meaning), "{}: {found}", key.name);
    }
}

#[test]
fn a_template_with_every_key_holds_no_key_that_is_unknown() {
    let template = reference::template();
    assert!(parse(&template, &[]).is_ok(), "{}", report(&template, &[]));
    let is_comment = |line: &str| line.starts_with("# ") && !line.ends_with('.');
    let bare = |line| if is_comment(line) { &line[2..] } else { line };
    let all = template.lines().map(bare).collect::<Vec<&str>>().join("\n");
    if let Err(errors) = parse(&all, &[]) {
        for error in &errors.diagnostics {
            has(&error.message, &["!unknown", "!missing", "! must be "]);
        }
    }
    for key in KEYS.iter() {
        assert!(all.contains(&format!("{} = ", key.short())), "{}", key.name);
    }
}

#[test]
fn files_that_are_no_text_are_named() {
    let utf16: Vec<u8> = RUN.encode_utf16().flat_map(u16::to_le_bytes).collect();
    let marked = [[0xff, 0xfe].as_slice(), &utf16].concat();
    let strange = [b"title = \"".as_slice(), &[0xff, 0xfe], b"\""].concat();
    for (bytes, part) in [(marked, "UTF-16"), (utf16, "zero bytes"), (strange, "case.toml:1:")] {
        let errors = Case::parse("case.toml", &bytes, &[]).unwrap_err();
        assert_eq!(errors.diagnostics.len(), 1, "{errors}");
        has(&errors.to_string(), &[part, "UTF-8", "case.toml"]);
        assert!(!errors.to_string().contains("inner"), "{errors}");
    }
}

#[test]
fn a_key_taken_away_makes_room_for_another() {
    let gone = unset("cea.max_frequency_hz");
    let case = valid(DISC, &[&gone, "cea.modes=10"]);
    assert_eq!(case.require_cea().unwrap().modes, frictionsim::case::ModeLimit::Lowest(10));
    assert!(valid(RUN, &[&unset("transient")]).transient.is_none());
    // A known key that is not there may go; an unknown one may not.
    valid(DISC, &[&unset("transient.duration")]);
}

#[test]
fn a_title_says_what_overrides_its_case() {
    let case = valid(RUN, &["contact.rotation_speed_rpm=2000"]);
    let end = "nodal diameters  [with contact.rotation_speed_rpm = 2000]";
    assert!(case.title.ends_with(end), "{}", case.title);
    assert!(!valid(RUN, &[]).title.contains("[with"));
}

#[test]
fn a_single_value_stands_for_a_list_of_one() {
    let given = ["output.probes=7 ; output.snapshots=0.01 ; transient.perturbation.harmonics=3 ; \
         cea.shapes_at=0.2 ; cea.friction_coefficients=0.2 ; sweep.analyses=cea ; \
         sweep.\"contact.friction_coefficient\"=0.2 ; cycle.harmonics=2"];
    let case = valid(RUN, &given);
    assert_eq!(case.output.recorder.probes, [7]);
    assert_eq!(case.output.recorder.snapshots, [0.01]);
    assert_eq!(case.cycle.unwrap().harmonics, Some(vec![2]));
    assert_eq!(case.sweep.unwrap().point_count(), 1);
}
