/* Does a program of C plan and measure with the installed library alone? Also compiled as C++11. Prints one
   line, or says what is wrong and ends with 1. */
#include <gnomon/c/gnomon.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

static int failed = 0;

static void expect(int holds, const char* what) {
  if (holds) return;
  printf("failed: %s\n", what);
  failed = 1;
}

int main(void) {
  const double boxes[2][6] = {{-40, -1, -200, 40, 0, 20}, {-4, 0, -30, 4, 6, -26}};
  const char* field = "";
  gnomon_camera camera;
  gnomon_view view;
  gnomon_light light;
  gnomon_scene scene;
  gnomon_plan_options options;
  gnomon_map maps[GNOMON_MAX_MAPS];
  gnomon_omission omissions[GNOMON_MAX_OMISSIONS];
  gnomon_plan plan;
  gnomon_stats stats;
  gnomon_history* history = gnomon_history_create();
  gnomon_caster_set* set = NULL;
  uint32_t indices[2];
  int64_t found = 0;
  int i;

  expect(strcmp(gnomon_version(), "0.1.0") == 0, "the version");
  expect(history != NULL, "a history");
  gnomon_camera_default(&camera, sizeof camera);
  camera.position[1] = 3.0;
  expect(gnomon_perspective(&camera, 1.0, 1.5, 0.2, 250.0, 960, 640, &field) == GNOMON_OK, "a camera");
  gnomon_view_default(&view, sizeof view);
  view.camera = &camera;
  gnomon_light_default(&light, sizeof light);
  light.direction[0] = 0.4;
  gnomon_scene_default(&scene, sizeof scene);
  scene.casters = scene.receivers = boxes[0];
  scene.caster_count = scene.receiver_count = 2;
  gnomon_plan_options_default(&options, sizeof options);
  options.warp = gnomon_find(GNOMON_WARPS, "lispsm");
  options.clip_space.zero_to_one = 1;
  gnomon_plan_default(&plan, sizeof plan);
  plan.maps = maps;
  plan.map_size = sizeof maps[0];
  plan.map_room = GNOMON_MAX_MAPS;
  plan.omissions = omissions;
  plan.omission_room = GNOMON_MAX_OMISSIONS;
  expect(gnomon_make_plan(&view, &light, &scene, &options, history, &plan, &field) == GNOMON_OK, "a plan");
  expect(plan.map_count > 0 && plan.map_count <= options.cascades, "maps");
  gnomon_stats_default(&stats, sizeof stats);
  expect(gnomon_measure(&plan, &view, &scene, NULL, &stats, &field) == GNOMON_OK, "an error");
  expect(stats.samples > 0 && stats.p95 > 0.0 && stats.p95 < 100.0, "an error in pixels per texel");
  expect(gnomon_caster_set_create(boxes[0], 2, &set, &field) == GNOMON_OK, "a set");
  for (i = 0; i < plan.map_count; ++i) {
    expect(gnomon_cull_set(&maps[i], set, indices, 2, &found, &field) == GNOMON_OK && found > 0, "casters");
    expect(maps[i].depth_begin < maps[i].depth_end && maps[i].size == sizeof maps[i], "a map");
  }
  for (i = 0; i < plan.omission_count; ++i) {
    gnomon_text text;
    gnomon_describe(&omissions[i], &text);
    expect(text.what[0] != '\0' && text.why[0] != '\0', "words for an omission");
  }
  options.split_lambda = (double)NAN;
  options.split_scheme = gnomon_find(GNOMON_SPLITS, "practical");
  expect(gnomon_make_plan(&view, &light, &scene, &options, NULL, &plan, &field) == GNOMON_INVALID_INPUT,
         "a refusal");
  expect(strcmp(field, "plan_options.split_lambda") == 0, "the name of the field");
  gnomon_caster_set_destroy(set);
  gnomon_history_destroy(history);
  if (!failed) printf("consumer of c: p95 %.17g, storage %.17g\n", stats.p95, stats.storage);
  return failed;
}
