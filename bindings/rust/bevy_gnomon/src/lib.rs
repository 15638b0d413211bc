//! gnomon's shadow maps for Bevy's directional light, in place of its own cascades.
//!
//! ```no_run
//! use bevy::prelude::*;
//! use bevy_gnomon::{GnomonPlugin, GnomonShadows};
//!
//! fn sun(mut commands: Commands) {
//!     commands.spawn((DirectionalLight { shadow_maps_enabled: true, ..default() }, GnomonShadows::default()));
//! }
//! App::new().add_plugins((DefaultPlugins, GnomonPlugin)).add_systems(Startup, sun);
//! ```
//!
//! [`capture`] writes the cascades that a light has, Bevy's own as well, as a file for `gnomon judge`.
use bevy::camera::primitives::Aabb;
use bevy::camera::visibility::VisibilitySystems;
use bevy::light::cascade::Cascade;
use bevy::light::{
    CascadeShadowConfig, Cascades, DirectionalLight, DirectionalLightShadowMap, NotShadowCaster, NotShadowReceiver,
    ShadowFilteringMethod, SimulationLightSystems,
};
use bevy::math::Affine3A;
use bevy::prelude::*;
use gnomon::{BiasWay, ClipSpace, History, Light, List, Plan, PlanOptions, Scene, View};

pub mod capture;

/// Bevy's clip space: depths of 0..1, reversed, y up.
pub const CLIP_SPACE: ClipSpace = ClipSpace { zero_to_one: 1, reversed_z: 1, ..gnomon::OPENGL };
/// As many cascades as Bevy's shaders take for a light.
pub const MAX_CASCADES: i32 = 4;

/// A directional light whose shadow maps are gnomon's. Each frame overwrites the light's [`Cascades`], the `bounds` and the overlap
/// of its [`CascadeShadowConfig`], and its biases. It serves one `Camera3d`: with several active ones, and where a plan is refused,
/// Bevy's cascades stay, over the last bounds.
#[derive(Component, Default)]
pub struct GnomonShadows {
    /// Of the plan. Size, filter and clip space of the maps are taken from Bevy, and so is a limit of four cascades.
    pub options: PlanOptions,
    plan: Option<Result<Plan, Refused>>,
    history: Option<History>,
}

impl GnomonShadows {
    /// With these options.
    pub fn new(options: PlanOptions) -> Self {
        Self { options, ..default() }
    }
    /// What the last frame planned, or what it refused. None: no frame yet, or no single camera.
    pub fn plan(&self) -> Option<&Result<Plan, Refused>> {
        self.plan.as_ref()
    }
}

/// Why a frame keeps Bevy's cascades.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Refused {
    /// gnomon cannot use the camera, the sun or an option.
    Input(gnomon::Error),
    /// Bevy's shaders cannot read such maps: they differ in size, bend lines, or are selected otherwise than by view depth.
    Maps,
}

impl From<gnomon::Error> for Refused {
    fn from(error: gnomon::Error) -> Self {
        Self::Input(error)
    }
}

impl std::fmt::Display for Refused {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Input(error) => error.fmt(f),
            Self::Maps => {
                f.write_str("not usable: maps that differ in size, bend lines, or are not selected by view depth")
            }
        }
    }
}
impl std::error::Error for Refused {}

/// Plans the maps of each light with [`GnomonShadows`], between Bevy's cascades and the frusta that cull by them.
pub struct GnomonPlugin;

impl Plugin for GnomonPlugin {
    fn build(&self, app: &mut App) {
        app.add_systems(
            PostUpdate,
            overwrite_cascades
                .after(SimulationLightSystems::UpdateDirectionalLightCascades)
                .after(VisibilitySystems::CalculateBounds)
                .before(SimulationLightSystems::UpdateLightFrusta),
        );
    }
}

/// How far Bevy's filters read from a point, texels.
pub fn kernel_radius_texels(method: ShadowFilteringMethod) -> f64 {
    match method {
        ShadowFilteringMethod::Hardware2x2 => 0.5,
        _ => 2.0, // a kernel of 5 x 5
    }
}

/// The `shadow_normal_bias` that keeps planes from shadowing themselves under a kernel of this radius, with no
/// `shadow_depth_bias`: the same for all cascades, since Bevy multiplies it by their texels' diagonals. A move along the normal is
/// at least as long along the light, so it replaces the constant as well.
pub fn normal_bias(options: &PlanOptions, kernel_radius_texels: f64) -> f32 {
    (options.bias_slope_texels + kernel_radius_texels + options.bias_constant_texels) as f32
}

/// A box in the world.
pub type WorldBox = gnomon::Aabb;

/// The bounds of a mesh in the world.
pub fn world_box(aabb: &Aabb, transform: &GlobalTransform) -> WorldBox {
    let Affine3A { matrix3, .. } = transform.affine();
    let center = transform.affine().transform_point3a(aabb.center).as_dvec3();
    let half = (matrix3.abs() * aabb.half_extents).as_dvec3();
    gnomon::glam_types::aabb(center - half, center + half)
}

