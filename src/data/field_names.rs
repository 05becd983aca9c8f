//! The names of a type's fields, from its serde implementation.

use serde::de::value::Error;
use serde::de::{Deserialize, Deserializer, Error as _, Visitor};

/// The fields that a struct with a derived `Deserialize` has in a file; none for any other type.
pub fn field_names<T: Deserialize<'static>>() -> &'static [&'static str] {
    let mut asked = Asked(&[]);
    // It ends in an error in any case: there is nothing to read.
    let _ = T::deserialize(&mut asked);
    asked.0
}

/// What a struct asked for.
struct Asked(&'static [&'static str]);

impl<'de> Deserializer<'de> for &mut Asked {
    type Error = Error;

    fn deserialize_any<V: Visitor<'de>>(self, _: V) -> Result<V::Value, Error> {
        Err(Error::custom("there is nothing to read"))
    }

    fn deserialize_struct<V: Visitor<'de>>(
        self,
        _: &'static str,
        fields: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, Error> {
        self.0 = fields;
        self.deserialize_any(visitor)
    }

    serde::forward_to_deserialize_any! {
        bool i8 i16 i32 i64 i128 u8 u16 u32 u64 u128 f32 f64 char str string bytes byte_buf option unit unit_struct
        newtype_struct seq tuple tuple_struct map enum identifier ignored_any
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use super::*;

    #[derive(serde::Deserialize)]
    #[expect(dead_code, reason = "only the names of its fields count")]
    struct Ring {
        radius: f32,
        #[serde(rename = "of")]
        owner: Option<String>,
    }

    #[test]
    fn a_struct_tells_its_fields_as_a_file_has_them() {
        assert_eq!(field_names::<Ring>(), ["radius", "of"]);
        assert_eq!(field_names::<BTreeMap<String, Ring>>(), [""; 0]);
    }
}
