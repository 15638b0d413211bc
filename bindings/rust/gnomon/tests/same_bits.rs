//! Do plans and errors have the bits of the native library? GNOMON_CASES names the file of c_dump_cases.
mod reader;

use gnomon::sys::*;
use gnomon::{Aabb, Camera, Light, Map, MeasureOptions, PlanOptions, Scene, Stats, Status, View};
use reader::{bytes, Reader};

#[test]
#[ignore = "takes the file of c_dump_cases: ./dev check rust"]
fn plans_and_errors_have_the_bits_of_the_native_library() {
    let file = std::fs::read(std::env::var("GNOMON_CASES").expect("GNOMON_CASES")).expect("the cases");
    let mut reader = Reader(&file);
    let mut options = MeasureOptions::default();
    (options.columns, options.rows, options.depths) = (9, 9, 7);
    let (mut plans, mut maps, mut refused) = (0, 0, 0);
    for number in 0..reader.count() {
        let (mut camera, mut light, mut plan_options) = (Camera::default(), Light::default(), PlanOptions::default());
        *camera = reader.take::<gnomon_camera>();
        *light = reader.take::<gnomon_light>();
        *plan_options = reader.take::<gnomon_plan_options>();
        let counts: [u32; 2] = reader.take();
        let (casters, receivers) = (reader.some::<Aabb>(counts[0] as usize), reader.some::<Aabb>(counts[1] as usize));
        let [status, count]: [i32; 2] = reader.take();
        let expected = reader.some::<gnomon_map>(count as usize);
        let scene = Scene { casters: casters[..].into(), receivers: receivers[..].into() };
        let view = View::new(&camera);
        let plan = match gnomon::plan(&view, &light, scene, &plan_options, None) {
            Ok(plan) => plan,
            Err(error) => {
                assert!(status == GNOMON_INVALID_INPUT && !error.field().is_empty(), "{number}: {error}");
                refused += 1;
                continue;
            }
        };
        assert_eq!(plan.status() as i32, status, "{number}");
        assert_eq!(plan.maps().len(), expected.len(), "{number}");
        for (map, expected) in plan.maps().iter().zip(&expected) {
            assert_eq!(bytes::<gnomon_map>(map), bytes(expected), "{number}");
        }
        maps += count;
        if plan.status() != Status::Ok {
            continue;
        }
        plans += 1;
        let stats: Stats = gnomon::measure(&plan, &view, scene, &options).unwrap();
        let expected: gnomon_stats = reader.take();
        assert_eq!(bytes::<gnomon_stats>(&stats), bytes(&expected), "{number}");
        // The same of maps that come from elsewhere.
        let foreign = gnomon::Plan::foreign(plan.maps(), plan.clip_space(), plan.selection()).unwrap();
        let stats: Stats = gnomon::measure(&foreign, &view, scene, &options).unwrap();
        assert_eq!(bytes::<gnomon_stats>(&stats), bytes(&expected), "{number}");
        let _: &Map = &foreign.maps()[0];
    }
    assert!(reader.0.is_empty() && plans > 100 && maps > 200);
    println!("{plans} plans, {maps} maps, {refused} refused");
}
