// Exact results on the disk: rays that were sent once are not sent again.
#include "exact_results.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cinttypes>
#include <cstdio>
#include <map>
#include <span>
#include <system_error>
#include <utility>

#include "base/bounded_file.hpp"
#include "base/fnv.hpp"
#include "base/whole_file.hpp"
#include "command.hpp"
#include "scene/inflate.hpp"

namespace gnomon::tool {
namespace {

constexpr std::string_view kMagic = "gnomon-exact/1\n";
constexpr std::size_t kPalette = 256;

void put(std::string& out, std::uint64_t value, int bytes) {
  for (int i = 0; i < bytes; ++i) out.push_back(static_cast<char>((value >> (8 * i)) & 255u));
}

std::uint64_t get(std::string_view bytes, std::size_t at, int count) noexcept {
  std::uint64_t value = 0;
  for (int i = 0; i < count; ++i)
    value |= std::uint64_t{static_cast<std::uint8_t>(bytes[at + static_cast<std::size_t>(i)])} << (8 * i);
  return value;
}

std::span<const std::uint8_t> bytes_of(std::string_view text) noexcept {
  return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

}  // namespace

ExactKey& ExactKey::add(std::string_view text) {
  hash_ = fnv_of(bytes_of(text), hash_);
  return add(static_cast<int>(text.size()));
}

ExactKey& ExactKey::add(double value) {
  std::array<std::uint8_t, 8> bytes{};
  const auto bits = std::bit_cast<std::uint64_t>(value);
  for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<std::uint8_t>(bits >> (8 * i));
  hash_ = fnv_of(bytes, hash_);
  return *this;
}

ExactKey& ExactKey::add(int value) {
  return add(static_cast<double>(value));
}

ExactKey& ExactKey::add(const glm::dvec3& value) {
  return add(value.x).add(value.y).add(value.z);
}

ExactKey& ExactKey::add(const Camera& camera) {
  add(camera.position).add(camera.forward).add(camera.up).add(camera.orthographic ? 1 : 0);
  for (const double value :
       {camera.left, camera.right, camera.bottom, camera.top, camera.near_depth, camera.far_depth})
    add(value);
  return add(camera.width).add(camera.height);
}

ExactKey& ExactKey::add(const trace::SurfacePoints& points) {
  add(points.width).add(points.height);
  for (const trace::SurfacePoint& point : points.pixels)
    add(static_cast<int>(point.state))
        .add(static_cast<double>(point.triangle))
        .add(point.position)
        .add(point.normal)
        .add(point.above);
  return *this;
}

std::string packed(const std::vector<float>& values) {
  std::map<std::uint32_t, std::size_t> places;  // by bits: a NaN is one value as well
  for (const float value : values) {
    if (places.size() > kPalette) break;
    places.try_emplace(std::bit_cast<std::uint32_t>(value), places.size());
  }
  const bool by_palette = places.size() <= kPalette;
  std::string plain;
  if (by_palette) {
    std::vector<std::uint32_t> palette(places.size());
    for (const auto& [bits, place] : places) palette[place] = bits;
    for (const std::uint32_t bits : palette) put(plain, bits, 4);
    for (const float value : values) put(plain, places.at(std::bit_cast<std::uint32_t>(value)), 1);
  } else {
    for (const float value : values) put(plain, std::bit_cast<std::uint32_t>(value), 4);
  }
  const std::vector<std::uint8_t> stream = detail::deflate(bytes_of(plain));
  std::string body;
  put(body, values.size(), 8);
  put(body, by_palette ? places.size() : kPalette + 1, 4);
  body.append(stream.begin(), stream.end());
  std::string out(kMagic);
  put(out, fnv_of(std::string_view(body)), 8);
  return out + body;
}

std::string unpack(std::string_view bytes, std::size_t count, std::vector<float>& values) {
  constexpr std::size_t kHead = 20;  // hash, count, palette
  if (!bytes.starts_with(kMagic) || bytes.size() < kMagic.size() + kHead)
    return "is no file of exact results";
  const std::string_view body = bytes.substr(kMagic.size() + 8);
  if (get(bytes, kMagic.size(), 8) != fnv_of(body)) return "is damaged";
  const std::uint64_t palette = get(body, 8, 4);
  if (get(body, 0, 8) != count) return "holds another number of values";
  const bool by_palette = palette <= kPalette;
  const std::size_t head = by_palette ? 4 * static_cast<std::size_t>(palette) : 0;
  const std::vector<std::uint8_t> plain =
      detail::inflate(bytes_of(body.substr(12)), head + (by_palette ? count : 4 * count));
  if (plain.empty()) return "is damaged";
  const std::string_view text(reinterpret_cast<const char*>(plain.data()), plain.size());
  values.clear();
  values.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t at = by_palette ? 4 * static_cast<std::size_t>(plain[head + i]) : 4 * i;
    if (by_palette && at >= head) return "is damaged";
    values.push_back(std::bit_cast<float>(static_cast<std::uint32_t>(get(text, at, 4))));
  }
  return {};
}

ExactResults::ExactResults(std::filesystem::path folder, const std::string& identity)
    : folder_(std::move(folder)), identity_(fnv_of(identity)) {}

ExactKey ExactResults::key(std::string_view what) const {
  return ExactKey(identity_).add(what).add(seconds_);
}

std::vector<float> ExactResults::values(const ExactKey& key, std::size_t count,
                                        const std::function<std::vector<float>()>& compute) const {
  if (folder_.empty()) return compute();
  std::array<char, 17> name{};
  std::snprintf(name.data(), name.size(), "%016" PRIx64, key.hash());
  const std::filesystem::path file = folder_ / (std::string(name.data()) + ".exact");
  constexpr std::uint64_t kMaxBytes = std::uint64_t{1} << 30;
  std::error_code error;
  std::vector<float> values;
  if (std::filesystem::exists(file, error)) {
    std::string bytes;
    std::string why = read_bounded_file(file, kMaxBytes, Readable::regular_file, bytes);
    if (why.empty()) why = unpack(bytes, count, values);
    if (why.empty()) return values;
    warn(file.string() + ": " + why + "; it is made again");
  }
  values = compute();
  if (!writes_) return values;
  std::filesystem::create_directories(folder_, error);
  const std::string why = write_whole_file(file, packed(values));
  writes_ = why.empty();
  if (!writes_) warn(file.string() + ": is not written, and none after it: " + why);
  return values;
}

}  // namespace gnomon::tool
