// What every pass of a frame knows. All positions are relative to the camera position.
const int kMaxMaps = GNOMON_MAX_MAPS;  // gnomon::kMaxMaps

struct ShadowMap {
  mat4 clip_from_camera_relative;  // z 0 near the light .. w
  vec4 interval_size;              // depth_begin, depth_end, width, height
};

layout(std140, binding = 0) uniform Frame {
  mat4 clip_from_camera_relative;  // of the camera, z reversed: w near .. 0 far
  vec4 right;                      // xyz, and per pixel: slope (or world units, orthographic)
  vec4 up;                         // the same
  vec4 forward;                    // xyz, and 1 for an orthographic camera
  vec4 image_edges;                // left, right, bottom, top
  vec4 light;                      // xyz: the way it travels, unit; number of maps
  vec4 bias;                       // BiasOptions: constant, slope, normal offset, largest slope
  vec4 layer;                      // texels of a layer along x and y; kernel radius in texels; far depth of the camera
  ShadowMap maps[kMaxMaps];
} frame;
