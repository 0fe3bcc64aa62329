#pragma once

namespace alula::scenarios {

/// Libraries read their environment when they are loaded, and some of it changes results (which vector units, how many
/// threads). Where it is not what Alula needs, sets it and starts the program once more in its own place.
void FixEnvironment(char** argv);

}  // namespace alula::scenarios
