//! How many pixels of a picture a plan will get wrong, before anything is drawn.
use core::mem::{size_of, MaybeUninit};
use core::ptr::null;

use crate::error::{check, Result};
use crate::sys::*;
use crate::{Camera, Plan, Point};

/// A shadow as a camera sees it: of other maps, of the last frame, or of rays.
#[derive(Clone, Copy, Debug)]
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
    /// count.
    pub occluder_distances: &'a [f32],
}

/// The pixels that a plan will get wrong.
pub type WrongPixels = gnomon_wrong_pixels;

impl ShadowPicture<'_> {
    /// `camera`: of `to_c`, to live as long as the result.
    fn to_c(self, camera: &gnomon_camera) -> Result<gnomon_shadow_picture> {
        let mut picture = MaybeUninit::<gnomon_shadow_picture>::uninit();
        let status =
            unsafe { gnomon_shadow_picture_default(picture.as_mut_ptr(), size_of::<gnomon_shadow_picture>() as u32) };
        assert_eq!(status, GNOMON_OK, "the library is older than this crate");
        if self.view_depths.len() != self.mask.len() {
            return Err(crate::Error::new("shadow_picture.view_depths"));
        }
        if !self.occluder_distances.is_empty() && self.occluder_distances.len() != self.mask.len() {
            return Err(crate::Error::new("shadow_picture.occluder_distances"));
        }
        let mut picture = unsafe { picture.assume_init() };
        picture.camera = camera;
        picture.mask = self.mask.as_ptr();
        picture.view_depths = self.view_depths.as_ptr();
        picture.pixel_count = self.mask.len() as i64;
        if !self.occluder_distances.is_empty() {
            picture.occluder_distances = self.occluder_distances.as_ptr();
        }
        Ok(picture)
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
/// ([`Plan::foreign`]). Each pixel takes the shadow at the middle of its texel.
/// `kernel_texels`: half side of the box of texels whose comparisons a filter averages; 0: one texel, hard comparison.
///
/// ```
/// use gnomon::{expected_error, Camera, Light, PlanOptions, Scene, ShadowPicture, View};
/// let camera = Camera::at([0.0, 10.0, 0.0], [0.0, -1.0, 0.0]).orthographic(10.0, 1.0, 0.1, 20.0, 64, 64)?;
/// let mask: Vec<f32> = (0..64 * 64).map(|pixel| f32::from(u8::from(pixel % 64 < 21))).collect();
/// let picture = ShadowPicture { camera: &camera, mask: &mask, view_depths: &[10.0; 64 * 64], occluder_distances: &[] };
/// let boxes = [[-9.0, -1.0, -9.0, 9.0, 0.0, 9.0], [-1.0, 1.0, -9.0, 9.0, 2.0, 9.0]];
/// let scene = Scene { casters: (&boxes).into(), receivers: (&boxes).into() };
/// let share = |size| {
///     let mut options = PlanOptions::default();
///     (options.cascades, options.resolution_max_size) = (1, size);
///     let plan = gnomon::plan(&View::new(&camera), &Light::directional([0.0, -1.0, 0.0]), scene, &options, None)?;
///     expected_error(&plan, picture, 0.0).map(|pixels| pixels.share)
/// };
/// assert!(share(256)? < share(8)?);
/// # Ok::<(), gnomon::Error>(())
/// ```
pub fn expected_error(plan: &Plan, picture: ShadowPicture<'_>, kernel_texels: f64) -> Result<WrongPixels> {
    let (camera, mut field) = (picture.camera.to_c(), null());
    let mut picture = picture.to_c(&camera)?;
    picture.kernel_texels = kernel_texels;
    let mut pixels = WrongPixels { wrong: 0.0, counted: 0.0, share: 0.0 };
    let status = unsafe { gnomon_expected_error(&plan.to_c(), &picture, &mut pixels, &mut field) };
    check(status, field).map(|_| pixels)
}
