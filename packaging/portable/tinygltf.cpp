// tinygltf compiled in, without its own decoders of pictures: gnomon has its own, and calls them itself.
#define TINYGLTF_IMPLEMENTATION
#include <tiny_gltf.h>
