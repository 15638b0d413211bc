// Files that are nearly right, by format.
#include "mutate.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <random>
#include <vector>

namespace gnomon::fuzz {
namespace {

using Json = nlohmann::ordered_json;

/// Small draws from a seed, the same with every standard library.
class Dice {
 public:
  explicit Dice(std::uint64_t seed) : engine_(seed * 0x9e3779b97f4a7c15ull + 1) {}
  std::uint64_t bits() { return engine_(); }
  /// 0 .. count - 1; 0 where there is nothing to choose from.
  std::size_t below(std::size_t count) {
    return count == 0 ? 0 : static_cast<std::size_t>(engine_() % count);
  }
  bool one_in(std::size_t count) { return below(count) == 0; }
  template <class List>
  auto pick(const List& list) {
    return list[below(std::size(list))];
  }

 private:
  std::mt19937_64 engine_;
};

std::uint32_t little(std::string_view bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i)
    value |= static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[at + i])) << 8 * i;
  return value;
}

void put_little(std::string& bytes, std::size_t at, std::uint32_t value) {
  for (std::size_t i = 0; i < 4; ++i) bytes[at + i] = static_cast<char>(value >> 8 * i & 0xff);
}

std::uint32_t big(std::string_view bytes, std::size_t at) {
  const std::uint32_t value = little(bytes, at);
  return value << 24 | (value & 0xff00) << 8 | (value >> 8 & 0xff00) | value >> 24;
}

void put_big(std::string& bytes, std::size_t at, std::uint32_t value) {
  for (std::size_t i = 0; i < 4; ++i) bytes[at + i] = static_cast<char>(value >> (24 - 8 * i) & 0xff);
}

constexpr std::array<std::uint32_t, 12> kWords{0,          1,          2,          0x7fffffff,
                                               0x80000000, 0xffffffff, 0xfffffffe, 0x0000ffff,
                                               0x7f800000, 0x7fc00000, 0x7f7fffff, 0x00000001};

/// Anywhere: flips, words, cuts, doubled and lost stretches.
void change_bytes(std::string& bytes, Dice& dice) {
  if (bytes.empty()) {
    bytes.push_back(static_cast<char>(dice.bits()));
    return;
  }
  const std::size_t at = dice.below(bytes.size());
  const std::size_t length = std::min(bytes.size() - at, std::size_t{1} << dice.below(10));
  switch (dice.below(7)) {
    case 0:
      bytes[at] = static_cast<char>(bytes[at] ^ (1 << dice.below(8)));
      break;
    case 1:
      bytes[at] = static_cast<char>(dice.bits());
      break;
    case 2:
      if (bytes.size() - at >= 4) put_little(bytes, at, dice.pick(kWords));
      break;
    case 3:
      bytes.resize(at);
      break;
    case 4:
      bytes.erase(at, length);
      break;
    case 5:
      bytes.insert(dice.below(bytes.size()), bytes.substr(at, length));
      break;
    default:
      std::fill_n(bytes.begin() + static_cast<std::ptrdiff_t>(at), length, dice.one_in(2) ? '\0' : '\xff');
  }
}

void collect(Json& value, std::vector<Json*>& all) {
  all.push_back(&value);
  if (value.is_structured())
    for (Json& child : value) collect(child, all);
}

Json odd_number(const Json& now, Dice& dice) {
  constexpr std::array<double, 19> kOdd{0.0,        -1.0,         1.0,          0.5,
                                        255.0,      65535.0,      65536.0,      2147483647,
                                        2147483648, 4294967295.0, 4294967296.0, 9007199254740993.0,
                                        1.8e19,     1e30,         1e31,         1e308,
                                        -1e308,     5e-324,       -0.0};
  if (now.is_number_integer() && std::abs(now.get<double>()) < 1e15 && dice.one_in(2))
    return now.get<std::int64_t>() + static_cast<std::int64_t>(dice.below(9)) - 4;
  if (now.is_number() && dice.one_in(3))
    return now.get<double>() * dice.pick(std::array{-1.0, 2.0, 0.5, 1e6, 1e-6, 1e12});
  const double odd = dice.pick(kOdd);
  if (std::abs(odd) < 9e15 && odd == static_cast<double>(static_cast<std::int64_t>(odd)) && dice.one_in(2))
    return static_cast<std::int64_t>(odd);
  return odd;
}

