// The report of some rows, written for a test.
#pragma once

#include <string>
#include <vector>

#include "gnomon/report/page.hpp"
#include "gnomon/report/rows_file.hpp"
#include "sample_rows.hpp"

namespace gnomon::report {

/// The report of these rows, in a folder of its own.
class Reported {
 public:
  explicit Reported(const std::vector<Row>& rows) {
    RowsFile file(folder.path() / kRowsFile);
    for (const Row& row : rows) file.append(row);
    page = text_of(write_report(folder.path(), &warnings));
  }
  TemporaryFolder folder;
  std::string page;
  std::vector<std::string> warnings;
};

}  // namespace gnomon::report
