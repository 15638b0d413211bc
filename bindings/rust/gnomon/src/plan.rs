//! Plans: the maps of one light, and what was omitted.
use core::fmt;
use core::mem::{size_of, MaybeUninit};
use core::ptr::{null, null_mut};

use crate::error::{check, Error, Result};
use crate::sys::*;
use crate::{Camera, ClipSpace, History, Light, Map, PlanOptions, Point, Scene, ShaderBlock, View};

/// Whether a plan has maps.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Status {
    /// There are maps to draw.
    Ok,
    /// No receiver is in view: everything there is lit.
    NothingVisible,
    /// Nothing can shadow the receivers in view: they are lit.
    NoCaster,
}

/// How an engine moves a depth off the surface.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(i32)]
pub enum BiasWay {
    /// Rasterizer states: a constant, and a factor times the growth of depth over a texel (glPolygonOffset, Direct3D, Vulkan,
    /// Metal, wgpu).
    Rasterizer = GNOMON_BIAS_RASTERIZER,
    /// A constant, and a move along the normal before the look-up (Bevy, Unity, Godot).
    NormalOffset = GNOMON_BIAS_NORMAL_OFFSET,
}
/// A bias in an engine's units. All of it is towards the light.
pub type EngineBias = gnomon_engine_bias;

impl Status {
    /// Of the status of a plan that was not refused.
    pub(crate) fn of(status: i32) -> Self {
        match status {
            GNOMON_OK => Status::Ok,
            GNOMON_NOTHING_VISIBLE => Status::NothingVisible,
            _ => Status::NoCaster,
        }
    }
}

/// The maps of one light. A plain value of about 15 kB, which owns no memory.
#[derive(Clone)]
pub struct Plan {
    // Its pointers are NULL except in a copy that a call takes.
    plan: gnomon_plan,
    maps: [Map; GNOMON_MAX_MAPS as usize],
    omissions: [Omission; GNOMON_MAX_OMISSIONS as usize],
}

// The pointers are NULL.
unsafe impl Send for Plan {}
unsafe impl Sync for Plan {}

impl Plan {
    fn empty() -> Self {
        let mut plan = MaybeUninit::<gnomon_plan>::uninit();
        let status = unsafe { gnomon_plan_default(plan.as_mut_ptr(), size_of::<gnomon_plan>() as u32) };
        assert_eq!(status, GNOMON_OK, "the library is older than this crate");
        let nothing = gnomon_omission { kind: 0, map: -1, a: 0.0, b: 0.0, saves_texels: 0 };
        Self {
            plan: unsafe { plan.assume_init() },
            maps: [Map::default(); GNOMON_MAX_MAPS as usize],
            omissions: [Omission(nothing); GNOMON_MAX_OMISSIONS as usize],
        }
    }

    /// Maps of another planner, to be measured. `clip_space`: of their matrices. `selection`: an index of
    /// [`List::Selections`](crate::List::Selections), how a point finds its map. At most eight maps.
    pub fn foreign(maps: &[Map], clip_space: ClipSpace, selection: i32) -> Result<Self> {
        let mut plan = Self::empty();
        plan.maps.get_mut(..maps.len()).ok_or(Error::new("plan.map_count"))?.copy_from_slice(maps);
        for map in &mut plan.maps {
            map.0 = map.to_c();
        }
        plan.plan.map_count = maps.len() as i32;
        plan.plan.status = GNOMON_OK;
        plan.plan.clip_space = clip_space;
        plan.plan.selection = selection;
        Ok(plan)
    }

    /// Whether there are maps to draw.
    pub fn status(&self) -> Status {
        Status::of(self.plan.status)
    }
    /// The maps to draw.
    pub fn maps(&self) -> &[Map] {
        &self.maps[..self.plan.map_count as usize]
    }
    /// What this scene did not need, and options that did not hold.
    pub fn omitted(&self) -> &[Omission] {
        &self.omissions[..(self.plan.omission_count as usize).min(self.omissions.len())]
    }
    /// What [`sys::gnomon_map::clip_from_camera_relative`](gnomon_map) is relative to, world space: the camera.
    pub fn origin(&self) -> Point {
        self.plan.origin
    }
    /// Unit, the way the light travels.
    pub fn light_direction(&self) -> Point {
        self.plan.light_direction
    }
    /// Clip space of all matrices.
    pub fn clip_space(&self) -> ClipSpace {
        self.plan.clip_space
    }
    /// How a point finds its map: an index of [`List::Selections`](crate::List::Selections).
    pub fn selection(&self) -> i32 {
        self.plan.selection
    }

    /// Finds the map of each point: its index in [`Plan::maps`], or -1 where the point is lit. `points`: world space.
    /// `view_depths`: of the points. All three have the same length.
    pub fn select(&self, points: &[Point], view_depths: &[f64], indices: &mut [i32]) -> Result<()> {
        if view_depths.len() != points.len() {
            return Err(Error::new("view_depths"));
        }
        if indices.len() != points.len() {
            return Err(Error::new("indices"));
        }
        let mut field = null();
        let status = unsafe {
            gnomon_select(
                &self.to_c(),
                points.as_ptr().cast(),
                view_depths.as_ptr(),
                points.len() as i64,
                indices.as_mut_ptr(),
                &mut field,
            )
        };
        check(status, field).map(|_| ())
    }

    /// The uniform block of shaders/library/shadow_block.glsl. `layer`: width and height of a layer of the texture, texels;
    /// zeros: those of the largest map. `blur_texels`: half side of the box that stored texels were blurred with, 0: none.
    pub fn shader_block(&self, layer: [i32; 2], blur_texels: f64) -> Result<ShaderBlock> {
        let (mut block, mut field) = ([0.0; GNOMON_SHADER_BLOCK_FLOATS as usize], null());
        let status = unsafe {
            gnomon_shader_block(&self.to_c(), layer[0], layer[1], blur_texels, block.as_mut_ptr(), &mut field)
        };
        check(status, field).map(|_| block)
    }

