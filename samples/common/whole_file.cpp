// SPDX-License-Identifier: MIT
#include "whole_file.h"

#include "asset_source.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace forelock::samples {
namespace {

constexpr size_t kPiece = size_t{1} << 30;  // of one system call

struct Descriptor {
  explicit Descriptor(int opened) : fd(opened) {}
  ~Descriptor() { close(); }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  bool close() {
    const int open = std::exchange(fd, -1);
    return open < 0 || ::close(open) == 0;
  }
  int fd;
};

[[noreturn]] void fail(const std::string& text) { throw AssetError(FLK_ERROR_IO, text); }

bool writeAll(int fd, std::span<const unsigned char> bytes) {
  while (!bytes.empty()) {
    const ssize_t put = ::write(fd, bytes.data(), std::min(bytes.size(), kPiece));
    if (put < 0 && errno == EINTR) continue;
    if (put < 0) return false;
    bytes = bytes.subspan(size_t(put));
  }
  return true;
}

// Removes what was not renamed.
struct Temporaries {
  std::vector<std::string> names;
  ~Temporaries() {
    for (const std::string& name : names) ::unlink(name.c_str());
  }
};

std::string writeBeside(const std::string& path, std::span<const unsigned char> bytes, Temporaries& temporaries) {
  struct stat status {};
  const bool replaces = ::stat(path.c_str(), &status) == 0;
  // Renaming onto a device or a pipe would replace it by a file.
  if (replaces && !S_ISREG(status.st_mode)) fail(path + ": is there already and is not a regular file: choose another name");
  std::string name;
  int fd = -1;
  for (int attempt = 0; fd < 0 && attempt < 1000; ++attempt) {
    name = path + "." + std::to_string(::getpid()) + "-" + std::to_string(attempt) + ".tmp";
    fd = ::open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (fd < 0 && errno != EEXIST) break;
  }
  Descriptor file(fd);
  if (fd < 0) fail(path + ": cannot be written: " + std::strerror(errno));
  temporaries.names.push_back(name);
  if (replaces) ::fchmod(fd, status.st_mode & 0777);
  const bool written = writeAll(fd, bytes) && ::fsync(fd) == 0;
  int error = written ? 0 : errno;
  if (!file.close() && error == 0) error = errno;
  if (error != 0) fail(path + ": cannot be written: " + std::strerror(error) + "; what was there is unchanged");
  return name;
}

}  // namespace

std::vector<unsigned char> readWholeFile(const std::string& path, uint64_t largest) {
  // Not blocking: a pipe that nobody writes to would be waited for.
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  if (file.fd < 0) fail(path + ": cannot be opened: " + std::strerror(errno));
  struct stat status {};
  if (::fstat(file.fd, &status) != 0 || !S_ISREG(status.st_mode)) fail(path + ": is not a regular file: name the strand file");
  if (uint64_t(status.st_size) > largest)
    throw AssetError(FLK_ERROR_LIMIT, path + ": it has " + std::to_string(status.st_size) + " bytes, more than the " + std::to_string(largest) +
                                          " that strands and vertices within the limits can fill: split it");
  std::vector<unsigned char> bytes(size_t(status.st_size));
  for (size_t done = 0; done < bytes.size();) {
    const ssize_t got = ::read(file.fd, bytes.data() + done, std::min(bytes.size() - done, kPiece));
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) fail(path + ": cannot be read: " + std::strerror(errno));
    if (got == 0) fail(path + ": it ended while it was read: it is still being written, try again");
    done += size_t(got);
  }
  return bytes;
}

void writeWholeFiles(const std::vector<std::pair<std::string, std::span<const unsigned char>>>& files) {
  Temporaries temporaries;
  std::vector<std::string> names;
  std::vector<std::string> targets;
  for (const auto& [path, bytes] : files) {
    std::error_code error;
    // Renaming onto a link would replace the link, not the file that it names.
    targets.push_back(std::filesystem::is_symlink(path, error) ? std::filesystem::canonical(path, error).string() : path);
    if (error && targets.back().empty()) fail(path + ": is a link that leads nowhere: " + error.message());
    names.push_back(writeBeside(targets.back(), bytes, temporaries));
  }
  for (size_t i = 0; i < files.size(); ++i) {
    if (::rename(names[i].c_str(), targets[i].c_str()) != 0) fail(files[i].first + ": cannot be written: " + std::strerror(errno));
    std::erase(temporaries.names, names[i]);
  }
}

}  // namespace forelock::samples
