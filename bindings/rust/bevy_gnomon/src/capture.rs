//! What do a light's cascades look like to `gnomon judge`? Files of format gnomon-capture/1 (docs/captures.md).
//!
//! ```no_run
//! # use bevy::prelude::*;
//! # use bevy::light::{CascadeShadowConfig, Cascades, DirectionalLightShadowMap, ShadowFilteringMethod};
//! # use bevy_gnomon::{capture, Boxes, MeshBounds};
//! fn write(
//!     camera: Single<(Entity, &Camera, &GlobalTransform, &Projection)>,
//!     light: Single<(&GlobalTransform, &DirectionalLight, &CascadeShadowConfig, &Cascades)>,
//!     meshes: Query<MeshBounds, With<Mesh3d>>,
//!     map_size: Res<DirectionalLightShadowMap>,
//! ) {
//!     let frame = capture::frame(*camera, *light, map_size.size, ShadowFilteringMethod::Gaussian);
//!     std::fs::write("capture.json", capture::file("mine", &Boxes::of(meshes.iter()), &[frame])).unwrap();
//! }
//! ```
use std::fmt::Write;

use bevy::light::cascade::Cascade;
use bevy::light::{CascadeShadowConfig, Cascades, DirectionalLight, ShadowFilteringMethod};
use bevy::prelude::*;

use crate::{Boxes, WorldBox, kernel_radius_texels};

/// Numbers as JSON, single precision by the shortest text that brings back its bits.
fn list<T: std::fmt::Debug>(numbers: impl IntoIterator<Item = T>) -> String {
    let numbers: Vec<String> = numbers.into_iter().map(|x| format!("{x:?}")).collect();
    format!("[{}]", numbers.join(", "))
}

fn boxes_text(boxes: &[WorldBox]) -> String {
    let each = boxes.iter().map(|b| format!("{{\"min\": {}, \"max\": {}}}", list(&b[..3]), list(&b[3..])));
    format!("[{}]", each.collect::<Vec<_>>().join(", "))
}

/// Camera, light and maps of this frame: an entry of a capture's `frames`. Empty where the light has no cascades for the camera.
pub fn frame(
    (view, camera, at, projection): (Entity, &Camera, &GlobalTransform, &Projection),
    (transform, light, config, cascades): (&GlobalTransform, &DirectionalLight, &CascadeShadowConfig, &Cascades),
    map_size: usize,
    filter: ShadowFilteringMethod,
) -> String {
    let own = cascades.cascades.get(&view).map_or(&[][..], Vec::as_slice);
    if own.is_empty() {
        return String::new();
    }
    let size = camera.physical_viewport_size().unwrap_or(UVec2::ONE);
    let maps: Vec<String> = own
        .iter()
        .zip(&config.bounds)
        .enumerate()
        .map(|(i, (cascade, &end))| map_text(cascade, depths(config, i, end), light, map_size, filter))
        .collect();
    format!(
        "{{\"camera\": {{\"view_from_world\": {}, \"clip_from_view\": {}, \"width\": {}, \"height\": {}}},\n\
         \"lights\": [{{\"type\": \"directional\", \"direction\": {}}}],\n\"maps\": [{}]}}",
        list(at.to_matrix().inverse().to_cols_array()),
        list(projection.get_clip_from_view().to_cols_array()),
        size.x,
        size.y,
        list(transform.forward().to_array()),
        maps.join(",\n")
    )
}

/// View depths at which a cascade begins and ends, and over which the one before it blends into it.
fn depths(config: &CascadeShadowConfig, index: usize, end: f32) -> [f32; 3] {
    match index {
        0 => [0.0, end, 0.0],
        _ => {
            let begin = config.bounds[index - 1];
            [begin, end, config.overlap_proportion * begin]
        }
    }
}

fn map_text(
    cascade: &Cascade,
    [begin, end, overlap]: [f32; 3],
    light: &DirectionalLight,
    map_size: usize,
    filter: ShadowFilteringMethod,
) -> String {
    let mut text = format!(
        "{{\"clip_from_world\": {}, \"width\": {map_size}, \"height\": {map_size}, \"depths\": {}, \"overlap\": {overlap:?}, ",
        list(cascade.clip_from_world.to_cols_array()),
        list([begin, end])
    );
    let along_normal = light.shadow_normal_bias * std::f32::consts::SQRT_2 * cascade.texel_size;
    write!(
        text,
        "\"depth_bits\": 0, \"clamps_depth\": true, \"filter_texels\": {:?}, \"bias\": {{\"world\": {:?}, \"normal_world\": {along_normal:?}}}}}",
        kernel_radius_texels(filter),
        light.shadow_depth_bias
    )
    .expect("writing into a string");
    text
}

/// A whole capture: the boxes of its scene, and what [`frame`] returned for each frame; frames without cascades are left out.
/// `name`: plain text.
pub fn file(name: &str, boxes: &Boxes, frames: &[String]) -> String {
    let frames: Vec<&str> = frames.iter().map(String::as_str).filter(|frame| !frame.is_empty()).collect();
    format!(
        "{{\"format\": \"gnomon-capture/1\", \"name\": {name:?}, \"engine\": \"Bevy 0.19\",\n\
         \"clip_space\": {{\"ndc_depth\": \"zero_to_one\", \"reversed_z\": true}},\n\"receivers\": {},\n\"casters\": {},\n\
         \"frames\": [{}]}}\n",
        boxes_text(&boxes.receivers),
        boxes_text(&boxes.casters),
        frames.join(",\n")
    )
}
