// Is each option that does not hold reported, and has it no effect on the plan?
#include "resolve/resolve.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include "gnomon/gnomon.hpp"
#include "support/plan_hash.hpp"

namespace gnomon::test {
namespace {

const Light kSun = DirectionalLight{{0.4, -1.0, -0.2}};
const Light kSpot = SpotLight{{3.0, 12.0, -20.0}, {0.1, -1.0, -0.1}, 0.7, 60.0};
const Light kPoint = PointLight{{3.0, 9.0, -20.0}, 60.0};

/// Everything that a plan is asked for.
struct Input {
  Light light = kSun;
  PlanOptions options;
  bool history = false, depths = false, points = false;
  std::size_t views = 0;

  [[nodiscard]] Resolved resolved() const {
    return resolve(options, {light, false, views, history, depths, points});
  }
};

Camera camera_at(double height, double x) {
  return perspective_camera({x, height, 0.0}, {0.05, -0.25, -1.0}, {0.0, 1.0, 0.0}, 1.0, 1.5, 0.5, 150.0, 480,
                            320);
}

std::vector<Box> town() {
  std::vector<Box> boxes{{{-120.0, -1.0, -160.0}, {120.0, 0.0, 20.0}}};
  for (int i = 0; i < 12; ++i) {
    const double x = 9.0 * (i % 4) - 14.0, z = -12.0 - 14.0 * (i / 4);
    boxes.push_back({{x, 0.0, z - 4.0}, {x + 4.0, 3.0 + i % 5, z}});
  }
  return boxes;
}

/// The plans of two frames, the second a step on.
std::vector<ShadowPlan> plans_of(const Input& in, double height) {
  const std::vector<Box> boxes = town();
  const SceneBounds bounds{boxes, boxes};
  const VisibleDepths depths = visible_between(4.0, 60.0);
  std::vector<glm::dvec3> points;
  if (in.points) {
    for (int i = 0; i < 200; ++i) points.push_back({0.25 * i - 20.0, 0.0, -6.0 - 0.3 * (i % 120)});
  }
  PlanHistory history;
  std::vector<ShadowPlan> plans;
  for (const double x : {0.0, 0.3}) {
    const Camera camera = camera_at(height, x);
    if (in.views > 0) {
      const std::vector<Camera> cameras(in.views, camera);
      plans.push_back(plan_views(cameras, in.light, bounds, in.options));
    } else {
      const View view{.camera = camera, .depths = in.depths ? &depths : nullptr, .points_world = points};
      plans.push_back(make_plan(view, in.light, bounds, in.options, in.history ? &history : nullptr));
    }
  }
  return plans;
}

bool about_options(const Omission& o) {
  return o.kind == OmissionKind::option_ignored || o.kind == OmissionKind::warp_in_stable_fit ||
         o.kind == OmissionKind::partition_in_stable_fit;
}

/// The hash of everything but the list of ignored options.
std::uint64_t hash_of(const std::vector<ShadowPlan>& plans) {
  PlanHash hash;
  for (const ShadowPlan& plan : plans) {
    for (const int v :
         {static_cast<int>(plan.status), static_cast<int>(plan.sizes_vary), static_cast<int>(plan.selection)})
      hash.add(v);
    for (const ShadowMap& map : plan.maps()) {
      hash.add(map);
      for (const char c : map.shape->name) hash.add(static_cast<int>(c));
    }
    for (const Omission& o : plan.omitted()) {
      if (about_options(o)) continue;
      hash.add(static_cast<int>(o.kind));
      hash.add(o.a);
      hash.add(o.b);
    }
  }
  return hash.value();
}

/// An option that does not hold.
struct Row {
  std::string what;
  Omission entry;
  void (*otherwise)(Input&);  // the input without the option
  void (*option)(Input&);
};

Omission ignored(IgnoredOption option) {
  return {OmissionKind::option_ignored, -1, static_cast<double>(option), 0.0, 0};
}

bool lists(std::span<const Omission> entries, const Omission& wanted) {
  return std::any_of(entries.begin(), entries.end(),
                     [&](const Omission& o) { return o.kind == wanted.kind && o.a == wanted.a; });
}

bool lists(const Resolved& resolved, const Omission& wanted) {
  return lists(resolved.of_maps.entries(), wanted) || lists(resolved.of_plan.entries(), wanted);
}

void sun(Input&) {}
void spot(Input& in) {
  in.light = kSpot;
}
void point(Input& in) {
  in.light = kPoint;
}
void two_views(Input& in) {
  in.views = 2;
}
void history(Input& in) {
  in.history = true;
}
void stable(Input& in) {
  in.options.fit = Fit::stable;
}
void optimal_splits(Input& in) {
  in.options.split.scheme = SplitScheme::optimal;
}
void by_storage(Input& in) {
  in.options.warp.objective = Objective::storage;
}
void cached(Input& in) {
  in.options.fit = Fit::warped_stable;
  in.history = true;
}
void rotated(Input& in) {
  in.options.fit = Fit::rotated;
}
void finest(Input& in) {
  in.options.split.selection = MapSelection::finest;
}
void faces(Input& in) {
  in.options.split.partition = Partition::frustum_faces;
}
void tetrahedron(Input& in) {
  in.options.split.partition = Partition::tetrahedron;
}
void uniform(Input& in) {
  in.options.split.scheme = SplitScheme::uniform;
}
void overlap(Input& in) {
  in.options.split.overlap = 0.2;
}
void budget(Input& in) {
  in.options.resolution.texel_budget = 3 << 20;
}
void bounded(Input& in) {
  in.options.resolution.max_error = 2.0;
}
void cadence(Input& in) {
  in.options.cadence = {4, 0.5, 0.01};
}
void planes(Input& in) {
  in.options.warp.planes[0] = {{0.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, 0.2};
}
void logarithmic(Input& in) {
  in.options.warp.shape = &shapes::logarithmic;
}
void rectilinear(Input& in) {
  in.options.warp.shape = &shapes::rectilinear;
}
void paraboloid(Input& in) {
  in.options.warp.shape = &shapes::paraboloid;
}
void lispsm(Input& in) {
  in.options.warp.warp = &warps::lispsm;
}
void depths(Input& in) {
  in.depths = true;
}
void points(Input& in) {
  in.points = true;
}

template <auto... each>
void all(Input& in) {
  (each(in), ...);
}

std::vector<Row> rows() {
  using O = IgnoredOption;
  return {
      {"a tetrahedron under a sun", ignored(O::partition), sun, tetrahedron},
      {"a tetrahedron under a spot", ignored(O::partition), spot, tetrahedron},
      {"frustum faces under a point light", ignored(O::partition), point, faces},
      {"frustum faces of two views", ignored(O::partition), two_views, faces},
      {"splits of a spot", ignored(O::split_scheme), spot, uniform},
      {"optimal splits by the picture", ignored(O::split_scheme), sun, optimal_splits},
      {"a blend band of a spot", ignored(O::split_overlap), spot, overlap},
      {"a blend band beside parts", ignored(O::split_overlap), faces, overlap},
      {"a blend band of the finest map", ignored(O::split_overlap), finest, overlap},
      {"a blend band beside planes", ignored(O::split_overlap), planes, overlap},
      {"visible depths of a point light", ignored(O::visible_depths), point, depths},
      {"a budget of parts", ignored(O::texel_budget), faces, budget},
      {"a history of parts", ignored(O::history), faces, history},
      {"a history of parts with a bound", ignored(O::history), all<faces, bounded>, history},
      {"the finest map of a point light", ignored(O::selection), point, finest},
      {"the finest map of parts", ignored(O::selection), faces, finest},
      {"a cadence without a history", ignored(O::cadence), sun, cadence},
      {"a cadence of a spot", ignored(O::cadence), all<spot, history>, cadence},
      {"a cadence of maps that change their size", ignored(O::cadence), all<bounded, history>, cadence},
      {"a cadence of parts", ignored(O::cadence), all<faces, history>, cadence},
      {"a cadence of two views", ignored(O::cadence), two_views, cadence},
      {"visible points of a spot", ignored(O::visible_points), all<by_storage, spot>, points},
      {"visible points of a stable grid", ignored(O::visible_points), stable, points},
      {"visible points of a cached map", ignored(O::visible_points), all<by_storage, cached>, points},
      {"visible points of cached cascades", ignored(O::visible_points), all<by_storage, cadence, history>,
       points},
      {"visible points of parts", ignored(O::visible_points), faces, points},
      {"logarithmic rows of a turned map", ignored(O::shape), rotated, logarithmic},
      {"logarithmic rows over frames", ignored(O::shape), history, logarithmic},
      {"logarithmic rows over frames within a bound", ignored(O::shape), all<history, bounded>, logarithmic},
      {"round texels under a sun", ignored(O::shape), sun, paraboloid},
      {"round texels within a bound", ignored(O::shape), all<point, bounded>, paraboloid},
      {"columns for points that are unknown", ignored(O::shape), sun, rectilinear},
      {"columns of a spot", ignored(O::shape), spot, rectilinear},
      {"planes under a spot", ignored(O::planes), spot, planes},
      {"planes beside parts", ignored(O::planes), faces, planes},
      {"planes of two views", ignored(O::planes), two_views, planes},
      {"planes with a stable grid", ignored(O::planes), stable, planes},
      {"planes within a budget", ignored(O::planes), budget, planes},
      {"a warp of a stable grid", {OmissionKind::warp_in_stable_fit}, stable, lispsm},
      {"a warp of a stable spot", {OmissionKind::warp_in_stable_fit}, all<spot, stable>, lispsm},
      {"parts of a stable grid", {OmissionKind::partition_in_stable_fit}, stable, faces},
  };
}

TEST(Resolve, an_option_that_does_not_hold_is_reported_and_changes_no_bit_of_the_plan) {
  for (const Row& row : rows()) {
    Input without;
    row.otherwise(without);
    Input with = without;
    row.option(with);
    EXPECT_TRUE(lists(with.resolved(), row.entry)) << row.what;
    EXPECT_FALSE(lists(without.resolved(), row.entry)) << row.what;
    for (const double height : {2.0, 25.0}) {
      const std::vector<ShadowPlan> plans = plans_of(with, height);
      for (const ShadowPlan& plan : plans) {
        EXPECT_EQ(plan.status, PlanStatus::ok) << row.what;
        EXPECT_TRUE(lists(plan.omitted(), row.entry)) << row.what;
      }
      EXPECT_EQ(hash_of(plans), hash_of(plans_of(without, height))) << row.what << " from " << height;
    }
  }
}

TEST(Resolve, the_rows_above_are_of_every_option_that_can_be_ignored) {
  std::set<double> found;
  std::set<OmissionKind> kinds;
  for (const Row& row : rows()) {
    kinds.insert(row.entry.kind);
    if (row.entry.kind == OmissionKind::option_ignored) found.insert(row.entry.a);
  }
  EXPECT_EQ(found.size(), static_cast<std::size_t>(IgnoredOption::planes) + 1);
  EXPECT_EQ(kinds.size(), 3u);
}

TEST(Resolve, options_that_hold_stay_as_they_are) {
  Input in;
  all<overlap, logarithmic, lispsm>(in);
  const Resolved resolved = in.resolved();
  EXPECT_EQ(resolved.options, in.options);
  EXPECT_TRUE(resolved.of_maps.entries().empty());
  EXPECT_TRUE(resolved.of_plan.entries().empty());
  EXPECT_EQ(resolved.conduct.warp, &warps::lispsm);
  EXPECT_EQ(resolved.conduct.shape, &shapes::logarithmic);
}

TEST(Resolve, a_trial_forgets_what_a_history_allows) {
  Input in;
  all<history, cadence>(in);
  Conduct how = in.resolved().conduct;
  EXPECT_TRUE(how.has_history && how.steady && how.caches_cascades);
  how.forget();
  EXPECT_FALSE(how.has_history || how.steady || how.caches_cascades);
}

TEST(Resolve, an_option_that_is_ignored_may_change_without_restarting_a_history) {
  const std::vector<Box> boxes = town();
  PlanHistory kept, changed;
  PlanOptions options;
  for (int frame = 0; frame < 4; ++frame) {
    const Camera camera = camera_at(2.0, 0.1 * frame);
    const ShadowPlan a = make_plan(camera, kSun, {boxes, boxes}, options, &kept);
    PlanOptions other = options;
    if (frame % 2 == 1) other.split.partition = Partition::tetrahedron;
    const ShadowPlan b = make_plan(camera, kSun, {boxes, boxes}, other, &changed);
    EXPECT_EQ(hash_of({a}), hash_of({b})) << frame;
  }
}

TEST(Resolve, pages_and_lights_have_their_own) {
  Input in;
  all<planes, tetrahedron, bounded, budget>(in);
  PageOptions asked;
  asked.policy = &page_policies::resolution;
  asked.plan = in.options;
  asked.plan.fit = Fit::stable;
  const ResolvedPages pages = resolve_pages(asked);
  EXPECT_TRUE(lists(pages.ignored.entries(), ignored(IgnoredOption::planes)));
  EXPECT_EQ(pages.base.fit, Fit::stable);
  EXPECT_EQ(pages.base.warp.warp, &warps::none);
  EXPECT_FALSE(pages.base.warp.has_planes());
  EXPECT_FALSE(lists(pages.ignored.entries(), ignored(IgnoredOption::shape)));
  asked.plan.fit = Fit::tight;
  asked.plan.warp.shape = &shapes::paraboloid;
  const ResolvedPages bent = resolve_pages(asked);
  EXPECT_TRUE(lists(bent.ignored.entries(), ignored(IgnoredOption::shape)));
  EXPECT_EQ(bent.base.warp.shape, &shapes::linear);
  EXPECT_EQ(bent.base.fit, Fit::tight);
  asked.share = 0.5;
  asked.reach_texels = 2.0;
  for (const PagePolicy* policy : all_page_policies()) {
    asked.policy = policy;
    const ResolvedPages own = resolve_pages(asked);
    EXPECT_EQ(own.options.share, policy->chooses ? 1.0 : 0.5) << policy->name;
    EXPECT_EQ(own.options.reach_texels, policy->chooses ? 0.0 : 2.0) << policy->name;
    EXPECT_EQ(lists(own.ignored.entries(), ignored(IgnoredOption::page_share)), policy->chooses);
    EXPECT_EQ(lists(own.ignored.entries(), ignored(IgnoredOption::page_reach)), policy->chooses);
    EXPECT_EQ(own.base.fit, policy->octaves ? Fit::stable : Fit::tight) << policy->name;
  }
  const PlanOptions lights = resolve_lights(in.options, 256);
  EXPECT_EQ(lights.resolution.max_size, 256);
  EXPECT_EQ(lights.resolution.max_error, 0.0);
  EXPECT_EQ(lights.resolution.texel_budget, 0);
  EXPECT_EQ(lights.split.partition, Partition::view_depth);
}

}  // namespace
}  // namespace gnomon::test
