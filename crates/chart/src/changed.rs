//! Parts that are given in any order, one method each.

/// Declares methods that give the same value with some of its fields changed,
/// `name(argument: Type) => { field: value }`, or with more in one of its lists, `[field: values]`.
macro_rules! changed {
    (@ $own:ident {$($($field:ident).+: $value:expr),+}) => { $($own.$($field).+ = $value;)+ };
    (@ $own:ident [$($list:ident).+: $values:expr]) => { $own.$($list).+.extend($values); };
    ($of:ty: $(
        $(#[$doc:meta])*
        $name:ident($($given:ident: $kind:ty),*) => $changes:tt
    )+) => {
        impl $of {$(
            $(#[$doc])*
            pub fn $name(mut self $(, $given: $kind)*) -> Self {
                changed!(@ self $changes);
                self
            }
        )+}
    };
}
