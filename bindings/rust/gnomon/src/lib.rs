//! Shadow maps, chosen by measurement.
//!
//! A camera, a light and the bounds of a scene become the shadow maps worth drawing, with their error in screen pixels per
//! texel. Lengths are in world units, angles in radians, and the world is right-handed unless a [`ClipSpace`] says otherwise.
//! Matrices are 16 numbers, column by column, and act on column vectors. A box is `[x, y, z, x, y, z]`: its least corner,
//! then its largest.
//!
//! ```
//! use gnomon::{Camera, Light, PlanOptions, Scene, View};
//!
//! let camera = Camera::at([0.0, 3.0, 10.0], [0.0, -0.1, -1.0]).perspective(1.0, 1.5, 0.1, 250.0, 960, 640)?;
//! let boxes = [[-40.0, -1.0, -200.0, 40.0, 0.0, 20.0], [-4.0, 0.0, -30.0, 4.0, 6.0, -26.0]];
//! let scene = Scene { casters: (&boxes).into(), receivers: (&boxes).into() };
//! let mut options = PlanOptions::default();
//! options.cascades = 2;
//! options.warp = gnomon::find(gnomon::List::Warps, "lispsm")?;
//!
//! let plan = gnomon::plan(&View::new(&camera), &Light::directional([0.4, -1.0, 0.3]), scene, &options, None)?;
//! for map in plan.maps() {
//!     // map.clip_from_camera_relative, map.cull_planes(), map.depth_begin .. map.depth_end, ...
//!     assert_eq!(map.width, 1024);
//! }
//! let error = gnomon::measure(&plan, &View::new(&camera), scene, &Default::default())?;
//! assert!(error.p95 < 10.0);
//! # Ok::<(), gnomon::Error>(())
//! ```
//!
//! [`Camera`], [`Light`], [`PlanOptions`], [`MeasureOptions`] and [`Map`] dereference to structs of [`sys`], whose fields carry
//! their unit, range and default. Any number may be put into any field: what a call cannot use, it refuses with the name of
//! the field.
//!
//! ```
//! # use gnomon::{Camera, Light, PlanOptions, Scene, View};
//! # let camera = Camera::default();
//! let mut options = PlanOptions::default();
//! options.cascades = 99;
//! let refused = gnomon::plan(&View::new(&camera), &Light::directional([0.0, -1.0, 0.0]), Scene::default(), &options, None);
//! assert_eq!(refused.unwrap_err().field(), "plan_options.cascades");
//! ```
#![cfg_attr(not(feature = "std"), no_std)]
#![deny(missing_docs)]

use core::mem::{size_of, MaybeUninit};
use core::ops::{Deref, DerefMut};
use core::ptr::{null, null_mut};

pub use gnomon_sys as sys;
use sys::*;

mod atlas;
mod clusters;
mod error;
mod frames;
#[cfg(feature = "glam")]
pub mod glam_types;
mod handle;
mod lights;
mod memory;
mod names;
mod pages;
mod picture;
mod plan;

pub use atlas::Atlas;
pub use clusters::{cluster_count, cluster_lights, cluster_memory, ClusterMemory, ClusterOptions, LightClusters};
pub use error::{Error, Result};
pub use frames::{hold_sun, jitter_texels, DepthTracker, HeldSun, JITTER_FRAMES};
pub use handle::{CasterSet, History};
pub use lights::{light_memory, plan_lights, LightHistory, LightMaps, LightOptions, LightPlan, LightRequest};
pub use memory::MemoryBlock;
pub use names::{find, names, version, List};
pub use pages::{
    page_memory, page_table_size, plan_pages, KeptPage, Page, PageHistory, PageOptions, PagePlan, PageSlot,
};
pub use picture::{expected_error, ShadowPicture, WrongPixels};
pub use plan::{plan, plan_views, BiasWay, EngineBias, Omission, Plan, Status};

use error::check;

/// A box: least x, y, z, then largest x, y, z. One whose least exceeds its largest takes no part in anything.
pub type Aabb = [f64; 6];
/// A point or a direction.
pub type Point = [f64; 3];
/// Clip space of matrices; all zero, the default here, is that of OpenGL.
pub type ClipSpace = gnomon_clip_space;
/// The OpenGL clip space.
pub const OPENGL: ClipSpace =
    ClipSpace { zero_to_one: 0, reversed_z: 0, y_down: 0, left_handed: 0, first_row_at_y_max: 0, reserved: 0 };
