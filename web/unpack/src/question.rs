//! A question is a packed file, its answer the file.

use lzma_rust2::{LzmaReader, Read as _, Result};

/// The engine, of a file of `xz --format=lzma`; nothing where it is no such
/// file.
pub fn answered(packed: &[u8]) -> Vec<u8> {
    unpacked(packed).unwrap_or_default()
}

fn unpacked(packed: &[u8]) -> Result<Vec<u8>> {
    let mut reader = LzmaReader::new_mem_limit(packed, u32::MAX, None)?;
    let (mut whole, mut part) = (Vec::new(), [0; 4096]);
    loop {
        let length = reader.read(&mut part)?;
        whole.extend_from_slice(&part[..length]);
        if length == 0 {
            return Ok(whole);
        }
    }
}
