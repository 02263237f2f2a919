// Line by line; a material lasts until the next newmtl.
#include "sim/import/mtl_reader.h"

#include <algorithm>
#include <map>

#include <fmt/format.h>

#include "base/error.h"
#include "base/srgb.h"
#include "sim/import/mesh_text.h"
#include "sim/import/text_lines.h"

namespace billow::sim {
namespace {

// The file name after a map's options, each of which has a known number of words; names may have blanks.
std::string map_file(const TextLine& line, bool& has_options) {
  static const std::map<std::string_view, std::size_t> words_of = {
      {"-blendu", 1}, {"-blendv", 1}, {"-cc", 1},    {"-clamp", 1},   {"-mm", 2},
      {"-texres", 1}, {"-bm", 1},     {"-boost", 1}, {"-imfchan", 1}, {"-type", 1}};
  std::size_t k = 1;
  while (k < line.words.size() && line.words[k].starts_with('-')) {
    has_options = true;
    const auto known = words_of.find(line.words[k]);
    ++k;
    if (known != words_of.end()) {
      k += known->second;
    } else {  // -o, -s, -t: one to three numbers
      for (int n = 0; n < 3 && k < line.words.size() &&
                      line.words[k].find_first_not_of("0123456789.+-eE") == std::string_view::npos;
           ++n)
        ++k;
    }
  }
  if (k >= line.words.size()) return "";
  std::string file(line.rest.substr(static_cast<std::size_t>(line.words[k].data() - line.rest.data())));
  std::replace(file.begin(), file.end(), '\\', '/');
  return file;
}

double number_or(const TextLine& line, std::size_t word, double otherwise) {
  if (word >= line.words.size()) return otherwise;
  try {
    return std::clamp(number_in(line.words[word]), 0.0, 1.0);
  } catch (const InputError&) {
    return otherwise;
  }
}

class MtlReader {
 public:
  explicit MtlReader(const std::function<void(const std::string&)>& ignore) : ignore_(ignore) {}

  void take(const TextLine& line) {
    const std::string_view key = line.words[0];
    if (key == "newmtl") {
      materials_.emplace_back().name = line.rest;
      return;
    }
    if (materials_.empty()) return;
    Material& material = materials_.back();
    if (key == "Kd")
      for (int c = 0; c < 3; ++c)
        material.colour(c) = static_cast<float>(
            srgb_to_linear(number_or(line, std::min<std::size_t>(c + 1, line.words.size() - 1), 1.0)));
    else if (key == "d")
      set_alpha(material, number_or(line, line.words.size() - 1, 1.0));
    else if (key == "Tr")
      set_alpha(material, 1.0 - number_or(line, 1, 0.0));
    else if (key.starts_with("map_") || key == "bump" || key == "norm" || key == "disp" || key == "refl")
      take_map(line, material);
  }

  std::vector<Material> materials() {
    for (Material& material : materials_)
      if (!material.texture.empty()) material.colour.head<3>().setOnes();
    return std::move(materials_);
  }

 private:
  static void set_alpha(Material& material, double alpha) {
    material.colour(3) = static_cast<float>(alpha);
    if (alpha < 1.0) material.alpha = AlphaMode::blend;
  }

  void take_map(const TextLine& line, Material& material) {
    bool has_options = false;
    const std::string file = map_file(line, has_options);
    if (line.words[0] == "map_Kd")
      material.texture = file;
    else if (line.words[0] == "map_d")
      material.alpha_texture = file, material.alpha = AlphaMode::blend;
    else
      return ignore_(fmt::format("maps {} of materials", line.words[0]));
    if (has_options) ignore_(fmt::format("options of {} (offset, scale and the like)", line.words[0]));
  }

  const std::function<void(const std::string&)>& ignore_;
  std::vector<Material> materials_;
};

}  // namespace

std::vector<Material> read_mtl(std::string bytes, const std::function<void(const std::string&)>& ignore) {
  const std::string text = plain_text(std::move(bytes));
  MtlReader reader(ignore);
  for (TextLines lines(text); lines.next();) reader.take(lines.line());
  return reader.materials();
}

}  // namespace billow::sim
