//! Records: sets of optional fields, such as settings and states.
//!
//! An absent field was not recorded: it is *unchanged* in a sequence of records and *not observable* in the first.
//! `overlay` folds a later record onto an earlier one.

/// Declares a record: a struct whose fields are all optional, with its entries and its folding.
macro_rules! record {
    ($(#[$about:meta])* pub struct $name:ident { $($(#[$what:meta])* $field:ident: $type:ty,)* }) => {
        $(#[$about])*
        #[derive(Clone, Debug, Default, PartialEq)]
        #[cfg_attr(
            feature = "serde",
            derive(serde::Serialize, serde::Deserialize),
            serde(deny_unknown_fields, default)
        )]
        #[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
        pub struct $name {
            $(
                $(#[$what])*
                #[cfg_attr(feature = "serde", serde(
                    serialize_with = "crate::json::number::write",
                    deserialize_with = "crate::json::number::read",
                    skip_serializing_if = "crate::field::unrecorded",
                ))]
                pub $field: Option<$type>,
            )*
        }

        impl $name {
            /// The names of all fields, in order.
            pub const FIELDS: &'static [&'static str] = &[$(stringify!($field)),*];

            /// Takes over what a later record holds.
            pub fn overlay(&mut self, change: &Self) {
                $(if let Some(change) = &change.$field {
                    match &mut self.$field {
                        Some(old) => $crate::field::Field::overlay(old, change),
                        empty => *empty = Some(change.clone()),
                    }
                })*
            }

            /// Removes the values of these fields; other names are ignored.
            pub fn forget(&mut self, fields: &[alloc::string::String]) {
                $(if fields.iter().any(|field| field == stringify!($field)) {
                    self.$field = None;
                })*
            }

            /// What is recorded here and differs from an earlier record.
            pub fn since(&self, earlier: &Self) -> Self {
                Self {
                    $($field: match (&self.$field, &earlier.$field) {
                        (Some(now), Some(before)) => $crate::field::Field::since(now, before),
                        (now, _) => now.clone(),
                    },)*
                }
            }

            /// Everything that is recorded, in the order of the fields.
            pub fn entries(&self) -> alloc::vec::Vec<$crate::field::Entry> {
                let mut out = alloc::vec::Vec::new();
                $(if let Some(value) = &self.$field {
                    $crate::field::Field::entries(value, stringify!($field), &mut out);
                })*
                out
            }

            /// Whether nothing is recorded.
            pub fn is_empty(&self) -> bool {
                $($crate::field::unrecorded(&self.$field))&&*
            }

            /// Reads one value by the field's name, in the form that `Display` of [`crate::Value`] writes.
            ///
            /// # Errors
            /// There is no such field, or its value is unreadable.
            #[cfg(feature = "text")]
            pub fn read(
                &mut self,
                field: &str,
                index: Option<&str>,
                text: &str,
            ) -> Result<(), $crate::error::TextError> {
                match field {
                    $(stringify!($field) => $crate::text::value::ReadField::read(&mut self.$field, index, text),)*
                    _ => Err($crate::error::TextError::new(alloc::format!("there is no field named {field}"))),
                }
            }
        }
    };
}

pub(crate) use record;
