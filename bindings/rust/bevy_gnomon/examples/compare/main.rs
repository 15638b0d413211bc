//! How good are gnomon's maps in Bevy, beside its own cascades? Two walks at equal texels, against exact rays, without a window.
//!
//!   cargo run --example compare -- [FOLDER] [--frames N]   FOLDER gets pictures, and captures of Bevy's cascades for gnomon judge
//!
//! Ends with 1 where the light's cascades differ from the plan, Bevy's culling leaves out a caster that a map of the plan needs, or
//! gnomon's maps have more misclassified pixels than Bevy's.
mod exact;
mod scenes;
mod stage;

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use bevy::light::ShadowFilteringMethod;
use bevy::prelude::DirectionalLight;
use bevy_gnomon::{CLIP_SPACE, capture, kernel_radius_texels, normal_bias};
use exact::Pixel;
use gnomon::{List, Map, Plan, PlanOptions, View};
use scenes::Scene;
use stage::{Stage, Way};

const SIZE: [u32; 2] = [640, 360];
const MAP_SIZE: usize = 512;
const FILTERS: [(&str, ShadowFilteringMethod); 2] =
    [("2x2", ShadowFilteringMethod::Hardware2x2), ("5x5", ShadowFilteringMethod::Gaussian)];

struct Row {
    name: &'static str,
    way: Way,
    wrong: usize,
    counted: usize,
    m_p95: Vec<f64>,
    first: Vec<bool>, // of the first frame: lit pixels
    picture: Vec<u8>,
}

fn rows(filter: ShadowFilteringMethod) -> Vec<Row> {
    let options = PlanOptions::default();
    let mut stable = options;
    stable.fit = gnomon::find(List::Fits, "stable").expect("a name of the library");
    let defaults = [DirectionalLight::DEFAULT_SHADOW_DEPTH_BIAS, DirectionalLight::DEFAULT_SHADOW_NORMAL_BIAS];
    let ways = [
        ("Bevy", Way::Bevy(defaults)),
        ("Bevy, gnomon's bias", Way::Bevy([0.0, normal_bias(&options, kernel_radius_texels(filter))])),
        ("gnomon, fit stable", Way::Gnomon(Box::new(stable))),
        ("gnomon", Way::Gnomon(Box::new(options))),
    ];
    ways.map(|(name, way)| Row { name, way, wrong: 0, counted: 0, m_p95: vec![], first: vec![], picture: vec![] })
        .into()
}

/// Light of a pixel, linear; the colors are alike.
fn light(picture: &[u8], pixel: usize) -> f32 {
    let c = f32::from(picture[4 * pixel + 1]) / 255.0;
    if c <= 0.04045 { c / 12.92 } else { ((c + 0.055) / 1.055).powf(2.4) }
}

/// Bevy's cascades as a plan, so that they are measured as gnomon's are.
fn foreign(stage: &Stage) -> gnomon::Result<Plan> {
    let mut begin = scenes::NEAR;
    let maps: Vec<Map> = stage
        .cascades()
        .into_iter()
        .map(|(matrix, end)| {
            let mut map = Map::default();
            map.clip_from_world = matrix.as_dmat4().to_cols_array();
            (map.width, map.height) = (MAP_SIZE as i32, MAP_SIZE as i32);
            (map.depth_begin, map.depth_end) = (begin, f64::from(end));
            begin = map.depth_end;
            map
        })
        .collect();
    Plan::foreign(&maps, CLIP_SPACE, gnomon::find(List::Selections, "view_depth")?)
}

fn p95(plan: &Plan, stage: &Stage, scene: &Scene) -> gnomon::Result<f64> {
    let boxes = scene.boxes.as_slice();
    let bounds = gnomon::Scene { casters: boxes.into(), receivers: boxes.into() };
    let camera = stage.camera();
    gnomon::measure(plan, &View::new(&camera), bounds, &Default::default()).map(|stats| stats.p95)
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}

/// Bevy's default beside gnomon's, above the same with misclassified pixels in red.
fn write_picture(file: &Path, exact: &[Pixel], rows: [&Row; 2]) -> std::io::Result<()> {
    let [width, height] = SIZE.map(|n| n as usize);
    let mut out = vec![0; 2 * width * 2 * height * 3];
    for (side, row) in rows.into_iter().enumerate() {
        for (pixel, &exact) in exact.iter().enumerate() {
            for half in 0..2 {
                let at = 3 * (((pixel / width + half * height) * 2 + side) * width + pixel % width);
                for c in 0..3 {
                    let shown = row.picture[4 * pixel + c];
                    out[at + c] = match (half, is_wrong(exact, row.first[pixel])) {
                        (0, _) => shown,
                        (_, true) => [255, 40, 40][c],
                        _ => 150 + shown / 5 * 2,
                    };
                }
            }
        }
    }
    let mut encoder = png::Encoder::new(std::fs::File::create(file)?, 2 * SIZE[0], 2 * SIZE[1]);
    encoder.set_color(png::ColorType::Rgb);
    Ok(encoder.write_header()?.write_image_data(&out)?)
}

