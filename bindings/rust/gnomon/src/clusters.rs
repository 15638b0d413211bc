//! Which lights reach into each cluster of the view: a tile of pixels times a slice of depth.
use core::mem::{size_of, MaybeUninit};
use core::ptr::null;

use crate::error::{check, Result};
use crate::sys::*;
use crate::{Camera, Light};

/// Options of [`cluster_lights`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ClusterOptions {
    /// Side of a tile, pixels, at least 1.
    pub tile_pixels: i32,
    /// Parts of the view depth, 1..256.
    pub depth_slices: i32,
}
impl Default for ClusterOptions {
    fn default() -> Self {
        Self { tile_pixels: 64, depth_slices: 48 }
    }
}

/// Clusters of an image with these options; 0 for what is out of range. [`ClusterMemory::begin`] has one entry more.
pub fn cluster_count(camera: &Camera, options: &ClusterOptions) -> usize {
    unsafe { gnomon_cluster_count(&camera.to_c(), options.tile_pixels, options.depth_slices) as usize }
}

/// Bytes of [`ClusterMemory::work`] for so many lights and entries of lists; 0 where either is out of range.
pub fn cluster_memory(lights: usize, entries: usize) -> usize {
    let number = |count| i64::try_from(count).unwrap_or(-1);
    unsafe { gnomon_cluster_memory(number(lights), number(entries)) as usize }
}

/// Memory of the caller's that lists are written to. Keep it from frame to frame.
#[derive(Debug)]
pub struct ClusterMemory<'a> {
    /// Where each list begins: [`cluster_count`] + 1 entries suffice, 2 are required.
    pub begin: &'a mut [u32],
    /// The lists: at least as many entries as lights. More: finer clusters.
    pub lights: &'a mut [u32],
    /// [`cluster_memory`] bytes.
    pub work: &'a mut [u8],
}

/// Lists of the lights that reach into each cluster. Those of cluster (column, row, slice) are [`LightClusters::of`].
#[derive(Clone, Copy, Debug)]
pub struct LightClusters<'a> {
    /// Clusters along the image's width.
    pub columns: i32,
    /// Clusters along its height.
    pub rows: i32,
    /// Clusters along the view depth.
    pub slices: i32,
    /// Side of a tile, pixels: larger than requested where the lists hold no finer ones.
    pub tile_pixels: i32,
    /// Whether the camera is orthographic.
    pub orthographic: bool,
    /// Slice of a surface: `floor(depth_scale * log2(view depth) + depth_offset)`, of the view depth itself for an orthographic
    /// camera, clamped to the slices.
    pub depth_scale: f64,
    /// See `depth_scale`.
    pub depth_offset: f64,
    /// Where each list begins, and where the last one ends.
    pub begin: &'a [u32],
    /// The lists: indices of lights, in ascending order.
    pub lights: &'a [u32],
}

impl<'a> LightClusters<'a> {
    /// Indices of the lights of a cluster, with row 0 at the bottom of the image; nothing for one that is not there.
    pub fn of(&self, column: i32, row: i32, slice: i32) -> &'a [u32] {
        let inside = |at: i32, end: i32| at >= 0 && at < end;
        if !(inside(column, self.columns) && inside(row, self.rows) && inside(slice, self.slices)) {
            return &[];
        }
        let at = (slice as usize * self.rows as usize + row as usize) * self.columns as usize + column as usize;
        match self.begin.get(at..at + 2) {
            Some(ends) => self.lights.get(ends[0] as usize..ends[1] as usize).unwrap_or(&[]),
            None => &[],
        }
    }
}

/// Lists the lights that can light a surface in each cluster of the view. Shading by the lists gives the same light as shading
/// by all, as long as a light is zero beyond its range and cone. Suns are in every list. Any lists fit: where they would be too
/// long, tiles become larger and slices fewer.
///
/// ```
/// use gnomon::{cluster_count, cluster_lights, cluster_memory, Camera, ClusterMemory, ClusterOptions, Light};
/// let camera = Camera::at([0.0, 3.0, 0.0], [0.0, 0.0, -1.0]).perspective(1.0, 1.5, 0.1, 250.0, 960, 640)?;
/// let lights = [Light::point([0.0, 1.0, -9.0], 2.0), Light::directional([0.0, -1.0, 0.0])];
/// let options = ClusterOptions::default();
/// let (mut begin, mut lists) = (vec![0; cluster_count(&camera, &options) + 1], vec![0; 100_000]);
/// let mut work = vec![0; cluster_memory(lights.len(), lists.len())];
/// let memory = ClusterMemory { begin: &mut begin, lights: &mut lists, work: &mut work };
/// let clusters = cluster_lights(&camera, &lights, &options, memory)?;
/// assert_eq!(clusters.of(0, 0, 0), [1]);
/// # Ok::<(), gnomon::Error>(())
/// ```
pub fn cluster_lights<'a>(
    camera: &Camera,
    lights: &[Light],
    options: &ClusterOptions,
    memory: ClusterMemory<'a>,
) -> Result<LightClusters<'a>> {
    let mut clusters = MaybeUninit::<gnomon_light_clusters>::uninit();
    let status =
        unsafe { gnomon_light_clusters_default(clusters.as_mut_ptr(), size_of::<gnomon_light_clusters>() as u32) };
    assert_eq!(status, GNOMON_OK, "the library is older than this crate");
    let mut clusters = unsafe { clusters.assume_init() };
    (clusters.tile_pixels, clusters.depth_slices) = (options.tile_pixels, options.depth_slices);
    (clusters.begin, clusters.begin_room) = (memory.begin.as_mut_ptr(), memory.begin.len() as i64);
    (clusters.lights, clusters.light_room) = (memory.lights.as_mut_ptr(), memory.lights.len() as i64);
    let mut field = null();
    // The call takes the size of a light from here, and not from the lights.
    let status = unsafe {
        gnomon_cluster_lights(
            &camera.to_c(),
            lights.as_ptr().cast(),
            size_of::<gnomon_light>() as u32,
            lights.len() as i64,
            memory.work.as_mut_ptr().cast(),
            memory.work.len() as i64,
            &mut clusters,
            &mut field,
        )
    };
    check(status, field)?;
    let count = clusters.columns as usize * clusters.rows as usize * clusters.slices as usize;
    Ok(LightClusters {
        columns: clusters.columns,
        rows: clusters.rows,
        slices: clusters.slices,
        tile_pixels: clusters.tile_pixels,
        orthographic: clusters.orthographic != 0,
        depth_scale: clusters.depth_scale,
        depth_offset: clusters.depth_offset,
        begin: &memory.begin[..count + 1],
        lights: &memory.lights[..clusters.light_count as usize],
    })
}
