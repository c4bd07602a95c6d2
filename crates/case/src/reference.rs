//! Reference of the case keys, in the forms that people and editors read.

use super::{Bound, KEYS, Kind};
use crate::*;
use serde_json::{Value, json};

/// Sections that the built-in disc needs; of another body its mesh file may give what stands there.
const OF_DISC: [&str; 4] = ["geometry", "mesh", "material", "contact"];

/// The sections, in the order of the documentation; the case itself is the empty one.
pub fn sections() -> Vec<&'static str> {
    let mut sections: Vec<&str> = KEYS.iter().map(CaseKey::section).collect();
    sections.dedup();
    sections
}

/// The keys of a section.
fn keys_of(section: &str) -> impl Iterator<Item = &'static CaseKey> {
    KEYS.iter().filter(move |key| key.section() == section)
}

/// Tables in Markdown, one for each section; a bracket in a text is none of a link.
pub fn markdown() -> String {
    // Code keeps its brackets.
    let plain = |text: &str| -> String {
        let parts = text.split('`').enumerate().map(|(k, part)| match k % 2 {
            0 => part.replace('[', "\\["),
            _ => part.to_owned(),
        });
        parts.collect::<Vec<_>>().join("`")
    };
    let mut out = String::new();
    for section in sections() {
        let _ = match section {
            "" => writeln!(out, "| key | values | unit | default | meaning |"),
            _ => writeln!(out, "\n`[{section}]`\n\n| key | values | unit | default | meaning |"),
        };
        let _ = writeln!(out, "|---|---|---|---|---|");
        for key in keys_of(section) {
            let default = key.default_toml().map(|value| format!("`{value}`"));
            let default = default.unwrap_or_else(|| plain(key.default_text()));
            let (name, unit) = (key.short(), key.unit);
            let [values, meaning] = [&*key.values(), key.meaning].map(plain);
            let _ = writeln!(out, "| `{name}` | {values} | {unit} | {default} | {meaning} |");
        }
    }
    out
}

/// A case with every key: those that it needs with an example, all others as comments that show
/// their default, or an example where they have none.
pub fn template() -> String {
    let mut out =
        "# Every key of a case. The built-in disc needs those that are not commented out.\n"
            .to_owned();
    for section in sections() {
        let needed = section.is_empty() || OF_DISC.contains(&section);
        if !section.is_empty() {
            let comment = if needed { "" } else { "# " };
            let name = section.replace('*', "NAME");
            let _ = writeln!(out, "\n{comment}[{name}]");
        }
        for key in keys_of(section) {
            let value = key.default_toml().unwrap_or(key.example);
            let note = match key.is_required() || key.default_toml().is_some() {
                true => String::new(),
                false => format!("; left out: {}", key.default_text()),
            };
            let comment = if needed && key.is_required() { "" } else { "# " };
            let line = format!("{comment}{} = {value}", key.short());
            let unit = if key.unit.is_empty() { String::new() } else { format!("{}, ", key.unit) };
            let _ = writeln!(out, "{line:<37} # {unit}{}{note}", key.meaning);
        }
    }
    out
}

/// One object for each key.
pub fn object(key: &CaseKey) -> Value {
    json!({
        "name": key.name,
        "values": key.values(),
        "unit": key.unit,
        "default": key.default_text(),
        "required": key.default_text() == "required",
        "example": key.example,
        "meaning": key.meaning,
        "of_rotating_waves": Some(key.of_waves).filter(|words| !words.is_empty()),
        "since": "0.1",
    })
}

