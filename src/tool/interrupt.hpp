// Ctrl-C while files are being written: the one at hand is finished, and the program ends with what it has.
#pragma once

#include <unistd.h>

#include <csignal>
#include <exception>

namespace gnomon::tool {

inline constexpr int kInterrupted = 130;  ///< exit code: 128 + SIGINT, as shells have it

/// Thrown where work can stop: nothing is half written there.
class Interrupted : public std::exception {
 public:
  [[nodiscard]] const char* what() const noexcept override { return "interrupted"; }
};

namespace detail {
inline volatile std::sig_atomic_t interrupts = 0;
extern "C" inline void on_interrupt(int) {
  // Who asks twice does not want to wait for the end of a frame.
  if (interrupts != 0) ::_exit(kInterrupted);
  interrupts = 1;
}
}  // namespace detail

/// From here on SIGINT and SIGTERM end the program at the next check_interrupt(). A file system that is full,
/// or has a limit, is an error of the write and no signal.
inline void watch_interrupts() {
  std::signal(SIGINT, detail::on_interrupt);
  std::signal(SIGTERM, detail::on_interrupt);
  std::signal(SIGXFSZ, SIG_IGN);
}

inline void check_interrupt() {
  if (detail::interrupts != 0) throw Interrupted();
}

}  // namespace gnomon::tool
