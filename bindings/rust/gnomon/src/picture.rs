//! How many pixels of a picture a plan will get wrong, before anything is drawn.
use core::ffi::c_void;
use core::fmt;
use core::mem::{size_of, MaybeUninit};
use core::ptr::null;
#[cfg(feature = "std")]
use std::{any::Any, cell::Cell};

use crate::error::{check, Result};
use crate::sys::*;
use crate::{Camera, Error, Plan, Point};

/// A shadow as a camera sees it: of other maps, of the last frame, or of rays.
#[derive(Clone, Copy)]
pub struct ShadowPicture<'a> {
    /// Its width and height are those of both pictures.
    pub camera: &'a Camera,
    /// A number for each pixel, rows from top to bottom: 1 lit .. 0 in shadow. Not counted: negative numbers, numbers above 1, not
    /// a number.
    pub mask: &'a [f32],
    /// View depths of the surfaces, as many, world units. No surface: 0, less, infinity, not a number.
    pub view_depths: &'a [f32],
    /// For each dark pixel the distance along the light from the surface to the occluder nearest the light, world units. A bias
    /// that is longer lights the surface. Negative, not a number: not known there. Empty: not known, and errors of the bias do not
    /// count. Not read beside `occluders`.
    pub occluder_distances: &'a [f32],
    /// Searches what casts shadows in the picture's light, by rays: the distance along the light from a point, world space, to the
    /// occluder nearest the light, world units. Negative where that lies beyond the point, -infinity where there is none. With it
    /// errors are those of the maps' own comparisons. A panic in it comes out of the call; without the feature `std` it aborts.
    /// `None`: each pixel takes the shadow at the middle of its texel.
    pub occluders: Option<&'a dyn Fn(Point) -> f64>,
    /// Beside `occluders`: normals of the surfaces, unit, towards the viewer, one for each pixel. Zero there, and empty: from
    /// `view_depths`.
    pub normals: &'a [[f32; 3]],
}

impl fmt::Debug for ShadowPicture<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("ShadowPicture")
            .field("camera", self.camera)
            .field("pixels", &self.mask.len())
            .field("occluders", &self.occluders.is_some())
            .finish()
    }
}

/// The pixels that a plan will get wrong.
pub type WrongPixels = gnomon_wrong_pixels;

/// Occluders during a call. No panic may unwind through the library.
struct Search<'a> {
    occluders: &'a dyn Fn(Point) -> f64,
    #[cfg(feature = "std")]
    panic: Cell<Option<Box<dyn Any + Send>>>,
}

#[cfg(feature = "std")]
impl<'a> Search<'a> {
    fn new(occluders: &'a dyn Fn(Point) -> f64) -> Self {
        Self { occluders, panic: Cell::new(None) }
    }
    /// After a panic it finds nothing, and the call soon returns.
    fn distance(&self, point: Point) -> f64 {
        let panicked = self.panic.take();
        if panicked.is_some() {
            self.panic.set(panicked);
            return f64::NEG_INFINITY;
        }
        // The closure is not called again.
        match std::panic::catch_unwind(std::panic::AssertUnwindSafe(|| (self.occluders)(point))) {
            Ok(distance) => distance,
            Err(payload) => {
                self.panic.set(Some(payload));
                f64::NEG_INFINITY
            }
        }
    }
    fn finish(self) {
        if let Some(payload) = self.panic.into_inner() {
            std::panic::resume_unwind(payload);
        }
    }
}

#[cfg(not(feature = "std"))]
impl<'a> Search<'a> {
    fn new(occluders: &'a dyn Fn(Point) -> f64) -> Self {
        Self { occluders }
    }
    fn distance(&self, point: Point) -> f64 {
        /// A second panic while the first unwinds aborts: before Rust 1.81, leaving extern "C" was undefined behaviour.
        struct Abort;
        impl Drop for Abort {
            fn drop(&mut self) {
                panic!("occluders panicked");
            }
        }
        let abort = Abort;
        let distance = (self.occluders)(point);
        core::mem::forget(abort);
        distance
    }
    fn finish(self) {}
}

