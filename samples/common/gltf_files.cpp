// SPDX-License-Identifier: MIT
#include "gltf_files.h"

#include "gltf_refusal.h"
#include "tinygltf_import.h"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace forelock::samples {
namespace {

namespace fs = std::filesystem;

struct Descriptor {
  explicit Descriptor(int opened) : fd(opened) {}
  ~Descriptor() {
    if (fd >= 0) ::close(fd);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int fd;
};

[[noreturn]] void refuseUri(const std::string& where, const std::string& uri, const std::string& why) {
  refuseGltf("GLTF_URI", where + " is \"" + printable(uri) + "\": " + why);
}

bool hasScheme(const std::string& uri) {
  const size_t colon = uri.find(':');
  return colon != std::string::npos && colon > 0 && std::isalpha(static_cast<unsigned char>(uri[0])) &&
         std::all_of(uri.begin(), uri.begin() + std::ptrdiff_t(colon), [](unsigned char c) { return std::isalnum(c) || c == '+' || c == '.' || c == '-'; });
}

int hexDigit(char c) { return c >= '0' && c <= '9' ? c - '0' : c >= 'a' && c <= 'f' ? c - 'a' + 10 : c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1; }

std::string percentDecoded(const std::string& uri) {
  std::string text;
  for (size_t i = 0; i < uri.size(); ++i) {
    const int high = uri[i] == '%' && i + 2 < uri.size() ? hexDigit(uri[i + 1]) : -1;
    const int low = high >= 0 ? hexDigit(uri[i + 2]) : -1;
    if (low >= 0) text += static_cast<char>(16 * high + low), i += 2;
    else text += uri[i];
  }
  return text;
}

// The real path of what the URI names, proven to lie in the folder.
fs::path resolve(const std::string& uri, const fs::path& folder, const std::string& where) {
  if (hasScheme(uri)) refuseUri(where, uri, "only files in the folder of the glTF file are read, nothing from elsewhere; put it there and name it");
  const std::string name = percentDecoded(uri);
  if (std::any_of(name.begin(), name.end(), [](unsigned char c) { return c < 32 || c == '\\'; }))
    refuseUri(where, uri, "it holds characters that no relative URI has");
  const fs::path relative(name);
  if (relative.is_absolute() || relative.has_root_path()) refuseUri(where, uri, "it is an absolute path; only files in the folder of the glTF file are read");
  for (const fs::path& part : relative)
    if (part == "..") refuseUri(where, uri, "it leaves the folder of the glTF file; only files inside are read");
  if (folder.empty()) refuseUri(where, uri, "it names a file, but there is no folder to look in");
  std::error_code error;
  const fs::path base = fs::canonical(folder, error);
  const fs::path real = error ? fs::path() : fs::canonical(folder / relative, error);
  if (error)
    refuseGltf("GLTF_FILE", where + " names " + printable(name) + ", which cannot be opened (" + error.message() + "): put it beside the glTF file",
               FLK_ERROR_IO);
  const auto [end, inside] = std::mismatch(base.begin(), base.end(), real.begin(), real.end());
  if (end != base.end() || inside == real.end()) refuseUri(where, uri, "it is a link that leaves the folder of the glTF file; only files inside are read");
  return real;
}

[[noreturn]] void refuseShort(const std::string& where, uint64_t wanted, uint64_t there, const std::string& what) {
  const size_t dot = where.rfind('.');
  refuseGltf("GLTF_BUFFER_SHORT", where.substr(0, dot) + ".byteLength is " + std::to_string(wanted) + ", but " + what + " holds " + std::to_string(there) +
                                      " bytes: it is truncated, fetch or export it again");
}

std::vector<unsigned char> readFile(const fs::path& path, uint64_t bytes, const std::string& where) {
  const std::string name = printable(path.filename().string());
  const auto refuseFile = [&](const std::string& why) { refuseGltf("GLTF_FILE", where + " names " + name + ", which " + why, FLK_ERROR_IO); };
  // Not blocking: a pipe that nobody writes to would be waited for.
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOFOLLOW));
  if (file.fd < 0) refuseFile(std::string("cannot be opened: ") + std::strerror(errno));
  struct stat status {};
  if (::fstat(file.fd, &status) != 0 || !S_ISREG(status.st_mode)) refuseFile("is no regular file");
  if (uint64_t(status.st_size) < bytes) refuseShort(where, bytes, uint64_t(status.st_size), name);
  std::vector<unsigned char> data(bytes);
  for (size_t done = 0; done < data.size();) {
    const ssize_t got = ::read(file.fd, data.data() + done, std::min<size_t>(data.size() - done, size_t{1} << 30));
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) refuseFile(got == 0 ? "ended while it was read: try again" : std::string("cannot be read: ") + std::strerror(errno));
    done += size_t(got);
  }
  return data;
}

}  // namespace

std::vector<unsigned char> readGltfBuffer(const std::string& uri, uint64_t bytes, const fs::path& folder, const std::string& where) {
  if (uri.compare(0, 5, "data:") != 0) return readFile(resolve(uri, folder, where), bytes, where);
  const size_t comma = uri.find(',');
  if (comma == std::string::npos || comma < 7 || uri.compare(comma - 7, 7, ";base64") != 0)
    refuseUri(where, uri, "data has to be in base64, as in data:application/octet-stream;base64,");
  // Three bytes are made of four characters.
  const uint64_t most = (uri.size() - comma - 1) / 4 * 3 + 3;
  if (most < bytes) refuseShort(where, bytes, most, "its data: URI at most");
  std::vector<unsigned char> data;
  std::string type;
  // Media types that the parser does not know are as good as the one it does.
  tinygltf::DecodeDataURI(&data, type, "data:application/octet-stream;base64" + uri.substr(comma), 0, false);
  if (data.size() < bytes) refuseShort(where, bytes, data.size(), "its data: URI");
  data.resize(bytes);
  return data;
}

}  // namespace forelock::samples
