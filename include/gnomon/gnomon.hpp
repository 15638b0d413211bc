// The parts of the core that an engine needs, in one include. Curves, logarithmic
// perspective in numbers and the choice of a technique lie in gnomon/study/.
#pragma once

#include "gnomon/version.hpp"  // first: it stops compilers that are set below C++20

#include "gnomon/atlas.hpp"
#include "gnomon/bias.hpp"
#include "gnomon/body.hpp"
#include "gnomon/bounds.hpp"
#include "gnomon/camera.hpp"
#include "gnomon/caster_set.hpp"
#include "gnomon/clip_space.hpp"
#include "gnomon/coarse_depths.hpp"
#include "gnomon/fit.hpp"
#include "gnomon/history.hpp"
#include "gnomon/jitter.hpp"
#include "gnomon/light.hpp"
#include "gnomon/light_clusters.hpp"
#include "gnomon/lights.hpp"
#include "gnomon/metric.hpp"
#include "gnomon/pages.hpp"
#include "gnomon/partition.hpp"
#include "gnomon/plan.hpp"
#include "gnomon/prune.hpp"
#include "gnomon/reuse.hpp"
#include "gnomon/shader_block.hpp"
#include "gnomon/shape.hpp"
#include "gnomon/snap.hpp"
#include "gnomon/split.hpp"
#include "gnomon/views.hpp"
#include "gnomon/visible_depths.hpp"
#include "gnomon/warp.hpp"
