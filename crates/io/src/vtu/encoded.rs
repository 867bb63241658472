//! Binary data: base64, and blocks compressed by zlib, each with VTK's header of lengths.

use std::io::Read;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use flate2::read::ZlibDecoder;

use crate::MAX_FILE_BYTES;

/// Why data cannot be unpacked.
pub(super) enum Trouble {
    /// In words.
    Wrong(String),
    /// More than [`MAX_FILE_BYTES`].
    TooLong,
}

/// How a file packs its binary data.
#[derive(Clone, Copy, Debug)]
pub(super) struct Packing {
    /// Whether lengths and numbers have their most significant byte first.
    pub(super) big_endian: bool,
    /// Whether lengths have eight bytes, not four.
    pub(super) long_lengths: bool,
    /// Whether blocks are compressed.
    pub(super) compressed: bool,
}

/// Bytes of base64 text. Parts that are padded on their own, as the header is in front of compressed blocks, follow each
/// other.
pub(super) fn base64(text: &[u8]) -> Result<Vec<u8>, Trouble> {
    let text: Vec<u8> = text.iter().copied().filter(|byte| !byte.is_ascii_whitespace()).collect();
    let mut bytes = Vec::with_capacity(text.len() / 4 * 3);
    let mut rest = &text[..];
    while !rest.is_empty() {
        let padding = rest.iter().position(|&byte| byte == b'=').unwrap_or(rest.len());
        let behind = rest[padding..].iter().position(|&byte| byte != b'=').unwrap_or(rest.len() - padding);
        let (part, after) = rest.split_at(padding + behind);
        STANDARD
            .decode_vec(part, &mut bytes)
            .map_err(|error| Trouble::Wrong(format!("no base64: {error}")))?;
        rest = after;
    }
    Ok(bytes)
}

impl Packing {
    /// The data behind its header; what follows them is not looked at.
    pub(super) fn unpack(self, bytes: &[u8]) -> Result<Vec<u8>, Trouble> {
        let mut rest = bytes;
        if !self.compressed {
            let length = self.length(&mut rest)?;
            return match rest.get(..length) {
                Some(data) => Ok(data.to_vec()),
                None => Err(truncated(length, rest.len())),
            };
        }
        let blocks = self.length(&mut rest)?;
        let (whole, last) = (self.length(&mut rest)?, self.length(&mut rest)?);
        let mut sizes = Vec::new();
        for _ in 0..blocks {
            sizes.push(self.length(&mut rest)?);
        }
        let mut data = Vec::new();
        for (block, size) in sizes.into_iter().enumerate() {
            let Some((packed, after)) = rest.split_at_checked(size) else {
                return Err(truncated(size, rest.len()));
            };
            rest = after;
            // A last block of 0 is a whole one.
            let expected = if block + 1 == blocks && last > 0 { last } else { whole };
            let before = data.len();
            let room = MAX_FILE_BYTES.saturating_sub(before as u64).saturating_add(1);
            let read = ZlibDecoder::new(packed).take(room).read_to_end(&mut data);
            read.map_err(|error| Trouble::Wrong(format!("block {block} is no zlib data: {error}")))?;
            if data.len() as u64 > MAX_FILE_BYTES {
                return Err(Trouble::TooLong);
            }
            let found = data.len() - before;
            if found != expected {
                return Err(Trouble::Wrong(format!(
                    "block {block} unpacks to {found} bytes, not {expected}"
                )));
            }
        }
        Ok(data)
    }

    /// A length, taken off the front.
    fn length(self, bytes: &mut &[u8]) -> Result<usize, Trouble> {
        let size = if self.long_lengths { 8 } else { 4 };
        let Some((length, rest)) = bytes.split_at_checked(size) else {
            return Err(truncated(size, bytes.len()));
        };
        *bytes = rest;
        let value = |value: u64, byte: &u8| value << 8 | u64::from(*byte);
        let value = match self.big_endian {
            true => length.iter().fold(0, value),
            false => length.iter().rev().fold(0, value),
        };
        usize::try_from(value).map_err(|_| Trouble::TooLong)
    }
}

fn truncated(needed: usize, left: usize) -> Trouble {
    Trouble::Wrong(format!("{needed} bytes are announced where {left} are left"))
}
