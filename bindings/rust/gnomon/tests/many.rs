//! Pages and many lights: the same as by the calls of C, pools from frame to frame, and what is refused by name.
use std::mem::MaybeUninit;
use std::ptr::{null, null_mut};

use gnomon::sys::*;
use gnomon::{
    light_memory, page_memory, page_table_size, plan_lights, plan_pages, Aabb, Camera, KeptPage, Light, LightHistory,
    LightMaps, LightOptions, LightRequest, List, MemoryBlock, PageHistory, PageOptions, PageSlot, PlanOptions, Point,
    Scene, ShadowPicture, View,
};

const BOXES: [Aabb; 3] =
    [[-40.0, -1.0, -200.0, 40.0, 0.0, 20.0], [-4.0, 0.0, -30.0, 4.0, 6.0, -26.0], [2.0, 0.0, -9.0, 3.0, 4.0, -8.0]];

fn camera() -> Camera {
    Camera::at([0.0, 3.0, 10.0], [0.0, -0.1, -1.0]).perspective(1.0, 1.5, 0.2, 250.0, 960, 640).unwrap()
}
fn scene() -> Scene<'static> {
    Scene { casters: (&BOXES).into(), receivers: (&BOXES).into() }
}
fn sun() -> Light {
    Light::directional([0.4, -1.0, 0.3])
}
fn ground() -> Vec<Point> {
    (0..3000).map(|i| [0.5 * f64::from(i % 31) - 8.0, 0.0, 5.0 - 0.05 * f64::from(i)]).collect()
}
fn options() -> PageOptions {
    let mut options = PageOptions::default();
    options.capacity = 512;
    let mut base = PlanOptions::default();
    base.fit = gnomon::find(List::Fits, "stable").unwrap();
    options.base = Some(base);
    options
}
fn field<T: std::fmt::Debug>(result: gnomon::Result<T>) -> &'static str {
    result.unwrap_err().field()
}
fn words(of: &gnomon_page) -> [u32; 5] {
    [of.level, of.column as u32, of.row as u32, of.slot, of.points]
}

