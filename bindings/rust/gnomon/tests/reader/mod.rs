//! A file of c_dump_cases or c_dump_frames, read as the plain numbers and structs of C that it holds.
use std::mem::size_of;

pub struct Reader<'a>(pub &'a [u8]);

impl Reader<'_> {
    /// Plain numbers of C, for which any bytes will do.
    pub fn take<T: Copy>(&mut self) -> T {
        let (one, rest) = self.0.split_at(size_of::<T>());
        self.0 = rest;
        unsafe { std::ptr::read_unaligned(one.as_ptr().cast()) }
    }
    pub fn some<T: Copy>(&mut self, count: usize) -> Vec<T> {
        (0..count).map(|_| self.take()).collect()
    }
    pub fn count(&mut self) -> usize {
        self.take::<u32>() as usize
    }
}

pub fn bytes<T>(of: &T) -> &[u8] {
    unsafe { std::slice::from_raw_parts((of as *const T).cast(), size_of::<T>()) }
}
