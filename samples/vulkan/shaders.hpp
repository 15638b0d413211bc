// The sample's shaders as SPIR-V, compiled by the build.
#pragma once

#include <cstdint>

#include "depth_layered_vert.h"
#include "depth_multiview_vert.h"
#include "depth_vert.h"
#include "scene_frag.h"
#include "scene_vert.h"
