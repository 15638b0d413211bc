// Light from everywhere else: a clear sky above, the ground's reflection below. Linear colours, sun at noon about 3.
#ifndef GNOMON_SHADE_SKY_GLSL
#define GNOMON_SHADE_SKY_GLSL
const vec3 kSunColor = vec3(3.1, 2.75, 2.25);
const vec3 kZenith = vec3(0.16, 0.34, 0.70);
const vec3 kHorizon = vec3(0.62, 0.74, 0.86);
const vec3 kGround = vec3(0.20, 0.18, 0.16);
const vec3 kBelowHorizon = vec3(0.36, 0.40, 0.45);  // where a scene has no ground

vec3 sky_color(vec3 direction, vec3 light) {
  float elevation = clamp(direction.y, 0.0, 1.0);
  vec3 sky = mix(kHorizon, kZenith, pow(elevation, 0.55));
  float toward_sun = max(dot(direction, -light), 0.0);
  sky += kSunColor * (0.06 * pow(toward_sun, 8.0) + 0.12 * pow(toward_sun, 64.0) +
                      2.0 * smoothstep(0.99985, 0.99992, toward_sun));
  return direction.y >= 0.0 ? sky : mix(kHorizon, kBelowHorizon, smoothstep(0.0, 0.6, -direction.y));
}

// Irradiance over pi on a surface that faces `normal`.
vec3 sky_ambient(vec3 normal) {
  float up = normal.y * 0.5 + 0.5;
  return 0.85 * mix(kGround * 1.3, mix(kHorizon, kZenith, 0.55), up * up * (3.0 - 2.0 * up));
}

// Filmic curve (Narkowicz 2015, ACES fit).
vec3 display_from_scene(vec3 c) {
  c *= 0.62;
  return clamp((c * (2.51 * c + 0.03)) / (c * (2.43 * c + 0.59) + 0.14), 0.0, 1.0);
}
#endif
