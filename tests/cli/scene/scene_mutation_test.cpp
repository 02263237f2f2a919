// A damaged scene is read or refused with an InputError; nothing else may happen.
#include <gtest/gtest.h>

#include <fstream>
#include <random>
#include <sstream>

#include "base/error.h"
#include "cli/scene/scene.h"
#include "tests/support/scene_files.h"

namespace billow {
namespace {

// One to four bytes changed, doubled or dropped; most changes put in what means something to YAML.
std::string mutated(std::string text, std::mt19937_64& bits) {
  constexpr std::string_view telling = "\n :-#[]{},&*!|>'\"%@`~.0123456789e\t?<\\";
  for (std::uint64_t left = 1 + bits() % 4; left > 0; --left) {
    const std::size_t at = bits() % text.size();
    const char byte = bits() % 4 ? telling[bits() % telling.size()] : static_cast<char>(bits() & 0xff);
    switch (bits() % 4) {
      case 0:
        text.erase(at, 1 + bits() % 8);
        break;
      case 1:
        text.insert(at, text.substr(bits() % text.size(), bits() % 30));
        break;
      case 2:
        text.insert(at, 1, byte);
        break;
      default:
        text[at] = byte;
    }
  }
  return text;
}

// A shipped scene over a mesh that is read in no time.
std::string scene_of(const std::string& name) {
  std::ifstream stream(BILLOW_SOURCE_DIR "/scenes/" + name);
  std::ostringstream text;
  text << stream.rdbuf();
  std::string yaml = text.str();
  yaml = test::edited(yaml, "../assets/meshes/cloth_50.obj", "cloth.obj");
  return test::edited(yaml, "    texture: ../assets/textures/tartan.png\n", "");
}

TEST(SceneMutation, GivesASceneOrAnInputError) {
  const test::SceneFolder folder;
  const std::string drape = scene_of("drape.yaml");
  std::mt19937_64 bits(20071);
  int read = 0, refused = 0;
  for (int i = 0; i < 400; ++i) {
    const std::string yaml = mutated(drape, bits);
    const auto file = folder.scene(yaml);
    try {
      cli::read_scene(file);
      ++read;
    } catch (const InputError& error) {
      ++refused;
      EXPECT_TRUE(std::string(error.what()).starts_with(file.string() + ":")) << error.what();
    } catch (const std::exception& error) {
      FAIL() << error.what() << "\n" << yaml;
    }
  }
  EXPECT_GT(read, 20);
  EXPECT_GT(refused, 100);
}

}  // namespace
}  // namespace billow
