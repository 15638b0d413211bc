// The triangles in Embree's hands: sixteen rays at a time, coordinates relative to the scene's centre.
#include <embree3/rtcore.h>

#include <array>
#include <cmath>
#include <string>

#include "embree_scene.hpp"

namespace gnomon::trace {
namespace {

constexpr std::size_t kPacket = 16;

/// Embree keeps the first member of a context as its own; the rest is ours.
struct FilterContext {
  RTCIntersectContext embree;
  const WorldTriangles* triangles;
  std::array<std::uint32_t, kPacket> except;
};

/// Takes back hits on the triangle that a ray is not to see, on what does not cast, and on what alpha masks
/// cut out.
void keep_true_hits(const RTCFilterFunctionNArguments* args) {
  const auto* context = reinterpret_cast<const FilterContext*>(args->context);
  for (unsigned i = 0; i < args->N; ++i) {
    if (args->valid[i] == 0) continue;
    const unsigned triangle = RTCHitN_primID(args->hit, args->N, i);
    const unsigned ray = RTCRayN_id(args->ray, args->N, i);
    const bool there =
        triangle != context->except[ray] && context->triangles->casts[triangle] &&
        context->triangles->is_there(triangle, static_cast<double>(RTCHitN_u(args->hit, args->N, i)),
                                     static_cast<double>(RTCHitN_v(args->hit, args->N, i)));
    if (!there) args->valid[i] = 0;
  }
}

class Native : public EmbreeScene {
 public:
  explicit Native(const WorldTriangles& triangles) : triangles_(triangles) {
    if (!triangles.bounds.empty()) centre_ = 0.5 * (triangles.bounds.min + triangles.bounds.max);
    device_ = rtcNewDevice(nullptr);
    if (device_ == nullptr)
      throw TraceError("Embree: no device: error " + std::to_string(rtcGetDeviceError(nullptr)));
    scene_ = rtcNewScene(device_);
    rtcSetSceneFlags(
        scene_, static_cast<RTCSceneFlags>(RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION));
    if (!triangles.corners.empty()) attach();
    rtcCommitScene(scene_);
    const RTCError error = rtcGetDeviceError(device_);
    if (error == RTC_ERROR_NONE) return;
    release();
    throw TraceError("Embree: the scene could not be built: error " + std::to_string(error));
  }
  ~Native() override { release(); }

  void occluded(std::span<const Ray> rays, std::span<std::uint8_t> out) const override {
    for (std::size_t i = 0; i < rays.size(); i += kPacket) {
      const std::size_t count = std::min(kPacket, rays.size() - i);
      packet(rays.subspan(i, count), out.subspan(i, count));
    }
  }

 private:
  void attach() {
    RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    const std::size_t count = triangles_.corners.size();
    auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), 3 * count));
    auto* indices = static_cast<unsigned*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(unsigned), count));
    if (vertices != nullptr && indices != nullptr) {
      for (std::size_t i = 0; i < 3 * count; ++i) {
        const glm::vec3 corner(triangles_.corners[i / 3][i % 3] - centre_);
        for (int a = 0; a < 3; ++a) vertices[3 * i + static_cast<std::size_t>(a)] = corner[a];
        indices[i] = static_cast<unsigned>(i);
      }
      rtcCommitGeometry(geometry);
      rtcAttachGeometry(scene_, geometry);
    }
    rtcReleaseGeometry(geometry);
  }

  void packet(std::span<const Ray> rays, std::span<std::uint8_t> out) const {
    alignas(64) std::array<int, kPacket> valid{};
    // Embree reads the lanes that are not valid, too.
    RTCRay16 packed{};
    FilterContext context;
    rtcInitIntersectContext(&context.embree);
    context.embree.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    context.embree.filter = keep_true_hits;
    context.triangles = &triangles_;
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const Ray& ray = rays[i];
      const glm::vec3 origin(ray.origin - centre_), direction(ray.direction);
      valid[i] = -1;
      packed.org_x[i] = origin.x;
      packed.org_y[i] = origin.y;
      packed.org_z[i] = origin.z;
      packed.dir_x[i] = direction.x;
      packed.dir_y[i] = direction.y;
      packed.dir_z[i] = direction.z;
      packed.tnear[i] = static_cast<float>(ray.begin);
      packed.tfar[i] = static_cast<float>(ray.end);
      packed.time[i] = 0.0f;
      packed.mask[i] = ~0u;
      packed.id[i] = static_cast<unsigned>(i);
      packed.flags[i] = 0;
      context.except[i] = ray.except;
    }
    rtcOccluded16(valid.data(), scene_, &context.embree, &packed);
    // Embree marks a stopped ray by an end of minus infinity.
    for (std::size_t i = 0; i < rays.size(); ++i)
      out[i] = std::isinf(packed.tfar[i]) && packed.tfar[i] < 0.0f ? 1 : 0;
  }

  void release() noexcept {
    if (scene_ != nullptr) rtcReleaseScene(scene_);
    if (device_ != nullptr) rtcReleaseDevice(device_);
  }

  const WorldTriangles& triangles_;
  glm::dvec3 centre_{0.0};
  RTCDevice device_ = nullptr;
  RTCScene scene_ = nullptr;
};

}  // namespace

bool built_with_embree() noexcept {
  return true;
}

std::unique_ptr<EmbreeScene> make_embree_scene(const WorldTriangles& triangles) {
  return std::make_unique<Native>(triangles);
}

}  // namespace gnomon::trace
