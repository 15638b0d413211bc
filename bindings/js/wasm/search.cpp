// How does a call search what JavaScript finds on the light's rays? By the one import of the larger modules.
#include "gnomon/c/gnomon.h"

extern "C" {

__attribute__((import_module("gnomon"), import_name("occluder_distance"))) double occluder_distance(
    double x, double y, double z);

/// For gnomon_shadow_picture::occluder_search.
gnomon_occluder_search gnomon_imported_search() {
  return [](const void*, const double point[3]) { return occluder_distance(point[0], point[1], point[2]); };
}

}  // extern "C"
