#pragma once

#include "scenarios/commands/command_line.h"

namespace alula::scenarios::commands {

// Each does one verb and gives the exit code.
int Run(const CommandLine& line);
int Export(const CommandLine& line);
int Gallery(const CommandLine& line);
int CheckTextures(const CommandLine& line);
int CheckLanding(const CommandLine& line);
int List(const CommandLine& line);
int CheckFiles(const CommandLine& line);
int CheckSensors(const CommandLine& line);
int Bench(const CommandLine& line);
int Sweep(const CommandLine& line);
int Replay(const CommandLine& line);
int Slam(const CommandLine& line);
int TrainVocabulary(const CommandLine& line);

}  // namespace alula::scenarios::commands
