// The core of gnomon in one include.
#pragma once

#include "gnomon/bias.hpp"
#include "gnomon/body.hpp"
#include "gnomon/bounds.hpp"
#include "gnomon/camera.hpp"
#include "gnomon/caster_set.hpp"
#include "gnomon/clip_space.hpp"
#include "gnomon/fit.hpp"
#include "gnomon/history.hpp"
#include "gnomon/light.hpp"
#include "gnomon/metric.hpp"
#include "gnomon/omni.hpp"
#include "gnomon/plan.hpp"
#include "gnomon/reuse.hpp"
#include "gnomon/snap.hpp"
#include "gnomon/split.hpp"
#include "gnomon/warp.hpp"
