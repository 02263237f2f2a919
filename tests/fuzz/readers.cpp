// One row and one function for each reader.
#include "tests/fuzz/readers.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <stdexcept>
#include <string>

#include "base/claim.h"
#include "base/error.h"
#include "base/npz.h"
#include "cli/golden/golden_tests.h"
#include "cli/golden/image_tolerance.h"
#include "cli/run/finished_run.h"
#include "cli/run/frame_list.h"
#include "cli/run/state_store.h"
#include "cli/scene/particle_expression.h"
#include "cli/scene/scene.h"
#include "cli/study/study.h"
#include "cli/study/study_results.h"
#include "cli/yaml/yaml_overrides.h"
#include "cli/yaml/yaml_tree.h"
#include "render/image/exr.h"
#include "render/image/exr_rows.h"
#include "render/image/png.h"
#include "render/image/texture_file.h"
#include "sim/import/assimp_reader.h"
#include "sim/import/gltf_document.h"
#include "sim/import/gltf_reader.h"
#include "sim/import/mesh_folder.h"
#include "sim/import/mtl_reader.h"
#include "sim/import/obj_reader.h"
#include "sim/import/off_reader.h"
#include "sim/import/ply_reader.h"
#include "sim/import/soup_codec.h"
#include "sim/import/stl_reader.h"
#include "sim/mesh/mesh_report.h"

