//! Lists that names are looked up in.
use crate::error::{text, Error, Result};
use crate::sys::*;

/// A list of names. Fields of options hold an index into one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(i32)]
pub enum List {
    /// `PlanOptions::warp`, `Map::warp`
    Warps = GNOMON_WARPS,
    /// `PlanOptions::warp_shape`, `Map::shape`
    Shapes = GNOMON_SHAPES,
    /// `PlanOptions::fit`
    Fits = GNOMON_FITS,
    /// `PlanOptions::split_scheme`
    Splits = GNOMON_SPLITS,
    /// `PlanOptions::split_partition`
    Partitions = GNOMON_PARTITIONS,
    /// `PlanOptions::split_selection`
    Selections = GNOMON_SELECTIONS,
    /// `PlanOptions::warp_objective`
    Objectives = GNOMON_OBJECTIVES,
    /// Bits of `PlanOptions::prune`: that of an entry is `1 << index`
    PruneRules = GNOMON_PRUNE_RULES,
    /// `PageOptions::policy`
    PagePolicies = GNOMON_PAGE_POLICIES,
}

/// The index of a name. Names stay, indices may change between versions.
///
/// ```
/// use gnomon::List;
/// assert!(gnomon::find(List::Fits, "stable").is_ok());
/// assert_eq!(gnomon::find(List::Fits, "teapot").unwrap_err().field(), "name");
/// ```
pub fn find(list: List, name: &str) -> Result<i32> {
    names(list).position(|(one, _)| one == name).map(|index| index as i32).ok_or(Error::new("name"))
}

/// Each name of a list with one line about it.
pub fn names(list: List) -> impl Iterator<Item = (&'static str, &'static str)> {
    let list = list as i32;
    (0..unsafe { gnomon_count(list) })
        .map(move |i| unsafe { (text(gnomon_name(list, i)), text(gnomon_summary(list, i))) })
}

/// Version of the library as "major.minor.patch".
pub fn version() -> &'static str {
    text(unsafe { gnomon_version() })
}