    /// The bias of a map in an engine's own units: what keeps planes from shadowing themselves under a kernel of this radius,
    /// texels. `map`: its index in [`Plan::maps`]. `depth_bits`: of a map that stores normalized integers, 1..32; 0: single
    /// precision. The depth is right where the map's w is constant: parallel light without a warp. Elsewhere it holds in the
    /// middle of the map.
    pub fn engine_bias(
        &self,
        map: usize,
        way: BiasWay,
        kernel_radius_texels: f64,
        depth_bits: i32,
    ) -> Result<EngineBias> {
        let mut bias = EngineBias { depth: 0.0, slope_factor: 0.0, normal_world: 0.0, units: 0.0 };
        let (map, mut field) = (i32::try_from(map).unwrap_or(-1), null());
        let status = unsafe {
            gnomon_translate_bias(
                &self.to_c(),
                map,
                way as i32,
                kernel_radius_texels,
                depth_bits,
                &mut bias,
                &mut field,
            )
        };
        check(status, field).map(|_| bias)
    }

    /// For a call that reads it, while `self` lives.
    pub(crate) fn to_c(&self) -> gnomon_plan {
        let mut plan = self.plan;
        plan.maps = self.maps.as_ptr() as *mut gnomon_map;
        plan.map_size = size_of::<gnomon_map>() as u32;
        plan.map_room = GNOMON_MAX_MAPS;
        plan
    }

    /// Lets a call change maps that are there.
    pub(crate) fn change(&mut self, call: impl FnOnce(*mut gnomon_plan, *mut *const c_char) -> i32) -> Result<()> {
        let mut field = null();
        let mut plan = self.plan;
        plan.maps = self.maps.as_mut_ptr().cast();
        plan.map_size = size_of::<gnomon_map>() as u32;
        plan.map_room = GNOMON_MAX_MAPS;
        check(call(&mut plan, &mut field), field).map(|_| ())
    }

    /// Lets a call write into it.
    fn fill(&mut self, call: impl FnOnce(*mut gnomon_plan, *mut *const c_char) -> i32) -> Result<()> {
        self.plan.maps = self.maps.as_mut_ptr().cast();
        self.plan.map_size = size_of::<gnomon_map>() as u32;
        self.plan.map_room = GNOMON_MAX_MAPS;
        self.plan.omissions = self.omissions.as_mut_ptr().cast();
        self.plan.omission_room = GNOMON_MAX_OMISSIONS;
        let mut field = null();
        let status = call(&mut self.plan, &mut field);
        self.plan.maps = null_mut();
        self.plan.omissions = null_mut();
        check(status, field).map(|_| ())
    }
}

impl fmt::Debug for Plan {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Plan")
            .field("status", &self.status())
            .field("maps", &self.maps())
            .field("omitted", &self.omitted())
            .finish()
    }
}

/// Something that a scene did not need, or an option that did not hold. Displays as two lines of English.
#[derive(Clone, Copy, Debug)]
#[repr(transparent)]
pub struct Omission(gnomon_omission);

impl core::ops::Deref for Omission {
    type Target = gnomon_omission;
    fn deref(&self) -> &gnomon_omission {
        &self.0
    }
}
impl fmt::Display for Omission {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut text = gnomon_text { what: [0; 48], why: [0; 144] };
        unsafe { gnomon_describe(&self.0, &mut text) };
        for (i, line) in [&text.what[..], &text.why[..]].iter().enumerate() {
            if i > 0 {
                f.write_str("\n")?;
            }
            for &letter in line.iter().take_while(|&&letter| letter != 0) {
                // All of it is ASCII.
                write!(f, "{}", letter as u8 as char)?;
            }
        }
        Ok(())
    }
}

/// Chooses the shadow maps of one light for one view. Allocates nothing.
pub fn plan(
    view: &View<'_>,
    light: &Light,
    scene: Scene<'_>,
    options: &PlanOptions,
    history: Option<&mut History>,
) -> Result<Plan> {
    let mut plan = Plan::empty();
    let (camera, light, scene, options) = (view.camera.to_c(), light.to_c(), scene.to_c(), options.to_c());
    let history = history.map_or(null_mut(), History::as_mut_ptr);
    let view = view.to_c(&camera)?;
    plan.fill(|to, field| unsafe { gnomon_make_plan(&view, &light, &scene, &options, history, to, field) })?;
    Ok(plan)
}

/// Chooses the maps that up to eight cameras share: two eyes, a split screen, faces of a probe.
pub fn plan_views(cameras: &[Camera], light: &Light, scene: Scene<'_>, options: &PlanOptions) -> Result<Plan> {
    let mut plan = Plan::empty();
    let mut copies = [Camera::default().0; GNOMON_MAX_VIEWS as usize];
    let mut places = [null(); GNOMON_MAX_VIEWS as usize];
    if cameras.len() > places.len() {
        return Err(Error::new("count"));
    }
    for ((camera, copy), place) in cameras.iter().zip(&mut copies).zip(&mut places) {
        *copy = camera.to_c();
        *place = copy as *const gnomon_camera;
    }
    let (light, scene, options) = (light.to_c(), scene.to_c(), options.to_c());
    plan.fill(|to, field| unsafe {
        gnomon_plan_views(places.as_ptr(), cameras.len() as i32, &light, &scene, &options, to, field)
    })?;
    Ok(plan)
}
