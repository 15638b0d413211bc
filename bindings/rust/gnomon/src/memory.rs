//! Memory of the caller's that calls work in and leave results in.
use crate::error::{Error, Result};

/// Sixteen bytes, aligned as calls ask for: `vec![MemoryBlock::default(); count]`. Keep them from frame to frame.
#[derive(Clone, Copy, Debug, Default)]
#[repr(align(16))]
pub struct MemoryBlock(
    /// What the library left there.
    pub [u8; 16],
);

impl MemoryBlock {
    /// Blocks that hold so many bytes, of which 0 says that a number was out of range.
    pub(crate) fn holding(bytes: i64, field: &'static str) -> Result<usize> {
        if bytes > 0 {
            Ok((bytes as usize + 15) / 16)
        } else {
            Err(Error::new(field))
        }
    }
}

/// A count for a call of C.
pub(crate) fn count(of: usize) -> i64 {
    i64::try_from(of).unwrap_or(-1)
}
