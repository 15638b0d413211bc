//! What a program does with plans, and what is refused by name.
use gnomon::{
    Aabb, Boxes, Camera, CasterSet, History, Light, List, Map, PlanOptions, Point, Scene, Status, View, VisibleDepths,
};

fn camera() -> Camera {
    Camera::at([0.0, 3.0, 10.0], [0.0, -0.1, -1.0]).perspective(1.0, 1.5, 0.2, 250.0, 960, 640).unwrap()
}
fn sun() -> Light {
    Light::directional([0.4, -1.0, 0.3])
}
fn street() -> Vec<Aabb> {
    let houses = (0..40).map(|i| {
        let (x, z) = (20.0 * f64::from(i % 2) - 12.0, -5.0 * f64::from(i));
        [x, 0.0, z - 3.0, x + 4.0, 2.0 + f64::from(i % 7), z]
    });
    std::iter::once([-40.0, -1.0, -200.0, 40.0, 0.0, 20.0]).chain(houses).collect()
}
fn both<'a>(boxes: impl Into<Boxes<'a>>) -> Scene<'a> {
    let boxes = boxes.into();
    Scene { casters: boxes, receivers: boxes }
}
fn field<T: std::fmt::Debug>(result: gnomon::Result<T>) -> &'static str {
    result.unwrap_err().field()
}

#[test]
fn sets_histories_and_foreign_maps_give_what_lists_and_plans_do() {
    let (camera, boxes, options) = (camera(), street(), PlanOptions::default());
    let view = View::new(&camera);
    let plan = gnomon::plan(&view, &sun(), both(&boxes[..]), &options, None).unwrap();
    let mut set = CasterSet::new(&boxes).unwrap();
    assert_eq!(set.len(), boxes.len());
    let of_set = gnomon::plan(&view, &sun(), both(&set), &options, None).unwrap();
    assert_eq!(plan.maps().len(), of_set.maps().len());
    for (a, b) in plan.maps().iter().zip(of_set.maps()) {
        assert_eq!(a.clip_from_world, b.clip_from_world);
    }
    let mut of_list = vec![0; boxes.len()];
    let mut of_tree = of_list.clone();
    let found = plan.maps()[0].cull(boxes[..].into(), &mut of_list).unwrap();
    assert_eq!(plan.maps()[0].cull((&set).into(), &mut of_tree).unwrap(), found);
    of_tree[..found].sort_unstable();
    assert_eq!(of_list[..found], of_tree[..found]);
    assert!(found > 0);
    // No room is no fault: the count is what there is.
    assert_eq!(plan.maps()[0].cull(boxes[..].into(), &mut []).unwrap(), found);

    let foreign: Vec<Map> = plan
        .maps()
        .iter()
        .map(|map| {
            let mut own = Map::default();
            own.clip_from_world = map.clip_from_world;
            (own.width, own.height, own.depth_begin, own.depth_end) =
                (map.width, map.height, map.depth_begin, map.depth_end);
            own
        })
        .collect();
    let foreign =
        gnomon::Plan::foreign(&foreign, gnomon::OPENGL, gnomon::find(List::Selections, "view_depth").unwrap()).unwrap();
    let own = gnomon::measure(&plan, &view, both(&boxes[..]), &Default::default()).unwrap();
    let other = gnomon::measure(&foreign, &view, both(&boxes[..]), &Default::default()).unwrap();
    assert_eq!(own.samples, other.samples);
    assert!((own.p95 - other.p95).abs() < 1e-9 * own.p95);

    let mut history = History::new().unwrap();
    for _ in 0..3 {
        gnomon::plan(&view, &sun(), both(&boxes[..]), &options, Some(&mut history)).unwrap();
    }
    let mut copy = History::new().unwrap();
    copy.copy_from(&history);
    history.clear();
    set.refit(&boxes).unwrap();
    set.update(1, &boxes[2]).unwrap();
    assert_eq!(field(set.refit(&boxes[1..])), "count");
    assert_eq!(field(set.update(900, &boxes[0])), "index");
}

#[test]
fn points_find_their_map_and_their_error() {
    let (camera, boxes) = (camera(), street());
    let mut options = PlanOptions::default();
    options.fit = gnomon::find(List::Fits, "stable").unwrap();
    let plan = gnomon::plan(&View::new(&camera), &sun(), both(&boxes[..]), &options, None).unwrap();
    let points = [[0.0, 0.0, -5.0], [0.0, 0.0, 900.0]];
    let mut indices = [7; 2];
    plan.select(&points, &[15.0, -890.0], &mut indices).unwrap();
    assert!(indices[0] >= 0 && indices[1] == -1);
    let map = &plan.maps()[indices[0] as usize];
    let mut errors = [unsafe { std::mem::zeroed() }; 1];
    map.measure_points(&camera, &points[..1], Some(&[[0.0, 1.0, 0.0]]), &mut errors).unwrap();
    assert!(errors[0].m_max > 0.0 && errors[0].m_max.is_finite());
    assert_eq!(plan.shader_block([0, 0], 0.0).unwrap()[10] as usize, plan.maps().len());
    assert_eq!(map.rebased(plan.origin()).unwrap().clip_from_camera_relative, map.clip_from_camera_relative);
    assert_eq!(map.reuse(map, &plan.clip_space()).unwrap().kind, gnomon::sys::GNOMON_REUSE_IDENTICAL);
    assert!(!map.cull_planes().is_empty());
    assert!(!format!("{plan:?}").is_empty());

    let mut depths = VisibleDepths::default();
    depths.add(&[15.0, 30.0, f32::INFINITY]);
    assert_eq!(depths.range(), (15.0, 30.0));
    let known = View { depths: Some(&depths), points: &points[..1], ..View::new(&camera) };
    assert_eq!(gnomon::plan(&known, &sun(), both(&boxes[..]), &Default::default(), None).unwrap().status(), Status::Ok);
    let eyes = [camera, camera];
    assert_eq!(gnomon::plan_views(&eyes, &sun(), both(&boxes[..]), &Default::default()).unwrap().status(), Status::Ok);
}

