// Starts the context before the first test and ends it after the last.
#include "shared_context.hpp"

#include <gtest/gtest.h>

namespace gnomon::render {
namespace {

std::unique_ptr<Context> context;

class SharedContext : public testing::Environment {
 public:
  void SetUp() override { context = create_context(ContextKind::automatic); }
  void TearDown() override { context.reset(); }
};
const testing::Environment* const registered = testing::AddGlobalTestEnvironment(new SharedContext);

}  // namespace

Context& shared_context() {
  return *context;
}

}  // namespace gnomon::render
