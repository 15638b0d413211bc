//! What owns memory of the library.
use core::ptr::{null, null_mut, NonNull};

use crate::error::{check, Error, Result};
use crate::sys::*;
use crate::Aabb;

/// Boxes sorted into a tree, for scenes with hundreds and more. Gives the same plans as their list, bit for bit.
#[derive(Debug)]
pub struct CasterSet(NonNull<gnomon_caster_set>);

// No call of C has global state, and those that take a set by const only read it.
unsafe impl Send for CasterSet {}
unsafe impl Sync for CasterSet {}

impl CasterSet {
    /// Sorts boxes into a new set, which owns a copy: about 75 bytes a box.
    pub fn new(boxes: &[Aabb]) -> Result<Self> {
        let (mut set, mut field) = (null_mut(), null());
        let status =
            unsafe { gnomon_caster_set_create(boxes.as_ptr().cast(), boxes.len() as i64, &mut set, &mut field) };
        check(status, field)?;
        NonNull::new(set).map(Self).ok_or(Error::new("memory"))
    }
    /// Boxes in the set, empty ones included.
    pub fn len(&self) -> usize {
        unsafe { gnomon_caster_set_count(self.0.as_ptr()) as usize }
    }
    /// Whether it has none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
    /// Takes new bounds for all boxes, in their first order. Fast while neighbours stay neighbours.
    pub fn refit(&mut self, boxes: &[Aabb]) -> Result<()> {
        let mut field = null();
        let status =
            unsafe { gnomon_caster_set_refit(self.0.as_ptr(), boxes.as_ptr().cast(), boxes.len() as i64, &mut field) };
        check(status, field).map(|_| ())
    }
    /// Takes new bounds for one box.
    pub fn update(&mut self, index: usize, bounds: &Aabb) -> Result<()> {
        let mut field = null();
        let index = i64::try_from(index).unwrap_or(-1);
        let status = unsafe { gnomon_caster_set_update(self.0.as_ptr(), index, bounds.as_ptr(), &mut field) };
        check(status, field).map(|_| ())
    }
    pub(crate) fn as_ptr(&self) -> *const gnomon_caster_set {
        self.0.as_ptr()
    }
}
impl Drop for CasterSet {
    fn drop(&mut self) {
        unsafe { gnomon_caster_set_destroy(self.0.as_ptr()) }
    }
}

/// State that plans carry from frame to frame: about 30 kB. Keep one per camera and light.
#[derive(Debug)]
pub struct History(NonNull<gnomon_history>);

unsafe impl Send for History {}
unsafe impl Sync for History {}

impl History {
    /// A new, empty history.
    pub fn new() -> Result<Self> {
        NonNull::new(unsafe { gnomon_history_create() }).map(Self).ok_or(Error::new("memory"))
    }
    /// Forgets all frames: call it at a cut.
    pub fn clear(&mut self) {
        unsafe { gnomon_history_clear(self.0.as_ptr()) }
    }
    /// Becomes equal to another, to try a frame twice.
    pub fn copy_from(&mut self, other: &History) {
        unsafe { gnomon_history_copy(other.0.as_ptr(), self.0.as_ptr()) }
    }
    pub(crate) fn as_mut_ptr(&mut self) -> *mut gnomon_history {
        self.0.as_ptr()
    }
}
impl Drop for History {
    fn drop(&mut self) {
        unsafe { gnomon_history_destroy(self.0.as_ptr()) }
    }
}
