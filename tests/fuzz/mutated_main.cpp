// Feeds a reader, or a whole program, files that are nearly right, each in a process of its own: none may
// crash, hang, end with a code other than 0 and 2, or leave a file half written.
#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "fuzz.hpp"
#include "mutate.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

namespace fs = std::filesystem;

constexpr const char* kUsage =
    "usage: mutated_NAME [--count N] [--first N] [--seconds N] [--keep FOLDER] [--name FILE] [--beside "
    "FOLDER] "
    "SEED... [-- PROGRAM ARGUMENT...]\n"
    "  --first: number of the first input; the same number is the same input\n"
    "  in arguments, {} is the input, {in} its folder (with the files of --beside), {out} a new folder\n";

// Seconds of the processor that one input may take: other programs on the machine do not use them up.
// Programs under the sanitizers take several times as long to start.
#if defined(__SANITIZE_ADDRESS__)
constexpr std::uint64_t kPatience = 120;
#else
constexpr std::uint64_t kPatience = 20;
#endif

struct Request {
  std::uint64_t count = 100, first = 0, seconds = kPatience;
  fs::path keep = "out/fuzz", name, beside;
  std::vector<fs::path> seeds;
  std::vector<std::string> program;
};

std::string content_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) throw std::runtime_error(file.string() + ": cannot be read");
  return {std::istreambuf_iterator<char>(in), {}};
}

Request request_of(int argc, char** argv) {
  Request request;
  const std::map<std::string, std::uint64_t*> numbers{
      {"--count", &request.count}, {"--first", &request.first}, {"--seconds", &request.seconds}};
  const std::map<std::string, fs::path*> paths{
      {"--keep", &request.keep}, {"--name", &request.name}, {"--beside", &request.beside}};
  std::vector<std::string> words(argv + 1, argv + argc);
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (words[i] == "--") {
      request.program.assign(words.begin() + static_cast<std::ptrdiff_t>(i) + 1, words.end());
      break;
    }
    const auto number = numbers.find(words[i]);
    const auto path = paths.find(words[i]);
    if (number == numbers.end() && path == paths.end()) {
      request.seeds.emplace_back(words[i]);
      continue;
    }
    if (++i == words.size()) throw std::runtime_error(words[i - 1] + ": wants a value");
    if (path != paths.end()) *path->second = words[i];
    if (number != numbers.end() &&
        std::from_chars(words[i].data(), words[i].data() + words[i].size(), *number->second).ec !=
            std::errc{})
      throw std::runtime_error(words[i - 1] + " " + words[i] + ": wants a number");
  }
  if (request.seeds.empty()) throw std::runtime_error("no seeds");
  std::sort(request.seeds.begin(), request.seeds.end());
  return request;
}

/// Code of the child's end: 128 + signal where one ended it, -1 where it took too long.
int code_of(pid_t child, std::uint64_t seconds) {
  // One that waits for something takes no time of the processor.
  constexpr std::uint64_t kWaiting = 10;
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(kWaiting * seconds);
  int status = 0;
  auto nap = std::chrono::microseconds(200);
  while (::waitpid(child, &status, WNOHANG) == 0) {
    if (std::chrono::steady_clock::now() > end) {
      ::kill(child, SIGKILL);
      ::waitpid(child, &status, 0);
      return -1;
    }
    std::this_thread::sleep_for(nap);
    nap = std::min(nap * 2, std::chrono::microseconds(20'000));
  }
  if (WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU) return -1;
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

void limit_processor(std::uint64_t seconds) {
  const rlimit limit{seconds, RLIM_INFINITY};
  ::setrlimit(RLIMIT_CPU, &limit);
}

void send_output_to(const fs::path& file, bool too) {
  const int to = ::open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666);
  ::dup2(to, STDERR_FILENO);
  ::dup2(too ? to : ::open("/dev/null", O_WRONLY), STDOUT_FILENO);
}

/// Ends the child, with nothing of the parent's flushed a second time.
[[noreturn]] void read_in_child(const std::string& input, const fs::path& said) {
  send_output_to(said, true);
  LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(input.data()), input.size());
  ::_exit(0);
}

[[noreturn]] void run_in_child(std::vector<std::string> words, const fs::path& said) {
  send_output_to(said, false);
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  ::execv(argv[0], argv.data());
  ::_exit(127);
}

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  const std::size_t at = text.find(what);
  return at == std::string::npos ? text : text.replace(at, what.size(), by);
}

/// The last line says why; those before it can only be warnings.
std::string wrong_message(const std::string& said) {
  if (said.empty() || said.back() != '\n') return "no line that says why";
  std::size_t lines = 0;
  for (std::size_t begin = 0; begin < said.size(); ++lines) {
    const std::size_t end = said.find('\n', begin);
    const std::string line = said.substr(begin, end - begin);
    const bool last = end + 1 == said.size();
    // libpng prints what it thinks of a damaged picture itself; the program's own warning follows.
    const bool is_warning = line.find(": warning: ") != std::string::npos || line.starts_with("libpng ");
    if (!last && !is_warning) return "more than one line that says why";
    for (const char c : line)
      if (static_cast<unsigned char>(c) < 0x20 || c == '\x7f') return "control characters in a message";
    begin = end + 1;
  }
  return {};
}