#[test]
fn pages_are_those_of_the_calls_of_c() {
    let (camera, points) = (camera(), ground());
    let normals = vec![[0.0, 1.0, 0.0]; points.len()];
    let view = View { points: &points, normals: &normals, ..View::new(&camera) };
    let options = options();
    let mut memory = vec![MemoryBlock::default(); page_memory(512, points.len()).unwrap()];
    let plan = plan_pages(&view, &sun(), scene(), &options, None, &mut memory).unwrap();

    let mut raw_memory = vec![MemoryBlock::default(); page_memory(512, points.len()).unwrap()];
    let raw = unsafe {
        let (mut view, mut scene, mut plan) =
            (MaybeUninit::uninit(), MaybeUninit::uninit(), MaybeUninit::<gnomon_page_plan>::uninit());
        gnomon_view_default(view.as_mut_ptr(), std::mem::size_of::<gnomon_view>() as u32);
        gnomon_scene_default(scene.as_mut_ptr(), std::mem::size_of::<gnomon_scene>() as u32);
        gnomon_page_plan_default(plan.as_mut_ptr(), std::mem::size_of::<gnomon_page_plan>() as u32);
        let (mut view, mut scene): (gnomon_view, gnomon_scene) = (view.assume_init(), scene.assume_init());
        view.camera = &*camera;
        (view.points, view.normals, view.point_count) =
            (points.as_ptr().cast(), normals.as_ptr().cast(), points.len() as i64);
        (scene.casters, scene.caster_count) = (BOXES.as_ptr().cast(), 3);
        (scene.receivers, scene.receiver_count) = (BOXES.as_ptr().cast(), 3);
        let mut settings: gnomon_page_options = *options;
        settings.plan = &**options.base.as_ref().unwrap();
        let bytes = 16 * raw_memory.len() as i64;
        let status = gnomon_plan_pages(
            &view,
            &*sun(),
            &scene,
            &settings,
            null(),
            raw_memory.as_mut_ptr().cast(),
            bytes,
            plan.as_mut_ptr(),
            null_mut(),
        );
        assert_eq!(status, GNOMON_OK);
        plan.assume_init()
    };
    let raw_pages = unsafe { std::slice::from_raw_parts(raw.pages, raw.page_count as usize) };
    assert!(plan.pages().len() > 20);
    assert!(plan.pages().iter().map(words).eq(raw_pages.iter().map(words)));
    assert_eq!(plan.table(), unsafe { std::slice::from_raw_parts(raw.table, raw.table_count as usize) });
    assert_eq!(plan.level_count(), raw.level_count as usize);
    assert_eq!((plan.page_texels(), plan.target_m()), ((raw.page_texels, raw.border_texels), raw.target_m));

    // A roof of beams, one unit wide, over ground that is seen from above.
    let beams = |point: Point| if point[0].rem_euclid(2.0) < 1.0 { 4.0 - point[1] } else { f64::NEG_INFINITY };
    unsafe extern "C" fn beams_in_c(_: *const std::ffi::c_void, point: *const f64) -> f64 {
        if (*point).rem_euclid(2.0) < 1.0 {
            4.0 - *point.add(1)
        } else {
            f64::NEG_INFINITY
        }
    }
    let above = Camera::at([0.0, 10.0, -20.0], [0.0, -1.0, 0.0]).orthographic(8.0, 1.0, 0.1, 20.0, 64, 64).unwrap();
    let (mask, depths) = ([1.0; 64 * 64], [10.0; 64 * 64]);
    let picture = ShadowPicture { occluders: Some(&beams), ..ShadowPicture::new(&above, &mask, &depths) };
    let expected = plan.expected_error(picture, 1.5).unwrap();
    let mut in_c = MaybeUninit::<gnomon_shadow_picture>::uninit();
    let mut raw_expected = gnomon_wrong_pixels { wrong: 0.0, counted: 0.0, share: 0.0 };
    unsafe {
        gnomon_shadow_picture_default(in_c.as_mut_ptr(), std::mem::size_of::<gnomon_shadow_picture>() as u32);
        let mut in_c = in_c.assume_init();
        (in_c.camera, in_c.mask, in_c.view_depths) = (&*above, mask.as_ptr(), depths.as_ptr());
        (in_c.pixel_count, in_c.kernel_texels) = (64 * 64, 1.5);
        in_c.occluder_search = Some(beams_in_c);
        assert_eq!(gnomon_expected_page_error(&raw, &in_c, &mut raw_expected, null_mut()), GNOMON_OK);
    }
    assert_eq!(expected.wrong.to_bits(), raw_expected.wrong.to_bits());
    assert!(expected.counted == 4096.0 && expected.share > 0.2 && expected.share < 0.8);
    assert_eq!(field(plan.expected_error(ShadowPicture { mask: &[], ..picture }, 0.0)), "shadow_picture.view_depths");

    let mut indices = vec![-1; points.len()];
    plan.select(&points, &mut indices).unwrap();
    assert!(indices.iter().all(|&i| (i as usize) < plan.pages().len()));
    // A page holds the point that it serves.
    let map = plan.page_map(indices[0] as usize).unwrap();
    let clip = |row: usize| -> f64 {
        (0..4).map(|c| map.clip_from_world[4 * c + row] * [points[0][0], points[0][1], points[0][2], 1.0][c]).sum()
    };
    assert!(clip(0).abs() <= clip(3) && clip(1).abs() <= clip(3));
    assert!(plan.level(0).unwrap().width >= map.width);
    let (stats, share) = plan.measure(&view, scene(), &Default::default()).unwrap();
    assert!(stats.samples > 0 && stats.p95 <= 1.5 && share > 0.0);
    assert!(format!("{plan:?}").contains("pages"));
}

#[test]
fn a_pool_draws_pages_once_and_those_that_a_moved_caster_touches_again() {
    let (camera, points) = (camera(), ground());
    let (view, options) = (View { points: &points, ..View::new(&camera) }, options());
    let mut memory = vec![MemoryBlock::default(); page_memory(512, points.len()).unwrap()];
    let plan = plan_pages(&view, &sun(), scene(), &options, None, &mut memory).unwrap();
    let (mut slots, mut table) = (vec![PageSlot::default(); 512], vec![0; page_table_size(512)]);
    let mut kept = vec![KeptPage { slot: 0, draw: 0, compose: 0, reserved: [0; 2] }; plan.pages().len()];
    assert!(slots[0].clip_from_world().is_none());
    assert_eq!(plan.keep(&[], &mut slots, &mut table, &mut kept).unwrap(), plan.pages().len());
    assert_eq!(slots[kept[0].slot as usize].clip_from_world(), Some(&plan.page_map(0).unwrap().clip_from_world));
    assert_eq!(plan.keep(&[], &mut slots, &mut table, &mut kept).unwrap(), 0);
    let drawn = plan.keep(&BOXES[2..], &mut slots, &mut table, &mut kept).unwrap();
    assert!(drawn > 0 && drawn < plan.pages().len());
    assert_eq!(kept.iter().filter(|page| page.draw != 0).count(), drawn);

    // The next frame knows the last one, which lies in other memory.
    let mut other = vec![MemoryBlock::default(); page_memory(512, points.len()).unwrap()];
    let feedback = vec![GNOMON_SHADOW_EDGE as u8; points.len()];
    let history = PageHistory { last: Some(&plan), feedback: &feedback };
    let next = plan_pages(&view, &sun(), scene(), &options, Some(history), &mut other).unwrap();
    assert!(!next.pages().is_empty());

    assert_eq!(field(plan.keep(&[], &mut slots, &mut table[1..], &mut kept)), "table");
    assert_eq!(field(plan.keep(&[], &mut slots, &mut table, &mut [])), "kept");
    let mut few = [PageSlot::default(); 2];
    assert_eq!(field(plan.keep(&[], &mut few, &mut table, &mut kept)), "slot_count");
    assert_eq!(field(plan.keep(&[[f64::NAN; 6]], &mut slots, &mut table, &mut kept)), "moved");
    assert_eq!(field(plan.level(99)), "level");
    assert_eq!(field(plan.page_map(usize::MAX)), "page");
    assert_eq!(field(plan.select(&points, &mut [])), "indices");
    let mut memory = vec![MemoryBlock::default(); page_memory(512, points.len()).unwrap()];
    let history = PageHistory { last: None, feedback: &feedback[1..] };
    assert_eq!(
        field(plan_pages(&view, &sun(), scene(), &options, Some(history), &mut memory)),
        "page_history.feedback"
    );
    let blocks = memory.len();
    assert_eq!(field(plan_pages(&view, &sun(), scene(), &options, None, &mut memory[..blocks / 2])), "bytes");
    let odd = View { normals: &points[1..], ..view };
    assert_eq!(field(plan_pages(&odd, &sun(), scene(), &options, None, &mut memory)), "view.normals");
    let mut broken = options;
    broken.policy = -7;
    assert_eq!(field(plan_pages(&view, &sun(), scene(), &broken, None, &mut memory)), "page_options.policy");
    assert_eq!(field(page_memory(0, 0)), "capacity, points");
}