/// The JSON schema of a case file, for editors.
pub fn schema() -> Value {
    let mut root = object_schema();
    for key in KEYS.iter() {
        let mut place = &mut root;
        for part in key.section().split('.').filter(|part| !part.is_empty()) {
            place = child(place, part, object_schema);
        }
        let is_of_body = OF_DISC.iter().any(|own| key.section().starts_with(own));
        let is_required = key.default_text() == "required" && !is_of_body;
        if let Some(required) = place["required"].as_array_mut().filter(|_| is_required) {
            required.push(json!(key.short()));
        }
        *child(place, key.short(), || Value::Null) = key_schema(key);
    }
    // A swept key is any key of the case, quoted or as tables.
    root["properties"]["sweep"]["additionalProperties"] = json!(true);
    root["$schema"] = json!("http://json-schema.org/draft-07/schema#");
    root["title"] = json!("frictionsim case");
    root["definitions"] = json!({ "range": {
        "type": "object",
        "properties": {
            "from": { "type": "number" },
            "to": { "type": "number" },
            "count": { "type": "integer", "minimum": 1 },
            "spacing": { "enum": ["linear", "log"] },
        },
        "required": ["from", "to", "count"],
        "additionalProperties": false,
    }});
    root
}

fn object_schema() -> Value {
    json!({ "type": "object", "properties": {}, "required": [], "additionalProperties": false })
}

/// The schema of a part of a section, made where it is not there; `*` is every other name.
fn child<'a>(place: &'a mut Value, part: &str, make: fn() -> Value) -> &'a mut Value {
    if part == "*" {
        if place["additionalProperties"] == json!(false) {
            place["additionalProperties"] = make();
        }
        return &mut place["additionalProperties"];
    }
    let properties = &mut place["properties"];
    if properties.get(part).is_none() {
        properties[part] = make();
    }
    &mut properties[part]
}

fn key_schema(key: &CaseKey) -> Value {
    let of_one = |one: Value| json!({ "anyOf": [one, { "type": "array", "items": one }] });
    let mut schema = match key.kind {
        Kind::Text => json!({ "type": "string" }),
        Kind::Texts => of_one(json!({ "type": "string" })),
        Kind::Flag => json!({ "type": "boolean" }),
        Kind::Number(bound) => number(bound),
        Kind::NumberOr(bound, word) => json!({ "anyOf": [number(bound), { "const": word }] }),
        Kind::Numbers(bound) => json!({ "anyOf": [
            number(bound),
            { "type": "array", "items": number(bound) },
            { "$ref": "#/definitions/range" },
        ]}),
        Kind::Count(least) => json!({ "type": "integer", "minimum": least }),
        Kind::Counts(least) => of_one(json!({ "type": "integer", "minimum": least })),
        Kind::Node => node(),
        Kind::Nodes => of_one(node()),
        Kind::Choice(words) => json!({ "enum": words() }),
        Kind::Choices(words) => of_one(json!({ "enum": words() })),
        Kind::Directions(words) => json!({ "anyOf": [
            { "enum": words() },
            { "type": "array", "minItems": 2, "maxItems": 2, "items": {
                "type": "array", "minItems": 2, "maxItems": 3, "items": { "type": "number" },
            }},
        ]}),
        Kind::Table => json!({ "type": "object" }),
        Kind::Parameter => {
            let numeric = KEYS.iter().filter(|key| key.is_numeric());
            let numeric = numeric.filter(|key| !key.name.contains('*'));
            json!({ "enum": numeric.map(|key| key.name).collect::<Vec<_>>() })
        }
    };
    let (meaning, values, text) = (key.meaning_with_unit(), key.values(), key.default_text());
    let default = if text == "required" { text.to_owned() } else { format!("default {text}") };
    schema["description"] = json!(format!("{meaning} ({values}; {default})"));
    schema
}

fn node() -> Value {
    let place = |[a, b]: [&str; 2]| {
        json!({
            "type": "object",
            "properties": {
                a: { "type": "number" }, b: { "type": "number" }, "z": { "type": "number" },
            },
            "required": [a, b],
            "additionalProperties": false,
        })
    };
    json!({ "anyOf": [
        { "type": "integer", "minimum": 1 },
        place(["x", "y"]),
        place(["radius", "angle_deg"]),
    ]})
}

fn number(bound: Bound) -> Value {
    let mut schema = json!({ "type": "number" });
    let words = match bound.is_closed {
        true => ["minimum", "maximum"],
        false => ["exclusiveMinimum", "exclusiveMaximum"],
    };
    for (word, end) in words.into_iter().zip(bound.ends).filter(|own| own.1.is_finite()) {
        schema[word] = if end == 0.0 { json!(0) } else { json!(end) };
    }
    schema
}