/// The error at one point.
pub type PointError = gnomon_point_error;
/// How to make a map from that of the last frame.
pub type Reuse = gnomon_reuse;
/// Texels of a map.
pub type TexelRect = gnomon_texel_rect;
/// Floats of a uniform block, for shaders/library/shadow_block.glsl.
pub type ShaderBlock = [f32; GNOMON_SHADER_BLOCK_FLOATS as usize];

macro_rules! sized {
    ($(#[$doc:meta])* $name:ident, $struct:ident, $default:ident) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug)]
        #[repr(transparent)]
        pub struct $name($struct);

        impl Default for $name {
            fn default() -> Self {
                let mut value = MaybeUninit::<$struct>::uninit();
                let status = unsafe { $default(value.as_mut_ptr(), size_of::<$struct>() as u32) };
                assert_eq!(status, GNOMON_OK, "the library is older than this crate");
                Self(unsafe { value.assume_init() })
            }
        }
        impl Deref for $name {
            type Target = $struct;
            fn deref(&self) -> &$struct {
                &self.0
            }
        }
        impl DerefMut for $name {
            fn deref_mut(&mut self) -> &mut $struct {
                &mut self.0
            }
        }
        impl $name {
            /// For a call. The library trusts `size`, which safe code can set.
            #[allow(dead_code)]
            fn to_c(&self) -> $struct {
                let mut value = self.0;
                value.size = size_of::<$struct>() as u32;
                value
            }
        }
    };
}
sized!(
    /// A viewing camera.
    Camera, gnomon_camera, gnomon_camera_default
);
sized!(
    /// A light that casts shadows.
    Light, gnomon_light, gnomon_light_default
);
sized!(
    /// Options of a plan. Every default suits most scenes.
    PlanOptions, gnomon_plan_options, gnomon_plan_options_default
);
sized!(
    /// How an error is sampled.
    MeasureOptions, gnomon_measure_options, gnomon_measure_options_default
);
sized!(
    /// One shadow map: what drawing, reading, culling and measuring it needs. For maps of one's own, set `clip_from_world`,
    /// `width`, `height` and the depths of a default one.
    Map, gnomon_map, gnomon_map_default
);
sized!(
    /// The aliasing error m, screen pixels per texel, over many points. Above 1, texels show.
    Stats, gnomon_stats, gnomon_stats_default
);

impl Camera {
    /// A camera at `position` that looks along `forward`, with y upwards.
    pub fn at(position: Point, forward: Point) -> Self {
        let mut camera = Self::default();
        camera.position = position;
        camera.forward = forward;
        camera
    }

    /// The same with a symmetric perspective. `fov_y`: full vertical angle, radians. `aspect`: width over height.
    pub fn perspective(self, fov_y: f64, aspect: f64, near: f64, far: f64, width: i32, height: i32) -> Result<Self> {
        let (mut camera, mut field) = (self.to_c(), null());
        let status = unsafe { gnomon_perspective(&mut camera, fov_y, aspect, near, far, width, height, &mut field) };
        check(status, field).map(|_| Self(camera))
    }

    /// The same with a parallel projection of `height_world` world units from bottom to top.
    pub fn orthographic(
        self,
        height_world: f64,
        aspect: f64,
        near: f64,
        far: f64,
        width: i32,
        height: i32,
    ) -> Result<Self> {
        let (mut camera, mut field) = (self.to_c(), null());
        let status =
            unsafe { gnomon_orthographic(&mut camera, height_world, aspect, near, far, width, height, &mut field) };
        check(status, field).map(|_| Self(camera))
    }

    /// The camera of an engine's own matrices. `clip_space` is that of `clip_from_view`. [`Error::why`] says what is wrong
    /// where there is no such camera.
    pub fn from_matrices(
        view_from_world: &[f64; 16],
        clip_from_view: &[f64; 16],
        clip_space: &ClipSpace,
        width: i32,
        height: i32,
    ) -> Result<Self> {
        let (mut camera, mut field, mut why) = (Self::default().0, null(), null());
        let status = unsafe {
            gnomon_camera_from(
                view_from_world.as_ptr(),
                clip_from_view.as_ptr(),
                clip_space,
                width,
                height,
                &mut camera,
                &mut why,
                &mut field,
            )
        };
        check(status, field).map(|_| Self(camera)).map_err(|error| error.because(why))
    }
}

impl Light {
    /// Parallel light that travels along `direction`.
    pub fn directional(direction: Point) -> Self {
        let mut light = Self::default();
        light.kind = GNOMON_DIRECTIONAL;
        light.direction = direction;
        light
    }

    /// A cone of light. `outer_radians`: its half angle. Nothing is lit beyond `range` world units.
    pub fn spot(position: Point, direction: Point, outer_radians: f64, range: f64) -> Self {
        let mut light = Self::point(position, range);
        light.kind = GNOMON_SPOT;
        light.direction = direction;
        light.outer_radians = outer_radians;
        light
    }

    /// Light into all directions, up to `range` world units.
    pub fn point(position: Point, range: f64) -> Self {
        let mut light = Self::default();
        light.kind = GNOMON_POINT;
        light.position = position;
        light.range = range;
        light
    }
}

impl Map {
    /// A caster counts if part of it lies where `dot(xyz, p) + w >= 0` for all of these planes.
    pub fn cull_planes(&self) -> &[[f64; 4]] {
        &self.0.cull_planes[..(self.cull_plane_count.max(0) as usize).min(self.0.cull_planes.len())]
    }

    /// The map serves a point only inside all of these planes.
    pub fn select_planes(&self) -> &[[f64; 4]] {
        &self.0.select_planes[..(self.select_plane_count.max(0) as usize).min(self.0.select_planes.len())]
    }

    /// Writes the indices of the casters that this map needs, and returns how many there are. No caster that can shadow a
    /// receiver of the map is missing, where `indices` has room for all.
    pub fn cull(&self, casters: Boxes<'_>, indices: &mut [u32]) -> Result<usize> {
        let (mut found, mut field) = (0, null());
        let (room, map) = (indices.len() as i64, self.to_c());
        let status = unsafe {
            match casters {
                Boxes::List(list) => gnomon_cull(
                    &map,
                    list.as_ptr().cast(),
                    list.len() as i64,
                    indices.as_mut_ptr(),
                    room,
                    &mut found,
                    &mut field,
                ),
                Boxes::Set(set) => {
                    gnomon_cull_set(&map, set.as_ptr(), indices.as_mut_ptr(), room, &mut found, &mut field)
                }
            }
        };
        check(status, field).map(|_| found as usize)
    }

    /// The same map with `clip_from_camera_relative` for an eye at `origin`: for one that was kept from an earlier frame.
    pub fn rebased(&self, origin: Point) -> Result<Map> {
        let (mut to, mut field) = (Self::default().0, null());
        let status = unsafe { gnomon_rebased(&self.to_c(), origin.as_ptr(), &mut to, &mut field) };
        check(status, field).map(|_| Map(to))
    }

    /// What this map can take from that of the last frame, where casters did not move. `clip_space`: of their plans.
    pub fn reuse(&self, previous: &Map, clip_space: &ClipSpace) -> Result<Reuse> {
        let (mut reuse, mut field) = (MaybeUninit::<Reuse>::zeroed(), null());
        let status =
            unsafe { gnomon_compare(&previous.to_c(), &self.to_c(), clip_space, reuse.as_mut_ptr(), &mut field) };
        check(status, field).map(|_| unsafe { reuse.assume_init() })
    }

    /// Measures at each point, world space; `errors` gets one for each. `normals`: unit, as many; `None`: the perspective part
    /// alone.
    pub fn measure_points(
        &self,
        camera: &Camera,
        points: &[Point],
        normals: Option<&[Point]>,
        errors: &mut [PointError],
    ) -> Result<()> {
        if normals.map_or(false, |n| n.len() != points.len()) {
            return Err(Error::new("normals"));
        }
        if errors.len() != points.len() {
            return Err(Error::new("errors"));
        }
        let mut field = null();
        let normals = normals.map_or(null(), |n| n.as_ptr().cast());
        let status = unsafe {
            gnomon_measure_points(
                &self.to_c(),
                &camera.to_c(),
                points.as_ptr().cast(),
                normals,
                points.len() as i64,
                errors.as_mut_ptr(),
                &mut field,
            )
        };
        check(status, field).map(|_| ())
    }
}

/// Boxes as a list or as a set. Both give the same plans; a set pays from hundreds of boxes on.
#[derive(Clone, Copy, Debug)]
pub enum Boxes<'a> {
    /// A list, read where it lies.
    List(&'a [Aabb]),
    /// A set.
    Set(&'a CasterSet),
}
impl Default for Boxes<'_> {
    fn default() -> Self {
        Boxes::List(&[])
    }
}
impl<'a> From<&'a [Aabb]> for Boxes<'a> {
    fn from(list: &'a [Aabb]) -> Self {
        Boxes::List(list)
    }
}
impl<'a, const N: usize> From<&'a [Aabb; N]> for Boxes<'a> {
    fn from(list: &'a [Aabb; N]) -> Self {
        Boxes::List(list)
    }
}
impl<'a> From<&'a CasterSet> for Boxes<'a> {
    fn from(set: &'a CasterSet) -> Self {
        Boxes::Set(set)
    }
}

