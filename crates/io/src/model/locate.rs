use std::fmt;

use serde::de::{DeserializeSeed, Error, IgnoredAny, MapAccess, SeqAccess, Visitor};
use serde_json::Deserializer;
use serde_json::de::StrRead;

use crate::place::Step;

/// The line of the value that a path of steps leads to, or of the last value on the way that is there.
///
/// The text is read once more and given up at the value: the parser then says where it stands. `None` if the text is
/// no JSON up to there. Cost: one pass, no tree.
pub(super) fn locate(text: &str, steps: &[Step]) -> Option<usize> {
    (0..=steps.len()).rev().find_map(|length| {
        let mut json: Deserializer<StrRead<'_>> = Deserializer::from_str(text);
        let error = Walk(&steps[..length]).deserialize(&mut json).err()?;
        error.to_string().contains(HERE).then(|| error.line())
    })
}

/// The message of the error that means "found".
const HERE: &str = "\u{1}here";

/// Follows the steps and fails at their end.
///
/// At the end a truth value is asked for: whatever else stands there, serde fails with "invalid type: …, expected",
/// followed by what `expecting` says, which is the message. On the way a number or a string fails likewise, with another one.
struct Walk<'s>(&'s [Step]);

impl<'de> DeserializeSeed<'de> for Walk<'_> {
    type Value = ();

    fn deserialize<D: serde::Deserializer<'de>>(self, json: D) -> Result<(), D::Error> {
        if self.0.is_empty() {
            // Whatever stands here, the parser stops before it and not, as for an array, behind its first blanks.
            json.deserialize_bool(self)
        } else {
            json.deserialize_any(self)
        }
    }
}

impl<'de> Visitor<'de> for Walk<'_> {
    type Value = ();

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(if self.0.is_empty() { HERE } else { "an object or an array" })
    }

    fn visit_bool<E: Error>(self, _: bool) -> Result<(), E> {
        Err(E::custom(self.0.first().map_or(HERE, |_| "expected an object or an array")))
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<(), A::Error> {
        let Some((step, rest)) = self.0.split_first() else {
            return Ok(());
        };
        while let Some(key) = map.next_key::<std::borrow::Cow<'de, str>>()? {
            match step {
                Step::Field(name) if *name == key => map.next_value_seed(Walk(rest))?,
                _ => drop(map.next_value::<IgnoredAny>()?),
            }
        }
        Ok(())
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut seq: A) -> Result<(), A::Error> {
        let Some((step, rest)) = self.0.split_first() else {
            return Ok(());
        };
        for index in 0.. {
            let more = match step {
                Step::Index(wanted) if *wanted == index => seq.next_element_seed(Walk(rest))?.is_some(),
                _ => seq.next_element::<IgnoredAny>()?.is_some(),
            };
            if !more {
                break;
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn finds_objects_arrays_and_numbers() {
        let text = "{\"a\": [1, {\"b\":\n  2.5}],\n\n \"c\": [\n[3,\n4]],\n\"d\":\n true, \"e\": null}";
        let at = |steps: &[Step]| locate(text, steps);
        assert_eq!(at(&[]), Some(1));
        assert_eq!(at(&[Step::Field("a"), Step::Index(1), Step::Field("b")]), Some(2));
        assert_eq!(at(&[Step::Field("c"), Step::Index(0), Step::Index(1)]), Some(6));
        assert_eq!(at(&[Step::Field("c"), Step::Index(0)]), Some(5));
        assert_eq!(at(&[Step::Field("c")]), Some(4));
        assert_eq!(at(&[Step::Field("d")]), Some(8));
        assert_eq!(at(&[Step::Field("e")]), Some(8));
        // What is missing is placed with what should hold it.
        assert_eq!(at(&[Step::Field("c"), Step::Field("d")]), Some(4));
        assert_eq!(at(&[Step::Field("z")]), Some(1));
    }
}
