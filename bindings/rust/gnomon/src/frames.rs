//! What changes from frame to frame: jittered grids, suns that turn slowly, visible depths that are followed.
use core::mem::MaybeUninit;
use core::ptr::{null, null_mut, NonNull};

use crate::error::{check, Error, Result};
use crate::sys::*;
use crate::{Aabb, Plan, Point, View, VisibleDepths};

/// Frames after which [`jitter_texels`] repeats.
pub const JITTER_FRAMES: u32 = GNOMON_JITTER_FRAMES as u32;

/// Offset of the texel grid in a frame, x and y in (-0.5, 0.5) texels. Offsets are a lattice of 64 points, and any
/// [`JITTER_FRAMES`] frames in a row hold all of it.
///
/// ```
/// assert_eq!(gnomon::jitter_texels(3), gnomon::jitter_texels(3 + gnomon::JITTER_FRAMES));
/// ```
pub fn jitter_texels(frame: u32) -> [f64; 2] {
    let mut offset = [0.0; 2];
    unsafe { gnomon_jitter_texels(frame, offset.as_mut_ptr()) };
    offset
}

impl Plan {
    /// Moves the texel grid of every map by `offset` texels across the light, each clamped to half a texel. The maps serve the
    /// same points and casters. Add 0.5 to `PlanOptions::filter_texels` before planning, so that no kernel leaves its map. A
    /// refused offset moves nothing.
    pub fn jitter(&mut self, offset: [f64; 2]) -> Result<()> {
        self.change(|plan, field| unsafe { gnomon_jitter(plan, offset.as_ptr(), field) })
    }
}

/// The decision of [`hold_sun`].
pub type HeldSun = gnomon_held_sun;

/// Keeps the direction of a sun that turns until a shadow edge could lie more than `most_pixels` from its true place, then
/// takes the sun's own. `view`: with points; without, the sun is not held. `held`: the direction of the last frame, zeros
/// before the first. `casters`: one box round all casters. `most_pixels`: at least 0, which never holds; 0.25 is below what a
/// texel of m = 1 can show. `least_light_sine`: sine of the angle between light and surface below which points are not
/// evaluated, 0..1; 0.05 suits most scenes.
///
/// ```
/// use gnomon::{hold_sun, Camera, View};
/// let camera = Camera::at([0.0, 3.0, 0.0], [0.0, 0.0, -1.0]);
/// let ground: Vec<[f64; 3]> = (5..40).map(|z| [0.0, 0.0, -f64::from(z)]).collect();
/// let (view, casters) = (View { points: &ground, ..View::new(&camera) }, [-40.0, -1.0, -90.0, 40.0, 6.0, 0.0]);
/// let first = hold_sun(&view, [0.0; 3], [0.3, -1.0, 0.0], &casters, 0.25, 0.05)?;
/// let next = hold_sun(&view, first.direction, [0.3 + 1e-6, -1.0, 0.0], &casters, 0.25, 0.05)?;
/// assert_eq!(next.direction, first.direction);
/// # Ok::<(), gnomon::Error>(())
/// ```
pub fn hold_sun(
    view: &View<'_>,
    held: Point,
    sun: Point,
    casters: &Aabb,
    most_pixels: f64,
    least_light_sine: f64,
) -> Result<HeldSun> {
    let (mut result, mut field) = (MaybeUninit::<HeldSun>::zeroed(), null());
    let camera = view.camera.to_c();
    let status = unsafe {
        gnomon_hold_sun(
            &view.to_c(&camera)?,
            held.as_ptr(),
            sun.as_ptr(),
            casters.as_ptr(),
            most_pixels,
            least_light_sine,
            result.as_mut_ptr(),
            &mut field,
        )
    };
    check(status, field).map(|_| unsafe { result.assume_init() })
}

/// Visible depths that are followed from frame to frame. Depths that come into view count at once, and those that leave it are
/// given up slowly. Keep one per camera.
///
/// ```
/// use gnomon::{DepthTracker, VisibleDepths};
/// let mut tracker = DepthTracker::new(4, 30)?;
/// let mut seen = VisibleDepths::default();
/// seen.add(&[4.0, 80.0]);
/// assert!(tracker.update(&seen).range().1 > 80.0);
/// # Ok::<(), gnomon::Error>(())
/// ```
#[derive(Debug)]
pub struct DepthTracker(NonNull<gnomon_depth_tracker>);

unsafe impl Send for DepthTracker {}
unsafe impl Sync for DepthTracker {}

impl DepthTracker {
    /// A new, empty tracker. `frames_per_bin`: frames that the nearest and the farthest depth take to move inwards by one bin; 4
    /// suits most scenes. `hold_frames`: frames for which a depth between them that shows nothing any more still counts; 30 does.
    /// Both 1..65535.
    pub fn new(frames_per_bin: i32, hold_frames: i32) -> Result<Self> {
        for (frames, field) in [(frames_per_bin, "frames_per_bin"), (hold_frames, "hold_frames")] {
            if !(1..=65535).contains(&frames) {
                return Err(Error::new(field));
            }
        }
        NonNull::new(unsafe { gnomon_depth_tracker_create(frames_per_bin, hold_frames) })
            .map(Self)
            .ok_or(Error::new("memory"))
    }
    /// Takes the visible depths of the next frame, and returns those to plan with. A frame that shows nothing changes nothing.
    pub fn update(&mut self, frame: &VisibleDepths) -> VisibleDepths {
        let mut depths = frame.clone();
        unsafe { gnomon_depth_tracker_update(self.0.as_ptr(), &frame.0, &mut depths.0, null_mut()) };
        depths
    }
    /// Forgets all frames: call it at a cut.
    pub fn clear(&mut self) {
        unsafe { gnomon_depth_tracker_clear(self.0.as_ptr()) }
    }
}
impl Drop for DepthTracker {
    fn drop(&mut self) {
        unsafe { gnomon_depth_tracker_destroy(self.0.as_ptr()) }
    }
}
