// A shadow mask as a file: exactly, as PFM, or as a grey picture of others.
#include "mask_file.hpp"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>
#include <string_view>

#include "base/bounded_file.hpp"
#include "gnomon/scene/image.hpp"
#include "output.hpp"

namespace gnomon::tool {
namespace {

constexpr std::uint64_t kMaxBytes = std::uint64_t{256} << 20;
constexpr std::uint64_t kMaxPixels = std::uint64_t{1} << 26;

[[noreturn]] void refuse_mask(const std::string& name, const std::string& why) {
  throw std::runtime_error(name + ": " + why);
}

std::string size_text(long long width, long long height) {
  return std::to_string(width) + "x" + std::to_string(height);
}

void check_size(const std::string& name, long long width, long long height, int wanted_width,
                int wanted_height) {
  if (width == wanted_width && height == wanted_height) return;
  refuse_mask(name, "is " + size_text(width, height) + " pixels, and the frame is " +
                        size_text(wanted_width, wanted_height));
}

/// The words of a PFM's head, one after the other.
class Head {
 public:
  Head(std::string_view text, const std::string& name) : text_(text), name_(name) {}
  std::string_view word() {
    constexpr std::string_view kSpace = " \t\r\n";
    const std::size_t begin = std::min(text_.find_first_not_of(kSpace, at_), text_.size());
    const std::size_t end = std::min(text_.find_first_of(kSpace, begin), text_.size());
    at_ = std::min(end + 1, text_.size());  // exactly one space before the numbers
    return text_.substr(begin, end - begin);
  }
  template <class Number>
  Number number() {
    const std::string_view text = word();
    Number value{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size())
      refuse_mask(name_, "is no PFM: its head is damaged");
    return value;
  }
  [[nodiscard]] std::size_t at() const noexcept { return at_; }

 private:
  std::string_view text_;
  const std::string& name_;
  std::size_t at_ = 0;
};

std::uint32_t bits_at(const std::uint8_t* bytes, bool little) noexcept {
  std::uint32_t bits = 0;
  for (std::uint32_t i = 0; i < 4; ++i) bits |= std::uint32_t{bytes[i]} << (8 * (little ? i : 3 - i));
  return bits;
}

std::vector<float> from_pfm(const std::vector<std::uint8_t>& bytes, const std::string& name, int width,
                            int height) {
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  Head head(text, name);
  if (head.word() != "Pf") refuse_mask(name, "is no PFM of one channel");
  const auto wide = head.number<long long>(), high = head.number<long long>();
  const auto scale = head.number<double>();
  check_size(name, wide, high, width, height);
  const auto w = static_cast<std::size_t>(width), h = static_cast<std::size_t>(height);
  if (bytes.size() - head.at() != 4 * w * h) refuse_mask(name, "has another number of values than pixels");
  std::vector<float> values(w * h);
  for (std::size_t row = 0; row < h; ++row) {  // rows from bottom to top
    for (std::size_t x = 0; x < w; ++x)
      values[(h - 1 - row) * w + x] =
          std::bit_cast<float>(bits_at(bytes.data() + head.at() + 4 * (row * w + x), scale < 0.0));
  }
  return values;
}

std::vector<float> from_picture(const std::vector<std::uint8_t>& bytes, const std::string& name, int width,
                                int height) {
  const Image image = decode_image(bytes, name, kMaxPixels);
  check_size(name, image.width, image.height, width, height);
  std::vector<float> values;
  constexpr float kWhite = 255.0f;
  for (std::size_t i = 0; i < image.rgba.size(); i += 4)
    values.push_back(static_cast<float>(image.rgba[i]) / kWhite);
  return values;
}

}  // namespace

void write_mask(const std::filesystem::path& file, std::span<const float> values, int width, int height) {
  std::string bytes = "Pf\n" + std::to_string(width) + " " + std::to_string(height) + "\n-1.0\n";
  const auto w = static_cast<std::size_t>(width), h = static_cast<std::size_t>(height);
  for (std::size_t row = h; row-- > 0;) {
    for (std::size_t x = 0; x < w; ++x) {
      const auto bits = std::bit_cast<std::uint32_t>(values[row * w + x]);
      for (int i = 0; i < 4; ++i) bytes.push_back(static_cast<char>((bits >> (8 * i)) & 255u));
    }
  }
  write_file(file, bytes);
}

std::vector<float> read_mask(const std::filesystem::path& folder, const std::string& name, int width,
                             int height) {
  const std::filesystem::path relative(name);
  const bool leaves = relative.is_absolute() || std::any_of(relative.begin(), relative.end(),
                                                            [](const auto& part) { return part == ".."; });
  if (name.empty() || leaves) refuse_mask(name, "is no file below the entry's folder");
  std::vector<std::uint8_t> bytes;
  if (const std::string why = read_bounded_file(folder / relative, kMaxBytes, Readable::regular_file, bytes);
      !why.empty())
    refuse_mask(name, why);
  const bool is_pfm = bytes.size() > 2 && bytes[0] == 'P' && (bytes[1] == 'f' || bytes[1] == 'F');
  std::vector<float> values =
      is_pfm ? from_pfm(bytes, name, width, height) : from_picture(bytes, name, width, height);
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (values[i] >= 0.0f && values[i] <= 1.0f) continue;
    const auto w = static_cast<std::size_t>(width);
    refuse_mask(name, "pixel " + std::to_string(i % w) + "," + std::to_string(i / w) + " is " +
                          (values[i] != values[i] ? std::string("not a number") : std::to_string(values[i])) +
                          ", not from 0 to 1");
  }
  return values;
}

}  // namespace gnomon::tool
