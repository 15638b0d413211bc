//! The C interface of gnomon, call by call. The crate `gnomon` is the safe layer over it.
//!
//! [`gnomon_make_plan`] and [`gnomon_plan`] are the first things to read. Results live in the caller's memory, and structs
//! that begin with `size` are filled in by the call `..._default`.
#![no_std]
#![allow(non_camel_case_types)]

#[cfg(any(
    target_arch = "aarch64",
    target_arch = "arm",
    target_arch = "powerpc64",
    target_arch = "riscv64",
    target_arch = "s390x"
))]
#[cfg(not(any(target_vendor = "apple", windows)))]
pub type c_char = u8;
#[cfg(not(all(
    any(
        target_arch = "aarch64",
        target_arch = "arm",
        target_arch = "powerpc64",
        target_arch = "riscv64",
        target_arch = "s390x"
    ),
    not(any(target_vendor = "apple", windows))
)))]
pub type c_char = i8;

include!("header.rs");

#[cfg(test)]
mod tests {
    extern crate std;

    #[test]
    #[cfg(target_pointer_width = "64")]
    fn fields_lie_where_the_compiler_of_c_puts_them() {
        let mut checked = 0;
        macro_rules! check {
            ($name:ident, $size:expr, $($field:ident: $offset:expr),*) => {
                assert_eq!(core::mem::size_of::<super::$name>(), $size, stringify!($name));
                let one = core::mem::MaybeUninit::<super::$name>::uninit();
                $(
                    let field = unsafe { core::ptr::addr_of!((*one.as_ptr()).$field) };
                    assert_eq!(field as usize - one.as_ptr() as usize, $offset, "{}.{}", stringify!($name), stringify!($field));
                    checked += 1;
                )*
            };
        }
        each_layout!(check);
        assert!(checked > 250);
    }

    #[test]
    fn the_library_has_the_version_of_the_crate() {
        let text = unsafe { std::ffi::CStr::from_ptr(super::gnomon_version() as *const _) };
        assert_eq!(text.to_str(), Ok(env!("CARGO_PKG_VERSION")));
    }
}
