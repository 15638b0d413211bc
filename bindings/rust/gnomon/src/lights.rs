//! Many lights in one pool: how large are the maps of each, and which are drawn in this frame?
use core::marker::PhantomData;
use core::mem::{size_of, size_of_val, MaybeUninit};
use core::ops::{Deref, DerefMut};
use core::ptr::{null, null_mut, NonNull};

use crate::error::{check, Error, Result};
use crate::memory::{count, MemoryBlock};
use crate::sys::*;
use crate::{Atlas, Camera, Light, PlanOptions, Scene, TexelRect, View};

/// One light of [`plan_lights`].
#[derive(Clone, Copy, Debug)]
#[repr(transparent)]
pub struct LightRequest<'a>(gnomon_light_request, PhantomData<&'a Light>);

impl<'a> LightRequest<'a> {
    /// A light whose error counts once.
    pub fn new(light: &'a Light) -> Self {
        let mut request = MaybeUninit::<gnomon_light_request>::uninit();
        let status =
            unsafe { gnomon_light_request_default(request.as_mut_ptr(), size_of::<gnomon_light_request>() as u32) };
        assert_eq!(status, GNOMON_OK, "the library is older than this crate");
        let mut request = unsafe { request.assume_init() };
        let light: &gnomon_light = light;
        // A light whose size was changed is refused by the call.
        request.light = light;
        Self(request, PhantomData)
    }
    /// Counts its error so many times, at least 0.
    pub fn weight(mut self, weight: f64) -> Self {
        self.0.weight = weight;
        self
    }
    /// Says that its casters moved, or that its maps are lost.
    pub fn changed(mut self, changed: bool) -> Self {
        self.0.changed = changed.into();
        self
    }
    /// Draw calls and triangles of all its maps, for a budget of milliseconds.
    pub fn costs(mut self, draws: f64, triangles: f64) -> Self {
        (self.0.draws, self.0.triangles) = (draws, triangles);
        self
    }
}

/// Options of [`plan_lights`]. Every default suits most scenes.
#[derive(Clone, Copy, Debug)]
pub struct LightOptions {
    /// Of the plans of all lights. `None`: the defaults.
    pub base: Option<PlanOptions>,
    fields: gnomon_light_options,
}

impl Default for LightOptions {
    fn default() -> Self {
        let mut fields = MaybeUninit::<gnomon_light_options>::uninit();
        let status =
            unsafe { gnomon_light_options_default(fields.as_mut_ptr(), size_of::<gnomon_light_options>() as u32) };
        assert_eq!(status, GNOMON_OK, "the library is older than this crate");
        Self { base: None, fields: unsafe { fields.assume_init() } }
    }
}
impl Deref for LightOptions {
    type Target = gnomon_light_options;
    fn deref(&self) -> &gnomon_light_options {
        &self.fields
    }
}
impl DerefMut for LightOptions {
    fn deref_mut(&mut self) -> &mut gnomon_light_options {
        &mut self.fields
    }
}
impl LightOptions {
    /// `base`: of `self.base`, to live as long as the result.
    fn to_c(self, base: &Option<gnomon_plan_options>) -> gnomon_light_options {
        let mut options = self.fields;
        options.size = size_of::<gnomon_light_options>() as u32;
        options.plan = base.as_ref().map_or(null(), |base| base);
        options
    }

    /// Options for the plan of one light: maps of its size.
    pub fn plan_options(&self, maps: &LightMaps) -> Result<PlanOptions> {
        let base = self.base.map(|base| base.to_c());
        let (mut options, mut own, mut field) = (PlanOptions::default(), maps.0, null());
        own.size = size_of::<gnomon_light_maps>() as u32;
        let status = unsafe { gnomon_light_plan_options(&self.to_c(&base), &own, &mut *options, &mut field) };
        check(status, field).map(|_| options)
    }
}

/// The maps of one light in the pool.
#[derive(Clone, Copy, Debug)]
#[repr(transparent)]
pub struct LightMaps(gnomon_light_maps);

impl Default for LightMaps {
    fn default() -> Self {
        let nothing = TexelRect { x: 0, y: 0, width: 0, height: 0 };
        Self(gnomon_light_maps {
            size: size_of::<gnomon_light_maps>() as u32,
            outcome: GNOMON_LIGHT_WITHOUT_RECEIVER,
            texels: 0,
            map_count: 0,
            place: [nothing; GNOMON_MAX_MAPS as usize],
            share: 0.0,
            m: 0.0,
            frames: 1,
            due: 0,
        })
    }
}
impl Deref for LightMaps {
    type Target = gnomon_light_maps;
    fn deref(&self) -> &gnomon_light_maps {
        &self.0
    }
}
impl LightMaps {
    /// Places in the pool, by index of the map in the light's plan.
    pub fn places(&self) -> &[TexelRect] {
        &self.0.place[..(self.0.map_count.max(0) as usize).min(self.0.place.len())]
    }
}

/// State of [`plan_lights`] from frame to frame. Keep one per pool and camera.
#[derive(Debug)]
pub struct LightHistory(NonNull<gnomon_light_history>);

unsafe impl Send for LightHistory {}
unsafe impl Sync for LightHistory {}

impl LightHistory {
    /// A new history for up to so many lights, at most `sys::GNOMON_MAX_LIGHTS`.
    pub fn new(lights: usize) -> Result<Self> {
        NonNull::new(unsafe { gnomon_light_history_create(count(lights)) }).map(Self).ok_or(Error::new("lights"))
    }
    /// Exchanges what is remembered of two lights: where their order changes.
    pub fn swap(&mut self, a: usize, b: usize) {
        unsafe { gnomon_light_history_swap(self.0.as_ptr(), count(a), count(b)) }
    }
    /// Forgets one light: where another one takes its index.
    pub fn forget(&mut self, light: usize) {
        unsafe { gnomon_light_history_forget(self.0.as_ptr(), count(light)) }
    }
}
impl Drop for LightHistory {
    fn drop(&mut self) {
        unsafe { gnomon_light_history_destroy(self.0.as_ptr()) }
    }
}

