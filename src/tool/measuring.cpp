// What do the commands that measure have in common: scenes, light, frames, and where results go?
#include "measuring.hpp"

#include <iterator>

#include "edit_words.hpp"
#include "offscreen_context.hpp"
#include "picture_words.hpp"
#include "scene_words.hpp"

namespace gnomon::tool {

Option scenes_option(Measuring& measuring, const std::string& help, bool required) {
  const auto set = [&measuring](const std::string& option, const std::vector<std::string>& words) {
    for (const std::string& word : words) check_scene_word(option, word);
    measuring.scenes = words;
  };
  return {.name = "SCENE",
          .target = ParsedWords{set, {}},
          .help = help,
          .required = required,
          .names = builtin_scene_words(),
          .completion = Completion::files};
}

std::vector<Option> measuring_options(Measuring& measuring, Option scenes, std::vector<Option> own,
                                      const std::string& out_help) {
  std::vector<Option> options{std::move(scenes)};
  const auto add = [&options](std::vector<Option> more) {
    options.insert(options.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
  };
  add(std::move(own));
  add(light_options(measuring.light));
  add(camera_options(measuring.camera));
  add(edit_options(measuring.edits));
  add({max_triangles_option(measuring.max_triangles),
       size_option(measuring.width, measuring.height),
       {.name = "--out", .target = &measuring.out, .help = out_help, .completion = Completion::folders},
       {.name = "--json", .target = &measuring.json, .help = "print each row as a line of JSON"},
       context_option(measuring.context)});
  return options;
}

}  // namespace gnomon::tool
