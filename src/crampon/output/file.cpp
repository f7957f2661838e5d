#include "crampon/output/file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <span>
#include <stdexcept>

#include <fmt/format.h>

namespace crampon {
namespace {

[[noreturn]] void fail(const std::filesystem::path& path, const char* verb, int code) {
  throw std::runtime_error(fmt::format("{}: cannot {}: {}", path.string(), verb, std::strerror(code)));
}

// No fsync: a stopped or killed run keeps its files without it, and a power cut is what checkpoints are for.
int write_all(int file, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t n = ::write(file, bytes.data(), bytes.size());
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) return errno;
    bytes.remove_prefix(static_cast<std::size_t>(n));
  }
  return 0;
}

void write_pieces(const std::filesystem::path& path, std::span<const std::string_view> pieces) {
  const std::filesystem::path partial = partial_name(path);
  const int file = ::open(partial.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (file < 0) fail(path, "write", errno);
  int code = 0;
  for (const std::string_view piece : pieces)
    if (code == 0) code = write_all(file, piece);
  if (::close(file) != 0 && code == 0) code = errno;  // network file systems report a full disk only here
  if (code == 0 && ::rename(partial.c_str(), path.c_str()) != 0) code = errno;
  if (code != 0) {
    ::unlink(partial.c_str());
    fail(path, "write", code);
  }
}

}  // namespace

std::filesystem::path partial_name(const std::filesystem::path& path) {
  std::filesystem::path partial = path;
  partial += ".partial";
  return partial;
}

void write_file(const std::filesystem::path& path, std::string_view bytes) { write_pieces(path, {&bytes, 1}); }

void write_file(const std::filesystem::path& path, const std::vector<std::string>& pieces) {
  write_pieces(path, std::vector<std::string_view>(pieces.begin(), pieces.end()));
}

std::string read_file(const std::filesystem::path& path) {
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) fail(path, "read", errno);
  std::string bytes;
  struct stat status {};
  if (::fstat(file, &status) == 0 && S_ISREG(status.st_mode)) bytes.reserve(static_cast<std::size_t>(status.st_size) + 1);
  char buffer[1 << 16];
  for (;;) {
    const ssize_t n = ::read(file, buffer, sizeof buffer);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) {
      const int code = errno;
      ::close(file);
      fail(path, "read", code);
    }
    if (n == 0) break;
    bytes.append(buffer, static_cast<std::size_t>(n));
  }
  ::close(file);
  return bytes;
}

}  // namespace crampon
