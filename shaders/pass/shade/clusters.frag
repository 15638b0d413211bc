#version 450 core
// The light of many lights, summed up in one pass: each pixel takes those of its cluster, by a filter that reads depths itself.
#include "pass/mask/look_up.glsl"
#include "pass/shade/lit.glsl"
#include "library/light_clusters.glsl"

layout(std430, binding = 4) readonly buffer ClusterBegins {
  LightClusters clusters;
  uint cluster_begins[];
};
layout(std430, binding = 5) readonly buffer ClusterLights { uint cluster_lights[]; };
layout(location = 1) out vec4 light_out;

uint cluster_begin(uint at) { return cluster_begins[at]; }
uint cluster_light(uint at) { return cluster_lights[at]; }

// The mask is that of the last light that reaches the pixel.
void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  Surface s = surface_at(pixel);
  mask = vec2(1.0, -1.0);
  light_out = vec4(0.0);
  if (s.sky) return;
  precise vec3 sum = vec3(0.0);
  uvec2 range = cluster_range(clusters, pixel, s.depth);
  for (uint i = range.x; i < range.y; ++i) {
    own_light = own_lights[cluster_light(i)];
    if (falloff_at(own_light.record, s) == 0.0) continue;
    if (s.receives) mask = mask_of(s);
    precise vec3 added = s.albedo * kSunColor * own_light.brightness.rgb * light_on(own_light.record, s, mask.x);
    sum += added;
  }
  light_out = vec4(sum, 0.0);
}