#[test]
fn lights_share_a_pool_and_a_history() {
    let camera = camera();
    let lamps = [
        Light::point([0.0, 4.0, -9.0], 20.0),
        Light::spot([3.0, 6.0, -20.0], [0.0, -1.0, 0.0], 0.6, 30.0),
        Light::point([900.0, 4.0, -9.0], 2.0),
    ];
    let requests: Vec<_> = lamps.iter().map(|lamp| LightRequest::new(lamp).costs(10.0, 1000.0)).collect();
    let mut memory = vec![MemoryBlock::default(); light_memory(3, 0).unwrap()];
    let (mut maps, mut options) = ([LightMaps::default(); 3], LightOptions::default());
    options.texel_budget = 1 << 20;
    let mut history = LightHistory::new(3).unwrap();
    let view = View::new(&camera);
    let mut first = 0;
    for frame in 0..3 {
        let plan =
            plan_lights(&view, &requests, scene(), &options, Some(&mut history), &mut memory, &mut maps).unwrap();
        assert_eq!((plan.lights().len(), plan.mapped), (3, 2));
        assert!(plan.texels > 0 && plan.texels <= 1 << 20);
        assert!(plan.lights()[2].places().is_empty() && plan.lights()[2].outcome == GNOMON_LIGHT_WITHOUT_RECEIVER);
        for (i, lamp) in lamps.iter().enumerate().take(2) {
            let atlas = plan.atlas(i).unwrap();
            assert_eq!(atlas.size(), [plan.pool_width, plan.pool_height]);
            assert_eq!(atlas.places().len(), plan.lights()[i].places().len());
            let own = options.plan_options(&plan.lights()[i]).unwrap();
            assert_eq!(own.resolution_max_size, plan.lights()[i].texels);
            assert!(lamp.camera_round(&camera).unwrap().far_depth > 0.0);
        }
        assert_eq!(field(plan.atlas(3)), "light");
        if frame == 0 {
            first = plan.due;
        }
        assert!(plan.due <= first);
    }
    history.swap(0, 1);
    history.forget(99);

    let weighted: Vec<_> = lamps.iter().map(|lamp| LightRequest::new(lamp).weight(f64::NAN).changed(true)).collect();
    let plan = |requests: &[LightRequest], memory: &mut [MemoryBlock], maps: &mut [LightMaps]| {
        field(plan_lights(&view, requests, scene(), &options, None, memory, maps))
    };
    assert_eq!(plan(&weighted, &mut memory, &mut maps), "light_request.weight");
    assert_eq!(plan(&requests, &mut memory[1..], &mut maps), "bytes");
    assert_eq!(plan(&requests, &mut memory, &mut maps[1..]), "light_plan.light_room");
    // A size that safe code may set is refused, and not read.
    let mut light = lamps[0];
    light.size = u32::MAX;
    assert_eq!(plan(&[LightRequest::new(&light)], &mut memory, &mut maps), "light.size");
    assert_eq!(field(LightHistory::new(usize::MAX)), "lights");
    assert_eq!(field(light_memory(1 << 20, 0)), "lights, points");
}
