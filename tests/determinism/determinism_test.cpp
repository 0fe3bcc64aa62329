// DESIGN.md, section 4: one scenario and one seed give one result, to the bit. Separate processes, as a user starts
// them, with address randomisation on, in other folders, environments and with other numbers of threads.
#include <gtest/gtest.h>

#include <map>
#include <nlohmann/json.hpp>

#include "tests/scenarios/command.h"
#include "tests/scenarios/temporary_folder.h"

namespace alula::scenarios::testing {
namespace {

struct Variant {
  std::string name;
  std::vector<std::string> arguments;
  std::vector<std::string> environment;
  bool elsewhere = false;
};

/// The digests of one run, by stream.
nlohmann::json Digests(const std::vector<std::string>& scenario, const Variant& variant) {
  const TemporaryFolder folder("determinism");
  std::vector<std::string> arguments = scenario;
  arguments.insert(arguments.end(), variant.arguments.begin(), variant.arguments.end());
  arguments.insert(arguments.end(), {"--json", "-", "--out", folder.path() / "r"});
  const CommandResult run = Alula(
      arguments, {.directory = variant.elsewhere ? folder.path().string() : "", .environment = variant.environment});
  if (run.exit_code > 1) {
    ADD_FAILURE() << variant.name << ": " << run.err;
    return {};
  }
  nlohmann::json verdict = nlohmann::json::parse(run.out);
  verdict["digests"]["all"] = verdict["digest"];
  return verdict["digests"];
}

void ExpectOneResult(const std::vector<std::string>& scenario, const std::vector<Variant>& variants) {
  const nlohmann::json first = Digests(scenario, {});
  for (const Variant& variant : variants) EXPECT_EQ(Digests(scenario, variant), first) << variant.name;
}

const std::vector<std::string> kOddEnvironment = {"LP_NUM_THREADS=3",  "LP_PERF=no_rast_linear",
                                                  "OMP_NUM_THREADS=4", "OPENCV_CPU_DISABLE=AVX2",
                                                  "LANG=de_DE.UTF-8",  "TZ=Asia/Tokyo"};

TEST(Determinism, HoverIsOneRun) {
  ExpectOneResult({"run", "hover"}, {{.name = "another process", .arguments = {}, .environment = {}},
                                     {.name = "two workers", .arguments = {"--workers", "2"}, .environment = {}},
                                     {.name = "another folder", .arguments = {}, .environment = {}, .elsewhere = true},
                                     {.name = "another environment", .arguments = {}, .environment = kOddEnvironment}});
}

TEST(Determinism, SeedsDiffer) {
  const nlohmann::json one = Digests({"run", "hover"}, {});
  const nlohmann::json two = Digests({"run", "hover", "--seed", "2"}, {});
  for (const char* stream : {"truth", "estimates", "commands", "measurements"}) EXPECT_NE(one[stream], two[stream]);
}

/// Pictures too: the first two seconds of the prescribed flight.
TEST(Determinism, PicturesAreOneRun) {
  ExpectOneResult(
      {"run", "prescribed_flight", "--set", "criteria=[{type: time_limit, limit: 2 s}]"},
      {{.name = "two workers", .arguments = {"--workers", "2"}, .environment = {}},
       {.name = "another environment", .arguments = {}, .environment = kOddEnvironment, .elsewhere = true}});
}

}  // namespace
}  // namespace alula::scenarios::testing
