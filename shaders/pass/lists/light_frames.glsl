// The frame across the light in which casters are tested, and how far coordinates are rounded.
#ifndef GNOMON_LISTS_LIGHT_FRAMES_GLSL
#define GNOMON_LISTS_LIGHT_FRAMES_GLSL
#include "pass/common/grazing.glsl"

layout(std140, binding = 3) uniform LightFrames {
  vec4 row[3 * GNOMON_MAX_MAPS];  // per map: coordinates of a point relative to the camera
  vec4 light;  // 1: local; the scene's extent; how far a coordinate is rounded, per its size
} light_frames;

vec3 light_from_point(int map, vec3 position) {
  vec4 p = vec4(position, 1.0);
  return vec3(dot(light_frames.row[3 * map], p), dot(light_frames.row[3 * map + 1], p), dot(light_frames.row[3 * map + 2], p));
}
bool local_light() { return light_frames.light.x > 0.5; }

// A corner relative to the camera is rounded by this. Terms larger than the scene come of an object that lies far from its own
// origin: they mostly cancel without rounding.
float size_of_coordinates(vec3 position, float terms) { return max(length(position), min(terms, light_frames.light.y)); }
#endif
