// Masks in a file, by name: those of one driver, for another driver's to be compared with.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "gnomon/scene/image.hpp"

namespace gnomon::render {

/// A mask of two channels as it is kept: visibility in steps of 1/65535, and the map that served the pixel.
struct KeptMask {
  std::vector<std::uint16_t> visibility;
  std::vector<std::uint8_t> map;  ///< 0: none
  bool operator==(const KeptMask&) const = default;
};

inline KeptMask kept(const FloatImage& mask) {
  KeptMask out;
  for (std::size_t i = 0; i + 1 < mask.values.size(); i += 2) {
    const float visibility = std::clamp(mask.values[i], 0.0f, 1.0f);
    out.visibility.push_back(static_cast<std::uint16_t>(std::lround(65535.0f * visibility)));
    out.map.push_back(static_cast<std::uint8_t>(std::clamp(mask.values[i + 1] + 1.0f, 0.0f, 255.0f)));
  }
  return out;
}

/// Appends "name, newline, pixels, newline, bytes" to a file.
class MaskWriter {
 public:
  explicit MaskWriter(const std::string& file) : out_(file, std::ios::binary) {}
  void add(const std::string& name, const KeptMask& mask) {
    out_ << name << '\n' << mask.map.size() << '\n';
    out_.write(reinterpret_cast<const char*>(mask.visibility.data()),
               static_cast<std::streamsize>(2 * mask.visibility.size()));
    out_.write(reinterpret_cast<const char*>(mask.map.data()), static_cast<std::streamsize>(mask.map.size()));
    if (!out_.flush()) throw std::runtime_error("the masks cannot be written");
  }

 private:
  std::ofstream out_;
};

/// The masks of a file that MaskWriter wrote.
inline std::map<std::string, KeptMask> read_masks(const std::string& file) {
  constexpr std::size_t kMaxPixels = 1u << 24;
  std::ifstream in(file, std::ios::binary);
  std::map<std::string, KeptMask> masks;
  for (std::string name, count; std::getline(in, name) && std::getline(in, count);) {
    const auto pixels = static_cast<std::size_t>(std::strtoull(count.c_str(), nullptr, 10));
    if (pixels > kMaxPixels) break;
    KeptMask& mask = masks[name];
    mask.visibility.resize(pixels);
    mask.map.resize(pixels);
    in.read(reinterpret_cast<char*>(mask.visibility.data()), static_cast<std::streamsize>(2 * pixels));
    in.read(reinterpret_cast<char*>(mask.map.data()), static_cast<std::streamsize>(pixels));
    if (!in) throw std::runtime_error(file + ": is cut off");
  }
  if (masks.empty()) throw std::runtime_error(file + ": holds no masks");
  return masks;
}

/// Prints how a mask differs from the one that is kept, as a row of JSON.
inline void print_difference(const std::string& name, const KeptMask& now, const KeptMask& kept) {
  constexpr int kStep = 257;  // 1/255
  std::size_t differ = 0, visibly = 0, maps = 0;
  int most = 0;
  const bool same_size = now.map.size() == kept.map.size();
  for (std::size_t i = 0; same_size && i < now.map.size(); ++i) {
    const int difference = std::abs(int{now.visibility[i]} - int{kept.visibility[i]});
    differ += difference > 0 ? 1 : 0;
    visibly += difference > kStep ? 1 : 0;
    maps += now.map[i] != kept.map[i] ? 1 : 0;
    most = std::max(most, difference);
  }
  if (!same_size) differ = visibly = maps = now.map.size();
  std::printf(
      "{\"part\":\"masks\",\"what\":\"%s\",\"pixels\":%zu,\"differ\":%zu,\"visibly\":%zu,\"other_map\":%zu,"
      "\"most\":%.5f}\n",
      name.c_str(), now.map.size(), differ, visibly, maps, most / 65535.0);
  if (std::fflush(stdout) != 0) throw std::runtime_error("the row cannot be written: is the disk full?");
}

}  // namespace gnomon::render
