// A blur whose radius the shader was compiled for. One invocation walks along a part of a row or column; loops over its
// window have bounds that every compiler unrolls, so that the window stays in registers.
const int kReach = GNOMON_REACH;      // taps to either side of the middle one
const int kSide = 2 * GNOMON_REACH + 1;

layout(location = 1) uniform ivec4 walk;  // texels along x and y to be filled, layer written, texels of one walk

float[GNOMON_REACH + 1] tap_weights_of(int map) {
  float weights[GNOMON_REACH + 1];
  for (int i = 0; i <= GNOMON_REACH; ++i) weights[i] = tap_weight(map, i);
  if (GNOMON_REACH == 0) weights[0] = 1.0;  // stored to be blurred later, by the weights of the block
  return weights;
}
