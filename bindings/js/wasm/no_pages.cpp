// How do the small modules go without pages? By an empty list of policies: names of the C interface would
// bring all of them along.
#include "gnomon/pages.hpp"

namespace gnomon {

std::span<const PagePolicy* const> all_page_policies() noexcept {
  return {};
}

}  // namespace gnomon
