//! Matrices and vectors of glam, which has the same order of columns.
use glam::{DMat4, DVec3, Mat4};

use crate::{Aabb, Camera, ClipSpace, Map, Result};

impl Camera {
    /// [`Camera::from_matrices`] of glam's.
    pub fn from_glam(
        view_from_world: DMat4,
        clip_from_view: DMat4,
        clip_space: &ClipSpace,
        width: i32,
        height: i32,
    ) -> Result<Self> {
        Self::from_matrices(
            &view_from_world.to_cols_array(),
            &clip_from_view.to_cols_array(),
            clip_space,
            width,
            height,
        )
    }
}

impl Map {
    /// Clip space of the map from world space.
    pub fn clip_from_world_glam(&self) -> DMat4 {
        DMat4::from_cols_array(&self.clip_from_world)
    }
    /// The same for points relative to [`Plan::origin`](crate::Plan::origin).
    pub fn clip_from_camera_relative_glam(&self) -> Mat4 {
        Mat4::from_cols_array(&self.clip_from_camera_relative)
    }
}

/// A box of its two corners.
pub fn aabb(least: DVec3, largest: DVec3) -> Aabb {
    [least.x, least.y, least.z, largest.x, largest.y, largest.z]
}
