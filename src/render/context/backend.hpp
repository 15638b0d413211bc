// What the back ends of create_context share.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "gnomon/render/context.hpp"

namespace gnomon::render {

/// Points this thread's table of OpenGL functions at the context that is current, and fills in renderer,
/// version, whether it is software and whether it reports resets. Throws RenderError below OpenGL 4.5.
void load_gl(void* (*get_proc_address)(const char*), ContextInfo* info);

/// Whether GL_RENDERER names a driver that draws on the CPU, into its memory.
[[nodiscard]] bool is_software(std::string_view renderer);

/// `refused` is kept in the context's info.
[[nodiscard]] std::unique_ptr<Context> create_osmesa_context(const std::vector<std::string>& refused = {});
/// Tries surfaceless, then every device. Takes the first GPU, or the first of all where `software_too`. Why
/// others were passed over is appended to `refused`. nullptr where none is left.
[[nodiscard]] std::unique_ptr<Context> create_egl_context(bool software_too,
                                                          std::vector<std::string>& refused);

}  // namespace gnomon::render
