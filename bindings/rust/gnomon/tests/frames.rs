//! Are frames, atlases, clusters and pictures those of the native library, bit for bit? GNOMON_FRAMES names the file of
//! c_dump_frames, whose source has its order.
mod reader;

use gnomon::sys::*;
use gnomon::{
    Aabb, BiasWay, Camera, ClusterMemory, ClusterOptions, DepthTracker, Light, PlanOptions, Point, Scene,
    ShadowPicture, View, VisibleDepths,
};
use reader::{bytes, Reader};

/// A list with its length before it.
fn list<T: Copy>(file: &mut Reader) -> Vec<T> {
    let count = file.count();
    file.some(count)
}
fn bits(of: &[f64]) -> Vec<u64> {
    of.iter().map(|number| number.to_bits()).collect()
}
fn field<T>(result: gnomon::Result<T>) -> &'static str {
    match result {
        Ok(_) => panic!("not refused"),
        Err(error) => error.field(),
    }
}

/// `slats` of tests/c/dump_frames.cpp: a roof of slats, by the way of the light, unit.
fn slats(way: Point) -> impl Fn(Point) -> f64 {
    move |point| {
        let up = (6.0 - point[1]) / -way[1];
        let at = point[0] - way[0] * up + 0.4 * (point[2] - way[2] * up);
        if at - 8.0 * (at / 8.0).floor() < 3.0 {
            f64::NEG_INFINITY
        } else {
            up
        }
    }
}