std::string odd_text(const std::string& now, Dice& dice) {
  switch (dice.below(9)) {
    case 0:
      return "";
    case 1:
      return "../" + now;
    case 2:
      return "/etc/passwd";
    case 3:
      return "data:application/octet-stream;base64,AAAA====AA";
    case 4:
      return std::string(5000, 'x');
    case 5:
      return now + "\x1b[31m\n\r\t<script>";
    case 6:
      return "%00%2e%2e%2fa";
    default: {
      std::string changed = now;
      change_bytes(changed, dice);
      return changed;
    }
  }
}

Json odd_value(Dice& dice) {
  switch (dice.below(6)) {
    case 0:
      return nullptr;
    case 1:
      return dice.one_in(2);
    case 2:
      return Json::array();
    case 3:
      return Json::object();
    case 4:
      return "text";
    default:
      return odd_number(0, dice);
  }
}

void wrap(Json& value, Dice& dice) {
  const std::size_t depth = std::size_t{1} << dice.below(11);
  for (std::size_t i = 0; i < depth; ++i) value = dice.one_in(2) ? Json::array({value}) : Json{{"a", value}};
}

void change_container(Json& value, Dice& dice) {
  if (value.empty()) {
    if (value.is_array()) value.push_back(odd_value(dice));
    return;
  }
  if (value.is_array()) {
    const std::size_t at = dice.below(value.size());
    const Json copy = value[at];
    const std::size_t kind = dice.below(4);
    if (kind == 0) value.erase(at);
    if (kind == 1) value.push_back(copy);
    if (kind == 2) std::swap(value[at], value[dice.below(value.size())]);
    if (kind == 3 && copy.dump(-1, ' ', false, Json::error_handler_t::ignore).size() < 200)
      value.insert(value.end(), std::size_t{1} << dice.below(9), copy);
    return;
  }
  auto member = value.begin();
  std::advance(member, static_cast<std::ptrdiff_t>(dice.below(value.size())));
  const std::string key = member.key();
  const Json copy = member.value();
  const std::size_t kind = dice.below(3);
  if (kind != 2) value.erase(key);
  if (kind == 1) value[odd_text(key, dice)] = copy;
  if (kind == 2) value[key + "x"] = copy;
}

void change_json(Json& root, Dice& dice) {
  std::vector<Json*> all;
  collect(root, all);
  Json& value = *dice.pick(all);
  if (dice.one_in(12)) {
    const Json other = *dice.pick(all);  // a copy: it may hold `value`
    value = other;
  } else if (dice.one_in(40)) {
    wrap(value, dice);
  } else if (dice.one_in(10)) {
    value = odd_value(dice);
  } else if (value.is_structured()) {
    change_container(value, dice);
  } else if (value.is_string()) {
    value = odd_text(value.get<std::string>(), dice);
  } else if (value.is_number()) {
    value = odd_number(value, dice);
  } else {
    value = odd_value(dice);
  }
}

/// What no JSON library would write: a member twice, numbers that are none, comments.
void change_json_text(std::string& text, Dice& dice) {
  const std::size_t comma = text.find(',', dice.below(text.size()));
  switch (dice.below(4)) {
    case 0: {
      const std::size_t next = comma == std::string::npos ? comma : text.find(',', comma + 1);
      if (next != std::string::npos) text.insert(next, text.substr(comma, next - comma));
      break;
    }
    case 1: {
      const std::size_t digit = text.find_first_of("0123456789", dice.below(text.size()));
      constexpr std::array<const char*, 6> kNumbers{"NaN", "Infinity", "1e999", "-", "00", "1e-400"};
      if (digit != std::string::npos) text.replace(digit, 1, dice.pick(kNumbers));
      break;
    }
    case 2:
      if (comma != std::string::npos) text.insert(comma, dice.one_in(2) ? "/* */" : ",");
      break;
    default:
      change_bytes(text, dice);
  }
}

std::string mutated_json(std::string_view input, Dice& dice) {
  Json root = Json::parse(input, nullptr, false);
  std::string text(input);
  if (!root.is_discarded() && !dice.one_in(8)) {
    const std::size_t changes = 1 + dice.below(4);
    for (std::size_t i = 0; i < changes; ++i) change_json(root, dice);
    text = root.dump(-1, ' ', false, Json::error_handler_t::ignore);
    if (!dice.one_in(8)) return text;
  }
  if (text.empty()) text = "{}";
  change_json_text(text, dice);
  return text;
}

