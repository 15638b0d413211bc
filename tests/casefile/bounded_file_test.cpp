// Reading a file that somebody else named: what has no end is refused, and nothing is waited for without end.
#include "base/bounded_file.hpp"

#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/un.h>

#include <array>
#include <cstdint>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

namespace gnomon {
namespace {

namespace fs = std::filesystem;
using std::chrono::milliseconds;

constexpr std::uint64_t kMax = 100000;

class BoundedFile : public testing::Test {
 protected:
  BoundedFile() {
    std::string name = (fs::temp_directory_path() / "gnomon_bounded_XXXXXX").string();
    folder_ = ::mkdtemp(name.data());
  }
  ~BoundedFile() override { fs::remove_all(folder_); }

  [[nodiscard]] fs::path written(std::size_t bytes) const {
    const fs::path file = folder_ / "file";
    std::ofstream(file, std::ios::binary) << std::string(bytes, 'x');
    return file;
  }
  [[nodiscard]] fs::path pipe() const {
    const fs::path file = folder_ / "pipe";
    EXPECT_EQ(::mkfifo(file.c_str(), 0600), 0);
    return file;
  }

  fs::path folder_;
};

std::string why(const fs::path& file, Readable readable = Readable::file_or_pipe, std::uint64_t max = kMax) {
  std::string bytes = "old";
  const std::string text = read_bounded_file(file, max, readable, bytes, milliseconds(50));
  EXPECT_TRUE(text.empty() || bytes.empty()) << "nothing is left of an attempt";
  return text;
}

TEST_F(BoundedFile, what_is_no_file_is_refused) {
  for (const Readable readable : {Readable::regular_file, Readable::file_or_pipe}) {
    EXPECT_EQ(why(folder_, readable), "is a folder, not a regular file");
    EXPECT_NE(why("/dev/zero", readable).find("is n"), std::string::npos);
    EXPECT_NE(why("/dev/null", readable).find("is n"), std::string::npos);
    EXPECT_NE(why(folder_ / "none", readable).find("No such file"), std::string::npos);
    EXPECT_NE(why("", readable), "");
  }
  const int listening = ::socket(AF_UNIX, SOCK_STREAM, 0);
  sockaddr_un address{AF_UNIX, {}};
  (folder_ / "socket").string().copy(address.sun_path, sizeof address.sun_path - 1);
  ASSERT_EQ(::bind(listening, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
  EXPECT_NE(why(folder_ / "socket"), "");
  ::close(listening);
}

TEST_F(BoundedFile, any_size_up_to_the_bound_is_read_and_no_byte_more) {
  for (const std::size_t size : {0, 1, 4095, 4096, 4097, 50000, 99999, 100000}) {
    std::string bytes;
    EXPECT_EQ(read_bounded_file(written(size), kMax, Readable::regular_file, bytes), "") << size;
    EXPECT_EQ(bytes, std::string(size, 'x'));
    std::vector<std::uint8_t> same;
    EXPECT_EQ(read_bounded_file(written(size), size, Readable::regular_file, same), "") << size;
    EXPECT_EQ(same.size(), size);
    if (size == 0) continue;
    EXPECT_NE(why(written(size), Readable::regular_file, size - 1), "") << size;
  }
  EXPECT_EQ(why(written(kMax + 1)), "is larger than 100000 bytes");
  EXPECT_EQ(why(written((1 << 20) + 1), Readable::regular_file, 1 << 20), "is larger than 1 MiB");
}

TEST_F(BoundedFile, a_file_that_states_no_size_is_read_to_its_end_and_bounded) {
  std::string bytes;
  ASSERT_EQ(read_bounded_file("/proc/self/status", kMax, Readable::regular_file, bytes), "");
  EXPECT_EQ(bytes.back(), '\n');
  EXPECT_EQ(why("/proc/self/status", Readable::regular_file, 10), "is larger than 10 bytes");
}

TEST_F(BoundedFile, a_pipe_is_read_to_its_end_where_pipes_are_taken) {
  const fs::path file = pipe();
  EXPECT_NE(why(file, Readable::regular_file).find("regular file"), std::string::npos);
  std::thread writer([&] {
    std::ofstream out(file, std::ios::binary);  // waits for the reader
    for (int i = 0; i < 70000; ++i) out << static_cast<char>('a' + i % 26);
  });
  std::string bytes;
  EXPECT_EQ(read_bounded_file(file, kMax, Readable::file_or_pipe, bytes), "");
  writer.join();
  ASSERT_EQ(bytes.size(), 70000u);
  for (std::size_t i = 0; i < bytes.size(); ++i) ASSERT_EQ(bytes[i], static_cast<char>('a' + i % 26));
}

TEST_F(BoundedFile, a_pipe_without_end_is_refused_at_the_bound) {
  std::array<int, 2> ends{};
  ASSERT_EQ(::pipe2(ends.data(), O_CLOEXEC), 0);
  // A pipe holds fewer bytes than the bound: the writer goes on until nobody reads.
  std::thread writer([&] {
    const std::string block(1000, 'x');
    for (std::size_t i = 0; i < 2 * kMax / block.size(); ++i)
      (void)!::write(ends[1], block.data(), block.size());
  });
  EXPECT_EQ(why("/proc/self/fd/" + std::to_string(ends[0])), "is larger than 100000 bytes");
  std::string rest(2 * kMax, ' ');
  for (std::size_t done = 0; done < kMax - 4096;) {
    const ssize_t got = ::read(ends[0], rest.data(), rest.size());
    if (got <= 0) break;
    done += static_cast<std::size_t>(got);
  }
  writer.join();
  ::close(ends[0]);
  ::close(ends[1]);
}

TEST_F(BoundedFile, a_pipe_that_gives_nothing_is_given_up) {
  const fs::path file = pipe();
  EXPECT_EQ(why(file), "cannot be read: the pipe gave nothing for 50 ms") << "nobody writes";
  const int open = ::open(file.c_str(), O_RDWR | O_CLOEXEC);
  EXPECT_EQ(why(file), "cannot be read: the pipe gave nothing for 50 ms") << "somebody could";
  ::close(open);
}

}  // namespace
}  // namespace gnomon
