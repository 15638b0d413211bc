//! Boxes, a sun and a camera in Bevy, drawn without a window.
use std::sync::{Arc, Mutex};

use bevy::camera::RenderTarget;
use bevy::camera::visibility::NoFrustumCulling;
use bevy::core_pipeline::tonemapping::Tonemapping;
use bevy::light::{
    CascadeShadowConfig, CascadeShadowConfigBuilder, Cascades, DirectionalLightShadowMap, NotShadowCaster,
    ShadowFilteringMethod,
};
use bevy::prelude::*;
use bevy::render::gpu_readback::{Readback, ReadbackComplete};
use bevy::render::render_resource::{TextureFormat, TextureUsages};
use bevy::render::renderer::RenderAdapterInfo;
use bevy::window::ExitCondition;
use bevy_gnomon::{Boxes, GnomonPlugin, GnomonShadows, MeshBounds, capture};
use gnomon::{Plan, PlanOptions};

use crate::scenes::{FAR, FOV_Y, NEAR, Scene};

const SUN_LUX: f32 = 2600.0;

#[derive(Clone)]
pub enum Way {
    /// Bevy's cascades with `shadow_depth_bias` and `shadow_normal_bias`.
    Bevy([f32; 2]),
    Gnomon(Box<PlanOptions>),
    /// The sun without shadows, and no sun: what a pixel's light is counted between.
    Unshadowed,
    Unlit,
}

pub struct Stage {
    app: App,
    camera: Entity,
    light: Entity,
    target: Handle<Image>,
    received: Arc<Mutex<Option<Vec<u8>>>>,
}

impl Stage {
    pub fn new([width, height]: [u32; 2], map_size: usize) -> Self {
        let mut app = App::new();
        let window = WindowPlugin { primary_window: None, exit_condition: ExitCondition::DontExit, ..default() };
        app.add_plugins((DefaultPlugins.set(window), GnomonPlugin))
            .insert_resource(DirectionalLightShadowMap { size: map_size })
            .insert_resource(GlobalAmbientLight { brightness: 200.0, ..default() })
            .insert_resource(ClearColor(Color::srgb(0.62, 0.74, 0.9)));
        app.finish();
        app.cleanup();
        let mut image = Image::new_target_texture(width, height, TextureFormat::Rgba8UnormSrgb, None);
        image.texture_descriptor.usage |= TextureUsages::COPY_SRC;
        let target = app.world_mut().resource_mut::<Assets<Image>>().add(image);
        let projection = PerspectiveProjection { fov: FOV_Y as f32, near: NEAR as f32, far: FAR as f32, ..default() };
        let camera = app
            .world_mut()
            .spawn((
                Camera3d::default(),
                RenderTarget::Image(target.clone().into()),
                Projection::Perspective(projection),
                Tonemapping::None,
                Msaa::Off,
            ))
            .id();
        let light = app.world_mut().spawn(DirectionalLight::default()).id();
        Self { app, camera, light, target, received: default() }
    }

    pub fn device(&self) -> String {
        let info = self.app.world().resource::<RenderAdapterInfo>();
        format!("{}, {:?}", info.name, info.backend)
    }

    pub fn load(&mut self, scene: &Scene) {
        let world = self.app.world_mut();
        let old: Vec<Entity> = world.query_filtered::<Entity, With<Mesh3d>>().iter(world).collect();
        for entity in old {
            world.despawn(entity);
        }
        let material = world.resource_mut::<Assets<StandardMaterial>>().add(StandardMaterial {
            base_color: Color::linear_rgb(0.8, 0.77, 0.72),
            perceptual_roughness: 0.5,
            reflectance: 0.0,
            ..default()
        });
        for one in &scene.boxes {
            let [least, largest] = [&one[..3], &one[3..]].map(|at| Vec3::new(at[0] as f32, at[1] as f32, at[2] as f32));
            let mesh = world.resource_mut::<Assets<Mesh>>().add(Cuboid::from_corners(least, largest));
            let mut mesh = world.spawn((
                Mesh3d(mesh),
                MeshMaterial3d(material.clone()),
                Transform::from_translation(0.5 * (least + largest)),
            ));
            if !scene.casts {
                mesh.insert(NotShadowCaster);
            }
        }
        world.entity_mut(self.light).insert(Transform::default().looking_to(scene.sun.as_vec3(), Vec3::Y));
        self.settle();
    }

    pub fn look(&mut self, eye: Vec3, target: Vec3) {
        let at = Transform::from_translation(eye).looking_at(target, Vec3::Y);
        self.app.world_mut().entity_mut(self.camera).insert(at);
    }

