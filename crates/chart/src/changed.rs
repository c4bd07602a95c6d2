//! Parts that are given in any order, one method each.

/// Declares methods that give the same value with some of its fields changed:
/// `name(argument: Type) => { field: value }`.
macro_rules! changed {
    ($of:ty: $(
        $(#[$doc:meta])*
        $name:ident($($given:ident: $kind:ty),*) => { $($($field:ident).+: $value:expr),+ }
    )+) => {
        impl $of {$(
            $(#[$doc])*
            pub fn $name(mut self $(, $given: $kind)*) -> Self {
                $(self.$($field).+ = $value;)+
                self
            }
        )+}
    };
}
