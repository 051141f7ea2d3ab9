#include "samples/support/standard_streams.h"

#include "engine/error.h"
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <unistd.h>

namespace irradia {
namespace {

int firstError = 0; // of stdout

void keepError(bool hasFailed) {
    if (hasFailed && firstError == 0) firstError = errno;
}

} // namespace

void prepareStandardStreams() {
    // Opened the wrong way round, a closed stdin or stdout goes on failing; a closed stderr takes everything.
    constexpr int kWays[] = {O_WRONLY, O_RDONLY, O_WRONLY};
    for (int stream = STDIN_FILENO; stream <= STDERR_FILENO; ++stream)
        if (::fcntl(stream, F_GETFD) < 0)
            static_cast<void>(::open("/dev/null", kWays[stream])); // the lowest free
    std::signal(SIGPIPE, SIG_IGN);
    std::signal(SIGXFSZ, SIG_IGN);
}

void writeResult(std::string_view text) {
    keepError(std::fwrite(text.data(), 1, text.size(), stdout) != text.size());
}

void finishResults() {
    keepError(std::fflush(stdout) != 0);
    if (firstError != 0 && firstError != EPIPE)
        fail(ExitCode::Io, "stdout: cannot be written: {}", std::strerror(firstError));
}

} // namespace irradia