/// Casters of shadows, and receivers that they fall on. Both may be the same.
#[derive(Clone, Copy, Debug, Default)]
pub struct Scene<'a> {
    /// What casts shadows.
    pub casters: Boxes<'a>,
    /// What shadows fall on.
    pub receivers: Boxes<'a>,
}

impl Scene<'_> {
    fn to_c(self) -> gnomon_scene {
        let mut scene = MaybeUninit::<gnomon_scene>::uninit();
        let status = unsafe { gnomon_scene_default(scene.as_mut_ptr(), size_of::<gnomon_scene>() as u32) };
        assert_eq!(status, GNOMON_OK, "the library is older than this crate");
        let mut scene = unsafe { scene.assume_init() };
        match self.casters {
            Boxes::List(list) => (scene.casters, scene.caster_count) = (list.as_ptr().cast(), list.len() as i64),
            Boxes::Set(set) => scene.caster_set = set.as_ptr(),
        }
        match self.receivers {
            Boxes::List(list) => (scene.receivers, scene.receiver_count) = (list.as_ptr().cast(), list.len() as i64),
            Boxes::Set(set) => scene.receiver_set = set.as_ptr(),
        }
        scene
    }
}

/// Visible view depths of a frame: pixels in each bin of the logarithm of depth.
#[derive(Clone, Debug)]
pub struct VisibleDepths(gnomon_visible_depths);

