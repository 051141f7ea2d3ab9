// A program while it runs: its stderr is read as it grows, it is sent signals, and awaited.
#pragma once

#include <chrono>
#include <csignal>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <spawn.h>
#include <stdexcept>
#include <string>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>
#include <vector>

namespace irradia::test {

class RunningProgram {
public:
    // stderr goes to the file `log`, stdout nowhere.
    RunningProgram(std::vector<std::string> arguments, const std::filesystem::path& log)
        : log_(log) {
        std::vector<char*> texts;
        for (std::string& argument : arguments) texts.push_back(argument.data());
        texts.push_back(nullptr);
        posix_spawn_file_actions_t actions;
        posix_spawn_file_actions_init(&actions);
        posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
        posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, log.c_str(), O_WRONLY | O_CREAT | O_TRUNC,
                                         0666);
        // Signals act as by default, whatever this process was started with.
        posix_spawnattr_t attributes;
        posix_spawnattr_init(&attributes);
        sigset_t all;
        sigfillset(&all);
        posix_spawnattr_setsigdefault(&attributes, &all);
        posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGDEF);
        const int failed = posix_spawn(&process_, texts[0], &actions, &attributes, texts.data(), environ);
        posix_spawnattr_destroy(&attributes);
        posix_spawn_file_actions_destroy(&actions);
        if (failed != 0) throw std::runtime_error("cannot be run: " + arguments[0]);
    }
    ~RunningProgram() {
        if (process_ == 0) return;
        ::kill(process_, SIGKILL);
        wait();
    }
    RunningProgram(const RunningProgram&) = delete;
    RunningProgram& operator=(const RunningProgram&) = delete;

    std::string log() const {
        std::ifstream stream(log_);
        return {std::istreambuf_iterator<char>(stream), {}};
    }
    // Whether the log held the text before the program ended, or before two minutes had passed.
    bool waitForLog(const std::string& text) const {
        const auto start = std::chrono::steady_clock::now();
        while (std::chrono::steady_clock::now() - start < std::chrono::minutes(2)) {
            if (log().find(text) != std::string::npos) return true;
            siginfo_t ended{};
            waitid(P_PID, static_cast<id_t>(process_), &ended, WEXITED | WNOHANG | WNOWAIT);
            if (ended.si_pid != 0) return false;
            std::this_thread::sleep_for(std::chrono::milliseconds(10));
        }
        return false;
    }
    void send(int signal) const { ::kill(process_, signal); }
    // The exit code, or minus the signal that ended it.
    int wait() {
        int status = 0;
        waitpid(process_, &status, 0);
        process_ = 0;
        return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
    }

private:
    std::filesystem::path log_;
    pid_t process_ = 0;
};

} // namespace irradia::test
