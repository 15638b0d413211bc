// What changes from frame to frame, for C: visible depths, jittered grids, and a sun that turns.
#include <cstdlib>

#include "c/convert.hpp"
#include "c/memory.hpp"
#include "geometry/usable.hpp"

struct gnomon_depth_tracker {
  gnomon::DepthTracker tracker;
};

namespace {

constexpr int32_t kMaxFrames = 65535;

bool usable_direction(const double* direction) noexcept {
  return direction != nullptr && gnomon::usable(gnomon::c::to_vector(direction));
}

}  // namespace

using namespace gnomon;
using namespace gnomon::c;

static_assert(kJitterFrames == GNOMON_JITTER_FRAMES);

extern "C" {

gnomon_depth_tracker* gnomon_depth_tracker_create(int32_t frames_per_bin, int32_t hold_frames) {
  if (frames_per_bin < 1 || frames_per_bin > kMaxFrames || hold_frames < 1 || hold_frames > kMaxFrames)
    return nullptr;
  auto* tracker = new_object<gnomon_depth_tracker>();
  if (tracker == nullptr) return nullptr;
  tracker->tracker.frames_per_bin = frames_per_bin;
  tracker->tracker.hold_frames = hold_frames;
  return tracker;
}
void gnomon_depth_tracker_destroy(gnomon_depth_tracker* tracker) {
  std::free(tracker);
}
void gnomon_depth_tracker_clear(gnomon_depth_tracker* tracker) {
  if (tracker != nullptr) tracker->tracker.clear();
}
int32_t gnomon_depth_tracker_update(gnomon_depth_tracker* tracker, const gnomon_visible_depths* frame,
                                    gnomon_visible_depths* depths, const char** invalid_field) {
  if (tracker == nullptr) return refuse("tracker", invalid_field);
  if (frame == nullptr) return refuse("frame", invalid_field);
  if (depths == nullptr) return refuse("depths", invalid_field);
  tracker->tracker.update(*reinterpret_cast<const VisibleDepths*>(frame));
  *reinterpret_cast<VisibleDepths*>(depths) = tracker->tracker.depths();
  return done(invalid_field);
}

int32_t gnomon_jitter_texels(uint32_t frame, double offset[2]) {
  if (offset == nullptr) return GNOMON_INVALID_INPUT;
  from_vector(jitter_texels(frame), offset);
  return GNOMON_OK;
}
int32_t gnomon_jitter(gnomon_plan* plan, const double offset[2], const char** invalid_field) {
  ShadowPlan p;
  if (const char* fault = to_plan(plan, p)) return refuse(fault, invalid_field);
  if (offset == nullptr || !usable(offset[0]) || !usable(offset[1])) return refuse("offset", invalid_field);
  gnomon_plan rooms;
  if (const char* fault = read(plan, rooms)) return refuse(fault, invalid_field);
  write_maps(jittered(p, {offset[0], offset[1]}).maps(), rooms);
  return done(invalid_field);
}

int32_t gnomon_hold_sun(const gnomon_view* view, const double held[3], const double sun[3],
                        const double casters[6], double most_pixels, double least_light_sine,
                        gnomon_held_sun* result, const char** invalid_field) {
  View v;
  if (const char* fault = to_view(view, v)) return refuse(fault, invalid_field);
  if (const char* fault = fault_of_view(v, {})) return refuse(fault, invalid_field);
  if (!usable_direction(held)) return refuse("held", invalid_field);
  if (!usable_direction(sun) || to_vector(sun) == glm::dvec3(0.0)) return refuse("sun", invalid_field);
  if (casters == nullptr) return refuse("casters", invalid_field);
  const Box box{to_vector(casters), to_vector(casters + 3)};
  if (!usable(box)) return refuse("casters", invalid_field);
  if (!(most_pixels >= 0.0 && usable(most_pixels))) return refuse("most_pixels", invalid_field);
  if (!(least_light_sine >= 0.0 && least_light_sine <= 1.0)) return refuse("least_light_sine", invalid_field);
  if (result == nullptr) return refuse("result", invalid_field);
  const HeldSun found = hold_sun(v, to_vector(held), to_vector(sun), box, most_pixels, least_light_sine);
  from_vector(found.direction, result->direction);
  result->error_pixels = found.error_pixels;
  result->turned_pixels = found.turned_pixels;
  result->points_capped = static_cast<int64_t>(found.points_capped);
  return done(invalid_field);
}

}  // extern "C"