    pub fn use_way(&mut self, way: &Way, filter: ShadowFilteringMethod) {
        let world = self.app.world_mut();
        world.entity_mut(self.camera).insert(filter);
        let mut light = world.entity_mut(self.light);
        let mut sun = DirectionalLight { illuminance: SUN_LUX, shadow_maps_enabled: true, ..default() };
        light.remove::<GnomonShadows>();
        match way {
            Way::Bevy([depth, normal]) => (sun.shadow_depth_bias, sun.shadow_normal_bias) = (*depth, *normal),
            Way::Gnomon(options) => _ = light.insert(GnomonShadows::new(**options)),
            Way::Unshadowed => sun.shadow_maps_enabled = false,
            Way::Unlit => (sun.illuminance, sun.shadow_maps_enabled) = (0.0, false),
        }
        let own: CascadeShadowConfig = CascadeShadowConfigBuilder { maximum_distance: FAR as f32, ..default() }.into();
        light.insert((sun, own));
    }

    /// Whether Bevy leaves out meshes beside a camera's or a map's frustum.
    pub fn cull(&mut self, culls: bool) {
        let world = self.app.world_mut();
        let all: Vec<Entity> = world.query_filtered::<Entity, With<Mesh3d>>().iter(world).collect();
        for mesh in all {
            match culls {
                true => world.entity_mut(mesh).remove::<NoFrustumCulling>(),
                false => world.entity_mut(mesh).insert(NoFrustumCulling),
            };
        }
    }

    /// Meshes, materials and pipelines are ready a few frames after they came.
    fn settle(&mut self) {
        for _ in 0..3 {
            self.app.update();
        }
    }

    /// The picture, red, green, blue and alpha in sRGB, rows top to bottom.
    pub fn draw(&mut self) -> Vec<u8> {
        self.settle();
        self.received.lock().expect("no thread panics").take();
        let received = self.received.clone();
        let reader = self
            .app
            .world_mut()
            .spawn(Readback::texture(self.target.clone()))
            .observe(move |event: On<ReadbackComplete>| {
                received.lock().expect("no thread panics").get_or_insert_with(|| event.data.clone());
            })
            .id();
        for _ in 0..100 {
            self.app.update();
            if let Some(picture) = self.received.lock().expect("no thread panics").take() {
                self.app.world_mut().despawn(reader);
                return picture;
            }
        }
        panic!("no picture came back in 100 frames");
    }

    /// The plan that was drawn, and whether the light has its matrices and depths to the last bit.
    pub fn plan(&self) -> (Plan, bool) {
        let light = self.app.world().entity(self.light);
        let plan = light.get::<GnomonShadows>().and_then(GnomonShadows::plan).expect("a frame was planned");
        let plan = plan.as_ref().unwrap_or_else(|error| panic!("{error}")).clone();
        let (own, bounds) = (self.cascades(), &light.get::<CascadeShadowConfig>().expect("of the light").bounds);
        let same = own.len() == plan.maps().len()
            && plan.maps().iter().zip(&own).zip(bounds).all(|((map, &(matrix, _)), &end)| {
                map.clip_from_world_glam().as_mat4() == matrix && map.depth_end as f32 == end
            });
        (plan, same)
    }

    /// clip_from_world of each cascade, and where it ends.
    pub fn cascades(&self) -> Vec<(Mat4, f32)> {
        let light = self.app.world().entity(self.light);
        let own = &light.get::<Cascades>().expect("of the light").cascades[&self.camera];
        let bounds = &light.get::<CascadeShadowConfig>().expect("of the light").bounds;
        own.iter().map(|cascade| cascade.clip_from_world).zip(bounds.iter().copied()).collect()
    }

    pub fn camera(&self) -> gnomon::Camera {
        let camera = self.app.world().entity(self.camera);
        let (own, at, projection) = camera.components::<(&Camera, &GlobalTransform, &Projection)>();
        bevy_gnomon::camera_of(own, at, projection).unwrap_or_else(|error| panic!("{error}"))
    }

    /// An entry of a capture's frames, and the boxes of its scene.
    pub fn captured(&mut self, filter: ShadowFilteringMethod) -> (String, Boxes) {
        let world = self.app.world_mut();
        let boxes = Boxes::of(world.query_filtered::<MeshBounds, With<Mesh3d>>().iter(world));
        let size = world.resource::<DirectionalLightShadowMap>().size;
        let camera = world.entity(self.camera).components::<(Entity, &Camera, &GlobalTransform, &Projection)>();
        let light = world
            .entity(self.light)
            .components::<(&GlobalTransform, &DirectionalLight, &CascadeShadowConfig, &Cascades)>();
        (capture::frame(camera, light, size, filter), boxes)
    }
}
