// A file that appears under its name only when it is whole: a temporary beside the target, synced and
// renamed.
#pragma once

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <span>

namespace irradia {

class AtomicFile {
public:
    explicit AtomicFile(const std::filesystem::path& target); // throws Error(Io)
    ~AtomicFile();                                            // removes the temporary unless committed
    AtomicFile(const AtomicFile&) = delete;
    AtomicFile& operator=(const AtomicFile&) = delete;

    void write(std::span<const uint8_t> bytes);
    void seek(uint64_t position);
    uint64_t position();
    void commit(); // flush, sync, rename

private:
    [[noreturn]] void failWithErrno(const char* what) const;

    std::filesystem::path name_;   // as the user wrote it, for errors
    std::filesystem::path target_; // behind symbolic links
    std::filesystem::path temporary_;
    std::FILE* stream_ = nullptr;
};

} // namespace irradia
