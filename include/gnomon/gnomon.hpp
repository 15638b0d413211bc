// The parts of the core that an engine needs, in one include. Authors of warps and shapes find what they
// need in gnomon/extend/; bias, formulas, logarithmic perspective and the
// choice of a technique in gnomon/study/.
#pragma once

#include "gnomon/version.hpp"  // first: it stops compilers that are set below C++20

#include "gnomon/atlas.hpp"
#include "gnomon/bounds.hpp"
#include "gnomon/camera.hpp"
#include "gnomon/clip_space.hpp"
#include "gnomon/light.hpp"
#include "gnomon/lights.hpp"
#include "gnomon/measure.hpp"
#include "gnomon/motion.hpp"
#include "gnomon/options.hpp"
#include "gnomon/pages.hpp"
#include "gnomon/plan.hpp"
#include "gnomon/shader.hpp"
#include "gnomon/shadow_map.hpp"
#include "gnomon/view.hpp"
