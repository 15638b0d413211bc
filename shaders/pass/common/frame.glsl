// The uniform block that every pass of a frame reads. All positions are relative to the camera position.
#ifndef GNOMON_COMMON_FRAME_GLSL
#define GNOMON_COMMON_FRAME_GLSL
#include "library/shadow_map.glsl"

const int kMaxMaps = GNOMON_MAX_MAPS;  // gnomon::kMaxMaps

layout(std140, binding = 0) uniform Frame {
  mat4 clip_from_camera_relative;  // of the camera, z reversed: w near .. 0 far
  vec4 right;                      // xyz, and per pixel: slope (or world units, orthographic)
  vec4 up;                         // the same
  vec4 forward;                    // xyz, and 1 for an orthographic camera
  vec4 image_edges;                // left, right, bottom, top
  vec4 light;                      // xyz: direction of travel, for local lights along the axis; w: number of maps
  vec4 light_place;                // as light_at takes it; w is 2 where the light falls by the inverse square
  vec4 light_cone;                 // way of its axis; cosine of its half angle, -1: none
  vec4 bias;                       // BiasOptions: constant, slope, normal offset, largest slope
  vec4 layer;                      // texels of a layer along x and y; range of the light, 0: none; view depth of thick air
  vec4 selection;                  // as map_serving takes it; SplitTransition; SampleNoise; what moves the noise in this frame
  ShadowMap maps[kMaxMaps];
} frame;

// The same of one light: the frame's, or one of many.
struct LightRecord {
  vec4 light;
  vec4 light_place;
  vec4 light_cone;
  vec4 bias;
  vec4 layer;
  vec4 selection;
};
LightRecord light_of_frame() {
  return LightRecord(frame.light, frame.light_place, frame.light_cone, frame.bias, frame.layer, frame.selection);
}
#endif
