#include "scenarios/commands/flight.h"

#include <unistd.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdio>

#include "base/error.h"
#include "scenarios/exit_codes.h"
#include "scenarios/progress.h"
#include "sim/run_folder.h"

namespace alula::scenarios::commands {
namespace {

std::atomic<bool> interrupted{false};

/// The first Ctrl-C ends the run cleanly; a second one kills the program as it would any.
void CatchInterrupts() {
  struct sigaction action = {};
  action.sa_handler = [](int) { interrupted.store(true, std::memory_order_relaxed); };
  action.sa_flags = static_cast<int>(SA_RESETHAND);
  ::sigaction(SIGINT, &action, nullptr);
  ::sigaction(SIGTERM, &action, nullptr);
}

/// The flying process's side: the verdict as JSON, a zero byte, the note.
std::string FlyHere(const Scenario& scenario, RunOptions options, bool show, Pulse& pulse, const FlightNote& note) {
  if (options.out) LeaveStackTraceIn(sim::RunFolder::PartialOf(*options.out, ::getpid()) / "crash.txt");
  CatchInterrupts();
  Progress progress(scenario.name, LimitOf(scenario.config), show);
  options.progress = [&progress](base::Time time) { progress.Show(time); };
  options.interrupt = &interrupted;
  options.pulse = &pulse.simulated_ns;
  const Verdict verdict = RunScenario(scenario, options);
  progress.Clear();
  const auto alive = [&pulse] { pulse.simulated_ns.fetch_add(1, std::memory_order_relaxed); };
  return ToJson(verdict) + '\0' + (note ? note(alive) : "");
}

}  // namespace

RunOptions OptionsOf(const CommandLine& line) {
  RunOptions options;
  options.workers = line.workers;
  options.render = line.render;
  return options;
}

FlightEnd Fly(const Scenario& scenario, const RunOptions& options, const CommandLine& line, const FlightNote& note) {
  const auto begin = std::chrono::steady_clock::now();  // for reports
  const Ending ending = Supervise(line.limits, [&](Pulse& pulse) {
    Report report;
    report.exit_code = Guarded([&] {
      report.text = FlyHere(scenario, options, line.talks(), pulse, note);
      return 0;
    });
    return report;
  });
  FlightEnd end;
  end.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  if (ending.death) {
    if (line.talks() && ::isatty(STDERR_FILENO) != 0) std::fprintf(stderr, "\r%100s\r", "");
    end.verdict = ConcludeDeadRun(scenario, options.out, ending.pid, *ending.death);
  } else if (ending.interrupted || ending.report.exit_code != 0) {
    end.exit_code = ending.interrupted ? kExitInterrupted : ending.report.exit_code;
    return end;
  } else {
    const std::size_t zero = ending.report.text.find('\0');
    end.verdict = VerdictFromJson(ending.report.text.substr(0, zero));
    end.note = ending.report.text.substr(zero + 1);
    if (end.verdict->versions.at("cpu") != "avx2+fma") {
      std::fprintf(stderr,
                   "note: this processor lacks AVX2 or FMA; digests differ from those of processors that have them\n");
    }
  }
  end.exit_code = ExitCode(end.verdict->outcome);
  return end;
}

int Guarded(const std::function<int()>& work) {
  try {
    return work();
  } catch (const base::InputError& e) {
    std::fprintf(stderr, "%s\n", e.what());
    return kExitBadInput;
  } catch (const Interrupted&) {
    std::fprintf(stderr, "\ninterrupted: nothing was written\n");
    return kExitInterrupted;
  } catch (const base::FaultError& e) {
    std::fprintf(stderr, "fault (%s): %s\n", e.reason().c_str(), e.what());
    return kExitFault;
  } catch (const std::exception& e) {
    std::fprintf(stderr, "fault: %s\n", e.what());
    return kExitFault;
  }
}

}  // namespace alula::scenarios::commands
