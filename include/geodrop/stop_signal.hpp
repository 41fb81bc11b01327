// Ctrl-C: the first SIGINT or SIGTERM asks the step loop to stop, the second ends the program at once.
#pragma once

namespace geodrop {

/// From now on SIGINT and SIGTERM set a flag instead of ending the program.
void catch_stop_signals();

/// True once the program was asked to stop; cheap enough for every step.
bool stop_requested();

}  // namespace geodrop
