// Lists of the pixels that look into each texel of a map, and the frame across the light in which casters are tested.
#ifndef GNOMON_LISTS_LISTS_GLSL
#define GNOMON_LISTS_LISTS_GLSL
// One pixel's point. Parallel light: two coordinates across the light, and the way along it. Local light: two slopes seen from
// the light, and the distance from it. Along the map's axis, rays far off it would lose more than they are lifted by.
struct ListedPixel {
  vec3 at;
  uint next;  // the list's next pixel plus 1, 0 at its end; kShadowed is added once something shadows the pixel
};
const uint kShadowed = 0x80000000u;

layout(std430, binding = 1) buffer ListedPixels { ListedPixel listed[]; };

layout(std140, binding = 3) uniform LightFrames {
  vec4 row[3 * GNOMON_MAX_MAPS];  // per map: coordinates of a point relative to the camera
  vec4 light;  // 1: local; least lift of a point off its own plane, and per distance to the camera and to the light
} light_frames;

vec3 light_from_point(int map, vec3 position) {
  vec4 p = vec4(position, 1.0);
  return vec3(dot(light_frames.row[3 * map], p), dot(light_frames.row[3 * map + 1], p), dot(light_frames.row[3 * map + 2], p));
}
bool local_light() { return light_frames.light.x > 0.5; }
#endif
