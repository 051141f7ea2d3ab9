#include "samples/support/interrupt.h"

#include "engine/error.h"
#include <atomic>
#include <csignal>
#include <ctime>

namespace irradia {
namespace {

std::atomic<int> firstSignal = 0;
std::atomic<long long> firstTime = 0; // nanoseconds
static_assert(std::atomic<int>::is_always_lock_free && std::atomic<long long>::is_always_lock_free);

// timeout(1) and some schedulers send a signal to the program and to its group, so twice at one time.
constexpr long long kSameRequest = 100'000'000;

long long now() {
    timespec time{};
    clock_gettime(CLOCK_MONOTONIC, &time);
    return time.tv_sec * 1'000'000'000ll + time.tv_nsec;
}

// Calls only what a signal handler may: signal-safety(7).
void onSignal(int signal) {
    int none = 0;
    if (firstSignal.compare_exchange_strong(none, signal)) {
        firstTime = now();
        return;
    }
    if (firstTime == 0 || now() - firstTime < kSameRequest) return;
    std::signal(signal, SIG_DFL);
    raise(signal); // delivered when this returns
}

bool isIgnored(int signal) {
    struct sigaction current {};
    return sigaction(signal, nullptr, &current) == 0 && current.sa_handler == SIG_IGN;
}

} // namespace

void catchInterrupts() {
    struct sigaction action {};
    action.sa_handler = onSignal;
    action.sa_flags = SA_RESTART;
    sigemptyset(&action.sa_mask);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP})
        if (signal != SIGHUP || !isIgnored(signal)) sigaction(signal, &action, nullptr);
}

const char* interruptedBy() {
    switch (firstSignal) {
    case 0:
        return nullptr;
    case SIGINT:
        return "SIGINT";
    case SIGTERM:
        return "SIGTERM";
    default:
        return "SIGHUP";
    }
}

void stopIfInterrupted() {
    if (const char* signal = interruptedBy())
        fail(ExitCode::Interrupted, "interrupted by {}: nothing is written", signal);
}

void endIfInterrupted(uint64_t done, const char* unit) {
    if (const char* signal = interruptedBy())
        fail(ExitCode::Interrupted, "interrupted by {} after {} {}, which are written", signal, done, unit);
}

} // namespace irradia
