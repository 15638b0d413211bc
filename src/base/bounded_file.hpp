// The bytes of a file that somebody else named: how many at most, and for how long are they waited for?
#pragma once

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <string>

namespace gnomon {

/// What a name may lead to. Folders, devices and sockets are refused in any case.
enum class Readable {
  regular_file,
  file_or_pipe  ///< pipes as well: what a shell writes for <(command)
};

/// How long a pipe may give nothing: one that nobody writes to would be waited for without end.
inline constexpr std::chrono::milliseconds kPipePatience{10000};

namespace detail {

/// "16 MiB", "1000 bytes".
[[nodiscard]] inline std::string size_text(std::uint64_t bytes) {
  constexpr std::uint64_t kMebi = 1u << 20;
  return bytes >= kMebi && bytes % kMebi == 0 ? std::to_string(bytes / kMebi) + " MiB"
                                              : std::to_string(bytes) + " bytes";
}

/// Bytes read, 0 at the end, below 0 where errno says why not. Waits for pipes alone.
[[nodiscard]] inline ssize_t read_some(int descriptor, bool is_pipe, std::chrono::milliseconds patience,
                                       void* to, std::size_t count) {
  ssize_t got = -1;
  do {
    pollfd pipe{descriptor, POLLIN, 0};
    // Without a writer so far, reading a pipe looks like its end: it is waited for first.
    const int ready = is_pipe ? ::poll(&pipe, 1, static_cast<int>(patience.count())) : 1;
    if (ready == 0) errno = ETIMEDOUT;
    got = ready > 0 ? ::read(descriptor, to, count) : -1;
  } while (got < 0 && (errno == EINTR || errno == EAGAIN));
  return got;
}

/// As read_bounded_file, of an open file that this closes.
template <typename Bytes>
[[nodiscard]] std::string read_descriptor(int descriptor, std::uint64_t max_bytes, Readable readable,
                                          std::chrono::milliseconds patience, Bytes& bytes) {
  struct Closing {
    int descriptor;
    ~Closing() { ::close(descriptor); }
  } const closing{descriptor};
  struct stat status {};
  if (::fstat(descriptor, &status) != 0) return std::string("cannot be read: ") + std::strerror(errno);
  if (S_ISDIR(status.st_mode)) return "is a folder, not a regular file";
  const bool is_pipe = readable == Readable::file_or_pipe && S_ISFIFO(status.st_mode);
  if (!S_ISREG(status.st_mode) && !is_pipe)
    return readable == Readable::regular_file ? "is not a regular file"
                                              : "is neither a regular file nor a pipe";
  // The size is a guess: files of /proc state none, and others grow meanwhile.
  constexpr std::uint64_t kLeast = 4096;
  const auto stated = static_cast<std::uint64_t>(std::max<off_t>(status.st_size, 0));
  if (stated > max_bytes) return "is larger than " + size_text(max_bytes);
  const auto room = [&](std::uint64_t wanted) {
    return static_cast<std::size_t>(std::min(std::max(wanted, kLeast), max_bytes) + 1);
  };
  std::size_t done = 0;
  bytes.resize(room(stated));
  for (;;) {
    if (done == bytes.size()) bytes.resize(room(2 * std::uint64_t{done}));
    const ssize_t got = read_some(descriptor, is_pipe, patience, bytes.data() + done, bytes.size() - done);
    if (got == 0) break;
    if (got < 0 && errno == ETIMEDOUT && is_pipe)
      return "cannot be read: the pipe gave nothing for " + std::to_string(patience.count()) + " ms";
    if (got < 0) return std::string("cannot be read: ") + std::strerror(errno);
    done += static_cast<std::size_t>(got);
    if (done > max_bytes) return "is larger than " + size_text(max_bytes);
  }
  bytes.resize(done);
  return {};
}

}  // namespace detail

/// Reads a whole file into `bytes`, a std::string or std::vector of bytes. Returns why it could not, without
/// the name, and "" where it could. It never holds more than max_bytes and one, also of a file that grows or
/// states no size, and never waits for the opening of a pipe.
template <typename Bytes>
[[nodiscard]] std::string read_bounded_file(const std::filesystem::path& file, std::uint64_t max_bytes,
                                            Readable readable, Bytes& bytes,
                                            std::chrono::milliseconds patience = kPipePatience) {
  bytes.clear();
  const int descriptor = ::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY);
  if (descriptor < 0) return std::string("cannot be read: ") + std::strerror(errno);
  std::string why = detail::read_descriptor(descriptor, max_bytes, readable, patience, bytes);
  if (!why.empty()) bytes.clear();
  return why;
}

}  // namespace gnomon
