#include "stack/pilot/map_alignment.h"

#include <gtest/gtest.h>

#include "base/random.h"

namespace alula::stack::pilot {
namespace {

using base::Transform;
using base::Vec3;

const Vec3 kStart(1, 2, 0.1);

std::vector<AlignmentPair> Pairs(const Transform& X_MO, double noise, base::RandomStream& random) {
  std::vector<AlignmentPair> pairs;
  for (const Vec3& p : {Vec3(6, 3, 1.5), Vec3(12, -2, 2), Vec3(20, 4, 1.2), Vec3(15, 9, 1.8), Vec3(8, 10, 2.2)}) {
    pairs.push_back({X_MO * p + noise * random.GaussianVec3(), p, 0.03});
  }
  return pairs;
}

TEST(MapAlignment, IsTheIdentityWithoutGates) {
  const Transform X = AlignMap({}, kStart, 0.1, 0.035, {});
  EXPECT_LT(X.p.norm() + base::Log(X.q).norm(), 1e-12);
}

TEST(MapAlignment, FindsTheTransformWhenTheListIsRight) {
  base::RandomStream random(1, "alignment");
  const Transform truth{base::FromYaw(0.05), {0.2, -0.1, 0.05}};
  MapAlignmentConfig config;
  config.hint_sigma = 0.001;  // a good list beats the prior
  config.huber = 100.0;
  auto pairs = Pairs(truth, 0.0, random);
  for (auto& pair : pairs) pair.sigma = 0.001;
  const Transform X = AlignMap(pairs, kStart, 0.5, 0.2, config);
  EXPECT_LT((X.p - truth.p).norm(), 1e-3);
  EXPECT_NEAR(base::Yaw(X.q), 0.05, 1e-4);
}

TEST(MapAlignment, APriorWeighsWhatTheListSays) {
  // One gate at the start: only the translation is seen; it is shared between prior and gate by their information.
  MapAlignmentConfig config;
  config.huber = 100.0;
  const AlignmentPair pair{kStart + Vec3(0.3, 0, 0), kStart, 0.0};
  const Transform X = AlignMap({pair}, kStart, 0.1, 0.035, config);
  const double share = (1 / 0.09) / (1 / 0.09 + 1 / 0.01);
  EXPECT_NEAR(X.p.x(), 0.3 * share, 1e-9);
}

TEST(MapAlignment, ImprovesTheLaterGates) {
  MapAlignmentConfig config;
  double before = 0.0, after = 0.0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    base::RandomStream random(seed, "alignment");
    const double yaw = 0.035 * random.Gaussian();
    const Vec3 t = 0.1 * random.GaussianVec3();
    const Transform truth{base::FromYaw(yaw), kStart + t - base::FromYaw(yaw) * kStart};
    auto pairs = Pairs(truth, 0.3, random);
    const Vec3 last_M = truth * pairs.back().p_O;
    const Vec3 last_O = pairs.back().p_O;
    pairs.pop_back();
    const Transform X = AlignMap(pairs, kStart, 0.1, 0.035, config);
    before += (last_O - last_M).norm();
    after += (X * last_O - last_M).norm();
  }
  EXPECT_LT(after, 0.9 * before);
}

}  // namespace
}  // namespace alula::stack::pilot
