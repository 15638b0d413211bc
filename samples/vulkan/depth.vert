// A depth pass by a plan. LAYERED, MULTIVIEW: all maps at once, each in its layer.
#version 450
#ifdef MULTIVIEW
#extension GL_EXT_multiview : require
#endif
#ifdef LAYERED
#extension GL_ARB_shader_viewport_layer_array : require
#endif

layout(std140, binding = 0) uniform Shadows { mat4 clip_from_point[8]; };  // the first part of ShadowData
layout(push_constant) uniform Push {
  vec4 eye;
  int map;
};
layout(location = 0) in vec3 position;  // world

void main() {
#if defined(MULTIVIEW)
  int index = gl_ViewIndex;
#elif defined(LAYERED)
  int index = gl_InstanceIndex;
  gl_Layer = index;
#else
  int index = map;
#endif
  gl_Position = clip_from_point[index] * vec4(position - eye.xyz, 1.0);
}