#[test]
#[ignore = "takes the file of c_dump_frames: ./dev check rust"]
fn all_that_changes_from_frame_to_frame_has_the_bits_of_the_native_library() {
    let data = std::fs::read(std::env::var("GNOMON_FRAMES").expect("GNOMON_FRAMES")).expect("the frames");
    let mut file = Reader(&data);
    let (mut camera, mut sun, mut options) = (Camera::default(), Light::default(), PlanOptions::default());
    *camera = file.take::<gnomon_camera>();
    *sun = file.take::<gnomon_light>();
    *options = file.take::<gnomon_plan_options>();
    let boxes: Vec<Aabb> = list(&mut file);
    let scene = Scene { casters: boxes[..].into(), receivers: boxes[..].into() };
    let plan = gnomon::plan(&View::new(&camera), &sun, scene, &options, None).unwrap();
    let maps: Vec<gnomon_map> = list(&mut file);
    assert!(!maps.is_empty() && plan.maps().len() == maps.len());
    for (map, expected) in plan.maps().iter().zip(&maps) {
        assert_eq!(bytes::<gnomon_map>(map), bytes(expected));
    }

    for _ in 0..file.count() {
        let frame = file.take::<i64>() as u32;
        let offset: [f64; 2] = file.take();
        assert_eq!(bits(&gnomon::jitter_texels(frame)), bits(&offset));
        let mut moved = plan.clone();
        moved.jitter(offset).unwrap();
        for map in moved.maps() {
            assert_eq!(bytes::<gnomon_map>(map), bytes(&file.take::<gnomon_map>()), "frame {frame}");
        }
    }

    let points: Vec<Point> = list(&mut file);
    let view = View { points: &points, ..View::new(&camera) };
    let (mut held, mut turns) = ([0.0; 3], 0);
    for _ in 0..file.count() {
        let direction: Point = file.take();
        let expected: gnomon_held_sun = file.take();
        let casters = [-40.0, -1.0, -200.0, 40.0, 8.0, 20.0];
        let found = gnomon::hold_sun(&view, held, direction, &casters, 0.25, 0.05).unwrap();
        assert_eq!(bytes(&found), bytes(&expected));
        turns += i32::from(found.direction == direction);
        held = found.direction;
    }
    assert!(turns > 1 && turns < 50);

    let frames: [i32; 2] = file.take();
    let mut tracker = DepthTracker::new(frames[0], frames[1]).unwrap();
    for _ in 0..file.count() {
        let mut seen = VisibleDepths::default();
        seen.add(&list::<f32>(&mut file));
        let (followed, expected) = (tracker.update(&seen), file.take::<gnomon_visible_depths>());
        assert_eq!(bytes(&followed), bytes(&expected));
    }

    for _ in 0..file.count() {
        let size: [i32; 2] = file.take();
        let (atlas, expected) = (plan.pack_atlas(size[0], size[1]).unwrap(), file.take::<gnomon_atlas>());
        assert_eq!(bytes(&atlas), bytes(&expected));
        for map in 0..atlas.places().len() {
            let matrix = atlas.atlas_from_clip(&plan.clip_space(), map).unwrap();
            assert_eq!(bits(&matrix), bits(&file.take::<[f64; 16]>()));
        }
    }

    for _ in 0..file.count() {
        let [map, way]: [i32; 2] = file.take();
        let way = if way == 0 { BiasWay::Rasterizer } else { BiasWay::NormalOffset };
        let found = plan.engine_bias(map as usize, way, 1.5, 24).unwrap();
        assert_eq!(bytes(&found), bytes(&file.take::<gnomon_engine_bias>()));
        assert!(found.units > 0.0);
    }

    let lights: Vec<Light> = list::<gnomon_light>(&mut file)
        .into_iter()
        .map(|one| {
            let mut light = Light::default();
            *light = one;
            light
        })
        .collect();
    let cluster_options = ClusterOptions::default();
    for _ in 0..file.count() {
        let room = file.take::<i64>() as usize;
        let mut begin = vec![0; gnomon::cluster_count(&camera, &cluster_options) + 1];
        let (mut lists, mut work) = (vec![0; room], vec![0; gnomon::cluster_memory(lights.len(), room)]);
        let memory = ClusterMemory { begin: &mut begin, lights: &mut lists, work: &mut work };
        let found = gnomon::cluster_lights(&camera, &lights, &cluster_options, memory).unwrap();
        assert_eq!([found.tile_pixels, found.columns, found.rows, found.slices], file.take::<[i32; 4]>());
        assert_eq!(bits(&[found.depth_scale, found.depth_offset]), bits(&file.take::<[f64; 2]>()));
        assert_eq!(found.begin, list::<u32>(&mut file));
        assert_eq!(found.lights, list::<u32>(&mut file));
        assert!(found.of(0, 0, found.slices - 1).contains(&0));
        assert!(found.of(found.columns, 0, 0).is_empty() && found.of(-1, 0, 0).is_empty());
    }

    let mask: Vec<f32> = list(&mut file);
    let view_depths: Vec<f32> = file.some(mask.len());
    let distances: Vec<f32> = file.some(mask.len());
    let picture = ShadowPicture::new(&camera, &mask, &view_depths);
    let found = gnomon::expected_error(&plan, picture, 0.0).unwrap();
    assert_eq!(bytes(&found), bytes(&file.take::<gnomon_wrong_pixels>()));
    let averaged = gnomon::expected_error(&plan, picture, 1.5).unwrap();
    assert_eq!(bytes(&averaged), bytes(&file.take::<gnomon_wrong_pixels>()));
    let biased =
        gnomon::expected_error(&plan, ShadowPicture { occluder_distances: &distances, ..picture }, 1.5).unwrap();
    assert_eq!(bytes(&biased), bytes(&file.take::<gnomon_wrong_pixels>()));
    assert!(biased.wrong > averaged.wrong);
    assert!(found.wrong > averaged.wrong && averaged.wrong > 0.0);
    let roof = slats(file.take());
    let normals: Vec<[f32; 3]> = file.some(mask.len());
    let picture = ShadowPicture { occluder_distances: &distances, occluders: Some(&roof), ..picture };
    let searched = gnomon::expected_error(&plan, picture, 1.5).unwrap();
    assert_eq!(bytes(&searched), bytes(&file.take::<gnomon_wrong_pixels>()));
    let facing = gnomon::expected_error(&plan, ShadowPicture { normals: &normals, ..picture }, 0.0).unwrap();
    assert_eq!(bytes(&facing), bytes(&file.take::<gnomon_wrong_pixels>()));
    assert!(searched.wrong > 0.0 && facing.wrong > 0.0);
    assert!(format!("{picture:?}").contains("occluders: true"));
    let edges: Vec<Point> = list(&mut file);
    let mut points = vec![[0.0; 3]; edges.len()];
    assert_eq!(picture.edge_points(&mut points).unwrap(), edges.len());
    assert_eq!(points, edges);
    assert!(file.0.is_empty());
}

