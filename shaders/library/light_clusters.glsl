// The list of lights for a pixel: gnomon::cluster_at over the lists of gnomon::LightClusters. The includer supplies
// cluster_begin() and cluster_light().
#ifndef GNOMON_LIBRARY_LIGHT_CLUSTERS_GLSL
#define GNOMON_LIBRARY_LIGHT_CLUSTERS_GLSL

struct LightClusters {
  ivec4 size;   // columns, rows, slices; side of a tile, pixels
  vec4 depth;   // depth_scale, depth_offset; 1 for an orthographic camera; 0
};

uint cluster_begin(uint at);  // gnomon::LightClusters::begin
uint cluster_light(uint at);  // gnomon::LightClusters::lights

// `pixel`: from the lower left corner. The lights are cluster_light(x) .. cluster_light(y - 1).
uvec2 cluster_range(LightClusters clusters, ivec2 pixel, float view_depth) {
  float along = clusters.depth.z > 0.5 ? view_depth : log2(max(view_depth, 1e-30));
  float slice = clamp(floor(clusters.depth.x * along + clusters.depth.y), 0.0, float(clusters.size.z - 1));
  ivec2 tile = clamp(pixel / clusters.size.w, ivec2(0), clusters.size.xy - 1);
  uint at = uint((int(slice) * clusters.size.y + tile.y) * clusters.size.x + tile.x);
  return uvec2(cluster_begin(at), cluster_begin(at + 1u));
}
#endif
