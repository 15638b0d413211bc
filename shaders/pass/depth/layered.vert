#version 450 core
// Casters into several maps of a plan in one pass: each instance names the layer it is drawn into. The same positions
// in the same order of operations as depth.vert, so that every bit of a depth is the same.
#extension GL_ARB_shader_viewport_layer_array : enable
#ifndef GL_ARB_shader_viewport_layer_array
#extension GL_AMD_vertex_shader_layer : enable
#endif
#include "pass/common/objects.glsl"

layout(location = 0) in vec3 position_object;
layout(location = 2) in vec2 texcoord;
layout(location = 3) in uint object_and_map;  // the map in the bits above
layout(location = 10) uniform mat4 clip_from_position[GNOMON_MAX_MAPS];
layout(location = 0) out vec2 texcoord_out;

const uint map_shift = 28u;  // as kMapShift of layered_maps.hpp

void main() {
  uint map = object_and_map >> map_shift, object_index = object_and_map & ((1u << map_shift) - 1u);
  gl_Position = clip_from_position[map] * vec4(relative_from_object(object_index, position_object), 1.0);
  gl_Layer = int(map);
  texcoord_out = texcoord;
}