fn is_wrong(exact: Pixel, lit: bool) -> bool {
    exact != Pixel::Uncounted && lit != (exact == Pixel::Lit)
}

/// False where something is not as it should be.
fn compare(stage: &mut Stage, scene: &Scene, frames: usize, folder: Option<&Path>) -> gnomon::Result<bool> {
    stage.load(scene);
    let mut all = FILTERS.map(|(_, filter)| rows(filter));
    let (mut unlike, mut culled, mut captures, mut first_exact) = (0, 0, vec![], vec![]);
    for frame in 0..frames.min(scene.walk.len()) {
        let (eye, target) = scene.walk[frame];
        stage.look(eye.as_vec3(), target.as_vec3());
        let exact = exact::picture(scene, frame, SIZE);
        let [full, none] = [Way::Unshadowed, Way::Unlit].map(|way| {
            stage.use_way(&way, ShadowFilteringMethod::Hardware2x2);
            stage.draw()
        });
        for (rows, (_, filter)) in all.iter_mut().zip(FILTERS) {
            for row in rows {
                stage.use_way(&row.way, filter);
                let picture = stage.draw();
                let plan = match row.way {
                    Way::Gnomon(_) => {
                        let (plan, same) = stage.plan();
                        unlike += usize::from(!same);
                        plan
                    }
                    _ => foreign(stage)?,
                };
                row.m_p95.push(p95(&plan, stage, scene)?);
                let lit: Vec<bool> = (0..exact.len())
                    .map(|i| {
                        let [full, none, own] = [&full, &none, &picture].map(|p| light(p, i));
                        own - none > 0.5 * (full - none)
                    })
                    .collect();
                row.wrong += exact.iter().zip(&lit).filter(|&(&exact, &lit)| is_wrong(exact, lit)).count();
                row.counted += exact.iter().filter(|&&exact| exact != Pixel::Uncounted).count();
                if frame == 0 && row.name == "gnomon" {
                    stage.cull(false);
                    culled += stage.draw().chunks(4).zip(picture.chunks(4)).filter(|(all, own)| all != own).count();
                    stage.cull(true);
                }
                if frame == 0 {
                    (row.first, row.picture) = (lit, picture);
                }
                if row.name == "Bevy" && filter == ShadowFilteringMethod::Gaussian {
                    captures.push(stage.captured(filter));
                }
            }
        }
        if frame == 0 {
            first_exact = exact;
        }
    }
    let mut good = unlike == 0 && culled == 0;
    for (rows, (filter, _)) in all.iter().zip(FILTERS) {
        for row in rows {
            let percent = 100.0 * row.wrong as f64 / row.counted as f64;
            println!(
                "| {} | {filter} | {} | {percent:.3} % | {:.2} |",
                scene.name,
                row.name,
                median(row.m_p95.clone())
            );
        }
        good = good && rows[3].wrong <= rows[..2].iter().map(|row| row.wrong).min().unwrap_or(0);
    }
    if unlike > 0 {
        eprintln!("compare: {unlike} frames of {} whose cascades differ from the plan", scene.name);
    }
    if culled > 0 {
        eprintln!("compare: Bevy's culling changes {culled} pixels of {}", scene.name);
    }
    if let Some(folder) = folder {
        let written = std::fs::create_dir_all(folder).and_then(|()| {
            let texts: Vec<String> = captures.iter().map(|(text, _)| text.clone()).collect();
            let text = capture::file(&format!("Bevy, {}", scene.name), &captures[0].1, &texts);
            std::fs::write(folder.join(format!("bevy_{}.json", scene.name)), text)?;
            write_picture(&folder.join(format!("{}.png", scene.name)), &first_exact, [&all[0][0], &all[0][3]])
        });
        if let Err(error) = written {
            eprintln!("compare: {}: {error}", folder.display());
            good = false;
        }
    }
    Ok(good)
}

fn main() -> ExitCode {
    let (mut folder, mut frames) = (None::<PathBuf>, usize::MAX);
    let mut given = std::env::args().skip(1);
    while let Some(word) = given.next() {
        if word == "--frames" {
            frames = given.next().and_then(|n| n.parse().ok()).filter(|&n| n > 0).unwrap_or(0);
        } else if word.starts_with('-') || folder.is_some() {
            frames = 0;
        } else {
            folder = Some(word.into());
        }
    }
    if frames == 0 {
        eprintln!("usage: compare [FOLDER] [--frames N]");
        return ExitCode::from(2);
    }
    let mut stage = Stage::new(SIZE, MAP_SIZE);
    println!(
        "Bevy 0.19 on {}, {} x {} pixels, 4 maps of {MAP_SIZE} x {MAP_SIZE} texels",
        stage.device(),
        SIZE[0],
        SIZE[1]
    );
    println!("\n| scene | filter | maps | misclassified | m p95 |\n|--|--|--|--:|--:|");
    let mut good = true;
    for scene in scenes::all() {
        match compare(&mut stage, &scene, frames, folder.as_deref()) {
            Ok(as_it_should_be) => good = good && as_it_should_be,
            Err(error) => {
                eprintln!("compare: {error}");
                return ExitCode::from(2);
            }
        }
    }
    ExitCode::from(u8::from(!good))
}
