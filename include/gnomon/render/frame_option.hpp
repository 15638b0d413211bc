// Which options of a frame does the source of its shadows honour?
#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>

namespace gnomon::render {

/// An option that a frame may request: one enumerator for each entry of frame_options.def.
enum class FrameOption : std::uint8_t {
#define GNOMON_FRAME_OPTION(name, what) name,
#include "gnomon/render/frame_options.def"
#undef GNOMON_FRAME_OPTION
};
/// How many there are.
inline constexpr std::size_t kFrameOptionCount =
#define GNOMON_FRAME_OPTION(name, what) 1 +
#include "gnomon/render/frame_options.def"
#undef GNOMON_FRAME_OPTION
    0;
/// The enumerator's name.
[[nodiscard]] std::string_view to_string(FrameOption option) noexcept;
/// The meaning of the option, one line, with names of code in backquotes.
[[nodiscard]] std::string_view describe(FrameOption option) noexcept;

/// A set of frame options.
class FrameOptionSet {
 public:
  /// The empty set.
  constexpr FrameOptionSet() noexcept = default;
  /// These.
  constexpr FrameOptionSet(std::initializer_list<FrameOption> options) noexcept {
    for (const FrameOption option : options) add(option);
  }
  /// All there are.
  [[nodiscard]] static constexpr FrameOptionSet all() noexcept {
    FrameOptionSet set;
    set.bits_ = (std::uint32_t{1} << kFrameOptionCount) - 1;
    return set;
  }
  /// Adds an option where `wanted`.
  constexpr void add(FrameOption option, bool wanted = true) noexcept {
    if (wanted) bits_ |= bit(option);
  }
  /// Whether the option is in the set.
  [[nodiscard]] constexpr bool has(FrameOption option) const noexcept { return (bits_ & bit(option)) != 0; }
  /// Whether no option is.
  [[nodiscard]] constexpr bool empty() const noexcept { return bits_ == 0; }
  /// This set without the options of another.
  [[nodiscard]] constexpr FrameOptionSet without(const FrameOptionSet& other) const noexcept {
    FrameOptionSet set;
    set.bits_ = bits_ & ~other.bits_;
    return set;
  }
  /// The same options.
  constexpr bool operator==(const FrameOptionSet&) const noexcept = default;

 private:
  static constexpr std::uint32_t bit(FrameOption option) noexcept {
    return std::uint32_t{1} << static_cast<unsigned>(option);
  }
  static_assert(kFrameOptionCount < 32);
  std::uint32_t bits_ = 0;
};
/// Names of the options in the order of the registry, with ", " between them; empty for the empty set.
[[nodiscard]] std::string to_string(const FrameOptionSet& options);

/// One source of shadows, and the options that it honours.
struct SourceSupport {
  std::string_view name;    ///< one word
  std::string_view what;    ///< what shadows are read from, one line
  FrameOptionSet supports;  ///< FrameStats::ignored has those of a frame's options that are not in it
};
/// One entry for each source, and for maps in a frame that has maps whose shape bends lines.
[[nodiscard]] std::span<const SourceSupport> source_supports() noexcept;
/// All of them as a table in Markdown, a row for each option and a column for each source.
[[nodiscard]] std::string source_table();

}  // namespace gnomon::render
