// Ending in order: the first SIGINT, SIGTERM or SIGHUP asks the work to stop after the piece in flight and to
// keep what there is, a second one ends the program at once.
#pragma once

#include <cstdint>

namespace irradia {

// From here on the signals only ask. A SIGHUP that is ignored stays ignored: that is what nohup is for.
void catchInterrupts();

// "SIGINT" once it was asked for, nullptr before.
const char* interruptedBy();

// Throws Error(Interrupted) where it was asked for: between steps that leave nothing to keep.
void stopIfInterrupted();
// The same at the end, when what was done is written: "after 12 frames, which are written".
void endIfInterrupted(uint64_t done, const char* unit);

} // namespace irradia
