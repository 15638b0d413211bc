// Does make_plan keep its promises for any input at all: every double, flag and enumerator, NaN included?
#include <array>
#include <vector>

#include "fuzz.hpp"
#include "gnomon/motion.hpp"
#include "plan_promises.hpp"
#include "support/seeded_input.hpp"

namespace {

using namespace gnomon;
using fuzz::Bytes;
using fuzz::require;
using test::SeededInput;

constexpr std::size_t kMaxBoxes = 24;  // a plan's time grows with them, its branches do not

/// Pointers to everything in an input that is a number.
struct Fields {
  std::vector<double*> real;
  std::vector<int*> whole;
  std::vector<bool*> flag;
  std::vector<std::uint8_t*> name;

  void add(glm::dvec3& v) {
    for (int c = 0; c < 3; ++c) real.push_back(&v[c]);
  }
  void add(Box& box) {
    add(box.min);
    add(box.max);
  }
  template <class Enum>
  void add_name(Enum& value) {
    static_assert(sizeof(Enum) == 1);
    name.push_back(reinterpret_cast<std::uint8_t*>(&value));
  }
};

void add_camera(Camera& c, Fields& f) {
  f.add(c.position);
  f.add(c.forward);
  f.add(c.up);
  f.real.insert(f.real.end(), {&c.left, &c.right, &c.bottom, &c.top, &c.near_depth, &c.far_depth});
  f.whole.insert(f.whole.end(), {&c.width, &c.height});
  f.flag.push_back(&c.orthographic);
}

void add_light(Light& light, Fields& f) {
  if (auto* sun = std::get_if<DirectionalLight>(&light)) f.add(sun->direction);
  if (auto* spot = std::get_if<SpotLight>(&light)) {
    f.add(spot->position);
    f.add(spot->direction);
    f.real.insert(f.real.end(), {&spot->outer_radians, &spot->range});
  }
  if (auto* point = std::get_if<PointLight>(&light)) {
    f.add(point->position);
    f.real.push_back(&point->range);
  }
}

void add_options(PlanOptions& o, Fields& f) {
  f.add(o.warp.focus);
  f.real.insert(f.real.end(), {&o.resolution.max_error, &o.resolution.prune_error, &o.split.overlap,
                               &o.split.lambda, &o.split.pseudo_near, &o.warp.focus_weight, &o.filter.texels,
                               &o.filter.world, &o.bias.constant_texels, &o.bias.slope_texels,
                               &o.bias.normal_offset_texels, &o.bias.max_slope, &o.light_near_share});
  f.whole.insert(f.whole.end(), {&o.resolution.max_size, &o.cascades, &o.resolution.stable_size_steps,
                                 &o.split.face_slices});
  f.flag.insert(f.flag.end(), {&o.clip_space.reversed_z, &o.clip_space.y_down});
  f.add_name(o.split.partition);
  f.add_name(o.split.scheme);
  f.add_name(o.split.range);
  f.add_name(o.fit);
  f.add_name(o.warp.objective);
  f.add_name(o.clip_space.ndc_depth);
  f.add_name(o.clip_space.handedness);
}

Fields fields_of(SeededInput& in) {
  Fields f;
  add_camera(in.camera, f);
  add_light(in.light, f);
  for (Box& box : in.receivers) f.add(box);
  for (Box& box : in.casters) f.add(box);
  for (double& split : in.options.split.given) f.real.push_back(&split);
  f.real.insert(f.real.end(), {&in.depths.min, &in.depths.max});
  add_options(in.options, f);
  return f;
}

/// A made-up case, as a start that reaches deep, or nothing but what the bytes say.
void start(Bytes& bytes, SeededInput& in) {
  const auto kind = bytes.take<std::uint8_t>();
  if (kind < 0xc0) {
    test::seed_input(bytes.take<std::uint16_t>(),
                     kind < 0x60 ? test::Extremes::ordinary : test::Extremes::stiff, in);
    return;
  }
  if (kind % 3 == 1) in.light = SpotLight{};
  if (kind % 3 == 2) in.light = PointLight{};
  in.receivers.resize(bytes.take<std::uint8_t>() % kMaxBoxes);
  in.casters.resize(bytes.take<std::uint8_t>() % kMaxBoxes);
  const auto warps = all_warps();
  const auto warp = bytes.take<std::uint8_t>();
  in.options.warp.warp = warp < warps.size() ? warps[warp] : nullptr;
  if (bytes.take<std::uint8_t>() % 2 != 0) in.visible = &in.depths;
  const Fields f = fields_of(in);
  for (double* value : f.real) *value = bytes.take<double>();
  for (int* value : f.whole) *value = bytes.take<std::int32_t>();
}

/// Overwrites numbers, one after the other: which, and with what.
void change(Bytes& bytes, SeededInput& in) {
  const Fields f = fields_of(in);
  constexpr int kMaxChanges = 64;
  for (int i = 0; i < kMaxChanges && !bytes.empty(); ++i) {
    const auto what = bytes.take<std::uint8_t>();
    const auto which = bytes.take<std::uint16_t>();
    if (what < 0xa0) *f.real[which % f.real.size()] = bytes.take<double>();
    if (what >= 0xa0 && what < 0xc0) *f.whole[which % f.whole.size()] = bytes.take<std::int32_t>();
    if (what >= 0xc0 && what < 0xd0) *f.flag[which % f.flag.size()] = (bytes.take<std::uint8_t>() & 1) != 0;
    if (what >= 0xd0 && what < 0xf0) *f.name[which % f.name.size()] = bytes.take<std::uint8_t>();
    if (what >= 0xf0 && what < 0xf8) in.options.resolution.texel_budget = bytes.take<std::int64_t>();
    if (what >= 0xf8) in.options.prune.bits = bytes.take<std::uint32_t>();
  }
}

/// What is asked of a plan after it is made must hold as well.
void use(const ShadowPlan& plan, const SeededInput& in) {
  std::array<std::uint32_t, 4> list{};
  for (const ShadowMap& map : plan.maps()) {
    require(cull_casters(map, in.casters, list) <= in.casters.size(), "no more casters than there are");
    const bool bare = !in.options.prune.has(PruneRule::casterless_cascades) ||
                      !in.options.prune.has(PruneRule::casterless_faces);
    require(bare || !in.casters.empty() || plan.status != PlanStatus::ok,
            "maps only where there are casters");
  }
  const AliasingStats m = measure(plan, in.camera, in.bounds(), {4, 4, 4});
  require(!std::isnan(m.p50) && !std::isnan(m.p95) && !std::isnan(m.max), "an error that is a number");
  (void)map_serving(plan, in.camera.position + in.camera.forward, 1.0);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Bytes bytes(data, size);
  SeededInput in;
  start(bytes, in);
  change(bytes, in);
  const ShadowPlan plan = in.plan();
  fuzz::check_plan(plan, in.options);
  if (plan.status == PlanStatus::invalid_input) return 0;
  use(plan, in);
  PlanHistory history;
  for (int frame = 0; frame < 2; ++frame) {
    fuzz::check_plan(make_plan({in.camera, in.visible}, in.light, in.bounds(), in.options, &history),
                     in.options);
    require(history.event_count >= 0 && history.event_count <= kMaxMaps, "room for events");
    in.camera.position += in.camera.forward * 0.01;
  }
  return 0;
}
