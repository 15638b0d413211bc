// The viewer's window under a display of the test's own, driven by a person's keys and mouse.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <spawn.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <filesystem>
#include <set>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "gnomon/report/row.hpp"
#include "gnomon/scene/image.hpp"
#include "process.hpp"

extern char** environ;

namespace gnomon::test {
namespace {

using namespace std::chrono_literals;

// Far longer than a window or a file takes, under the sanitizers and beside others.
constexpr std::chrono::seconds kLimit{240};
// The same for what is there after some pictures.
constexpr int kMaxPictures = 1000;

pid_t start(std::vector<std::string> words, const std::string& log, int keep_open = -1) {
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, 0, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, 1, log.c_str(), O_WRONLY | O_CREAT | O_APPEND, 0600);
  posix_spawn_file_actions_addopen(&actions, 2, log.c_str(), O_WRONLY | O_CREAT | O_APPEND, 0600);
  if (keep_open >= 0) posix_spawn_file_actions_adddup2(&actions, keep_open, 3);
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  pid_t process = 0;
  const int failed = posix_spawnp(&process, argv[0], &actions, nullptr, argv.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  return failed == 0 ? process : -1;
}

int wait_for(pid_t process) {
  int status = 0;
  if (waitpid(process, &status, 0) != process) return -1;
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

/// Runs a program to its end; its output, or "" where it is not there.
std::string output_of(const std::vector<std::string>& words, const TemporaryFolder& folder,
                      int* code = nullptr) {
  const std::string log = folder.write("output", "");
  const pid_t process = start(words, log);
  const int ended = process < 0 ? -1 : wait_for(process);
  if (code != nullptr) *code = ended;
  return content_of(log);
}

/// One X server for all tests of this program.
class Display : public testing::Environment {
 public:
  void SetUp() override {
    int ends[2];
    if (pipe(ends) != 0) return lack("a pipe");
    // No key repeats by itself where a busy machine is late to let it go; and no server begins anew,
    // refusing who comes meanwhile, where its last client leaves.
    server_ = start(
        {"Xvfb", "-r", "-noreset", "-displayfd", "3", "-screen", "0", "1400x900x24", "-nolisten", "tcp"},
        folder_.write("xvfb", ""), ends[1]);
    close(ends[1]);
    std::string number;
    for (char c = 0; read(ends[0], &c, 1) == 1 && c != '\n';) number += c;
    close(ends[0]);
    if (server_ < 0 || number.empty()) return lack("Xvfb");
    setenv("DISPLAY", (":" + number).c_str(), 1);
    setenv("HOME", folder_.path().c_str(), 1);
    unsetenv("XDG_CONFIG_HOME");
    unsetenv("XDG_STATE_HOME");
    unsetenv("WAYLAND_DISPLAY");
    int code = 0;
    (void)output_of({"xdotool", "version"}, folder_, &code);
    if (code != 0) return lack("xdotool");
  }
  void TearDown() override {
    if (server_ > 0) {
      kill(server_, SIGTERM);
      (void)wait_for(server_);
    }
  }
  [[nodiscard]] const std::string& lacking() const { return lacking_; }
  [[nodiscard]] const std::filesystem::path& home() const { return folder_.path(); }

 private:
  void lack(const char* what) { lacking_ = what; }
  TemporaryFolder folder_;
  pid_t server_ = -1;
  std::string lacking_;
};
Display* const display = static_cast<Display*>(testing::AddGlobalTestEnvironment(new Display));

std::size_t different_pixels(const Image& a, const Image& b) {
  if (a.rgba.size() != b.rgba.size()) return a.rgba.size() + b.rgba.size();
  std::size_t count = 0;
  for (std::size_t i = 0; i < a.rgba.size(); i += 4)
    count += std::equal(&a.rgba[i], &a.rgba[i] + 3, &b.rgba[i]) ? 0 : 1;
  return count;
}

/// Of another view, or from another place.
constexpr std::size_t kOther = 1000;

/// The viewer in a folder of its own, as a person has it on the screen.
class ViewWindow : public testing::Test {
 protected:
  void SetUp() override {
    if (!display->lacking().empty())
      GTEST_SKIP() << "no window can be driven here: " << display->lacking() << " is missing";
    before_ = std::filesystem::current_path();
    std::filesystem::current_path(folder_.path());
  }
  void TearDown() override {
    if (process_ > 0) {
      kill(process_, SIGKILL);
      (void)wait_for(process_);
    }
    if (!before_.empty()) std::filesystem::current_path(before_);
  }

  void open(std::vector<std::string> words) {
    words.insert(words.begin(), {GNOMON_PROGRAM, "view"});
    process_ = start(words, log());
    ASSERT_GT(process_, 0);
    // A search that meets a window on its way out ends with an error: it is made again.
    const auto end = std::chrono::steady_clock::now() + kLimit;
    int code = 1;
    while (code != 0 && !has_ended() && std::chrono::steady_clock::now() < end) {
      std::this_thread::sleep_for(5ms);
      window_ = output_of({"xdotool", "search", "--onlyvisible", "--name", "^gnomon view: "}, folder_, &code);
    }
    window_ = window_.substr(0, window_.find('\n'));
    ASSERT_TRUE(code == 0 && !window_.empty()) << window_ << content_of(log());
    // Off the picture, whose probe would draw over it.
    drive({"mousemove", "--window", window_, "2", "2"});
    drive({"windowfocus", "--sync", window_});
  }
  void drive(std::vector<std::string> words) {
    words.insert(words.begin(), "xdotool");
    int code = 0;
    const std::string said = output_of(words, folder_, &code);
    EXPECT_EQ(code, 0) << testing::PrintToString(words) << ": " << said;
  }
  void key(const std::string& name) { drive({"key", name}); }
  /// The first picture that is another one.
  Image picture_other_than(const Image& from) {
    Image now = picture();
    for (int i = 0; i < kMaxPictures && different_pixels(from, now) <= kOther; ++i) now = picture();
    EXPECT_GT(different_pixels(from, now), kOther);
    return now;
  }
  /// Holds a key down until the picture is another one, and returns that.
  Image hold(const std::string& name, const Image& from) {
    drive({"keydown", name});
    Image other = picture_other_than(from);
    drive({"keyup", name});
    return other;
  }
  /// The viewer's frame takes until go_on().
  void stop() const {
    int status = 0;
    ASSERT_EQ(kill(process_, SIGSTOP), 0);
    ASSERT_EQ(waitpid(process_, &status, WUNTRACED), process_);
    ASSERT_TRUE(WIFSTOPPED(status)) << content_of(log());
  }
  void go_on() const { ASSERT_EQ(kill(process_, SIGCONT), 0); }
  /// Waits until the file is there; false where the viewer ended without it.
  [[nodiscard]] bool wrote(const std::filesystem::path& file) const {
    const auto end = std::chrono::steady_clock::now() + kLimit;
    while (!std::filesystem::exists(file) && !has_ended() && std::chrono::steady_clock::now() < end)
      std::this_thread::sleep_for(5ms);
    return std::filesystem::exists(file);
  }
  /// The next picture, as F12 writes it.
  Image picture() {
    const std::string number = std::to_string(++pictures_);
    const std::filesystem::path file = "gnomon_view_" + std::string(4 - number.size(), '0') + number + ".png";
    key("F12");
    EXPECT_TRUE(wrote(file)) << content_of(log());
    return read(file);
  }
  [[nodiscard]] static Image read(const std::filesystem::path& file) {
    const std::string bytes = content_of(file);
    EXPECT_FALSE(bytes.empty()) << file;
    if (bytes.empty()) return {};
    return decode_image({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()}, file.string(),
                        1u << 24);
  }
  int close() {
    key("ctrl+q");
    const int code = wait_for(process_);
    process_ = -1;
    return code;
  }
  [[nodiscard]] bool has_ended() const {
    siginfo_t info{};
    return waitid(P_PID, static_cast<id_t>(process_), &info, WEXITED | WNOHANG | WNOWAIT) != 0 ||
           info.si_pid != 0;
  }
  [[nodiscard]] std::string log() const { return (folder_.path() / "log").string(); }
  /// The picture of the state file without a window, in the size of `like`.
  [[nodiscard]] Image headless(const std::string& state, const Image& like) const {
    const Finished run = spawn_gnomon({"view", "--state", state, "--size",
                                       std::to_string(like.width) + "x" + std::to_string(like.height),
                                       "--out", "headless.png", "--context", "osmesa"});
    EXPECT_EQ(run.exit_code, 0) << run.err;
    return read("headless.png");
  }

  TemporaryFolder folder_;
  std::filesystem::path before_;
  pid_t process_ = -1;
  std::string window_;
  int pictures_ = 0;
};

const std::vector<std::string> kSmall{"builtin:hangar", "--map-size", "256", "--size", "640x300"};

TEST_F(ViewWindow, shows_what_its_state_shows_without_a_window) {
  open(kSmall);
  const Image lit = picture();
  key("2");  // heat
  key("v");  // no warp
  key("minus");
  const Image heat = picture();
  EXPECT_GT(different_pixels(lit, heat), kOther);
  key("F5");
  ASSERT_TRUE(wrote("gnomon_view.json"));
  EXPECT_EQ(different_pixels(heat, headless("gnomon_view.json", heat)), 0u);
  const std::string state = content_of("gnomon_view.json");
  EXPECT_NE(state.find("\"view\": \"heat\""), std::string::npos);
  EXPECT_NE(state.find("\"warp\": \"none\""), std::string::npos);
  EXPECT_NE(state.find("\"cascades\": 3"), std::string::npos);
  EXPECT_EQ(close(), 0);
  EXPECT_EQ(content_of(log()), "") << "warnings, or errors of OpenGL";
  // The session is where the base directory specification has it.
  EXPECT_NE(content_of(display->home() / ".config/gnomon/view.json").find("builtin:hangar"),
            std::string::npos);
  EXPECT_EQ(content_of(display->home() / ".local/state/gnomon/view_state.json"), state);
}

TEST_F(ViewWindow, moves_at_once_and_undoes) {
  open(kSmall);
  const Image begin = picture();
  (void)hold("w", begin);
  key("r");
  EXPECT_EQ(different_pixels(begin, picture()), 0u);
  key("Escape");  // closes nothing but the help
  key("F5");
  EXPECT_TRUE(wrote("gnomon_view.json"));
  EXPECT_EQ(close(), 0);
}

TEST_F(ViewWindow, records_a_path_and_flies_along_it) {
  open(kSmall);
  Image moved = picture();
  key("k");
  key("k");  // the camera did not move: no path
  key("k");
  for (int i = 0; i < 3; ++i) moved = hold("w", moved);
  const Image end = picture();
  key("k");
  ASSERT_TRUE(wrote("gnomon_path_0001.json"));
  key("r");  // the middle of the path
  const Image middle = picture();
  EXPECT_GT(different_pixels(end, middle), kOther);
  key("F5");
  ASSERT_TRUE(wrote("gnomon_view.json"));
  EXPECT_EQ(different_pixels(middle, headless("gnomon_view.json", middle)), 0u);
  EXPECT_EQ(close(), 0);
  EXPECT_FALSE(std::filesystem::exists("gnomon_path_0002.json"))
      << content_of("gnomon_path_0001.json") << content_of("gnomon_path_0002.json") << content_of(log());
  std::vector<std::string> command{"view",      "--path", "gnomon_path_0001.json", "--out", "path.png",
                                   "--context", "osmesa"};
  command.insert(command.begin() + 1, kSmall.begin(), kSmall.end());
  *std::find(command.begin(), command.end(), "640x300") =
      std::to_string(middle.width) + "x" + std::to_string(middle.height);
  const Finished run = spawn_gnomon(command);
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(different_pixels(middle, read("path.png")), 0u);
}

TEST_F(ViewWindow, stays_where_it_is_at_a_click_and_turns_by_a_drag) {
  open(kSmall);
  const Image begin = picture();
  // The way into the picture and the click are one frame's.
  stop();
  drive({"mousemove", "--window", window_, "510", "100", "click", "1"});
  go_on();
  EXPECT_EQ(different_pixels(begin, picture()), 0u);
  drive({"mousedown", "1"});
  EXPECT_EQ(different_pixels(begin, picture()), 0u);
  drive({"mousemove", "--window", window_, "570", "120"});
  (void)picture_other_than(begin);
  drive({"mouseup", "1"});
  EXPECT_EQ(close(), 0);
}

TEST_F(ViewWindow, comes_to_what_lies_under_the_cursor) {
  open(kSmall);
  Image last = picture();
  drive({"mousemove", "--window", window_, "510", "150"});
  // The triangles are sorted for rays in the background: until then the key says so.
  bool came = false;
  for (int i = 0; i < kMaxPictures && !came; ++i) {
    key("c");
    const Image now = picture();
    came = different_pixels(last, now) > kOther;
    last = now;
  }
  EXPECT_TRUE(came);
  key("F5");
  ASSERT_TRUE(wrote("gnomon_view.json"));
  EXPECT_NE(content_of("gnomon_view.json").find("\"eye\""), std::string::npos);
  EXPECT_EQ(close(), 0);
}

TEST_F(ViewWindow, shows_the_scene_in_the_first_frame_that_counts) {
  const Finished run = spawn_gnomon({"view", "builtin:hangar", "--map-size", "256", "--size", "640x300",
                                     "--exit-after", "1", "--screenshot", "shot.png"});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  const Image shot = read("shot.png");
  // Right of the panel, above the status line.
  std::set<std::array<std::uint8_t, 3>> colors;
  for (int y = 0; y < shot.height / 2; ++y)
    for (int x = 3 * shot.width / 4; x < shot.width; ++x) {
      const std::uint8_t* const at =
          &shot.rgba[4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(shot.width) +
                          static_cast<std::size_t>(x))];
      colors.insert({at[0], at[1], at[2]});
    }
  EXPECT_GT(colors.size(), 100u);
}

TEST_F(ViewWindow, takes_keys_in_their_order_however_long_a_frame_takes) {
  open(kSmall);
  const Image begin = picture();
  stop();
  for (int i = 0; i < 3; ++i) key("k");  // the camera does not move between them: no path
  drive({"keydown", "w"});
  go_on();
  (void)picture_other_than(begin);
  drive({"keyup", "w"});
  EXPECT_FALSE(std::filesystem::exists("gnomon_path_0001.json")) << content_of("gnomon_path_0001.json");
  key("k");
  ASSERT_TRUE(wrote("gnomon_path_0001.json"));
  EXPECT_EQ(close(), 0);
  EXPECT_FALSE(std::filesystem::exists("gnomon_path_0002.json"));
}

TEST_F(ViewWindow, goes_through_filters_views_wipe_freeze_and_sizes_without_an_error) {
  open(kSmall);
  Image last = picture();
  const Image first = last;
  for (const char* view : {"3", "4", "5", "6", "7", "8", "1"}) key(view);
  for (int i = 0; i < 12; ++i) key("f");
  key("F3");
  drive({"mousemove", "--window", window_, "510", "100", "mousedown", "1", "mousemove", "--window", window_,
         "560", "100", "mouseup", "1", "mousemove", "--window", window_, "2", "2"});
  key("F3");
  key("F3");
  key("F2");
  key("F1");
  key("F1");
  drive({"windowsize", "--sync", window_, "800", "420"});
  last = picture();
  // The panel keeps its width.
  EXPECT_EQ(last.width - first.width, 160);
  EXPECT_EQ(last.height - first.height, 120);
  drive({"windowsize", "--sync", window_, "120", "90"});
  key("Tab");
  EXPECT_EQ(picture().width, 120);
  key("F5");
  ASSERT_TRUE(wrote("gnomon_view.json"));
  EXPECT_EQ(close(), 0);
  EXPECT_EQ(content_of(log()), "");
}

TEST_F(ViewWindow, draws_pages_as_the_command_line_does) {
  std::vector<std::string> words = kSmall;
  words.insert(words.end(), {"--pages", "clipmap", "--page-size", "64", "--page-target", "1.5"});
  open(words);
  const Image lit = picture();
  key("9");
  const Image kept = picture();  // at rest: nothing is drawn
  EXPECT_GT(different_pixels(lit, kept), kOther);
  key("5");
  const Image levels = picture();
  key("F5");
  ASSERT_TRUE(wrote("gnomon_view.json"));
  EXPECT_EQ(different_pixels(levels, headless("gnomon_view.json", levels)), 0u);
  // The command line that the state stands for.
  std::vector<std::string> command{"view", "--view", "cascades", "--out", "lv.png", "--context", "osmesa"};
  command.insert(command.begin() + 1, words.begin(), words.end());
  *std::find(command.begin(), command.end(), "640x300") =
      std::to_string(levels.width) + "x" + std::to_string(levels.height);
  const Finished run = spawn_gnomon(command);
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(different_pixels(levels, read("lv.png")), 0u);
  // Edges are read from the picture: the last round is that of a picture at rest.
  key("g");
  const Image edges = picture();
  EXPECT_GT(different_pixels(levels, edges), kOther);
  std::filesystem::remove("gnomon_view.json");
  key("F5");
  ASSERT_TRUE(wrote("gnomon_view.json"));
  // Where a page lies in the pool depends on those before it, and with it the rounding of a look-up.
  constexpr std::size_t kRounded = 40;
  EXPECT_LT(different_pixels(edges, headless("gnomon_view.json", edges)), kRounded);
  key("f");
  (void)picture();
  key("f");  // pcss
  (void)picture();
  key("f");
  const Image smrt = picture();
  key("f");  // vsm stores texels of pages
  EXPECT_GT(different_pixels(smrt, picture()), 100u);
  key("f");  // convolution
  (void)picture();
  key("f");
  const Image power_cdf = picture();
  key("f");  // savsm sums up whole maps: the last picture stays
  EXPECT_EQ(different_pixels(power_cdf, picture()), 0u);
  EXPECT_EQ(close(), 0);
  EXPECT_EQ(content_of(log()), "") << "warnings, or errors of OpenGL";
}

TEST_F(ViewWindow, keeps_its_scene_and_state_where_a_file_is_broken) {
  open(kSmall);
  const Image begin = picture();
  (void)folder_.write("gnomon_view.json", "{\"gnomon_view\": 1, \"scene\": 5}");
  key("F9");
  EXPECT_EQ(different_pixels(begin, picture()), 0u);
  (void)folder_.write("gnomon_view.json", "{\"gnomon_view\": 1, \"scene\": \"/no/such/scene.glb\"}");
  key("F9");
  (void)picture();  // the file is open; its scene is the state's until it turns out that there is none
  bool is_back = false;
  for (int i = 0; i < kMaxPictures && !is_back; ++i) {
    std::filesystem::remove("gnomon_view.json");
    key("F5");
    ASSERT_TRUE(wrote("gnomon_view.json"));
    is_back = content_of("gnomon_view.json").find("builtin:hangar") != std::string::npos;
  }
  EXPECT_TRUE(is_back) << content_of("gnomon_view.json");
  EXPECT_EQ(close(), 0);
}

TEST_F(ViewWindow, ends_by_itself_with_its_screenshot) {
  const Finished run = spawn_gnomon({"view", "builtin:hangar", "--map-size", "256", "--size", "640x300",
                                     "--exit-after", "3", "--screenshot", "shot.png", "--ui-scale", "1.5"});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  const Image shot = read("shot.png");
  EXPECT_EQ(shot.width, 640);
  // The panel is dark; the picture beside it is not.
  const auto brightness = [&shot](int begin, int end) {
    std::size_t sum = 0;
    for (int y = 0; y < 200; ++y)
      for (int x = begin; x < end; ++x) sum += shot.rgba[4 * static_cast<std::size_t>(y * shot.width + x)];
    return sum / static_cast<std::size_t>(200 * (end - begin));
  };
  EXPECT_LT(brightness(0, 300), 70u);
  EXPECT_GT(brightness(450, 640), 110u);
  const Finished missing = spawn_gnomon({"view", "/no/such/scene.glb", "--exit-after", "3"});
  EXPECT_EQ(missing.exit_code, 2);
  EXPECT_NE(missing.err.find("/no/such/scene.glb"), std::string::npos) << missing.err;
}

TEST_F(ViewWindow, flies_a_benchmark_and_shows_what_it_showed_before) {
  std::vector<std::string> words = kSmall;
  words.insert(words.end(), {"--frames", "5"});
  open(words);
  const Image begin = picture();
  key("F7");
  ASSERT_TRUE(wrote("gnomon_benchmark_0001.csv"));
  EXPECT_EQ(different_pixels(begin, picture()), 0u);
  EXPECT_EQ(close(), 0);
  EXPECT_EQ(content_of(log()), "");
  const std::string rows = content_of("gnomon_benchmark_0001.csv");
  EXPECT_EQ(std::count(rows.begin(), rows.end(), '\n'), 6) << rows;
}

TEST_F(ViewWindow, flies_a_benchmark_by_itself_and_refuses_what_it_cannot_write) {
  std::vector<std::string> words = kSmall;
  words.insert(words.begin(), "view");
  words.insert(words.end(), {"--frames", "3", "--benchmark", "rows.csv"});
  const Finished run = spawn_gnomon(words);
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_NE(run.out.find("rows.csv: 3 frames, "), std::string::npos) << run.out;
  const std::string rows = content_of("rows.csv");
  EXPECT_EQ(std::count(rows.begin(), rows.end(), '\n'), 4) << rows;
  words.back() = "rows.csv/rows.csv";
  const Finished no_folder = spawn_gnomon(words);
  EXPECT_EQ(no_folder.exit_code, 2);
  EXPECT_NE(no_folder.err.find("rows.csv"), std::string::npos) << no_folder.err;
  EXPECT_EQ(content_of("rows.csv"), rows);
  words.back() = "more.csv";
  for (const std::vector<std::string>& other :
       {std::vector<std::string>{"--out", "picture.png"}, std::vector<std::string>{"--tour", "tour"}}) {
    std::vector<std::string> both = words;
    both.insert(both.end(), other.begin(), other.end());
    const Finished refused = spawn_gnomon(both);
    EXPECT_EQ(refused.exit_code, 2);
    EXPECT_NE(refused.err.find("--benchmark"), std::string::npos) << refused.err;
    EXPECT_FALSE(std::filesystem::exists("more.csv"));
    EXPECT_FALSE(std::filesystem::exists(other.back()));
  }
}

/// A result of `gnomon compare` as its file of rows has it.
std::string result_line(const char* filter, int cascades, double ms, double wrong) {
  report::Row row;
  row.index = static_cast<std::uint64_t>(cascades);
  row.scene = "builtin:hangar";
  row.width = 64;
  row.height = 64;
  row.light = "sun";
  row.technique = {"none", "uniform", "tight", filter, cascades, 256};
  row.plan_status = "ok";
  row.truth = "filtered";
  row.errors.false_lit = wrong;
  row.times.total_ms = {ms, ms, ms};
  row.times.baseline_ms = 1.0;
  return report::to_json_line(row) + "\n";
}

TEST_F(ViewWindow, loads_the_technique_that_is_clicked_in_the_results) {
  // So far apart that the present setting moves no axis: the first lies in the lower left corner.
  (void)folder_.write("results.jsonl", result_line("vsm", 3, 1e-3, 1e-6) + result_line("pcf", 2, 1e3, 1.0));
  std::vector<std::string> words = kSmall;
  words.back() = "900x720";
  words.insert(words.end(), {"--results", "results.jsonl"});
  open(words);
  (void)picture();
  key("F5");
  ASSERT_TRUE(wrote("gnomon_view.json"));
  drive({"mousemove", "--window", window_, "13", "340"});
  (void)picture();  // a frame in which the cursor is there
  drive({"click", "1"});
  (void)picture();
  std::filesystem::remove("gnomon_view.json");
  key("F5");
  ASSERT_TRUE(wrote("gnomon_view.json"));
  const std::string state = content_of("gnomon_view.json");
  EXPECT_NE(state.find("\"filter\": \"vsm"), std::string::npos) << state;
  EXPECT_NE(state.find("\"cascades\": 3"), std::string::npos) << state;
  EXPECT_EQ(close(), 0);
  EXPECT_EQ(content_of(log()), "");
  const Finished broken =
      spawn_gnomon({"view", "builtin:hangar", "--results", "nowhere", "--exit-after", "3"});
  EXPECT_EQ(broken.exit_code, 2);
  EXPECT_NE(broken.err.find("nowhere"), std::string::npos) << broken.err;
}

}  // namespace
}  // namespace gnomon::test
