#include "engine/image/atomic_file.h"

#include "engine/error.h"
#include "engine/image/image.h"
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <unistd.h>

namespace irradia {
namespace {

// Names such as /dev/stdout stand for what somebody else has open, and may go on writing.
bool isOpenElsewhere(const std::filesystem::path& file) {
    const std::string name = std::filesystem::absolute(file).lexically_normal().string();
    return name.starts_with("/dev/std") || name.starts_with("/dev/fd/") || name.starts_with("/proc/");
}

// The file a rename must replace: symbolic links are kept, devices and folders refused.
std::filesystem::path resolveTarget(const std::filesystem::path& file) {
    std::error_code error;
    const auto status = std::filesystem::status(file, error);
    if (std::filesystem::is_directory(status)) fail(ExitCode::Io, "{}: is a folder", file.string());
    if (isOpenElsewhere(file) ||
        (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status)))
        fail(ExitCode::Io, "{}: is not a regular file, so it cannot be replaced", file.string());
    if (!std::filesystem::is_symlink(file, error)) return file;
    const auto resolved = std::filesystem::weakly_canonical(file, error);
    return error ? file : resolved;
}

// Best effort: makes the rename itself survive a power cut.
void syncFolder(const std::filesystem::path& file) {
    const auto folder = file.has_parent_path() ? file.parent_path() : std::filesystem::path(".");
    const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (descriptor < 0) return;
    ::fsync(descriptor);
    ::close(descriptor);
}

} // namespace

AtomicFile::AtomicFile(const std::filesystem::path& target)
    : name_(target)
    , target_(resolveTarget(target)) {
    int descriptor = -1;
    for (int attempt = 0; attempt < 1000 && descriptor < 0; ++attempt) {
        temporary_ = target_;
        temporary_ += fmt::format(".{}-{}.tmp", ::getpid(), attempt);
        descriptor = ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        if (descriptor < 0 && errno != EEXIST) break;
    }
    if (descriptor < 0) failWithErrno("cannot be written");
    stream_ = ::fdopen(descriptor, "wb");
    if (stream_) return;
    const int error = errno;
    ::close(descriptor);
    ::unlink(temporary_.c_str());
    errno = error;
    failWithErrno("cannot be written");
}

AtomicFile::~AtomicFile() {
    if (!stream_) return;
    std::fclose(stream_);
    ::unlink(temporary_.c_str());
}

void AtomicFile::write(std::span<const uint8_t> bytes) {
    if (std::fwrite(bytes.data(), 1, bytes.size(), stream_) != bytes.size())
        failWithErrno("cannot be written");
}

void AtomicFile::seek(uint64_t position) {
    if (::fseeko(stream_, static_cast<off_t>(position), SEEK_SET) != 0) failWithErrno("cannot be written");
}

uint64_t AtomicFile::position() {
    const off_t position = ::ftello(stream_);
    if (position < 0) failWithErrno("cannot be written");
    return static_cast<uint64_t>(position);
}

void AtomicFile::commit() {
    if (std::fflush(stream_) != 0 || ::fsync(::fileno(stream_)) != 0) failWithErrno("cannot be written");
    if (::rename(temporary_.c_str(), target_.c_str()) != 0) failWithErrno("cannot be replaced");
    std::fclose(stream_); // everything is on disk already
    stream_ = nullptr;
    syncFolder(target_);
}

void AtomicFile::failWithErrno(const char* what) const {
    fail(ExitCode::Io, "{}: {}: {}", name_.string(), what, std::strerror(errno));
}

void writeFileAtomically(const std::filesystem::path& file, std::span<const uint8_t> bytes) {
    AtomicFile target(file);
    target.write(bytes);
    target.commit();
}

void requireWritable(const std::filesystem::path& file) {
    AtomicFile{file};
}

} // namespace irradia
