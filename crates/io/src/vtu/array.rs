//! The arrays of a file, in all of VTK's encodings.

use std::ops::Range;

use roxmltree::Node;

use super::encoded::{Packing, Trouble, base64};
use super::error::VtuError;
use crate::MAX_FILE_BYTES;
use crate::place::excerpt;

/// What is wrong, and the byte of the document where it is.
pub(super) type Fault = (usize, VtuError);

/// The types of numbers that arrays have.
const NUMBERS: [(&str, Number); 10] = [
    ("Float64", Number::F64),
    ("Float32", Number::F32),
    ("Int64", Number::I64),
    ("UInt64", Number::U64),
    ("Int32", Number::I32),
    ("UInt32", Number::U32),
    ("Int16", Number::I16),
    ("UInt16", Number::U16),
    ("Int8", Number::I8),
    ("UInt8", Number::U8),
];
const NUMBER_NAMES: &str = "Float64, Float32, Int64, UInt64, Int32, UInt32, Int16, UInt16, Int8, UInt8";

#[derive(Clone, Copy)]
enum Number {
    F64,
    F32,
    I64,
    U64,
    I32,
    U32,
    I16,
    U16,
    I8,
    U8,
}

/// The data that stand behind the document proper.
pub(super) struct Appended<'b> {
    pub(super) bytes: &'b [u8],
    pub(super) base64: bool,
    /// Where in it arrays begin, sorted.
    pub(super) offsets: Vec<usize>,
}

/// Everything about a file that its arrays are decoded by.
pub(super) struct Arrays<'b> {
    pub(super) packing: Packing,
    pub(super) appended: Option<Appended<'b>>,
}

/// An attribute that has to be there.
pub(super) fn attribute<'a>(node: Node<'a, '_>, name: &'static str) -> Result<&'a str, Fault> {
    node.attribute(name).ok_or_else(|| {
        let element = node.tag_name().name().into();
        (node.range().start, VtuError::NoAttribute { element, attribute: name })
    })
}

/// What an array is called in messages.
pub(super) fn name(node: Node<'_, '_>) -> String {
    excerpt(node.attribute("Name").unwrap_or(node.tag_name().name()))
}

impl Arrays<'_> {
    /// All numbers of an array.
    pub(super) fn floats(&self, node: Node<'_, '_>) -> Result<Vec<f64>, Fault> {
        let number = number(node)?;
        if let Some((start, text)) = ascii(node)? {
            return words(node, start, text, number, |word| match number {
                Number::F32 => word.parse::<f32>().ok().map(f64::from),
                _ => word.parse().ok(),
            });
        }
        self.binary(node, number, |bytes| number.float(bytes))
    }

    /// All numbers of an array of integers.
    pub(super) fn integers(&self, node: Node<'_, '_>) -> Result<Vec<i64>, Fault> {
        let number = number(node)?;
        if let Some((start, text)) = ascii(node)? {
            return words(node, start, text, number, |word| word.parse().ok());
        }
        if let Number::F32 | Number::F64 = number {
            let found = "a number with a point".into();
            return Err((
                node.range().start,
                VtuError::Number { array: name(node), found, number: "integer" },
            ));
        }
        self.binary(node, number, |bytes| number.integer(bytes))
    }

    /// Numbers of as many bytes as their type has, given with the least significant byte first.
    fn binary<T>(
        &self,
        node: Node<'_, '_>,
        number: Number,
        read: impl Fn([u8; 8]) -> Option<T>,
    ) -> Result<Vec<T>, Fault> {
        let at = node.range().start;
        let wrong = |why| (at, VtuError::Encoded { array: name(node), why });
        let data = self.data(node)?;
        let size = number.size();
        if data.len() % size != 0 {
            return Err(wrong(format!(
                "{} bytes are no whole number of numbers of {size} bytes",
                data.len()
            )));
        }
        // Of small types, too, no more numbers than the limit holds of large ones: all become large here.
        if (data.len() / size) as u64 > MAX_FILE_BYTES / 8 {
            return Err((at, VtuError::TooLong { array: name(node), limit: MAX_FILE_BYTES }));
        }
        let numbers = data.chunks_exact(size).map(|chunk| {
            let mut bytes = [0; 8];
            bytes[..size].copy_from_slice(chunk);
            if self.packing.big_endian {
                bytes[..size].reverse();
            }
            read(bytes).ok_or_else(|| wrong("a number is beyond the range of 64-bit integers".into()))
        });
        numbers.collect()
    }

    /// The bytes of an array that is not text.
    fn data(&self, node: Node<'_, '_>) -> Result<Vec<u8>, Fault> {
        let at = node.range().start;
        let fault = |trouble| {
            let array = name(node);
            (
                at,
                match trouble {
                    Trouble::Wrong(why) => VtuError::Encoded { array, why },
                    Trouble::TooLong => VtuError::TooLong { array, limit: MAX_FILE_BYTES },
                },
            )
        };
        let packed = match attribute(node, "format")? {
            "binary" => base64(node.text().unwrap_or_default().as_bytes()).map_err(fault)?,
            "appended" => {
                let offset = offset(node)?;
                let Some(Appended { bytes, base64: text, offsets }) = &self.appended else {
                    let error = VtuError::NoElement { element: "AppendedData", within: "VTKFile".into() };
                    return Err((at, error));
                };
                // What is text ends where the next array begins; the rest says itself how long it is.
                let next = offsets.iter().find(|&&next| next > offset).copied().filter(|_| *text);
                let range: Range<usize> = offset..next.unwrap_or(bytes.len()).min(bytes.len());
                let Some(part) = bytes.get(range) else {
                    let why = format!("offset {offset} is beyond the {} bytes of the data", bytes.len());
                    return Err(fault(Trouble::Wrong(why)));
                };
                match text {
                    true => base64(part).map_err(fault)?,
                    false => return self.packing.unpack(part).map_err(fault),
                }
            }
            other => {
                let known = "ascii, binary, appended";
                return Err((at, VtuError::Attribute { attribute: "format", found: excerpt(other), known }));
            }
        };
        self.packing.unpack(&packed).map_err(fault)
    }
}