/// Whether it ends as files of its kind do.
bool is_whole(const fs::path& file) {
  const std::string kind = file.extension().string(), bytes = content_of(file);
  if (kind == ".png") return bytes.find("IEND") != std::string::npos;
  if (kind == ".html") return bytes.ends_with("</html>\n");
  if (kind == ".svg") return bytes.find("</svg>") != std::string::npos;
  if (kind == ".csv" || kind == ".md") return bytes.empty() || bytes.back() == '\n';
  return true;
}

/// Files that a program writes beside their name first end in its process number.
std::string half_written(const fs::path& folder) {
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const std::string end = entry.path().extension().string();
    if (end.size() > 1 && end.find_first_not_of("0123456789", 1) == std::string::npos)
      return "left " + entry.path().filename().string();
    if (entry.is_regular_file() && !is_whole(entry.path()))
      return "left half of " + entry.path().filename().string();
  }
  return {};
}

class Runs {
 public:
  explicit Runs(const Request& request) : request_(request) {
    std::string name = (fs::temp_directory_path() / "gnomon_mutated_XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr) throw std::runtime_error("cannot make a temporary folder");
    folder_ = name;
    for (const fs::path& seed : request.seeds) seeds_.push_back(content_of(seed));
  }
  ~Runs() {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
  }
  Runs(const Runs&) = delete;
  Runs& operator=(const Runs&) = delete;

  /// How many broke a promise.
  int all() {
    int broken = 0;
    std::map<int, int> codes;
    for (std::uint64_t i = request_.first; i < request_.first + request_.count; ++i) {
      const std::size_t which = i % seeds_.size();
      const std::string input = gnomon::fuzz::mutated(seeds_[which], i);
      const auto [code, why] = one(request_.seeds[which], input);
      ++codes[code];
      if (why.empty()) continue;
      ++broken;
      fs::create_directories(request_.keep);
      const fs::path kept =
          request_.keep / ("mutated_" + std::to_string(i) + "_" + request_.seeds[which].filename().string());
      std::ofstream(kept, std::ios::binary) << input;
      std::printf("%s: %s\n%s\n", kept.c_str(), why.c_str(),
                  content_of(folder_ / "said").substr(0, 4000).c_str());
    }
    std::printf("%llu inputs of %zu seeds:", static_cast<unsigned long long>(request_.count), seeds_.size());
    for (const auto& [code, count] : codes) std::printf(" %d ended with %d,", count, code);
    std::printf(" %d broke a promise\n", broken);
    return broken;
  }

 private:
  /// Code, and what is wrong with it.
  std::pair<int, std::string> one(const fs::path& seed, const std::string& input) {
    const fs::path said = folder_ / "said";
    std::fflush(nullptr);
    if (request_.program.empty()) {
      gnomon::fuzz::folder_of_input() = seed.parent_path().string();
      const pid_t child = ::fork();
      if (child == 0) {
        limit_processor(request_.seconds);
        read_in_child(input, said);
      }
      const int code = code_of(child, request_.seconds);
      return {code, code == 0 ? "" : described(code)};
    }
    const fs::path in = folder_ / "in", out = folder_ / "out";
    fs::remove_all(in);
    fs::remove_all(out);
    fs::create_directories(in);
    fs::create_directories(out);
    if (!request_.beside.empty()) fs::copy(request_.beside, in, fs::copy_options::recursive);
    const fs::path file = in / (request_.name.empty() ? seed.filename() : request_.name);
    std::ofstream(file, std::ios::binary) << input;
    std::vector<std::string> words;
    for (const std::string& word : request_.program)
      words.push_back(replaced(replaced(replaced(word, "{}", file.string()), "{in}", in.string()), "{out}",
                               out.string()));
    const pid_t child = ::fork();
    if (child == 0) {
      limit_processor(request_.seconds);
      run_in_child(words, said);
    }
    const int code = code_of(child, request_.seconds);
    std::string why = code == 0 || code == 2 ? half_written(out) : described(code);
    fs::remove(file);
    if (why.empty()) why = half_written(in);
    if (why.empty() && code == 2) why = wrong_message(content_of(said));
    return {code, why};
  }

  [[nodiscard]] std::string described(int code) const {
    if (code < 0) return "took longer than " + std::to_string(request_.seconds) + " s";
    return code > 128 ? "ended by signal " + std::to_string(code - 128) : "exit code " + std::to_string(code);
  }

  const Request& request_;
  fs::path folder_;
  std::vector<std::string> seeds_;
};

}  // namespace

int main(int argc, char** argv) {
  try {
    const Request request = request_of(argc, argv);
    return Runs(request).all() == 0 ? 0 : 1;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n%s", error.what(), kUsage);
    return 2;
  }
}
