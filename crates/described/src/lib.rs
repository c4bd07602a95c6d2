//! `#[derive(Described)]`: the keys of a struct in JSON, each with its comment as meaning.

use proc_macro::{Delimiter, TokenStream, TokenTree};
use std::fmt::Write;

/// Implements `frictionsim_output::Described` for a type without parameters. An untagged enum has the keys of its variants,
/// another one is a value without keys.
#[proc_macro_derive(Described)]
pub fn derive_described(item: TokenStream) -> TokenStream {
    let is_untagged = item.to_string().contains("untagged");
    let mut tokens = item.into_iter();
    let is_kind = |token: &TokenTree| ["struct", "enum"].contains(&token.to_string().as_str());
    let kind = tokens.find(is_kind).map(|kind| kind.to_string());
    let name = tokens.next().map_or_else(String::new, |name| name.to_string());
    let mut calls = String::new();
    let body = match tokens.next() {
        Some(TokenTree::Group(group)) if group.delimiter() == Delimiter::Brace => group.stream(),
        _ => TokenStream::new(),
    };
    if kind.as_deref() == Some("struct") {
        describe_fields(body, &mut calls);
    } else if is_untagged {
        body.into_iter().for_each(|token| describe_variant(&token, &mut calls));
    }
    let code = format!(
        "impl ::frictionsim_output::Described for {name} {{
            fn describe(path: &str, keys: &mut Vec<::frictionsim_output::Entry>) {{
                let _ = (path, &keys);
                {calls}
            }}
        }}"
    );
    code.parse().unwrap_or_default()
}

/// Adds the calls that describe what a variant holds between its brackets: one value, or fields.
fn describe_variant(token: &TokenTree, calls: &mut String) {
    let TokenTree::Group(group) = token else { return };
    let own = group.stream();
    match group.delimiter() {
        Delimiter::Brace => describe_fields(own, calls),
        Delimiter::Parenthesis => {
            *calls += &format!("<{own} as ::frictionsim_output::Described>::describe(path, keys);");
        }
        _ => {}
    }
}

/// Adds the calls that describe fields, which commas outside of angle brackets part.
fn describe_fields(fields: TokenStream, calls: &mut String) {
    let (mut field, mut depth) = (Vec::new(), 0);
    for token in fields {
        match token.to_string().as_str() {
            "<" => depth += 1,
            ">" => depth -= 1,
            "," if depth == 0 => {
                describe_field(&field, calls);
                field.clear();
                continue;
            }
            _ => {}
        }
        field.push(token);
    }
    describe_field(&field, calls);
}

/// Adds the call that describes a field: attributes, `pub`, its name, a colon, and its type.
fn describe_field(tokens: &[TokenTree], calls: &mut String) {
    let Some(colon) = tokens.iter().position(|token| token.to_string() == ":") else { return };
    let (mut docs, mut is_flat, mut is_skipped) = (Vec::new(), false, false);
    for token in &tokens[..colon] {
        let TokenTree::Group(group) = token else { continue };
        let mut inside = group.stream().into_iter();
        match inside.next().map(|name| name.to_string()).as_deref() {
            Some("doc") => docs.extend(inside.nth(1).map(|text| text.to_string())),
            Some("serde") => {
                is_flat |= group.to_string().contains("flatten");
                // `skip` alone: other attributes skip a key under a condition.
                is_skipped |= group.to_string().contains("skip)");
            }
            _ => {}
        }
    }
    if is_skipped {
        return;
    }
    let name = &tokens[colon - 1];
    let of_type: TokenStream = tokens[colon + 1..].iter().cloned().collect();
    let _ = writeln!(
        calls,
        "::frictionsim_output::describe_field(<{of_type} as ::frictionsim_output::Described>::describe, path,
            (\"{name}\", concat!({}), {is_flat}), keys);",
        docs.join(", ")
    );
}
