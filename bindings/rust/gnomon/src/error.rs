//! What a call refuses, by name.
use core::fmt;

use crate::sys::{c_char, GNOMON_INVALID_INPUT, GNOMON_OUT_OF_MEMORY};

/// What a call could not use, or that there was no memory.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Error {
    field: &'static str,
    why: &'static str,
}
/// What fallible calls return.
pub type Result<T> = core::result::Result<T, Error>;

impl Error {
    pub(crate) fn new(field: &'static str) -> Self {
        Self { field, why: "" }
    }
    pub(crate) fn because(mut self, why: *const c_char) -> Self {
        self.why = text(why);
        self
    }

    /// The struct and its field, such as `camera.far_depth`, or the parameter; `memory` where there was none.
    pub fn field(&self) -> &'static str {
        self.field
    }
    /// One sentence about it, or "".
    pub fn why(&self) -> &'static str {
        self.why
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "not usable: {}", self.field)?;
        if self.why.is_empty() {
            Ok(())
        } else {
            write!(f, ": {}", self.why)
        }
    }
}
#[cfg(feature = "std")]
impl std::error::Error for Error {}

/// The status of a call, or what it refused.
pub(crate) fn check(status: i32, field: *const c_char) -> Result<i32> {
    match status {
        GNOMON_INVALID_INPUT => Err(Error::new(text(field))),
        GNOMON_OUT_OF_MEMORY => Err(Error::new("memory")),
        _ => Ok(status),
    }
}

/// A static text of the library, zero-terminated; "" for none.
pub(crate) fn text(from: *const c_char) -> &'static str {
    if from.is_null() {
        return "";
    }
    let mut length = 0;
    unsafe {
        while *from.add(length) != 0 {
            length += 1;
        }
        core::str::from_utf8(core::slice::from_raw_parts(from.cast(), length)).unwrap_or("")
    }
}
