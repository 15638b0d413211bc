//! Where the maps of a plan lie in one texture.
use core::fmt;
use core::mem::MaybeUninit;
use core::ptr::null;

use crate::error::{check, Result};
use crate::sys::*;
use crate::{ClipSpace, Plan, TexelRect};

/// Maps in one texture; no two share a texel.
///
/// ```
/// # use gnomon::{Camera, Light, PlanOptions, Scene, View};
/// # let camera = Camera::at([0.0, 3.0, 0.0], [0.0, 0.0, -1.0]).perspective(1.0, 1.5, 0.1, 250.0, 960, 640)?;
/// # let boxes = [[-40.0, -1.0, -90.0, 40.0, 0.0, 0.0], [0.0, 1.0, -9.0, 1.0, 6.0, -8.0]];
/// # let scene = Scene { casters: (&boxes).into(), receivers: (&boxes).into() };
/// # let plan = gnomon::plan(&View::new(&camera), &Light::directional([0.3, -1.0, 0.0]), scene, &PlanOptions::default(), None)?;
/// let atlas = plan.pack_atlas(0, 0)?;
/// for (map, place) in atlas.places().iter().enumerate() {
///     let atlas_from_clip = atlas.atlas_from_clip(&plan.clip_space(), map)?;
///     // Draw the map with its place as the viewport, and look it up by the matrix.
///     # assert!(place.width > 0 && atlas_from_clip[0] > 0.0);
/// }
/// # Ok::<(), gnomon::Error>(())
/// ```
#[derive(Clone, Copy)]
pub struct Atlas(gnomon_atlas);

impl Plan {
    /// Places the maps into a texture of `width` times `height` texels. Both 0: into the smallest one whose sides are powers of
    /// two, which any plan fits into. The same sizes give the same places.
    pub fn pack_atlas(&self, width: i32, height: i32) -> Result<Atlas> {
        Atlas::filled(|atlas, field| unsafe { gnomon_pack_atlas(&self.to_c(), width, height, atlas, field) })
    }
}

impl Atlas {
    /// Of a call that writes it.
    pub(crate) fn filled(call: impl FnOnce(*mut gnomon_atlas, *mut *const c_char) -> i32) -> Result<Self> {
        let (mut atlas, mut field) = (MaybeUninit::<gnomon_atlas>::zeroed(), null());
        check(call(atlas.as_mut_ptr(), &mut field), field).map(|_| Self(unsafe { atlas.assume_init() }))
    }

    /// Width and height, texels; zeros: there is no map, or the maps do not fit.
    pub fn size(&self) -> [i32; 2] {
        [self.0.width, self.0.height]
    }
    /// The place of each map: of all, or of none where they do not fit.
    pub fn places(&self) -> &[TexelRect] {
        &self.0.place[..self.0.count as usize]
    }
    /// Texels of the maps over those of the texture, 0..1.
    pub fn efficiency(&self) -> f64 {
        self.0.efficiency
    }
    /// From the clip space of a map to its part of the atlas. x and y are 0..1 over the whole texture, z is the depth in 0..1.
    pub fn atlas_from_clip(&self, clip_space: &ClipSpace, map: usize) -> Result<[f64; 16]> {
        let (mut matrix, mut field) = ([0.0; 16], null());
        let map = i32::try_from(map).unwrap_or(-1);
        let status = unsafe { gnomon_atlas_from_clip(&self.0, clip_space, map, matrix.as_mut_ptr(), &mut field) };
        check(status, field).map(|_| matrix)
    }
}

impl fmt::Debug for Atlas {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Atlas").field("size", &self.size()).field("places", &self.places()).finish()
    }
}