#[test]
fn bad_input_is_refused_by_name() {
    let (camera, boxes) = (camera(), street());
    let view = View::new(&camera);
    let with = |change: fn(&mut PlanOptions)| {
        let mut options = PlanOptions::default();
        change(&mut options);
        field(gnomon::plan(&view, &sun(), both(&boxes[..]), &options, None))
    };
    assert_eq!(with(|o| o.cascades = 9), "plan_options.cascades");
    assert_eq!(with(|o| o.warp = i32::MAX), "plan_options.warp");
    assert_eq!(with(|o| o.fit = -1), "plan_options.fit");
    assert_eq!(with(|o| o.prune = u32::MAX), "plan_options.prune");
    assert_eq!(with(|o| o.filter_texels = f64::NAN), "plan_options.filter_texels");
    let nan: [Aabb; 1] = [[f64::NAN; 6]];
    assert_eq!(field(gnomon::plan(&view, &sun(), both(&nan), &Default::default(), None)), "scene.casters");
    assert_eq!(field(CasterSet::new(&nan)), "boxes");
    assert_eq!(
        field(gnomon::plan(&view, &Light::directional([0.0; 3]), both(&boxes[..]), &Default::default(), None)),
        "light.direction"
    );
    let mut light = sun();
    light.kind = 99;
    assert_eq!(field(gnomon::plan(&view, &light, both(&boxes[..]), &Default::default(), None)), "light.kind");
    assert_eq!(field(Camera::default().perspective(60.0, 1.0, 0.1, 9.0, 1, 1)), "fov_y");
    let error = Camera::from_matrices(&[f64::NAN; 16], &[0.0; 16], &gnomon::OPENGL, 1, 1).unwrap_err();
    assert!(!error.why().is_empty() && error.to_string().starts_with("not usable: "));
    assert_eq!(field(gnomon::find(List::Warps, "teapot")), "name");
    assert_eq!(field(gnomon::plan_views(&[], &sun(), both(&boxes[..]), &Default::default())), "count");
    assert_eq!(field(gnomon::plan_views(&[camera; 9], &sun(), both(&boxes[..]), &Default::default())), "count");

    let plan = gnomon::plan(&view, &sun(), both(&boxes[..]), &Default::default(), None).unwrap();
    let points: [Point; 1] = [[0.0; 3]];
    assert_eq!(field(plan.select(&points, &[], &mut [0])), "view_depths");
    assert_eq!(field(plan.select(&points, &[1.0], &mut [])), "indices");
    assert_eq!(field(plan.shader_block([-1, 0], 0.0)), "layer_width");
    let map = plan.maps()[0];
    let mut none: [gnomon::PointError; 0] = [];
    assert_eq!(field(map.measure_points(&camera, &points, None, &mut none)), "errors");
    assert_eq!(field(map.measure_points(&camera, &points, Some(&[]), &mut none)), "normals");
    assert_eq!(field(gnomon::Plan::foreign(&[map; 9], gnomon::OPENGL, 0)), "plan.map_count");
}

#[test]
fn fields_that_safe_code_may_set_lead_to_no_read_beyond_a_struct() {
    let (mut camera, boxes) = (camera(), street());
    let plan = gnomon::plan(&View::new(&camera), &sun(), both(&boxes[..]), &Default::default(), None).unwrap();
    camera.size = u32::MAX;
    let mut options = PlanOptions::default();
    options.size = u32::MAX;
    assert_eq!(
        gnomon::plan(&View::new(&camera), &sun(), both(&boxes[..]), &options, None).unwrap().status(),
        Status::Ok
    );
    let mut map = plan.maps()[0];
    map.size = u32::MAX;
    assert_eq!(map.rebased([0.0; 3]).unwrap().width, map.width);
    assert!(gnomon::Plan::foreign(&[map], gnomon::OPENGL, 0).unwrap().select(&[[0.0; 3]], &[1.0], &mut [0]).is_ok());
    for count in [i32::MIN, -1, 33, i32::MAX] {
        map.cull_plane_count = count;
        map.select_plane_count = count;
        assert!(map.cull_planes().len() <= 32 && map.select_planes().len() <= 4);
        assert!(map.cull(boxes[..].into(), &mut [0; 41]).is_err());
    }
}

#[cfg(feature = "glam")]
#[test]
fn matrices_of_glam_are_those_of_arrays() {
    use glam::{DMat4, DVec3};
    let view = DMat4::look_at_rh(DVec3::new(0.0, 3.0, 10.0), DVec3::new(0.0, 2.0, 0.0), DVec3::Y);
    let clip = DMat4::perspective_rh_gl(1.0, 1.5, 0.2, 250.0);
    let camera = Camera::from_glam(view, clip, &gnomon::OPENGL, 960, 640).unwrap();
    assert!((camera.position[1] - 3.0).abs() < 1e-9 && (camera.near_depth - 0.2).abs() < 1e-9);
    let ground = [gnomon::glam_types::aabb(DVec3::new(-40.0, -1.0, -200.0), DVec3::new(40.0, 0.0, 20.0))];
    let plan = gnomon::plan(&View::new(&camera), &sun(), both(&ground), &Default::default(), None).unwrap();
    let map = &plan.maps()[0];
    assert_eq!(map.clip_from_world_glam().to_cols_array(), map.clip_from_world);
    assert_eq!(map.clip_from_camera_relative_glam().to_cols_array(), map.clip_from_camera_relative);
}
