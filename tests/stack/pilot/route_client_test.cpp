#include "stack/pilot/route_client.h"

#include <gtest/gtest.h>

namespace alula::stack::pilot {
namespace {

using base::Milliseconds;
using base::Time;
using planning::RouteEnd;
using planning::RouteRequest;
using planning::RouteResult;

RouteResult Found(RouteEnd end) {
  RouteResult result;
  result.ok = true;
  result.end = end;
  result.legs = {{.gate = 3, .path_O = {}}};
  return result;
}

TEST(RouteClient, AsksOneRouteAtATimeAndOftenOnlyForNewMaps) {
  RouteClient client;
  const Time start{1'000'000'000};
  EXPECT_TRUE(client.Due(start, false));
  RouteRequest request;
  client.Ask(start, 0, request);
  EXPECT_EQ(request.number, 1u);
  EXPECT_FALSE(client.Due(start + Milliseconds(500), true)) << "one is being planned";
  client.Accept(0, Found(RouteEnd::kTarget));
  EXPECT_TRUE(client.Due(start + Milliseconds(100), true));
  EXPECT_FALSE(client.Due(start + Milliseconds(399), false));
  EXPECT_TRUE(client.Due(start + Milliseconds(400), false));
  client.Ask(start, 0, request);
  EXPECT_EQ(request.number, 2u);
}

TEST(RouteClient, IgnoresAnAnswerThatAnotherTrajectoryMadeOutOfDate) {
  RouteClient client;
  RouteRequest request;
  client.Ask(Time{}, 7, request);
  EXPECT_FALSE(client.Accept(8, Found(RouteEnd::kTarget)));
  EXPECT_EQ(client.last().end, RouteEnd::kUnknownSpace) << "nothing was learnt from it";
  EXPECT_TRUE(client.legs().empty());
  EXPECT_TRUE(client.Due(Time{}, true)) << "but another may be asked for";
}

TEST(RouteClient, AFailureKeepsWhatIsKnownOfTheRouteBeingFlown) {
  RouteClient client;
  RouteRequest request;
  request.target_O = base::Vec3::Zero();
  client.Ask(Time{}, 0, request);
  EXPECT_TRUE(client.Accept(0, Found(RouteEnd::kTarget)));
  EXPECT_TRUE(client.last().to_target);

  request.target_O.reset();
  client.Ask(Time{}, 0, request);
  RouteResult failure;
  failure.reason = "no way";
  EXPECT_FALSE(client.Accept(0, failure));
  EXPECT_FALSE(client.last().ok);
  EXPECT_EQ(client.last().reason, "no way");
  EXPECT_EQ(client.last().end, RouteEnd::kTarget);
  EXPECT_TRUE(client.last().to_target);
  EXPECT_EQ(client.legs().size(), 1u);
}

}  // namespace
}  // namespace alula::stack::pilot