/// Where in the appended data an array begins.
pub(super) fn offset(node: Node<'_, '_>) -> Result<usize, Fault> {
    let text = attribute(node, "offset")?;
    text.trim().parse().map_err(|_| {
        let found = excerpt(text);
        (node.range().start, VtuError::Attribute { attribute: "offset", found, known: "a number of bytes" })
    })
}

fn number(node: Node<'_, '_>) -> Result<Number, Fault> {
    let word = attribute(node, "type")?;
    let found = NUMBERS.iter().find(|(known, _)| *known == word);
    found.map(|(_, number)| *number).ok_or_else(|| {
        let error = VtuError::Attribute { attribute: "type", found: excerpt(word), known: NUMBER_NAMES };
        (node.range().start, error)
    })
}

/// Text and its place, of an array of text.
fn ascii<'a>(node: Node<'a, '_>) -> Result<Option<(usize, &'a str)>, Fault> {
    if attribute(node, "format")? != "ascii" {
        return Ok(None);
    }
    let text = node.children().find(Node::is_text);
    Ok(Some(text.map_or((node.range().end, ""), |t| (t.range().start, t.text().unwrap_or_default()))))
}

fn words<T>(
    node: Node<'_, '_>,
    start: usize,
    text: &str,
    number: Number,
    read: impl Fn(&str) -> Option<T>,
) -> Result<Vec<T>, Fault> {
    let words = text.split_ascii_whitespace().map(|word| {
        read(word).ok_or_else(|| {
            let place = start + (word.as_ptr() as usize).saturating_sub(text.as_ptr() as usize);
            (place, VtuError::Number { array: name(node), found: excerpt(word), number: number.name() })
        })
    });
    words.collect()
}

impl Number {
    fn name(self) -> &'static str {
        NUMBERS.iter().find(|(_, number)| *number as u8 == self as u8).map_or("number", |(name, _)| name)
    }

    fn size(self) -> usize {
        match self {
            Self::F64 | Self::I64 | Self::U64 => 8,
            Self::F32 | Self::I32 | Self::U32 => 4,
            Self::I16 | Self::U16 => 2,
            Self::I8 | Self::U8 => 1,
        }
    }

    fn float(self, bytes: [u8; 8]) -> Option<f64> {
        let [a, b, c, d, ..] = bytes;
        match self {
            Self::F64 => Some(f64::from_le_bytes(bytes)),
            Self::F32 => Some(f32::from_le_bytes([a, b, c, d]).into()),
            _ => self.integer(bytes).map(|integer| integer as f64),
        }
    }

    fn integer(self, bytes: [u8; 8]) -> Option<i64> {
        let [a, b, c, d, ..] = bytes;
        match self {
            Self::F64 | Self::F32 => None,
            Self::I64 => Some(i64::from_le_bytes(bytes)),
            Self::U64 => i64::try_from(u64::from_le_bytes(bytes)).ok(),
            Self::I32 => Some(i32::from_le_bytes([a, b, c, d]).into()),
            Self::U32 => Some(u32::from_le_bytes([a, b, c, d]).into()),
            Self::I16 => Some(i16::from_le_bytes([a, b]).into()),
            Self::U16 => Some(u16::from_le_bytes([a, b]).into()),
            Self::I8 => Some(i8::from_le_bytes([a]).into()),
            Self::U8 => Some(a.into()),
        }
    }
}
