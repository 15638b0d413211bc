//! Virtual shadow maps: which pages do visible points need?
use core::fmt;
use core::marker::PhantomData;
use core::mem::{size_of, size_of_val, MaybeUninit};
use core::ops::{Deref, DerefMut};
use core::ptr::null;
use core::slice::from_raw_parts;

use crate::error::{check, Error, Result};
use crate::memory::{count, MemoryBlock};
use crate::sys::*;
use crate::{
    Aabb, Light, Map, MeasureOptions, PlanOptions, Point, Scene, ShadowPicture, Stats, Status, View, WrongPixels,
};

/// Options of [`plan_pages`]. Every default suits most scenes.
#[derive(Clone, Copy, Debug)]
pub struct PageOptions {
    /// The base of the levels. `None`: the defaults with warp none, as levels follow the view already. With fit stable, pages
    /// keep their place in the world under camera motion.
    pub base: Option<PlanOptions>,
    fields: gnomon_page_options,
}

impl Default for PageOptions {
    fn default() -> Self {
        let mut fields = MaybeUninit::<gnomon_page_options>::uninit();
        let status =
            unsafe { gnomon_page_options_default(fields.as_mut_ptr(), size_of::<gnomon_page_options>() as u32) };
        assert_eq!(status, GNOMON_OK, "the library is older than this crate");
        Self { base: None, fields: unsafe { fields.assume_init() } }
    }
}
impl Deref for PageOptions {
    type Target = gnomon_page_options;
    fn deref(&self) -> &gnomon_page_options {
        &self.fields
    }
}
impl DerefMut for PageOptions {
    fn deref_mut(&mut self) -> &mut gnomon_page_options {
        &mut self.fields
    }
}

/// Blocks of memory that [`plan_pages`] needs for a pool of this capacity and so many visible points. Without points, some ten
/// thousand suffice for samples of the receivers' boxes.
pub fn page_memory(capacity: i32, points: usize) -> Result<usize> {
    MemoryBlock::holding(unsafe { gnomon_page_memory(capacity, count(points)) }, "capacity, points")
}

/// One resident page: its level, place in the level's virtual map, and slot in the pool.
pub type Page = gnomon_page;

/// Report of the last frame's image, for policies that read it.
#[derive(Clone, Copy, Debug, Default)]
pub struct PageHistory<'a> {
    /// The plan of the last frame, in other memory than the new one.
    pub last: Option<&'a PagePlan<'a>>,
    /// Bits of each visible point, such as `sys::GNOMON_SHADOW_EDGE`; empty: nothing was reported.
    pub feedback: &'a [u8],
}

/// Levels and resident pages, in the memory that the call was given.
pub struct PagePlan<'m> {
    // Its lists lie in the memory; its omissions are NULL.
    plan: gnomon_page_plan,
    memory: PhantomData<&'m mut [MemoryBlock]>,
}

// The memory is lent, and calls only read it.
unsafe impl Send for PagePlan<'_> {}
unsafe impl Sync for PagePlan<'_> {}

