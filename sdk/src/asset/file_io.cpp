#include "asset/file_io.h"

#include "asset/sniff.h"

#include <algorithm>
#include <cerrno>
#include <climits>
#include <cstdlib>
#include <cinttypes>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <string>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

namespace forelock {
namespace {

class Descriptor {
public:
  explicit Descriptor(int fd) noexcept : fd_(fd) {}
  ~Descriptor() { close(); }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;

  explicit operator bool() const noexcept { return fd_ >= 0; }
  int get() const noexcept { return fd_; }
  bool close() noexcept {
    const int fd = fd_;
    fd_ = -1;
    return fd < 0 || ::close(fd) == 0;
  }

private:
  int fd_;
};

// strerror_r comes in two shapes, told apart by what it returns.
[[maybe_unused]] const char* reasonFrom(const char* text, const char*) noexcept { return text; }
[[maybe_unused]] const char* reasonFrom(int, const char* buffer) noexcept { return buffer; }

struct Reason {
  explicit Reason(int error) noexcept : text(reasonFrom(strerror_r(error, buffer, sizeof buffer), buffer)) {}
  char buffer[128] = "unknown error";
  const char* text;
};

// Bytes read, fewer than asked for only at the end of the file; -1 with errno set.
ssize_t readUpTo(int fd, std::span<std::byte> out) noexcept {
  std::size_t done = 0;
  while (done < out.size()) {
    constexpr std::size_t piece = std::size_t{1} << 30;
    const ssize_t got = ::read(fd, out.data() + done, std::min(out.size() - done, piece));
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) return -1;
    if (got == 0) break;
    done += static_cast<std::size_t>(got);
  }
  return static_cast<ssize_t>(done);
}

bool writeAll(int fd, std::span<const std::byte> bytes) noexcept {
  while (!bytes.empty()) {
    constexpr std::size_t piece = std::size_t{1} << 30;
    const ssize_t put = ::write(fd, bytes.data(), std::min(bytes.size(), piece));
    if (put < 0 && errno == EINTR) continue;
    if (put < 0) return false;
    bytes = bytes.subspan(static_cast<std::size_t>(put));
  }
  return true;
}

// A new file in the folder of `path`, so that it can be renamed onto it; its name goes to `name`. -1 with errno set.
int createBeside(const char* path, std::pmr::string& name) {
  constexpr int attempts = 1000;
  for (int attempt = 0;; ++attempt) {
    char suffix[48];
    std::snprintf(suffix, sizeof suffix, ".%ld-%d.tmp", static_cast<long>(::getpid()), attempt);
    name.assign(path).append(suffix);
    const int fd = ::open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (fd >= 0 || errno != EEXIST || attempt == attempts) return fd;
  }
}

}  // namespace

Mapping::~Mapping() {
  if (!bytes_.empty()) ::munmap(const_cast<std::byte*>(bytes_.data()), bytes_.size());
}

bool Mapping::map(int fd, uint64_t size) noexcept {
  if (size == 0 || size > SIZE_MAX) return false;
  void* memory = ::mmap(nullptr, static_cast<std::size_t>(size), PROT_READ, MAP_PRIVATE, fd, 0);
  if (memory == MAP_FAILED) return false;
  *this = Mapping();
  bytes_ = {static_cast<const std::byte*>(memory), static_cast<std::size_t>(size)};
  return true;
}

