#include "worlds/wind.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/error.h"

namespace alula::worlds {
namespace {

using base::Milliseconds;
using base::Vec3;

/// Over a time T the variance of a Gauss–Markov process is known to about √(2τ/T), relative.
TEST(WindField, IsStationaryWithTheStatedDeviationWhateverTheStep) {
  const Wind wind{{2.0, -1.0, 0.0}, 0.6, 0.5};
  for (const int step_ms : {1, 50, 2000}) {
    SCOPED_TRACE(step_ms);
    WindField field(wind, 7);
    const int steps = 200'000;
    Vec3 sum = Vec3::Zero();
    Vec3 squares = Vec3::Zero();
    for (int i = 0; i < steps; ++i) {
      const Vec3 gust = field.At(Vec3::Zero(), Milliseconds(step_ms)) - wind.mean_W;
      sum += gust;
      squares += gust.cwiseAbs2();
    }
    const double independent = std::min<double>(steps, steps * step_ms * 1e-3 / (2.0 * wind.gust_time));
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_NEAR(sum[axis] / steps, 0.0, 4.0 * wind.gust_sigma / std::sqrt(independent));
      EXPECT_NEAR(squares[axis] / steps, 0.36, 4.0 * 0.36 * std::sqrt(2.0 / independent));
    }
  }
}

TEST(WindField, DeviationHoldsFromTheFirstStepOn) {
  double squares = 0.0;
  for (std::uint64_t seed = 0; seed < 2000; ++seed) {
    WindField field({Vec3::Zero(), 1.5, 10.0}, seed);
    squares += field.At(Vec3::Zero(), Milliseconds(1)).squaredNorm() / 3.0;
  }
  EXPECT_NEAR(squares / 2000, 2.25, 4.0 * 2.25 * std::sqrt(2.0 / 6000));
}

TEST(WindField, CorrelationFallsByOneOverEInTheStatedTime) {
  WindField field({Vec3::Zero(), 1.0, 2.0}, 3);
  const int lag = 20;  // 2 s
  std::vector<double> gusts;
  for (int i = 0; i < 200'000; ++i) gusts.push_back(field.At(Vec3::Zero(), Milliseconds(100)).x());
  double product = 0.0;
  for (std::size_t i = lag; i < gusts.size(); ++i) product += gusts[i] * gusts[i - lag];
  EXPECT_NEAR(product / static_cast<double>(gusts.size() - lag), std::exp(-1.0), 0.05);  // 4σ over 20 000 s
}

TEST(WindField, SameSeedSameWind) {
  const Wind wind{{1.0, 0.0, 0.0}, 0.5, 1.0};
  WindField a(wind, 1);
  WindField b(wind, 1);
  WindField c(wind, 2);
  const Vec3 first = a.At(Vec3::Zero(), Milliseconds(1));
  EXPECT_EQ(first, b.At(Vec3::Zero(), Milliseconds(1)));
  EXPECT_NE(first, c.At(Vec3::Zero(), Milliseconds(1)));
}

TEST(WindField, WithoutGustsItIsTheMean) {
  WindField field({{3.0, 0.0, 0.0}, 0.0, 1.0}, 1);
  for (int i = 0; i < 10; ++i) EXPECT_EQ(field.At(Vec3::Zero(), Milliseconds(1)), Vec3(3.0, 0.0, 0.0));
}

TEST(WindField, RejectsTimesThatMakeNoSense) {
  EXPECT_THROW(WindField({Vec3::Zero(), 1.0, 0.0}, 1), base::InputError);
  EXPECT_THROW(WindField({Vec3::Zero(), -1.0, 1.0}, 1), base::InputError);
}

}  // namespace
}  // namespace alula::worlds