/// Chooses the pages that the view's points need. `memory`: [`page_memory`] blocks, which hold the plan.
///
/// ```
/// use gnomon::{page_memory, plan_pages, Camera, Light, MemoryBlock, PageOptions, Scene, View};
/// let camera = Camera::at([0.0, 3.0, 0.0], [0.0, 0.0, -1.0]).perspective(1.0, 1.5, 0.1, 250.0, 960, 640)?;
/// let ground: Vec<[f64; 3]> = (5..90).map(|z| [0.0, 0.0, -f64::from(z)]).collect();
/// let boxes = [[-40.0, -1.0, -90.0, 40.0, 0.0, 0.0], [0.0, 1.0, -9.0, 1.0, 6.0, -8.0]];
/// let scene = Scene { casters: (&boxes).into(), receivers: (&boxes).into() };
/// let mut options = PageOptions::default();
/// options.capacity = 256;
/// let mut memory = vec![MemoryBlock::default(); page_memory(options.capacity, ground.len())?];
/// let view = View { points: &ground, ..View::new(&camera) };
/// let plan = plan_pages(&view, &Light::directional([0.3, -1.0, 0.0]), scene, &options, None, &mut memory)?;
/// let mut indices = vec![-1; ground.len()];
/// plan.select(&ground, &mut indices)?;
/// assert!(indices.iter().all(|&index| (index as usize) < plan.pages().len()));
/// # Ok::<(), gnomon::Error>(())
/// ```
pub fn plan_pages<'m>(
    view: &View<'_>,
    light: &Light,
    scene: Scene<'_>,
    options: &PageOptions,
    history: Option<PageHistory<'_>>,
    memory: &'m mut [MemoryBlock],
) -> Result<PagePlan<'m>> {
    let mut plan = MaybeUninit::<gnomon_page_plan>::uninit();
    let mut past = MaybeUninit::<gnomon_page_history>::uninit();
    let status = unsafe {
        gnomon_page_plan_default(plan.as_mut_ptr(), size_of::<gnomon_page_plan>() as u32)
            | gnomon_page_history_default(past.as_mut_ptr(), size_of::<gnomon_page_history>() as u32)
    };
    assert_eq!(status, GNOMON_OK, "the library is older than this crate");
    let (mut plan, mut past, mut field) = unsafe { (plan.assume_init(), past.assume_init(), null()) };
    if let Some(history) = history {
        past.last = history.last.map_or(null(), |last| &last.plan);
        (past.feedback, past.feedback_count) = (history.feedback.as_ptr(), history.feedback.len() as i64);
    }
    let base = options.base.map(|base| base.to_c());
    let mut settings = options.fields;
    settings.size = size_of::<gnomon_page_options>() as u32;
    settings.plan = base.as_ref().map_or(null(), |base| base);
    let camera = view.camera.to_c();
    let status = unsafe {
        gnomon_plan_pages(
            &view.to_c(&camera)?,
            &light.to_c(),
            &scene.to_c(),
            &settings,
            &past,
            memory.as_mut_ptr().cast(),
            size_of_val(memory) as i64,
            &mut plan,
            &mut field,
        )
    };
    check(status, field).map(|_| PagePlan { plan, memory: PhantomData })
}