FlkResult readFile(const char* path, uint64_t largest, bool must_copy, const Report& report, AcceptHead accept, FileBytes& file_bytes) {
  // Not blocking: opening a pipe that nobody writes to would wait for ever before it could be refused.
  Descriptor file(::open(path, O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  if (!file) return report.fail(FLK_ERROR_IO, "FILE_NOT_OPENED", "cannot be opened: %s; check the path and its permissions", Reason(errno).text);
  struct stat status {};
  if (::fstat(file.get(), &status) != 0)
    return report.fail(FLK_ERROR_IO, "FILE_NOT_READ", "cannot be examined: %s", Reason(errno).text);
  if (S_ISDIR(status.st_mode))
    return report.fail(FLK_ERROR_IO, "FILE_IS_DIRECTORY", "it is a directory: name the strand file inside");
  if (!S_ISREG(status.st_mode))
    return report.fail(FLK_ERROR_IO, "FILE_NOT_REGULAR", "it is a pipe, a socket or a device: copy it to a file first");

  const uint64_t size = static_cast<uint64_t>(status.st_size);
  std::byte head[sniffed_bytes];
  const std::size_t head_size = std::min<uint64_t>(size, sizeof head);
  const ssize_t got = readUpTo(file.get(), std::span(head, head_size));
  if (got < 0) return report.fail(FLK_ERROR_IO, "FILE_NOT_READ", "cannot be read: %s", Reason(errno).text);
  if (const FlkResult result = accept(std::span(head, static_cast<std::size_t>(got)), report); result != FLK_SUCCESS)
    return result;
  if (size > largest)
    return report.fail(FLK_ERROR_LIMIT, "FILE_TOO_LARGE",
                       "it has %" PRIu64 " bytes, more than the %" PRIu64
                       " that strands and vertices within the limits can fill: split it or raise the limits",
                       size, largest);

  if (!must_copy && static_cast<std::size_t>(got) == head_size && file_bytes.mapping.map(file.get(), size)) return FLK_SUCCESS;
  std::pmr::vector<std::byte>& bytes = file_bytes.copy;
  bytes.resize(size);
  if (head_size != 0) std::memcpy(bytes.data(), head, head_size);
  const ssize_t rest = readUpTo(file.get(), std::span(bytes).subspan(head_size));
  if (rest < 0) return report.fail(FLK_ERROR_IO, "FILE_NOT_READ", "cannot be read: %s", Reason(errno).text);
  const uint64_t total = static_cast<uint64_t>(got) + static_cast<uint64_t>(rest);
  if (total != size)
    return report.fail(FLK_ERROR_IO, "FILE_NOT_READ",
                       "it ended at byte %" PRIu64 " of %" PRIu64 " while it was read: it is still being written, try again",
                       total, size);
  return FLK_SUCCESS;
}

FlkResult writeFile(const char* path, std::span<const std::byte> bytes, const Report& report,
                    std::pmr::memory_resource* memory) {
  // Renaming onto a link would replace the link, not the file that it names.
  char target[PATH_MAX];
  struct stat link {};
  if (::lstat(path, &link) == 0 && S_ISLNK(link.st_mode)) {
    if (!::realpath(path, target))
      return report.fail(FLK_ERROR_IO, "FILE_NOT_WRITTEN", "%s is a link that leads nowhere: %s; remove it or choose another name", path, Reason(errno).text);
    path = target;
  }
  // Renaming onto a device or a pipe would replace it by a file.
  struct stat status {};
  const bool replaces = ::stat(path, &status) == 0;
  if (replaces && !S_ISREG(status.st_mode))
    return report.fail(FLK_ERROR_IO, "FILE_NOT_REGULAR", "%s is there already and is not a regular file: choose another name",
                       path);

  std::pmr::string temporary(memory);
  Descriptor file(createBeside(path, temporary));
  if (!file)
    return report.fail(FLK_ERROR_IO, "FILE_NOT_WRITTEN", "%s cannot be written: no file can be created beside it (%s)", path, Reason(errno).text);
  if (replaces) ::fchmod(file.get(), status.st_mode & 0777);
  const bool written = writeAll(file.get(), bytes) && ::fsync(file.get()) == 0;
  int error = written ? 0 : errno;
  if (!file.close() && error == 0) error = errno;
  if (error == 0 && ::rename(temporary.c_str(), path) != 0) error = errno;
  if (error == 0) return FLK_SUCCESS;
  ::unlink(temporary.c_str());
  return report.fail(FLK_ERROR_IO, "FILE_NOT_WRITTEN", "%s cannot be written: %s; what was there is unchanged", path,
                     Reason(error).text);
}

}  // namespace forelock