/// Rows: one line among the others, or lines themselves lost, doubled and run together.
std::string mutated_lines(std::string_view input, Dice& dice) {
  std::vector<std::string> lines;
  for (std::size_t begin = 0; begin < input.size();) {
    const std::size_t end = std::min(input.find('\n', begin), input.size());
    lines.emplace_back(input.substr(begin, end - begin));
    begin = end + 1;
  }
  const std::size_t at = dice.below(lines.size());
  if (dice.one_in(8)) lines.insert(lines.begin() + static_cast<std::ptrdiff_t>(at), lines[at]);
  if (!dice.one_in(8)) lines[at] = mutated_json(lines[at], dice);
  std::string text;
  for (const std::string& line : lines) text += line + (dice.one_in(60) ? "" : "\n");
  if (dice.one_in(8)) change_bytes(text, dice);
  return text;
}

struct Chunk {
  std::uint32_t type = 0;
  std::string data;
};

std::string glb_of(const std::vector<Chunk>& chunks) {
  std::string glb = std::string("glTF\2\0\0\0\0\0\0\0", 12);
  for (const Chunk& chunk : chunks) {
    std::string head(8, '\0');
    put_little(head, 0, static_cast<std::uint32_t>((chunk.data.size() + 3) / 4 * 4));
    put_little(head, 4, chunk.type);
    glb += head + chunk.data + std::string((4 - chunk.data.size() % 4) % 4, ' ');
  }
  put_little(glb, 8, static_cast<std::uint32_t>(glb.size()));
  return glb;
}

std::string mutated_glb(std::string_view input, Dice& dice) {
  std::vector<Chunk> chunks;
  for (std::size_t at = 12; at + 8 <= input.size();) {
    const std::size_t length = std::min<std::size_t>(little(input, at), input.size() - at - 8);
    chunks.push_back({little(input, at + 4), std::string(input.substr(at + 8, length))});
    at += 8 + length;
  }
  if (chunks.empty()) return std::string(input.substr(0, 8));
  const std::size_t kind = dice.below(10);
  if (kind < 6) chunks[0].data = mutated_json(chunks[0].data, dice);
  if (kind == 6 || kind == 7) {
    // Floats that are none, indices out of range.
    std::string& data = chunks.back().data;
    for (std::size_t i = dice.below(8); i < 8 && data.size() >= 4; ++i)
      put_little(data, dice.below(data.size() / 4) * 4, dice.pick(kWords));
  }
  if (kind == 8) {
    const std::size_t what = dice.below(3);
    if (what == 0) chunks.push_back(chunks[dice.below(chunks.size())]);
    if (what == 1) chunks.erase(chunks.begin() + static_cast<std::ptrdiff_t>(dice.below(chunks.size())));
    if (what == 2) chunks[dice.below(chunks.size())].type = static_cast<std::uint32_t>(dice.bits());
  }
  std::string glb = glb_of(chunks);
  if (kind == 9) {
    constexpr std::array<std::size_t, 5> kFields{4, 8, 12, 16, 20};  // version, lengths, type, first bytes
    const std::size_t field = dice.pick(kFields);
    if (field + 4 <= glb.size()) {
      const std::uint32_t nearly = little(glb, field) + static_cast<std::uint32_t>(dice.below(9)) - 4;
      put_little(glb, field, dice.one_in(2) ? nearly : dice.pick(kWords));
    }
    if (dice.one_in(3)) change_bytes(glb, dice);
  }
  return glb;
}

/// Of PNG, over type and data (ISO/IEC 15948, annex D).
std::uint32_t crc(std::string_view bytes) {
  std::uint32_t c = 0xffffffff;
  for (const char byte : bytes) {
    c ^= static_cast<unsigned char>(byte);
    for (int bit = 0; bit < 8; ++bit) c = (c & 1) != 0 ? 0xedb88320 ^ c >> 1 : c >> 1;
  }
  return ~c;
}

