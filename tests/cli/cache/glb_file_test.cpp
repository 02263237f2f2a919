// GLB files, read again by a parser of the test's own.
#include "cli/cache/glb_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <nlohmann/json.hpp>

#include "cli/cache/base64.h"

namespace billow::cli {
namespace {

using nlohmann::json;

std::uint32_t number_at(const std::string& bytes, std::size_t place) {
  std::uint32_t number;
  std::memcpy(&number, bytes.data() + place, sizeof number);
  return number;
}

struct Glb {
  json document;
  std::string binary;

  explicit Glb(const std::string& bytes) {
    EXPECT_EQ(bytes.substr(0, 4), "glTF");
    EXPECT_EQ(number_at(bytes, 4), 2u);
    EXPECT_EQ(number_at(bytes, 8), bytes.size());
    const std::size_t length = number_at(bytes, 12);
    EXPECT_EQ(bytes.substr(16, 4), "JSON");
    EXPECT_EQ(length % 4, 0u);
    document = json::parse(bytes.substr(20, length));
    EXPECT_EQ(number_at(bytes, 20 + length) % 4, 0u);
    binary = bytes.substr(28 + length);
  }
  std::vector<float> floats(int accessor) const {
    const json& about = document["accessors"][accessor];
    const json& view = document["bufferViews"][about["bufferView"].get<int>()];
    std::vector<float> numbers(view["byteLength"].get<std::size_t>() / sizeof(float));
    EXPECT_EQ(view["byteOffset"].get<std::size_t>() % 4, 0u);
    std::memcpy(numbers.data(), binary.data() + view["byteOffset"].get<std::size_t>(), view["byteLength"]);
    return numbers;
  }
};

// A square whose corner 4 is another one on point 0: five vertices on four points.
GlbPart square() {
  GlbPart part{"square", "body", {}};
  part.drawn.surface.triangle.resize(2, 3);
  part.drawn.surface.triangle << 0, 1, 2, 2, 3, 4;
  part.drawn.surface.point.resize(5);
  part.drawn.surface.point << 0, 1, 2, 3, 0;
  part.drawn.surface.uv.resize(5, 2);
  part.drawn.surface.uv << 0, 0, 1, 0, 1, 1, 0, 1, 0, 0.25f;
  return part;
}

Eigen::MatrixX3f flat(float height) {
  Eigen::MatrixX3f position(4, 3);
  position << 0, height, 0, 0, height, 1, 1, height, 1, 1, height, 0;
  return position;
}

TEST(GlbFile, KeepsEveryCornerAndTurnsV) {
  const Glb glb(glb_file({square()}, {{0.0, {flat(0.5f)}}}));
  const json& primitive = glb.document["meshes"][0]["primitives"][0];
  EXPECT_THAT(glb.floats(primitive["attributes"]["POSITION"]),
              testing::ElementsAre(0, 0.5f, 0, 0, 0.5f, 1, 1, 0.5f, 1, 1, 0.5f, 0, 0, 0.5f, 0));
  EXPECT_THAT(glb.floats(primitive["attributes"]["TEXCOORD_0"]),
              testing::ElementsAre(0, 1, 1, 1, 1, 0, 0, 0, 0, 0.75f));
  EXPECT_EQ(glb.document["accessors"][primitive["indices"].get<int>()]["count"], 6);
  EXPECT_FALSE(glb.document.contains("animations"));  // one moment does not move
}

// base + sum of weight * displacement, with the weights that the animation has at a key, is where the part was.
TEST(GlbFile, IsTheStateAtEveryKey) {
  std::vector<GlbKey> keys;
  for (const float height : {0.0f, 0.25f, -1.0f, 3.0f}) {
    keys.push_back({0.04 * static_cast<double>(keys.size()), {flat(height)}});
    keys.back().positions[0](1, 0) += height * height;
  }
  const GlbPart part = square();
  const Glb glb(glb_file({part}, keys));
  const json& primitive = glb.document["meshes"][0]["primitives"][0];
  const json& sampler = glb.document["animations"][0]["samplers"][0];
  EXPECT_EQ(sampler["interpolation"], "LINEAR");
  EXPECT_THAT(glb.floats(sampler["input"]), testing::ElementsAre(0.0f, 0.04f, 0.08f, 0.12f));
  const std::vector<float> weights = glb.floats(sampler["output"]);
  ASSERT_EQ(primitive["targets"].size(), 3u);
  ASSERT_EQ(weights.size(), 12u);
  for (std::size_t k = 0; k < keys.size(); ++k) {
    SCOPED_TRACE(k);
    std::vector<float> place = glb.floats(primitive["attributes"]["POSITION"]);
    for (std::size_t t = 0; t < 3; ++t) {
      const std::vector<float> moved = glb.floats(primitive["targets"][t]["POSITION"]);
      for (std::size_t n = 0; n < place.size(); ++n) place[n] += weights[3 * k + t] * moved[n];
    }
    for (int c = 0; c < 5; ++c)
      for (int axis = 0; axis < 3; ++axis)
        EXPECT_NEAR(place[3 * c + axis], keys[k].positions[0](part.drawn.surface.point(c), axis), 1e-6);
  }
}

TEST(GlbFile, WhatNeverMovesHasNoTargets) {
  GlbPart still = square(), moving = square();
  const Glb glb(glb_file({still, moving}, {{0.0, {flat(0), flat(0)}}, {1.0, {flat(0), flat(1)}}}));
  EXPECT_FALSE(glb.document["meshes"][0]["primitives"][0].contains("targets"));
  EXPECT_EQ(glb.document["meshes"][1]["primitives"][0]["targets"].size(), 1u);
  ASSERT_EQ(glb.document["animations"][0]["channels"].size(), 1u);
  EXPECT_EQ(glb.document["animations"][0]["channels"][0]["target"]["node"], 1);
}

TEST(GlbFile, BodiesShareTheirTexture) {
  GlbPart part = square();
  part.drawn.finish[0].texture = render::Image(2, 2);
  GlbPart other = part;
  other.drawn.finish[0].texture.pixels[5] = 9;
  const Glb glb(glb_file({part, part, other}, {{0.0, {flat(0), flat(0), flat(0)}}}));
  EXPECT_EQ(glb.document["images"].size(), 2u);
  const auto texture = [&](int m) {
    return glb.document["materials"][m]["pbrMetallicRoughness"]["baseColorTexture"]["index"].get<int>();
  };
  EXPECT_EQ(texture(0), texture(1));
  EXPECT_NE(texture(0), texture(2));
}

// The vectors of RFC 4648.
TEST(Base64, IsTheStandards) {
  const std::pair<const char*, const char*> known[] = {
      {"", ""}, {"f", "Zg=="}, {"fo", "Zm8="}, {"foo", "Zm9v"}, {"foob", "Zm9vYg=="}};
  for (const auto& [bytes, text] : known) EXPECT_EQ(base64(bytes), text);
  EXPECT_EQ(base64("\xff\xfe\xfd"), "//79");
}

}  // namespace
}  // namespace billow::cli
