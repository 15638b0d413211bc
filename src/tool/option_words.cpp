// The words for an option's value, shared by --help and manual pages.
#include "option_words.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <type_traits>

namespace gnomon::tool {
namespace {

template <class Words>
std::string comma_list(const Words& words) {
  std::string all;
  for (const auto& word : words) {
    all += all.empty() ? "" : ",";
    if constexpr (std::is_same_v<std::remove_cvref_t<decltype(word)>, int>) {
      all += std::to_string(word);
    } else {
      all += word;
    }
  }
  return all;
}

/// Whether `text` has `word` as one of its words.
bool has_word(std::string_view text, std::string_view word) {
  const auto joins = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; };
  for (std::size_t at = text.find(word); at != std::string_view::npos; at = text.find(word, at + 1)) {
    const std::size_t end = at + word.size();
    if ((at == 0 || !joins(text[at - 1])) && (end == text.size() || !joins(text[end]))) return true;
  }
  return false;
}

}  // namespace

std::string upper(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return text;
}

std::string number_word(double value) {
  // Beyond this a double has no digits to show.
  constexpr double kLong = 1e15;
  if (std::abs(value) >= kLong) {
    char text[32];
    std::snprintf(text, sizeof text, "%g", value);
    return text;
  }
  std::string text = std::to_string(value);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.ends_with('.')) text.pop_back();
  return text;
}

bool takes_list(const Option& option) {
  return std::holds_alternative<std::vector<int>*>(option.target) ||
         std::holds_alternative<std::vector<std::string>*>(option.target) ||
         std::holds_alternative<ParsedWords>(option.target);
}

bool is_positional(const Option& option) {
  return !option.name.starts_with('-');
}

std::string value_word(const Option& option) {
  if (std::holds_alternative<bool*>(option.target)) return {};
  if (!option.word.empty()) return option.word;
  if (!option.names.empty()) return "NAME";
  if (option.completion == Completion::files) return "FILE";
  if (option.completion == Completion::folders) return "DIR";
  const bool number = std::holds_alternative<int*>(option.target) ||
                      std::holds_alternative<double*>(option.target) ||
                      std::holds_alternative<std::uint64_t*>(option.target) ||
                      std::holds_alternative<std::vector<int>*>(option.target);
  return number ? "N" : "TEXT";
}

std::string default_word(const Option& option) {
  return std::visit(
      [&option](const auto& target) -> std::string {
        using Type = std::remove_cvref_t<decltype(target)>;
        if constexpr (std::is_same_v<Type, bool*>) {
          return {};
        } else if constexpr (std::is_same_v<Type, ParsedWord> || std::is_same_v<Type, ParsedWords>) {
          return target.shown;
        } else if constexpr (std::is_same_v<Type, std::string*>) {
          return *target;
        } else if constexpr (std::is_same_v<Type, std::vector<std::string>*> ||
                             std::is_same_v<Type, std::vector<int>*>) {
          return comma_list(*target);
        } else {
          const auto value = static_cast<double>(*target);
          // A value outside of the range marks an option that is not given.
          const bool legal = !option.range || (value >= (*option.range)[0] && value <= (*option.range)[1]);
          return legal ? number_word(value) : std::string();
        }
      },
      option.target);
}

std::string values_word(const Option& option, std::string_view footer) {
  const auto is_said = [&](const std::string& name) {
    return has_word(option.help, name) || has_word(footer, name);
  };
  if (std::all_of(option.names.begin(), option.names.end(), is_said)) return {};
  return any_of_text(option.names);
}

std::string positional_word(const Option& option) {
  const std::string word = upper(option.name) + (takes_list(option) ? "..." : "");
  return option.required ? word : "[" + word + "]";
}

}  // namespace gnomon::tool
