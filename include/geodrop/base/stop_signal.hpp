// What a user, a queue or the system tells a run by signals.
#pragma once

namespace geodrop {

/// From now on SIGINT, SIGTERM and SIGHUP (unless it is ignored, as by nohup) ask the step loop to stop; a second
/// SIGINT or SIGTERM ends the program at once. SIGUSR1 asks for a checkpoint. A pipe that nobody reads (SIGPIPE) and a
/// file beyond its limit (SIGXFSZ) are errors of the write, not the end.
void catch_signals();

/// True once the program was asked to stop; cheap enough for every step.
bool stop_requested();

/// True once for each time that a checkpoint was asked for; cheap enough for every step.
bool take_checkpoint_request();

}  // namespace geodrop
