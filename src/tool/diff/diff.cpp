// `gnomon diff`: do two pictures show the same?
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "base/bounded_file.hpp"
#include "command.hpp"
#include "gnomon/scene/image.hpp"
#include "output.hpp"

namespace gnomon::tool {
namespace {

// As other comparers of images grade them, with 2 left for bad input as in every command.
constexpr int kSame = 0, kWithinAllowance = 1, kDifferent = 3, kOtherSize = 4;

struct DiffRequest {
  std::string first, second;
  int tolerance = 0;     ///< steps of 8 bits by which a colour may differ
  double allowed = 0.0;  ///< percent of the pixels that may differ by more
  std::string out;       ///< picture of the differences; empty: none
  bool json = false;
};

Image load_picture(const std::string& file) {
  constexpr std::uint64_t kMaxBytes = std::uint64_t{256} << 20;
  constexpr std::uint64_t kMaxPixels = std::uint64_t{1} << 28;
  std::vector<std::uint8_t> bytes;
  const std::string why = read_bounded_file(file, kMaxBytes, Readable::regular_file, bytes);
  if (!why.empty()) throw std::runtime_error(file + ": " + why);
  return decode_image(bytes, file, kMaxPixels);
}

struct Difference {
  std::size_t pixels = 0, differing = 0;  ///< by more than the tolerance
  int largest = 0;                        ///< steps of 8 bits, over all channels
  double rms = 0.0;                       ///< the same, over all channels of all pixels
  int x = 0, y = 0;                       ///< of the pixel with the largest
  Image picture;                          ///< grey: alike; from yellow to red: the larger the difference
};

bool is_opaque(const Image& image) {
  for (std::size_t i = 3; i < image.rgba.size(); i += 4)
    if (image.rgba[i] != 255) return false;
  return true;
}

/// Steps by which the pixel's channels differ at most.
int largest_step(const std::uint8_t* a, const std::uint8_t* b) {
  int largest = 0;
  for (std::size_t c = 0; c < 4; ++c) largest = std::max(largest, std::abs(int{a[c]} - int{b[c]}));
  return largest;
}

std::array<std::uint8_t, 4> shown(const std::uint8_t* a, int step, int tolerance) {
  if (step <= tolerance) {
    const auto grey = static_cast<std::uint8_t>((int{a[0]} + int{a[1]} + int{a[2]}) / 12);
    return {grey, grey, grey, 255};
  }
  // Square root: small differences are to be seen as well.
  const double share = std::sqrt(step / 255.0);
  return {255, static_cast<std::uint8_t>(std::lround(220.0 * (1.0 - share))), 0, 255};
}

Difference difference_of(const Image& a, const Image& b, int tolerance) {
  Difference d;
  d.pixels = a.rgba.size() / 4;
  d.picture = a;
  // Alpha counts where a picture has any: those of --shadow-only have nothing else.
  const std::size_t channels = is_opaque(a) && is_opaque(b) ? 3 : 4;
  double sum = 0.0;
  for (std::size_t i = 0; i < d.pixels; ++i) {
    const std::uint8_t *p = &a.rgba[4 * i], *q = &b.rgba[4 * i];
    const int step = largest_step(p, q);
    for (std::size_t c = 0; c < channels; ++c) {
      const double off = static_cast<double>(p[c]) - static_cast<double>(q[c]);
      sum += off * off;
    }
    if (step > d.largest) {
      d.largest = step;
      d.x = static_cast<int>(i % static_cast<std::size_t>(a.width));
      d.y = static_cast<int>(i / static_cast<std::size_t>(a.width));
    }
    if (step > tolerance) ++d.differing;
    const std::array<std::uint8_t, 4> color = shown(p, step, tolerance);
    std::copy(color.begin(), color.end(), d.picture.rgba.begin() + static_cast<std::ptrdiff_t>(4 * i));
  }
  d.rms = d.pixels > 0 ? std::sqrt(sum / static_cast<double>(channels * d.pixels)) : 0.0;
  return d;
}

int run_diff(const DiffRequest& request) {
  if (!request.out.empty()) check_file("--out", request.out, {request.first, request.second});
  const Image a = load_picture(request.first), b = load_picture(request.second);
  if (a.width != b.width || a.height != b.height) {
    const std::string sizes = std::to_string(a.width) + "x" + std::to_string(a.height) + " and " +
                              std::to_string(b.width) + "x" + std::to_string(b.height);
    print_line(request.json ? nlohmann::ordered_json{{"verdict", "other size"},
                                                     {"sizes", {{a.width, a.height}, {b.width, b.height}}}}
                                  .dump()
                            : "other size: " + sizes);
    flush_output();
    return kOtherSize;
  }
  const Difference d = difference_of(a, b, request.tolerance);
  const double percent =
      100.0 * static_cast<double>(d.differing) / static_cast<double>(std::max<std::size_t>(d.pixels, 1));
  const int code = d.differing == 0 ? kSame : percent <= request.allowed ? kWithinAllowance : kDifferent;
  const char* verdict = code == kSame              ? "same"
                        : code == kWithinAllowance ? "within what is allowed"
                                                   : "different";
  if (request.json) {
    print_line(nlohmann::ordered_json{
        {"verdict", verdict},
        {"pixels", d.pixels},
        {"differing", d.differing},
        {"percent", percent},
        {"largest", d.largest},
        {"largest_at", {d.x, d.y}},
        {"rms",
         d.rms}}.dump());
  } else {
    char text[256];
    std::snprintf(
        text, sizeof text,
        "%s: %zu of %zu pixels (%.3g %%) differ by more than %d of 255; largest %d at %d,%d; RMS %.3g",
        verdict, d.differing, d.pixels, percent, request.tolerance, d.largest, d.x, d.y, d.rms);
    print_line(text);
  }
  flush_output();
  if (!request.out.empty()) write_png(d.picture, request.out);
  return code;
}

}  // namespace

std::function<int()> declare_diff(Arguments& arguments) {
  const auto request = std::make_shared<DiffRequest>();
  arguments.options = {
      {.name = "A",
       .target = &request->first,
       .help = "a picture, PNG or JPEG",
       .required = true,
       .completion = Completion::files},
      {.name = "B",
       .target = &request->second,
       .help = "the picture to compare with, PNG or JPEG",
       .required = true,
       .completion = Completion::files},
      {.name = "--tolerance",
       .target = &request->tolerance,
       .help = "largest difference of a channel, alpha included, that is ignored, steps of 1/255",
       .range = {{0, 255}}},
      {.name = "--allow-percent",
       .target = &request->allowed,
       .help = "percent of pixels that may differ by more than the tolerance",
       .range = {{0.0, 100.0}}},
      {.name = "--out",
       .target = &request->out,
       .help = "write the differences as a PNG picture",
       .completion = Completion::files},
      {.name = "--json", .target = &request->json, .help = "print the result as one line of JSON"}};
  arguments.footer =
      "Exit: 0 no pixel differs by more than the tolerance; 1 at most --allow-percent of the pixels do; 2 "
      "bad "
      "input; 3 more pixels do; 4 the sizes differ.";
  return [request] { return run_diff(*request); };
}

}  // namespace gnomon::tool