/// Blocks of memory that [`plan_lights`] needs for so many lights and visible points.
pub fn light_memory(lights: usize, points: usize) -> Result<usize> {
    MemoryBlock::holding(unsafe { gnomon_light_memory(count(lights), count(points)) }, "lights, points")
}

/// Maps of many lights in one pool. Dereferences to a struct of [`sys`](crate::sys): texels, error, which are due.
#[derive(Debug)]
pub struct LightPlan<'m> {
    // Its pointer is NULL except in a copy that a call takes.
    plan: gnomon_light_plan,
    lights: &'m [LightMaps],
}

unsafe impl Send for LightPlan<'_> {}
unsafe impl Sync for LightPlan<'_> {}

impl Deref for LightPlan<'_> {
    type Target = gnomon_light_plan;
    fn deref(&self) -> &gnomon_light_plan {
        &self.plan
    }
}
impl LightPlan<'_> {
    /// The maps of each light, in the order of the requests.
    pub fn lights(&self) -> &[LightMaps] {
        self.lights
    }
    /// The pool as the atlas of one light's maps.
    pub fn atlas(&self, light: usize) -> Result<Atlas> {
        let mut plan = self.plan;
        plan.lights = self.lights.as_ptr() as *mut gnomon_light_maps;
        Atlas::filled(|atlas, field| unsafe { gnomon_light_atlas(&plan, count(light), atlas, field) })
    }
}

/// Divides the texels of one pool among lights, and chooses which of them are due. `memory`: [`light_memory`] blocks. `maps`: one
/// for each light, which the plan borrows. Plan each light that is due by [`plan`](crate::plan) with
/// [`LightOptions::plan_options`].
///
/// ```
/// use gnomon::{light_memory, plan_lights, Camera, Light, LightMaps, LightOptions, LightRequest, MemoryBlock, Scene, View};
/// let camera = Camera::at([0.0, 3.0, 0.0], [0.0, 0.0, -1.0]).perspective(1.0, 1.5, 0.1, 250.0, 960, 640)?;
/// let lamps = [Light::point([0.0, 4.0, -9.0], 20.0), Light::point([3.0, 4.0, -20.0], 20.0)];
/// let casters = [[0.0, 1.0, -9.0, 1.0, 3.0, -8.0], [2.0, 1.0, -22.0, 4.0, 3.0, -19.0]];
/// let scene = Scene { casters: (&casters).into(), receivers: (&[[-40.0, -1.0, -90.0, 40.0, 0.0, 0.0]]).into() };
/// let requests = [LightRequest::new(&lamps[0]), LightRequest::new(&lamps[1]).weight(2.0)];
/// let (mut memory, mut maps) = (vec![MemoryBlock::default(); light_memory(2, 0)?], [LightMaps::default(); 2]);
/// let options = LightOptions::default();
/// let plan = plan_lights(&View::new(&camera), &requests, scene, &options, None, &mut memory, &mut maps)?;
/// for (lamp, maps) in lamps.iter().zip(plan.lights()) {
///     let shadow = gnomon::plan(&View::new(&camera), lamp, scene, &options.plan_options(maps)?, None)?;
///     assert!(shadow.maps().iter().all(|map| map.width == maps.texels));
/// }
/// # Ok::<(), gnomon::Error>(())
/// ```
pub fn plan_lights<'m>(
    view: &View<'_>,
    requests: &[LightRequest<'_>],
    scene: Scene<'_>,
    options: &LightOptions,
    history: Option<&mut LightHistory>,
    memory: &mut [MemoryBlock],
    maps: &'m mut [LightMaps],
) -> Result<LightPlan<'m>> {
    let mut plan = MaybeUninit::<gnomon_light_plan>::uninit();
    let status = unsafe { gnomon_light_plan_default(plan.as_mut_ptr(), size_of::<gnomon_light_plan>() as u32) };
    assert_eq!(status, GNOMON_OK, "the library is older than this crate");
    let (mut plan, mut field) = unsafe { (plan.assume_init(), null()) };
    plan.lights = maps.as_mut_ptr().cast();
    plan.light_size = size_of::<gnomon_light_maps>() as u32;
    plan.light_room = maps.len() as i64;
    let (base, camera) = (options.base.map(|base| base.to_c()), view.camera.to_c());
    let status = unsafe {
        gnomon_plan_lights(
            &view.to_c(&camera)?,
            requests.as_ptr().cast(),
            size_of::<gnomon_light_request>() as u32,
            requests.len() as i64,
            &scene.to_c(),
            &options.to_c(&base),
            history.map_or(null_mut(), |history| history.0.as_ptr()),
            memory.as_mut_ptr().cast(),
            size_of_val(memory) as i64,
            &mut plan,
            &mut field,
        )
    };
    plan.lights = null_mut();
    check(status, field)?;
    Ok(LightPlan { lights: &maps[..plan.light_count as usize], plan })
}

impl Light {
    /// A camera that sees all that a local light can light, for maps that serve several frames; of a directional light, `camera`
    /// itself.
    pub fn camera_round(&self, camera: &Camera) -> Result<Camera> {
        let (mut round, mut field) = (Camera::default(), null());
        let status = unsafe { gnomon_camera_round(&self.to_c(), &camera.to_c(), &mut *round, &mut field) };
        check(status, field).map(|_| round)
    }
}
