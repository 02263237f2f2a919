#include "render/gl/backend.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>

#include "base/out_of_memory.h"
#include "render/gl/gl_context.h"

namespace billow::render {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

TEST(Backend, ReadsBackWhatItWrites) {
  for (const char* text : {"auto", "osmesa", "egl", "egl:0", "egl:12"}) EXPECT_EQ(text_of(parse_backend(text)), text);
}

TEST(Backend, SaysWhatCanBeWritten) {
  EXPECT_THAT([] { parse_backend("osmes"); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("did you mean 'osmesa'?")));
  EXPECT_THAT([] { parse_backend("vulkan"); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("backends are: auto, osmesa, egl, egl:N")));
  for (const char* text : {"egl:", "egl:-1", "egl:one", "egl:1x", "egl: 1", "egl:99999999999"})
    EXPECT_THAT([&] { parse_backend(text); }, ThrowsMessage<std::invalid_argument>(HasSubstr("names no device")))
        << text;
}

class BackendOfEnvironment : public testing::Test {
 protected:
  BackendOfEnvironment() { unsetenv("BILLOW_BACKEND"); }
  ~BackendOfEnvironment() override {
    if (before_) setenv("BILLOW_BACKEND", before_->c_str(), 1);
    if (!before_) unsetenv("BILLOW_BACKEND");
  }

 private:
  std::optional<std::string> before_ =
      std::getenv("BILLOW_BACKEND") ? std::optional<std::string>(std::getenv("BILLOW_BACKEND")) : std::nullopt;
};

TEST_F(BackendOfEnvironment, IsAutomaticUnlessItSaysSo) {
  EXPECT_EQ(text_of(backend_of_environment()), "auto");
  setenv("BILLOW_BACKEND", "", 1);
  EXPECT_EQ(text_of(backend_of_environment()), "auto");
  setenv("BILLOW_BACKEND", "egl:1", 1);
  EXPECT_EQ(text_of(backend_of_environment()), "egl:1");
  setenv("BILLOW_BACKEND", "elg", 1);
  EXPECT_THAT([] { backend_of_environment(); },
              ThrowsMessage<std::invalid_argument>(AllOf(HasSubstr("BILLOW_BACKEND"), HasSubstr("'egl'"))));
}

TEST(GlContext, AutomaticIsSoftware) {
  const GlContext context((Backend()));
  EXPECT_TRUE(context.is_software()) << context.description();
  EXPECT_EQ(text_of(context.backend()), "osmesa");
}

TEST(GlContext, OfEglIsSoftwareWithoutANumber) {
  const GlContext context(parse_backend("egl"));
  EXPECT_TRUE(context.is_software()) << context.description();
  EXPECT_EQ(text_of(context.backend()), "egl");
}

TEST(GlContext, ListsTheDevicesWhereOneIsMissing) {
  EXPECT_THAT([] { GlContext context(parse_backend("egl:63")); },
              ThrowsMessage<ResourceError>(AllOf(HasSubstr("no device 63"), HasSubstr("egl:0 ("))));
}

// What drivers are told does not reach whatever is started afterwards.
TEST(GlContext, LeavesTheEnvironmentAsItWas) {
  unsetenv("LP_NUM_THREADS");
  const auto value_of = [](const char* name) { return std::string(std::getenv(name) ? std::getenv(name) : "nothing"); };
  for (const char* backend : {"osmesa", "egl"})
    for (const char* name : {"LP_NUM_THREADS", "LIBGL_ALWAYS_SOFTWARE", "EGL_LOG_LEVEL"}) {
      const std::string before = value_of(name);
      const GlContext context(parse_backend(backend), 2);
      EXPECT_EQ(value_of(name), before) << name << " by " << backend;
    }
}

// Mesa would take a GPU for software, or fall over its own feet.
TEST(GlContext, IsSoftwareWhateverTheEnvironmentSays) {
  for (const char* name : {"GALLIUM_DRIVER", "MESA_LOADER_DRIVER_OVERRIDE"}) {
    setenv(name, "zink", 1);
    for (const char* backend : {"osmesa", "egl"}) EXPECT_TRUE(GlContext(parse_backend(backend)).is_software()) << name;
    EXPECT_STREQ(std::getenv(name), "zink");
    unsetenv(name);
  }
}

}  // namespace
}  // namespace billow::render
