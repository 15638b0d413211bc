// Whole files in and out, with errors that name them.
#include "file.hpp"

#include <unistd.h>

#include <fstream>
#include <sstream>
#include <system_error>

#include "gnomon/report/row.hpp"

namespace gnomon::report {

namespace fs = std::filesystem;

std::string read_text(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  if (in) text << in.rdbuf();
  // An empty file sets the failbit of the output: nothing was there to insert.
  if (!in.is_open() || in.bad()) throw ReportError(file.string() + ": cannot be read");
  return text.str();
}

void write_text(const fs::path& file, const std::string& text) {
  fs::path aside = file;
  aside += "." + std::to_string(::getpid());
  {
    std::ofstream out(aside, std::ios::binary);
    out << text;
    out.flush();
    if (!out) throw ReportError(aside.string() + ": cannot be written");
  }
  std::error_code error;
  fs::rename(aside, file, error);
  if (error) throw ReportError(file.string() + ": " + error.message());
}

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error || !fs::is_directory(folder)) throw ReportError(folder.string() + ": cannot be made a folder");
}

fs::path inside(const fs::path& folder, const std::string& name) {
  const fs::path relative = fs::path(name).lexically_normal();
  if (relative.is_absolute() || relative.empty() || *relative.begin() == "..")
    throw ReportError(folder.string() + ": a row names the file '" + name + "' outside of its folder");
  return folder / relative;
}

}  // namespace gnomon::report