/// Bounds of meshes that cast, and of those that receive.
#[derive(Default)]
pub struct Boxes {
    /// Without those of [`NotShadowCaster`].
    pub casters: Vec<WorldBox>,
    /// Without those of [`NotShadowReceiver`].
    pub receivers: Vec<WorldBox>,
}

/// What [`Boxes::of`] reads.
pub type MeshBounds<'a> =
    (&'a Aabb, &'a GlobalTransform, &'a InheritedVisibility, Has<NotShadowCaster>, Has<NotShadowReceiver>);

impl Boxes {
    /// Of all meshes that are not hidden.
    pub fn of<'a>(
        meshes: impl Iterator<Item = (&'a Aabb, &'a GlobalTransform, &'a InheritedVisibility, bool, bool)>,
    ) -> Self {
        let mut boxes = Self::default();
        for (aabb, transform, visibility, not_caster, not_receiver) in meshes {
            if !visibility.get() {
                continue;
            }
            let bounds = world_box(aabb, transform);
            if !not_caster {
                boxes.casters.push(bounds);
            }
            if !not_receiver {
                boxes.receivers.push(bounds);
            }
        }
        boxes
    }
}

/// gnomon's camera of a camera of Bevy.
pub fn camera_of(
    camera: &Camera,
    transform: &GlobalTransform,
    projection: &Projection,
) -> gnomon::Result<gnomon::Camera> {
    let size = camera.physical_viewport_size().unwrap_or(UVec2::ONE).as_ivec2();
    let view_from_world = transform.to_matrix().as_dmat4().inverse();
    gnomon::Camera::from_glam(view_from_world, projection.get_clip_from_view().as_dmat4(), &CLIP_SPACE, size.x, size.y)
}

type ViewParts<'a> = (Entity, &'a Camera, &'a GlobalTransform, &'a Projection, Option<&'a ShadowFilteringMethod>);

fn overwrite_cascades(
    mut lights: Query<(
        &mut GnomonShadows,
        &GlobalTransform,
        &mut DirectionalLight,
        &mut CascadeShadowConfig,
        &mut Cascades,
    )>,
    cameras: Query<ViewParts, With<Camera3d>>,
    meshes: Query<MeshBounds, With<Mesh3d>>,
    map_size: Res<DirectionalLightShadowMap>,
) {
    let mut active = cameras.iter().filter(|(_, camera, ..)| camera.is_active);
    let (Some((view, camera, at, projection, filter)), None) = (active.next(), active.next()) else {
        return;
    };
    let boxes = Boxes::of(meshes.iter());
    let radius = kernel_radius_texels(filter.copied().unwrap_or_default());
    for (mut shadows, transform, mut light, mut config, mut cascades) in &mut lights {
        if !light.shadow_maps_enabled {
            continue;
        }
        let options = options_for(&shadows.options, map_size.size, radius);
        let planned = camera_of(camera, at, projection).map_err(Refused::from).and_then(|camera| {
            let plan = planned(&camera, transform, &boxes, &options, &mut shadows.history)?;
            let own = (0..plan.maps().len()).map(|i| cascade(&plan, i, transform, radius, &options));
            let own = own.collect::<gnomon::Result<Vec<_>>>()?;
            Ok((plan, own))
        });
        shadows.plan = Some(planned.map(|(plan, own)| {
            config.bounds = plan.maps().iter().map(|map| map.depth_end as f32).collect();
            config.overlap_proportion = 0.0;
            light.shadow_depth_bias = 0.0;
            light.shadow_normal_bias = normal_bias(&options, radius);
            cascades.cascades.insert(view, own);
            plan
        }));
    }
}

/// A plan whose maps Bevy's shaders can read.
fn planned(
    camera: &gnomon::Camera,
    light: &GlobalTransform,
    boxes: &Boxes,
    options: &PlanOptions,
    history: &mut Option<History>,
) -> Result<Plan, Refused> {
    if history.is_none() {
        *history = Some(History::new()?);
    }
    let sun = Light::directional(light.forward().as_dvec3().to_array());
    let scene = Scene { casters: boxes.casters.as_slice().into(), receivers: boxes.receivers.as_slice().into() };
    let plan = gnomon::plan(&View::new(camera), &sun, scene, options, history.as_mut())?;
    let (linear, size) = (gnomon::find(List::Shapes, "linear")?, options.resolution_max_size);
    let readable = plan.maps().len() <= MAX_CASCADES as usize
        && plan.selection() == gnomon::find(List::Selections, "view_depth")?
        && plan.maps().iter().all(|map| map.shape == linear && (map.width, map.height) == (size, size));
    if readable { Ok(plan) } else { Err(Refused::Maps) }
}

/// With what Bevy decides.
fn options_for(asked: &PlanOptions, map_size: usize, radius: f64) -> PlanOptions {
    let mut options = *asked;
    options.cascades = options.cascades.min(MAX_CASCADES);
    options.resolution_max_size = map_size as i32;
    options.filter_texels = radius;
    options.clip_space = CLIP_SPACE;
    options
}

/// A map as Bevy has it. Its view is turned like the light, at the world's origin.
fn cascade(
    plan: &Plan,
    index: usize,
    light: &GlobalTransform,
    radius: f64,
    options: &PlanOptions,
) -> gnomon::Result<Cascade> {
    let clip_from_world = plan.maps()[index].clip_from_world_glam();
    let world_from_cascade = Mat4::from_quat(light.rotation());
    let bias = plan.engine_bias(index, BiasWay::NormalOffset, radius, 0)?;
    // Bevy counts sides of square texels, and multiplies them by the root of 2.
    let diagonal = bias.normal_world / (options.bias_slope_texels + radius);
    Ok(Cascade {
        world_from_cascade,
        clip_from_cascade: (clip_from_world * world_from_cascade.as_dmat4()).as_mat4(),
        clip_from_world: clip_from_world.as_mat4(),
        texel_size: (diagonal * std::f64::consts::FRAC_1_SQRT_2) as f32,
    })
}

#[cfg(test)]
mod tests {
    use bevy::math::Vec3A;

    use super::*;

    #[test]
    fn bounds_of_a_turned_mesh() {
        let aabb = Aabb { center: Vec3A::new(1.0, 0.0, 0.0), half_extents: Vec3A::new(3.0, 2.0, 1.0) };
        let quarter = Transform::from_rotation(Quat::from_rotation_z(std::f32::consts::FRAC_PI_2));
        let turned = GlobalTransform::from(quarter.with_translation(Vec3::new(10.0, 20.0, 30.0)));
        let bounds = world_box(&aabb, &turned);
        for (found, expected) in bounds.into_iter().zip([8.0, 18.0, 29.0, 12.0, 24.0, 31.0]) {
            assert!((found - expected).abs() < 1e-5, "{bounds:?}");
        }
    }

    fn camera() -> gnomon::Camera {
        let camera = gnomon::Camera::at([0.0, 3.0, 10.0], [0.0, -0.1, -1.0]);
        camera.perspective(1.0, 1.5, 0.1, 250.0, 960, 640).unwrap()
    }
    fn sun() -> GlobalTransform {
        Transform::default().looking_to(Vec3::new(0.4, -1.0, 0.3), Vec3::Y).into()
    }
    fn boxes() -> Boxes {
        let boxes = vec![[-40.0, -1.0, -200.0, 40.0, 0.0, 20.0], [-4.0, 0.0, -30.0, 4.0, 6.0, -26.0]];
        Boxes { casters: boxes.clone(), receivers: boxes }
    }

    #[test]
    fn maps_that_bevy_cannot_read() {
        let plan = |change: &dyn Fn(&mut PlanOptions)| {
            let mut options = PlanOptions::default();
            change(&mut options);
            planned(&camera(), &sun(), &boxes(), &options_for(&options, 512, 0.5), &mut None)
                .map(|plan| plan.maps().len())
        };
        assert_eq!(plan(&|_| ()), Ok(4));
        assert_eq!(plan(&|options| options.cascades = 8), Ok(4));
        assert_eq!(plan(&|options| options.resolution_texel_budget = 400_000), Err(Refused::Maps));
        let finest = gnomon::find(List::Selections, "finest").unwrap();
        assert_eq!(plan(&|options| options.split_selection = finest), Err(Refused::Maps));
        assert!(matches!(plan(&|options| options.bias_max_slope = f64::NAN), Err(Refused::Input(_))));
    }

    /// Bevy's move along the normal is at least what each map needs, and not much more.
    #[test]
    fn bias_of_each_cascade() {
        for radius in [0.5, 2.0] {
            let options = options_for(&PlanOptions::default(), 512, radius);
            let plan = planned(&camera(), &sun(), &boxes(), &options, &mut None).unwrap();
            assert!(plan.maps().len() > 1);
            for (i, map) in plan.maps().iter().enumerate() {
                let own = cascade(&plan, i, &sun(), radius, &options).unwrap();
                let needed =
                    plan.engine_bias(i, BiasWay::NormalOffset, radius, 0).unwrap().normal_world + map.bias_constant;
                let along_normal = f64::from(normal_bias(&options, radius) * std::f32::consts::SQRT_2 * own.texel_size);
                assert!(
                    along_normal > 0.999 * needed && along_normal < 1.2 * needed,
                    "{i}: {along_normal} for {needed}"
                );
                let product = own.clip_from_cascade * own.world_from_cascade.inverse();
                assert!(product.abs_diff_eq(own.clip_from_world, 1e-4), "{product} and {}", own.clip_from_world);
            }
        }
    }
}