impl PagePlan<'_> {
    /// Whether there are pages to draw.
    pub fn status(&self) -> Status {
        Status::of(self.plan.status)
    }
    /// Resident pages, coarsest level first.
    pub fn pages(&self) -> &[Page] {
        unsafe { list(self.plan.pages, self.plan.page_count) }
    }
    /// Hash table over the pages, as shaders/library reads it.
    pub fn table(&self) -> &[u32] {
        unsafe { list(self.plan.table, self.plan.table_count) }
    }
    /// Levels that have pages.
    pub fn level_count(&self) -> usize {
        self.plan.level_count as usize
    }
    /// A level, coarsest first: width and height are those of the whole virtual map.
    pub fn level(&self, level: usize) -> Result<Map> {
        let level = i32::try_from(level).unwrap_or(-1);
        self.map(|plan, map, field| unsafe { gnomon_page_level(plan, level, map, field) })
    }
    /// A page as a map of its own, to draw it and to cull its casters.
    pub fn page_map(&self, page: usize) -> Result<Map> {
        self.map(|plan, map, field| unsafe { gnomon_page_map(plan, count(page), map, field) })
    }
    fn map(
        &self,
        call: impl FnOnce(*const gnomon_page_plan, *mut gnomon_map, *mut *const c_char) -> i32,
    ) -> Result<Map> {
        let (mut map, mut field) = (Map::default(), null());
        check(call(&self.plan, &mut *map, &mut field), field).map(|_| map)
    }
    /// Texels of a page's side, without its borders, and of each border.
    pub fn page_texels(&self) -> (i32, i32) {
        (self.plan.page_texels, self.plan.border_texels)
    }
    /// Error that levels were chosen for; larger than requested where the pool is small.
    pub fn target_m(&self) -> f64 {
        self.plan.target_m
    }
    /// The page that serves each point, world space: its index, or -1. Both have the same length.
    pub fn select(&self, points: &[Point], indices: &mut [i32]) -> Result<()> {
        if indices.len() != points.len() {
            return Err(Error::new("indices"));
        }
        let mut field = null();
        let status = unsafe {
            gnomon_page_select(
                &self.plan,
                points.as_ptr().cast(),
                points.len() as i64,
                indices.as_mut_ptr(),
                &mut field,
            )
        };
        check(status, field).map(|_| ())
    }
    /// The error in the pages that serve what the view sees, and the texels of all pages over the camera's pixels.
    pub fn measure(&self, view: &View<'_>, scene: Scene<'_>, options: &MeasureOptions) -> Result<(Stats, f64)> {
        let (camera, mut stats, mut share, mut field) = (view.camera.to_c(), Stats::default(), 0.0, null());
        let status = unsafe {
            gnomon_measure_pages(
                &self.plan,
                &view.to_c(&camera)?,
                &scene.to_c(),
                &options.to_c(),
                &mut *stats,
                &mut share,
                &mut field,
            )
        };
        check(status, field).map(|_| (stats, share))
    }
    /// [`expected_error`](crate::expected_error) in the pages that serve the points of the picture. A point without a page is drawn
    /// as lit.
    pub fn expected_error(&self, picture: ShadowPicture<'_>, kernel_texels: f64) -> Result<WrongPixels> {
        picture.expect(kernel_texels, |picture, pixels, field| unsafe {
            gnomon_expected_page_error(&self.plan, picture, pixels, field)
        })
    }
    /// Finds the pages that a pool still holds, and a slot for each of the others. `moved`: boxes of casters that changed since
    /// the last call, where they were and where they are. `slots`: the pool, at least one for each page. `table`:
    /// [`page_table_size`] entries. `kept`: one for each page. Returns how many are to be drawn.
    pub fn keep(
        &self,
        moved: &[Aabb],
        slots: &mut [PageSlot],
        table: &mut [u32],
        kept: &mut [KeptPage],
    ) -> Result<usize> {
        if table.len() < page_table_size(slots.len()) {
            return Err(Error::new("table"));
        }
        if kept.len() != self.pages().len() {
            return Err(Error::new("kept"));
        }
        let (mut drawn, mut field) = (0, null());
        let status = unsafe {
            gnomon_keep_pages(
                &self.plan,
                moved.as_ptr().cast(),
                moved.len() as i64,
                slots.as_mut_ptr().cast(),
                i32::try_from(slots.len()).unwrap_or(-1),
                table.as_mut_ptr(),
                kept.as_mut_ptr(),
                &mut drawn,
                &mut field,
            )
        };
        check(status, field).map(|_| drawn as usize)
    }
}

impl fmt::Debug for PagePlan<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("PagePlan")
            .field("status", &self.status())
            .field("pages", &self.pages().len())
            .field("levels", &self.level_count())
            .finish()
    }
}

/// Entries of the table that [`PagePlan::keep`] needs; 0 where `slots` is out of range.
pub fn page_table_size(slots: usize) -> usize {
    unsafe { gnomon_page_table_size(i32::try_from(slots).unwrap_or(-1)) as usize }
}

/// One slot of a pool that keeps pages from frame to frame: a default one holds nothing. [`PagePlan::keep`] alone changes it.
#[derive(Clone, Copy, Debug)]
#[repr(transparent)]
pub struct PageSlot(gnomon_page_slot);

impl Default for PageSlot {
    fn default() -> Self {
        Self(gnomon_page_slot { clip_from_world: [0.0; 16], texels: 0, reserved: 0, used: 0, behind: 0 })
    }
}
impl PageSlot {
    /// The matrix of the page that was drawn into it; `None`: it holds nothing.
    pub fn clip_from_world(&self) -> Option<&[f64; 16]> {
        if self.0.used == 0 {
            None
        } else {
            Some(&self.0.clip_from_world)
        }
    }
}

/// Where a page of a plan lies in a pool: its slot, and whether it, or its moving casters alone, are to be drawn.
pub type KeptPage = gnomon_kept_page;

unsafe fn list<'a, T>(first: *const T, count: i64) -> &'a [T] {
    if first.is_null() || count <= 0 {
        return &[];
    }
    from_raw_parts(first, count as usize)
}