/// `scene`: a [`Search`].
unsafe extern "C" fn search(scene: *const c_void, point: *const f64) -> f64 {
    (*scene.cast::<Search<'_>>()).distance(*point.cast::<Point>())
}

impl<'a> ShadowPicture<'a> {
    /// A picture of whose occluders and normals nothing is known.
    pub fn new(camera: &'a Camera, mask: &'a [f32], view_depths: &'a [f32]) -> Self {
        Self { camera, mask, view_depths, occluder_distances: &[], occluders: None, normals: &[] }
    }

    /// `camera`: of `to_c`, to live as long as the result.
    fn to_c(self, camera: &gnomon_camera) -> Result<gnomon_shadow_picture> {
        let mut picture = MaybeUninit::<gnomon_shadow_picture>::uninit();
        let status =
            unsafe { gnomon_shadow_picture_default(picture.as_mut_ptr(), size_of::<gnomon_shadow_picture>() as u32) };
        assert_eq!(status, GNOMON_OK, "the library is older than this crate");
        if self.view_depths.len() != self.mask.len() {
            return Err(Error::new("shadow_picture.view_depths"));
        }
        if !self.occluder_distances.is_empty() && self.occluder_distances.len() != self.mask.len() {
            return Err(Error::new("shadow_picture.occluder_distances"));
        }
        if !self.normals.is_empty() && self.normals.len() != self.mask.len() {
            return Err(Error::new("shadow_picture.normals"));
        }
        let mut picture = unsafe { picture.assume_init() };
        picture.camera = camera;
        picture.mask = self.mask.as_ptr();
        picture.view_depths = self.view_depths.as_ptr();
        picture.pixel_count = self.mask.len() as i64;
        if !self.occluder_distances.is_empty() {
            picture.occluder_distances = self.occluder_distances.as_ptr();
        }
        if !self.normals.is_empty() {
            picture.normals = self.normals.as_ptr().cast();
        }
        Ok(picture)
    }

    /// Counts by a call of C.
    pub(crate) fn expect(
        self,
        kernel_texels: f64,
        call: impl FnOnce(*const gnomon_shadow_picture, *mut WrongPixels, *mut *const c_char) -> i32,
    ) -> Result<WrongPixels> {
        let (camera, mut field) = (self.camera.to_c(), null());
        let mut picture = self.to_c(&camera)?;
        picture.kernel_texels = kernel_texels;
        let searched = self.occluders.map(Search::new);
        if let Some(scene) = &searched {
            picture.occluder_search = Some(search);
            picture.occluder_scene = (scene as *const Search<'_>).cast();
        }
        let mut pixels = WrongPixels { wrong: 0.0, counted: 0.0, share: 0.0 };
        let status = call(&picture, &mut pixels, &mut field);
        if let Some(scene) = searched {
            scene.finish();
        }
        check(status, field).map(|_| pixels)
    }

    /// Writes points of the surfaces along the shadow's edges, world space, evenly over the picture: as many as `points` has room
    /// for. Returns how many. A plan for them ([`View::points`](crate::View::points)) has its texels where they show.
    pub fn edge_points(self, points: &mut [Point]) -> Result<usize> {
        let (camera, mut written, mut field) = (self.camera.to_c(), 0, null());
        let picture = self.to_c(&camera)?;
        let status = unsafe {
            gnomon_shadow_edge_points(
                &picture,
                points.as_mut_ptr().cast(),
                points.len() as i64,
                &mut written,
                &mut field,
            )
        };
        check(status, field).map(|_| written as usize)
    }
}

/// Counts the pixels that comparisons in the plan's maps will misclassify, without drawing them; also of foreign maps
/// ([`Plan::foreign`]), and in pages by [`PagePlan::expected_error`](crate::PagePlan::expected_error).
/// `kernel_texels`: half side of the box of texels whose comparisons a filter averages; 0: one texel, hard comparison.
///
/// ```
/// use gnomon::{expected_error, Camera, Light, PlanOptions, Scene, ShadowPicture, View};
/// let mut camera = Camera::at([0.0, 10.0, 0.0], [0.0, -1.0, 0.0]).orthographic(10.0, 1.0, 0.1, 20.0, 64, 64)?;
/// camera.up = [0.0, 0.0, -1.0];
/// let mask: Vec<f32> = (0..64 * 64).map(|pixel| f32::from(u8::from(pixel % 64 < 26))).collect();
/// let roof = |point: [f64; 3]| if point[0] > -1.0 { 2.0 - point[1] } else { f64::NEG_INFINITY };
/// let picture = ShadowPicture { occluders: Some(&roof), ..ShadowPicture::new(&camera, &mask, &[10.0; 64 * 64]) };
/// let boxes = [[-9.0, -1.0, -9.0, 9.0, 0.0, 9.0], [-1.0, 1.0, -9.0, 9.0, 2.0, 9.0]];
/// let scene = Scene { casters: (&boxes).into(), receivers: (&boxes).into() };
/// let share = |size| {
///     let mut options = PlanOptions::default();
///     (options.cascades, options.resolution_max_size) = (1, size);
///     let plan = gnomon::plan(&View::new(&camera), &Light::directional([0.0, -1.0, 0.0]), scene, &options, None)?;
///     expected_error(&plan, picture, 0.0).map(|pixels| pixels.share)
/// };
/// assert!(share(256)? == 0.0 && share(8)? > 0.05);
/// # Ok::<(), gnomon::Error>(())
/// ```
pub fn expected_error(plan: &Plan, picture: ShadowPicture<'_>, kernel_texels: f64) -> Result<WrongPixels> {
    let plan = plan.to_c();
    picture
        .expect(kernel_texels, |picture, pixels, field| unsafe { gnomon_expected_error(&plan, picture, pixels, field) })
}
