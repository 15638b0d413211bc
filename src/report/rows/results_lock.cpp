// Who writes into a folder of results: one process at a time.
#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

#include "file.hpp"
#include "gnomon/report/rows_file.hpp"

namespace gnomon::report {
namespace {

namespace fs = std::filesystem;

constexpr const char* kLockFile = "results.lock";

/// Who wrote its number into the file; "another process" where none is there yet.
std::string holder(int descriptor) {
  char text[16];
  const ssize_t size = ::pread(descriptor, text, sizeof text, 0);
  std::string digits(text, static_cast<std::size_t>(size > 0 ? size : 0));
  digits.resize(std::min(digits.size(), digits.find_first_not_of("0123456789")));
  return digits.empty() ? "another process" : "process " + digits;
}

/// Whether the descriptor's file is the one that the name leads to: its last owner removes it.
bool is_the_file(int descriptor, const fs::path& file) {
  struct stat open {};
  struct stat named {};
  return ::fstat(descriptor, &open) == 0 && ::stat(file.c_str(), &named) == 0 &&
         open.st_ino == named.st_ino && open.st_dev == named.st_dev;
}

}  // namespace

ResultsLock::ResultsLock(const fs::path& folder) : file_(folder / kLockFile) {
  for (;;) {
    descriptor_ = ::open(file_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0666);
    if (descriptor_ < 0) refuse(file_, std::string("cannot be made: ") + std::strerror(errno));
    // The system ends this lock with the process, however that ends. File systems that know no locks are used
    // without.
    if (::flock(descriptor_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
      const std::string who = holder(descriptor_);
      ::close(descriptor_);
      refuse(folder, "in use by " + who);
    }
    if (is_the_file(descriptor_, file_)) break;
    ::close(descriptor_);
  }
  // For the message of whoever comes next; a full disk only makes it less telling.
  const std::string number = std::to_string(::getpid()) + "\n";
  (void)!::ftruncate(descriptor_, 0);
  (void)!::pwrite(descriptor_, number.data(), number.size(), 0);
}

ResultsLock::ResultsLock(ResultsLock&& other) noexcept
    : file_(std::move(other.file_)), descriptor_(std::exchange(other.descriptor_, -1)) {}

ResultsLock::~ResultsLock() {
  if (descriptor_ < 0) return;
  ::unlink(file_.c_str());  // before the lock ends: afterwards it may be another's
  ::close(descriptor_);
}

}  // namespace gnomon::report
