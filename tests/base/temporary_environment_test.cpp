#include "base/temporary_environment.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

namespace billow {
namespace {

using Changes = std::vector<TemporaryEnvironment::Change>;

std::string value_of(const char* name) {
  const char* value = std::getenv(name);
  return value ? value : "nothing";
}

TEST(TemporaryEnvironment, ChangesWhatIsFoundAndPutsItBack) {
  setenv("BILLOW_TEST_OLD", "old", 1);
  setenv("BILLOW_TEST_OLDER", "older", 1);
  {
    const TemporaryEnvironment changed(Changes{{"BILLOW_TEST_OLD", "new"}, {"BILLOW_TEST_ADDED", "added"}});
    EXPECT_EQ(value_of("BILLOW_TEST_OLD"), "new");
    EXPECT_EQ(value_of("BILLOW_TEST_ADDED"), "added");
    EXPECT_EQ(value_of("BILLOW_TEST_OLDER"), "older");  // its name only begins alike
    const TemporaryEnvironment without(Changes{{"BILLOW_TEST_OLD", std::nullopt}});
    EXPECT_EQ(value_of("BILLOW_TEST_OLD"), "nothing");
    EXPECT_EQ(value_of("BILLOW_TEST_ADDED"), "added");
  }
  EXPECT_EQ(value_of("BILLOW_TEST_OLD"), "old");
  EXPECT_EQ(value_of("BILLOW_TEST_ADDED"), "nothing");
}

TEST(TemporaryEnvironment, WhatLibrariesGotStaysValid) {
  const char* kept = nullptr;
  {
    const TemporaryEnvironment changed(Changes{{"BILLOW_TEST_KEPT", "kept"}});
    kept = std::getenv("BILLOW_TEST_KEPT");
  }
  EXPECT_EQ(std::string(kept), "kept");
}

TEST(TemporaryEnvironment, ProcessesStartedLaterInheritNothing) {
  { const TemporaryEnvironment changed(Changes{{"BILLOW_TEST_LEAK", "leaked"}}); }
  EXPECT_EQ(std::system("test -z \"$BILLOW_TEST_LEAK\""), 0);
}

}  // namespace
}  // namespace billow