fn camera() -> Camera {
    Camera::at([0.0, 3.0, 10.0], [0.0, -0.1, -1.0]).perspective(1.0, 1.5, 0.2, 250.0, 96, 64).unwrap()
}
fn plan_of(boxes: &[Aabb]) -> gnomon::Plan {
    let scene = Scene { casters: boxes.into(), receivers: boxes.into() };
    let sun = Light::directional([0.4, -1.0, 0.3]);
    gnomon::plan(&View::new(&camera()), &sun, scene, &PlanOptions::default(), None).unwrap()
}
const BOXES: [Aabb; 2] = [[-40.0, -1.0, -200.0, 40.0, 0.0, 20.0], [-4.0, 0.0, -30.0, 4.0, 6.0, -26.0]];

#[test]
fn bad_input_is_refused_by_name() {
    let (camera, mut plan) = (camera(), plan_of(&BOXES));
    let before = plan.maps()[0];
    assert_eq!(field(plan.jitter([0.0, f64::NAN])), "offset");
    assert_eq!(before.clip_from_world, plan.maps()[0].clip_from_world);
    let (view, sun, casters) = (View::new(&camera), [0.0, -1.0, 0.0], [0.0; 6]);
    let hold = |held, sun, casters: &Aabb, most, sine| field(gnomon::hold_sun(&view, held, sun, casters, most, sine));
    assert_eq!(hold([f64::NAN; 3], sun, &casters, 0.25, 0.05), "held");
    assert_eq!(hold(sun, [0.0; 3], &casters, 0.25, 0.05), "sun");
    assert_eq!(hold(sun, sun, &[f64::INFINITY; 6], 0.25, 0.05), "casters");
    assert_eq!(hold(sun, sun, &casters, -1.0, 0.05), "most_pixels");
    assert_eq!(hold(sun, sun, &casters, 0.25, 2.0), "least_light_sine");
    assert_eq!(field(DepthTracker::new(0, 30)), "frames_per_bin");
    assert_eq!(field(DepthTracker::new(4, 65536)), "hold_frames");
    assert_eq!(field(plan.pack_atlas(-1, 0)), "width");
    assert_eq!(field(plan.pack_atlas(64, 0)), "height");
    let atlas = plan.pack_atlas(0, 0).unwrap();
    assert_eq!(field(atlas.atlas_from_clip(&gnomon::OPENGL, usize::MAX)), "map");
    let small = plan.pack_atlas(8, 8).unwrap();
    assert!(small.places().is_empty() && small.size() == [0, 0]);

    assert_eq!(field(plan.engine_bias(99, BiasWay::Rasterizer, 0.0, 0)), "map");
    assert_eq!(field(plan.engine_bias(0, BiasWay::NormalOffset, f64::NAN, 0)), "kernel_radius_texels");
    assert_eq!(field(plan.engine_bias(0, BiasWay::NormalOffset, 0.0, -1)), "depth_bits");

    let (mask, depths) = ([1.0f32; 96 * 64], [5.0f32; 96 * 64]);
    let picture = ShadowPicture::new(&camera, &mask, &depths);
    let expect = |picture| field(gnomon::expected_error(&plan, picture, 0.0));
    assert_eq!(expect(ShadowPicture { mask: &mask[1..], ..picture }), "shadow_picture.view_depths");
    assert_eq!(
        expect(ShadowPicture { mask: &mask[1..], view_depths: &depths[1..], ..picture }),
        "shadow_picture.pixel_count"
    );
    assert_eq!(
        expect(ShadowPicture { occluder_distances: &depths[1..], ..picture }),
        "shadow_picture.occluder_distances"
    );
    let normals = [[0.0, 1.0, 0.0]; 96 * 64];
    assert_eq!(expect(ShadowPicture { normals: &normals[1..], ..picture }), "shadow_picture.normals");
    assert_eq!(field(ShadowPicture { view_depths: &[], ..picture }.edge_points(&mut [])), "shadow_picture.view_depths");
    assert_eq!(picture.edge_points(&mut []).unwrap(), 0);
    let mut broken = camera;
    broken.near_depth = -1.0;
    assert_eq!(expect(ShadowPicture { camera: &broken, ..picture }), "camera.near_depth");
}

