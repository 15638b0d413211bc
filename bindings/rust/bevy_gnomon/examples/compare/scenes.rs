//! Scenes of boxes, each with a sun and a walk.
use bevy::math::DVec3;
use bevy_gnomon::WorldBox;

pub struct Scene {
    pub name: &'static str,
    pub boxes: Vec<WorldBox>,
    /// Whether the boxes cast shadows.
    pub casts: bool,
    /// The way its light travels, any length.
    pub sun: DVec3,
    /// Eye and target in each frame.
    pub walk: Vec<(DVec3, DVec3)>,
}

pub const FOV_Y: f64 = 1.0; // radians
pub const NEAR: f64 = 0.2;
pub const FAR: f64 = 220.0;
const FRAMES: i32 = 6;

fn walk(eye: DVec3, target: DVec3, step: DVec3) -> Vec<(DVec3, DVec3)> {
    (0..FRAMES).map(|i| (eye + f64::from(i) * step, target + f64::from(i) * step)).collect()
}

/// The street of bindings/js/test/street.js.
fn street() -> Scene {
    let mut boxes = vec![[-40.0, -1.0, -200.0, 40.0, 0.0, 20.0]];
    for i in 0..40 {
        let (x, z) = (if i % 2 == 0 { -12.0 } else { 8.0 }, -5.0 * f64::from(i));
        boxes.push([x, 0.0, z - 3.0, x + 4.0, f64::from(2 + i % 7), z]);
    }
    let walk = walk(DVec3::new(0.0, 4.0, 10.0), DVec3::new(2.0, 1.0, -20.0), DVec3::new(0.2, 0.0, -1.3));
    Scene { name: "street", boxes, casts: true, sun: DVec3::new(0.5, -1.0, -0.35), walk }
}

/// Thin posts in rows, below a low sun.
fn posts() -> Scene {
    let mut boxes = vec![[-60.0, -1.0, -160.0, 60.0, 0.0, 20.0]];
    for row in 0..24 {
        for column in 0..7 {
            let (x, z) = (-18.0 + 6.0 * f64::from(column) + 1.7 * f64::from(row % 3), -6.0 * f64::from(row) - 2.0);
            boxes.push([x, 0.0, z, x + 0.25, 1.5 + 0.5 * f64::from((row + column) % 4), z + 0.25]);
        }
    }
    let walk = walk(DVec3::new(-3.0, 2.0, 9.0), DVec3::new(1.0, 0.0, -25.0), DVec3::new(0.3, 0.0, -1.1));
    Scene { name: "posts", boxes, casts: true, sun: DVec3::new(0.8, -0.45, 0.3), walk }
}

/// Nothing casts a shadow: plans have no maps.
fn ground() -> Scene {
    let walk = vec![(DVec3::new(0.0, 4.0, 10.0), DVec3::new(0.0, 0.0, -20.0))];
    Scene {
        name: "ground",
        boxes: vec![[-60.0, -1.0, -160.0, 60.0, 0.0, 20.0]],
        casts: false,
        sun: DVec3::new(0.5, -1.0, -0.35),
        walk,
    }
}

pub fn all() -> [Scene; 3] {
    [street(), posts(), ground()]
}