std::string mutated_png(std::string_view input, Dice& dice) {
  std::vector<std::string> chunks;  // type and data
  for (std::size_t at = 8; at + 12 <= input.size();) {
    const std::size_t length = std::min<std::size_t>(big(input, at), input.size() - at - 12);
    chunks.emplace_back(input.substr(at + 4, 4 + length));
    at += 12 + length;
  }
  if (chunks.empty()) return std::string(input);
  const std::size_t at = dice.below(chunks.size());
  std::string& chunk = chunks[at];
  switch (dice.below(6)) {
    case 0: {  // width, height; then depth, colour type, compression, filter, interlace
      std::string& header = chunks[0];
      if (header.size() < 17) break;
      if (dice.one_in(2))
        put_big(header, 4 + 4 * dice.below(2), dice.one_in(2) ? 1 << dice.below(20) : dice.pick(kWords));
      else
        header[12 + dice.below(5)] = static_cast<char>(dice.below(18));
      break;
    }
    case 1:
      chunks.erase(chunks.begin() + static_cast<std::ptrdiff_t>(at));
      break;
    case 2:
      chunks.insert(chunks.begin() + static_cast<std::ptrdiff_t>(dice.below(chunks.size())),
                    std::string(chunk));
      break;
    case 3:
      std::swap(chunks[at], chunks[dice.below(chunks.size())]);
      break;
    case 4: {
      constexpr std::array<const char*, 8> kTypes{"iCCP", "zTXt", "PLTE", "tRNS",
                                                  "gAMA", "sRGB", "cHRM", "eXIf"};
      std::string made = dice.pick(kTypes);
      for (std::size_t i = dice.below(64); i > 0; --i) made += static_cast<char>(dice.bits());
      chunks.insert(chunks.begin() + 1, made);
      break;
    }
    default: {
      std::string data = chunk.substr(4);
      change_bytes(data, dice);
      chunk = chunk.substr(0, 4) + data;
    }
  }
  std::string png(input.substr(0, 8));
  for (const std::string& each : chunks) {
    std::string ends(8, '\0');
    put_big(ends, 0, static_cast<std::uint32_t>(each.size() - 4));
    put_big(ends, 4, dice.one_in(30) ? 0 : crc(each));
    png += ends.substr(0, 4) + each + ends.substr(4);
  }
  if (dice.one_in(8)) change_bytes(png, dice);
  return png;
}

std::string mutated_jpeg(std::string_view input, Dice& dice) {
  std::string jpeg(input);
  std::vector<std::size_t> segments;
  for (std::size_t at = 2; at + 4 <= jpeg.size() && jpeg[at] == '\xff';) {
    segments.push_back(at);
    if (jpeg[at + 1] == '\xda') break;  // the scan: what follows has no length
    at += 2u + (std::size_t{static_cast<unsigned char>(jpeg[at + 2])} << 8) + static_cast<unsigned char>(jpeg[at + 3]);
  }
  if (segments.empty() || dice.one_in(3)) {
    change_bytes(jpeg, dice);
    return jpeg;
  }
  const std::size_t which = dice.below(segments.size()), at = segments[which];
  const std::size_t end = which + 1 < segments.size() ? segments[which + 1] : std::min(jpeg.size(), at + 14);
  switch (dice.below(4)) {
    case 0:  // its length, its content
    case 1:
      jpeg[at + 2 + dice.below(end - at - 2)] = static_cast<char>(dice.bits());
      break;
    case 2:
      jpeg.erase(at, end - at);
      break;
    default:
      jpeg.insert(segments[dice.below(segments.size())], jpeg.substr(at, end - at));
  }
  return jpeg;
}

}  // namespace

std::string mutated(std::string_view input, std::uint64_t seed) {
  Dice dice(seed);
  if (input.starts_with("glTF")) return mutated_glb(input, dice);
  if (input.starts_with("\x89PNG")) return mutated_png(input, dice);
  if (input.starts_with("\xff\xd8")) return mutated_jpeg(input, dice);
  if (input.starts_with("{\"") && input.find("\n{\"") != std::string_view::npos)
    return mutated_lines(input, dice);
  if (input.starts_with('{') || input.starts_with('[')) return mutated_json(input, dice);
  std::string bytes(input);
  for (std::size_t i = dice.below(4); i < 4; ++i) change_bytes(bytes, dice);
  return bytes;
}

}  // namespace gnomon::fuzz
