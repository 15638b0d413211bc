//! Which pixels are lit? Exact rays in double precision.
use bevy::math::DVec3;
use bevy_gnomon::WorldBox;

use crate::scenes::{FOV_Y, Scene};

#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Pixel {
    /// Sky, or turned from the sun.
    Uncounted,
    Shadow,
    Lit,
}

/// Distance in lengths of the ray, and the axis of the face that is hit.
fn first_hit(boxes: &[WorldBox], origin: DVec3, ray: DVec3) -> Option<(f64, usize)> {
    const BEGIN: f64 = 1e-6; // what is nearer is the surface itself
    let inverse = 1.0 / ray;
    let mut first: Option<(f64, usize)> = None;
    for one in boxes {
        let a = (DVec3::from_slice(&one[..3]) - origin) * inverse;
        let b = (DVec3::from_slice(&one[3..]) - origin) * inverse;
        let (near, far) = (a.min(b), a.max(b));
        let (enter, leave) = (near.max_element(), far.min_element());
        if enter <= leave && enter > BEGIN && first.is_none_or(|(t, _)| enter < t) {
            first = Some((enter, near.max_position()));
        }
    }
    first
}

/// Rows top to bottom.
pub fn picture(scene: &Scene, frame: usize, [width, height]: [u32; 2]) -> Vec<Pixel> {
    let (eye, target) = scene.walk[frame];
    let forward = (target - eye).normalize();
    let right = forward.cross(DVec3::Y).normalize();
    let up = right.cross(forward);
    let sun = scene.sun.normalize();
    let (tangent, size) = ((0.5 * FOV_Y).tan(), [f64::from(width), f64::from(height)]);
    let pixel = |i: u32| {
        let x = (2.0 * (f64::from(i % width) + 0.5) / size[0] - 1.0) * tangent * size[0] / size[1];
        let y = (1.0 - 2.0 * (f64::from(i / width) + 0.5) / size[1]) * tangent;
        let ray = forward + x * right + y * up;
        let Some((t, axis)) = first_hit(&scene.boxes, eye, ray) else {
            return Pixel::Uncounted;
        };
        if ray[axis].signum() * sun[axis] <= 0.0 {
            return Pixel::Uncounted;
        }
        match first_hit(&scene.boxes, eye + t * ray - 1e-6 * sun, -sun) {
            None => Pixel::Lit,
            Some(_) => Pixel::Shadow,
        }
    };
    (0..width * height).map(pixel).collect()
}
