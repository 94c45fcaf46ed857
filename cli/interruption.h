// Lets a long command end in order when the user presses Ctrl-C.
#pragma once

#include <string>

namespace chasles::cli {

/// From now on SIGINT and SIGTERM end the program with a line on standard error and the exit status of an interruption.
/// A signal that is ignored, as in the background of a shell, stays so.
void end_when_interrupted();

/// While one exists, the first SIGINT or SIGTERM only sets a flag, and the next one ends the program. At most
/// one may exist at a time.
class Interruption {
public:
    Interruption();
    ~Interruption();
    Interruption(const Interruption&) = delete;
    Interruption& operator=(const Interruption&) = delete;

    [[nodiscard]] static bool is_requested();
};

/// Says on standard error what is kept of an interrupted command. Returns the exit status.
int report_interruption(const std::string& what);

} // namespace chasles::cli