/// Expects the error of a ground that the camera sees from above, all lit, with these occluders.
fn search(occluders: &dyn Fn(Point) -> f64) -> f64 {
    let camera = Camera::at([0.0, 10.0, -20.0], [0.0, -1.0, 0.0]).orthographic(8.0, 1.0, 0.1, 20.0, 16, 16).unwrap();
    let (mask, depths) = ([1.0; 256], [10.0; 256]);
    let picture = ShadowPicture { occluders: Some(occluders), ..ShadowPicture::new(&camera, &mask, &depths) };
    gnomon::expected_error(&plan_of(&BOXES), picture, 0.0).unwrap().share
}

#[cfg(feature = "std")]
#[test]
fn a_panic_of_the_occluders_comes_out_of_the_call_and_they_are_not_called_again() {
    let called = std::cell::Cell::new(0);
    let count = |_| {
        called.set(called.get() + 1);
        f64::INFINITY
    };
    assert_eq!(search(&count), 1.0);
    assert!(called.get() > 10);
    called.set(0);
    let panicking = |point| {
        if count(point) > 0.0 && called.get() == 5 {
            std::panic::panic_any("of the occluders");
        }
        f64::INFINITY
    };
    let caught = std::panic::catch_unwind(std::panic::AssertUnwindSafe(|| search(&panicking))).unwrap_err();
    assert_eq!(caught.downcast_ref::<&str>(), Some(&"of the occluders"));
    assert_eq!(called.get(), 5);
}

#[cfg(not(feature = "std"))]
#[test]
fn without_std_a_panic_of_the_occluders_aborts() {
    use std::os::unix::process::ExitStatusExt;
    const CHILD: &str = "GNOMON_PANICS";
    assert_eq!(search(&|_| f64::NEG_INFINITY), 0.0);
    if std::env::var_os(CHILD).is_some() {
        // Where the panic unwinds, the test passes in the child.
        let _ = std::panic::catch_unwind(|| search(&|_| panic!("of the occluders")));
        return;
    }
    let child = std::process::Command::new(std::env::current_exe().unwrap())
        .args(["--nocapture", "--exact", "without_std_a_panic_of_the_occluders_aborts"])
        .env(CHILD, "1")
        .output()
        .unwrap();
    const SIGABRT: i32 = 6;
    assert_eq!(child.status.signal(), Some(SIGABRT), "{child:?}");
    assert!(String::from_utf8_lossy(&child.stderr).contains("occluders panicked"), "{child:?}");
}

#[test]
fn clusters_refuse_what_does_not_fit_and_read_nothing_beyond_a_light() {
    let camera = camera();
    let mut lights = [Light::point([0.0, 1.0, -9.0], 5.0); 3];
    // The call knows the size of a light by itself.
    lights[0].size = u32::MAX;
    let options = ClusterOptions::default();
    let list = |lights: &[Light], options: &ClusterOptions, begin: usize, room: usize, bytes: usize| {
        let (mut begin, mut lists, mut work) = (vec![0; begin], vec![0; room], vec![0; bytes]);
        let memory = ClusterMemory { begin: &mut begin, lights: &mut lists, work: &mut work };
        gnomon::cluster_lights(&camera, lights, options, memory).map(|found| found.lights.len())
    };
    let bytes = gnomon::cluster_memory(3, 100);
    // One cluster of all lights is what two begins hold.
    assert_eq!(list(&lights, &options, 2, 100, bytes), Ok(3));
    assert_eq!(field(list(&lights, &options, 1, 100, bytes)), "light_clusters.begin_room");
    assert_eq!(field(list(&lights, &options, 2, 2, bytes)), "light_clusters.light_room");
    assert_eq!(field(list(&lights, &options, 2, 100, bytes - 1)), "bytes");
    let tiles = ClusterOptions { tile_pixels: 0, ..options };
    assert_eq!(field(list(&lights, &tiles, 2, 100, bytes)), "light_clusters.tile_pixels");
    assert_eq!(gnomon::cluster_count(&camera, &tiles), 0);
    lights[2].kind = 9;
    assert_eq!(field(list(&lights, &options, 2, 100, bytes)), "light.kind");
    assert_eq!(gnomon::cluster_memory(usize::MAX, 0), 0);
}