impl Default for VisibleDepths {
    fn default() -> Self {
        let mut depths = MaybeUninit::uninit();
        unsafe {
            gnomon_visible_depths_clear(depths.as_mut_ptr());
            Self(depths.assume_init())
        }
    }
}
impl VisibleDepths {
    /// Counts the view depths of pixels. Not counted, as the sky: 0, less, infinity, not a number.
    pub fn add(&mut self, view_depths: &[f32]) {
        unsafe { gnomon_visible_depths_add(&mut self.0, view_depths.as_ptr(), view_depths.len() as i64, null_mut()) };
    }
    /// Nearest and farthest visible depth; the nearest exceeds the farthest where nothing is visible.
    pub fn range(&self) -> (f64, f64) {
        (self.0.min, self.0.max)
    }
}

/// A camera, and what is known of the surfaces that it sees.
#[derive(Clone, Copy, Debug)]
pub struct View<'a> {
    /// Who sees.
    pub camera: &'a Camera,
    /// Visible depths of this frame or the last ones; `None`: unknown.
    pub depths: Option<&'a VisibleDepths>,
    /// Points of surfaces that the camera sees, world space; empty: unknown. Time grows with their number.
    pub points: &'a [Point],
    /// Unit normals at the points towards the eye, as many; empty: unknown. Pages read them, and warps do not
    /// serve points that are turned from the light.
    pub normals: &'a [Point],
}

impl<'a> View<'a> {
    /// A camera of whose surfaces nothing is known.
    pub fn new(camera: &'a Camera) -> Self {
        Self { camera, depths: None, points: &[], normals: &[] }
    }

    /// `camera`: of [`Camera::to_c`], to live as long as the result.
    fn to_c(self, camera: &gnomon_camera) -> Result<gnomon_view> {
        let mut view = MaybeUninit::<gnomon_view>::uninit();
        let status = unsafe { gnomon_view_default(view.as_mut_ptr(), size_of::<gnomon_view>() as u32) };
        assert_eq!(status, GNOMON_OK, "the library is older than this crate");
        let mut view = unsafe { view.assume_init() };
        view.camera = camera;
        view.depths = self.depths.map_or(null(), |depths| &depths.0);
        if !self.points.is_empty() {
            (view.points, view.point_count) = (self.points.as_ptr().cast(), self.points.len() as i64);
        }
        if !self.normals.is_empty() {
            if self.normals.len() != self.points.len() {
                return Err(Error::new("view.normals"));
            }
            view.normals = self.normals.as_ptr().cast();
        }
        Ok(view)
    }
}

/// Measures the perspective error of a plan over what the view sees: its points, else a grid of pixels and depths in the
/// receivers. Plans of foreign matrices ([`Plan::foreign`]) serve as well.
pub fn measure(plan: &Plan, view: &View<'_>, scene: Scene<'_>, options: &MeasureOptions) -> Result<Stats> {
    let (camera, mut stats, mut field) = (view.camera.to_c(), Stats::default(), null());
    let status = unsafe {
        gnomon_measure(&plan.to_c(), &view.to_c(&camera)?, &scene.to_c(), &options.to_c(), &mut stats.0, &mut field)
    };
    check(status, field).map(|_| stats)
}