namespace billow::test {
namespace {

namespace fs = std::filesystem;

fs::path lay(const fs::path& file, std::string_view bytes) {
  std::ofstream out(file, std::ios::binary | std::ios::trunc);
  out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (!out.flush()) throw std::runtime_error("cannot write " + file.string());
  return file;
}

// ---- text ----

// What is written must read as what was read.
void read_yaml(std::string_view bytes, const fs::path&) {
  const cli::NodePtr tree = cli::parse_yaml(std::string(bytes), "input");
  const std::string written = cli::to_yaml(*tree);
  if (cli::to_yaml(*cli::parse_yaml(written, "written")) != written)
    throw std::logic_error("the tree does not read back");
}

void read_scene_file(std::string_view bytes, const fs::path& folder) {
  cli::read_scene(lay(folder / "scenes" / "input.yaml", bytes));
}

void read_study_file(std::string_view bytes, const fs::path& folder) {
  const cli::Study study = cli::read_study(lay(folder / "scenes" / "studies" / "input.yaml", bytes));
  for (const cli::PictureSpec& picture : study.pictures) cli::files_of(picture);
}

void read_golden_file(std::string_view bytes, const fs::path& folder) {
  cli::read_golden_tests(lay(folder / "goldens.yaml", bytes));
}

void read_tolerance(std::string_view bytes, const fs::path& folder) {
  lay(folder / "picture.tolerance.yaml", bytes);
  cli::tolerance_of(folder / "picture.png", {});
}

// Lines of "path=value", as they follow -D.
void read_overrides(std::string_view bytes, const fs::path&) {
  static const cli::NodePtr tree = cli::parse_yaml(
      "billow: 1\nbodies:\n  - name: drape\n    cloth: {mesh: a.obj, mass: 0.2}\nsolver: {step: auto}\n", "tree");
  std::vector<cli::Override> overrides;
  for (std::size_t begin = 0; begin < bytes.size() && overrides.size() < 100;) {
    const std::size_t end = std::min(bytes.find('\n', begin), bytes.size());
    const std::string_view line = bytes.substr(begin, end - begin);
    const std::size_t equals = std::min(line.find('='), line.size());
    overrides.push_back(
        {std::string(line.substr(0, equals)), std::string(line.substr(std::min(equals + 1, line.size())))});
    begin = end + 1;
  }
  cli::to_yaml(*cli::with_overrides(tree, overrides));
}

void read_expression(std::string_view bytes, const fs::path&) {
  Eigen::MatrixX3d position(3, 3);
  position << 0, 0, 0, 1, 0, 0, 0, 0.5, -1;
  sim::Mesh mesh;
  mesh.position = position;
  mesh.group["edge"] = {0, 1};
  cli::evaluate_at_particles(std::string(bytes), position, mesh);
}

void read_frames(std::string_view bytes, const fs::path&) {
  if (const auto spans = cli::parse_frames(std::string(bytes))) cli::frames_in(*spans, 250);
}

// ---- meshes ----

// Into the bytes that leave the importing process, out of them again, and welded, as `import_mesh` does.
void weld_all_of(const sim::PolygonSoup& soup) { sim::report_of(sim::weld(sim::decode_soup(sim::encode_soup(soup)))); }

const sim::ImportLimits small_mesh = {.max_file_bytes = 1u << 20, .max_vertices = 200'000, .max_faces = 200'000};

template <auto read>
void read_mesh(std::string_view bytes, const fs::path& file) {
  weld_all_of(read(lay(file, bytes), small_mesh));
}

void read_obj_file(std::string_view bytes, const fs::path& folder) {
  read_mesh<sim::read_obj>(bytes, folder / "input.obj");
}
void read_off_file(std::string_view bytes, const fs::path& folder) {
  read_mesh<sim::read_off>(bytes, folder / "input.off");
}
void read_ply_file(std::string_view bytes, const fs::path& folder) {
  read_mesh<sim::read_ply>(bytes, folder / "input.ply");
}

// A binary one goes to assimp once its claims are checked.
void read_stl_file(std::string_view bytes, const fs::path& folder) {
  const std::string copy(bytes);
  if (sim::is_text_stl(copy)) return weld_all_of(sim::read_text_stl(copy, small_mesh));
  sim::check_binary_stl(copy, small_mesh);
  read_mesh<sim::read_with_assimp>(bytes, folder / "input.stl");
}

// One of glTF 1.0 throws OldGltf, an InputError, and goes to assimp in a child process.
void read_gltf_file(std::string_view bytes, const fs::path& folder) {
  read_mesh<sim::read_gltf>(bytes, folder / "input.gltf");
}
void read_glb_file(std::string_view bytes, const fs::path& folder) {
  read_mesh<sim::read_gltf>(bytes, folder / "input.glb");
}

void read_mtl_file(std::string_view bytes, const fs::path&) {
  sim::read_mtl(std::string(bytes), [](const std::string&) {});
}

// What the importing process answers, which a hostile file may have taken over.
void read_soup(std::string_view bytes, const fs::path&) { sim::report_of(sim::weld(sim::decode_soup(bytes))); }

// ---- pictures ----

constexpr std::size_t most_pixels = 1 << 22;  // whoever claims more is refused by other limits, which take their time

void read_png_file(std::string_view bytes, const fs::path& folder) {
  if (render::claimed_png_pixels(bytes) > most_pixels) return;
  const render::Image image = render::decode_png(bytes, "input");
  render::PngRows rows(lay(folder / "input.png", bytes));
  for (int y = 0; y < rows.height(); ++y)
    if (!std::equal(image.row(y), image.row(y) + std::size_t(image.width) * image.channels, rows.next()))
      throw std::logic_error("read by rows it is another picture");
}

void read_texture_bytes(std::string_view bytes, const fs::path&) {
  if (render::claimed_pixels(bytes) > most_pixels) return;
  render::Image image = render::decode_texture(bytes, "input");
  if (render::has_alpha(image)) render::bleed_into_holes(image);
}

void read_exr_file(std::string_view bytes, const fs::path& folder) {
  const fs::path file = lay(folder / "input.exr", bytes);
  render::exr_fault(file, 4, 3);
  render::ExrRows rows(file);
  render::ValueRow row(rows.shape().width, static_cast<Eigen::Index>(rows.shape().channels.size()));
  for (int y = 0; y < rows.shape().height; ++y) rows.read(row);
}

// ---- what billow wrote, damaged ----

void read_npz_file(std::string_view bytes, const fs::path& folder) { read_npz(lay(folder / "input.npz", bytes)); }

cli::StateStore store_in(const fs::path& folder) {
  cli::Scene scene;
  scene.motion_hash = "0123456789abcdef";
  cli::StepChoice choice;
  choice.step = 0.01;
  return {folder / "states", scene, choice, 4};
}

void read_state_record(std::string_view bytes, const fs::path& folder) {
  const cli::StateStore store = store_in(folder);
  lay(store.folder() / cli::StateStore::record_name, bytes);
  try {
    store.holds_this_run();
  } catch (const InputError&) {
    // its facts are read whatever it is of
  }
  store.read_record();
}

void read_state(std::string_view bytes, const fs::path& folder) {
  const cli::StateStore store = store_in(folder);
  lay(store.file(0.0), bytes);
  store.read(0.0);
}

void read_checkpoint(std::string_view bytes, const fs::path& folder) {
  const cli::StateStore store = store_in(folder);
  lay(store.folder() / cli::StateStore::checkpoint_name, bytes);
  store.read_checkpoint();
}

void read_run_record(std::string_view bytes, const fs::path& folder) {
  lay(folder / "run.json", bytes);
  cli::read_finished_run(folder);
}

void read_result_file(std::string_view bytes, const fs::path& folder) {
  lay(folder / "result.json", bytes);
  cli::read_result(folder, "0123456789abcdef");
}

void read_claim(std::string_view bytes, const fs::path& folder) { claim_holder(lay(folder / "claim", bytes)); }

constexpr std::array readers = {
    FuzzReader{"yaml", read_yaml},          FuzzReader{"scene", read_scene_file},
    FuzzReader{"study", read_study_file},   FuzzReader{"tolerance", read_tolerance},
    FuzzReader{"override", read_overrides}, FuzzReader{"expression", read_expression},
    FuzzReader{"frames", read_frames},      FuzzReader{"obj", read_obj_file},
    FuzzReader{"mtl", read_mtl_file},       FuzzReader{"off", read_off_file},
    FuzzReader{"ply", read_ply_file},       FuzzReader{"stl", read_stl_file},
    FuzzReader{"gltf", read_gltf_file},     FuzzReader{"glb", read_glb_file},
    FuzzReader{"soup", read_soup},          FuzzReader{"png", read_png_file},
    FuzzReader{"jpeg", read_texture_bytes}, FuzzReader{"exr", read_exr_file},
    FuzzReader{"npz", read_npz_file},       FuzzReader{"states", read_state_record},
    FuzzReader{"state", read_state},        FuzzReader{"checkpoint", read_checkpoint},
    FuzzReader{"run", read_run_record},     FuzzReader{"result", read_result_file},
    FuzzReader{"claim", read_claim},        FuzzReader{"golden", read_golden_file},
};

}  // namespace

std::span<const FuzzReader> fuzz_readers() { return readers; }

const FuzzReader* find_fuzz_reader(std::string_view name) {
  for (const FuzzReader& reader : readers)
    if (reader.name == name) return &reader;
  return nullptr;
}

void furnish_fuzz_folder(const fs::path& folder) {
  fs::create_directories(folder / "scenes" / "studies");
  fs::create_directories(folder / "states");
  const fs::path shipped = BILLOW_SOURCE_DIR;
  fs::create_symlink(shipped / "assets", folder / "assets");
  fs::create_symlink(shipped / "tests" / "corpus" / "files", folder / "corpus");
  for (const auto& scene : fs::directory_iterator(shipped / "scenes"))
    if (scene.path().extension() == ".yaml")
      fs::create_symlink(scene.path(), folder / "scenes" / scene.path().filename());
}

}  // namespace billow::test
