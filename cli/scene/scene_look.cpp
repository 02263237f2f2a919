// Textures and colours: the scene's own, or those of a mesh's materials.
#include <fmt/format.h>

#include <algorithm>

#include "cli/scene/scene_files.h"
#include "cli/scene/scene_parts.h"
#include "render/image/texture_file.h"
#include "sim/import/mesh_folder.h"

namespace billow::cli {

namespace fs = std::filesystem;

namespace {

constexpr std::uintmax_t most_texture_bytes = 1u << 28;

// A texture with holes is cut out unless somebody says otherwise.
AlphaMode alpha_of(const render::Image& texture) {
  return render::has_alpha(texture) ? AlphaMode::cut_out : AlphaMode::opaque;
}

render::Finish own_finish(const Look& look, const FileWatch& watch, TextureBudget& budget) {
  render::Finish finish;
  check_file(look.texture_file, "texture", look.texture_where);
  if (watch) watch(look.texture_file);
  located(look.texture_where, [&] {
    finish.texture = render::read_texture(look.texture_file);
    budget.take(std::size_t(finish.texture.width) * finish.texture.height);
  });
  finish.colour.setOnes();
  finish.alpha = alpha_of(finish.texture);
  return finish;
}

// The materials that faces have, as finishes; their faces are renumbered.
class MeshFinishes {
 public:
  MeshFinishes(const Look& look, sim::Mesh& mesh, const fs::path& mesh_file, const FileWatch& watch,
               TextureBudget& budget)
      : look_(look), mesh_(mesh), folder_(mesh_file, most_texture_bytes), watch_(watch), budget_(budget) {}

  std::vector<render::Finish> take() {
    std::vector<int> used(mesh_.face_material);
    std::sort(used.begin(), used.end());
    used.erase(std::unique(used.begin(), used.end()), used.end());
    std::vector<render::Finish> finishes;
    for (const int material : used) finishes.push_back(material < 0 ? plain() : finish_of(mesh_.material[material]));
    for (int& material : mesh_.face_material)
      material = static_cast<int>(std::lower_bound(used.begin(), used.end(), material) - used.begin());
    return finishes;
  }

 private:
  render::Finish plain() const {
    render::Finish finish;
    finish.colour = look_.colour;
    return finish;
  }

  render::Finish finish_of(const sim::Material& material) {
    render::Finish finish;
    finish.colour = material.colour.head<3>();
    finish.opacity = material.colour(3);
    finish.cutoff = material.cutoff;
    if (!material.texture_bytes.empty())
      read(material, "(in the file)", [&] { finish.texture = decoded(material.texture_bytes); });
    else if (!material.texture.empty())
      read(material, material.texture, [&] { finish.texture = texture_file(material.texture); });
    if (!material.alpha_texture.empty())
      read(material, material.alpha_texture, [&] {
        const render::Image grey = texture_file(material.alpha_texture);
        render::Image base = finish.texture.pixels.empty() ? white(grey.width, grey.height) : finish.texture;
        finish.texture = render::with_alpha(base, grey);
      });
    finish.alpha = material.alpha.value_or(alpha_of(finish.texture));
    return finish;
  }

  static render::Image white(int width, int height) {
    render::Image image(width, height);
    std::fill(image.pixels.begin(), image.pixels.end(), 255);
    return image;
  }

  render::Image texture_file(const std::string& name) {
    const std::string bytes = folder_.read(name);
    if (watch_) watch_(folder_.path() / name);
    return decoded(bytes);
  }

  // Any number of materials may each name a large texture, also one that proves damaged at its end.
  render::Image decoded(std::string_view bytes) {
    budget_.take(render::claimed_pixels(bytes));
    return render::decode_texture(bytes, "it");
  }

  // What cannot be read is told and left out: the shape does not depend on it.
  template <class Read>
  void read(const sim::Material& material, const std::string& texture, const Read& work) {
    try {
      work();
    } catch (const InputError& error) {
      mesh_.ignored.push_back(fmt::format("texture '{}' of material '{}': {}", texture, material.name, error.what()));
    }
  }

  const Look& look_;
  sim::Mesh& mesh_;
  sim::MeshFolder folder_;
  const FileWatch& watch_;
  TextureBudget& budget_;
};

}  // namespace

void load_look(Look& look, sim::Mesh& mesh, const fs::path& mesh_file, const FileWatch& watch, TextureBudget& budget) {
  const bool own = !look.texture_file.empty();
  if (own || !look.of_mesh) mesh.face_material.clear();
  look.shows_vertex_colours = !own && look.of_mesh && mesh.colour.rows() > 0;
  if (own) {
    look.finish = {own_finish(look, watch, budget)};
  } else if (mesh.face_material.empty()) {
    look.finish = {render::Finish()};
    look.finish[0].colour = look.shows_vertex_colours ? Eigen::Vector3f::Ones() : look.colour;
  } else {
    look.finish = MeshFinishes(look, mesh, mesh_file, watch, budget).take();
  }
  mesh.material.clear();
  for (render::Finish& finish : look.finish) {
    finish.alpha = look.alpha.value_or(finish.alpha);
    if (finish.alpha != AlphaMode::opaque) render::bleed_into_holes(finish.texture);
  }
}

}  // namespace billow::cli
