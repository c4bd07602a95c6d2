//! Objects of JSON with the meaning of their keys, and columns of files that are such keys.

/// Declares objects, each a struct: `key: type = "meaning";` is a field, its key and what the reference says of it;
/// `key?: type` is absent where there is none. With a name of columns, `Name, COLUMNS`, each key is a column of files
/// as well and, with a label as in `Always "label" Fixed(2)`, one that people see; without a meaning it is a field
/// alone. Attributes may stand before an object and before a key.
macro_rules! keys {
    (@ $(#[$($meta:tt)+])* $name:ident {
        $($(#[$($own:tt)+])* $key:ident $(?: $option:ty)? $(: $type:ty)? $(= $meaning:literal
            $(, $when:ident $label:literal $format:expr)?)?;)+
    }) => {
        $(#[$($meta)+])*
        #[derive(Clone, Debug, PartialEq, frictionsim_output::Described, serde::Serialize)]
        pub struct $name {$(
            $(#[doc = $meaning])?
            $(#[$($own)+])*
            $(#[serde(skip_serializing_if = "Option::is_none")] #[cfg_attr(any(), key($option))])?
            pub $key: $($type)? $(Option<$option>)?,
        )+}
    };
    (@ $(#[$($meta:tt)+])* $name:ident, $columns:ident {
        $($(#[$($own:tt)+])* $key:ident $(?: $option:ty)? $(: $type:ty)? $(= $meaning:literal
            $(, $when:ident $label:literal $format:expr)?)?;)+
    }) => {
        $crate::keys::keys! { @ $(#[$($meta)+])* $name {
            $($(#[$($own)+])* $key $(?: $option)? $(: $type)? $(= $meaning)?;)+
        }}

        frictionsim_output::columns! {
            #[doc = "Its keys as columns."]
            pub(crate) $columns: own as $name;
            $($($key: $meaning = own.$key.to_owned() $(, $when $label $format)?;)?)+
        }
    };
    ($($(#[$($meta:tt)+])* $name:ident $(, $columns:ident)? { $($keys:tt)+ })+) => {$(
        $crate::keys::keys! { @ $(#[$($meta)+])* $name $(, $columns)? { $($keys)+ } }
    )+};
}
pub(crate) use keys;
