// The parts of a glTF file: its JSON, its buffers, and numbers in them.
#pragma once

#include <Eigen/Core>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "sim/import/mesh_folder.h"

namespace billow::sim {

/// What is thrown of glTF 1.0, which another reader knows.
struct OldGltf : InputError {
  OldGltf() : InputError("it is of glTF 1.0") {}
};

/// A glTF document and what its buffers hold.
class GltfDocument {
 public:
  /// Throws OldGltf, and InputError where the file is no glTF, or a buffer is missing, outside the folder or too short.
  GltfDocument(const std::filesystem::path& file, std::uintmax_t max_file_bytes);

  const nlohmann::json& root() const { return root_; }

  /// An entry of one of the document's lists, such as ("nodes", 3). Throws InputError where it is not there.
  const nlohmann::json& entry(const char* list, const nlohmann::json& index) const;

  /// The rows of an accessor (count x components), normalised integers as fractions. At most `max_count` of them.
  Eigen::MatrixXd numbers(const nlohmann::json& accessor_index, long long max_count) const;

  /// The bytes of a buffer view.
  std::string_view view(const nlohmann::json& index) const;

  /// What a URI holds: data of its own, or the file of that name.
  std::string resource(const std::string& uri) const;

 private:
  void load_binary(std::string bytes);
  void load_buffers();
  void fill(const nlohmann::json& accessor, int components, Eigen::MatrixXd& rows) const;
  void replace_sparse(const nlohmann::json& sparse, const nlohmann::json& accessor, Eigen::MatrixXd& rows) const;

  MeshFolder folder_;
  nlohmann::json root_;
  std::string chunk_;  // of a GLB
  std::vector<std::string> buffer_;
};

/// A whole number of a glTF object, `otherwise` where it is not given. Throws InputError where it is something else.
long long gltf_integer(const nlohmann::json& object, const char* key, long long otherwise);
/// A number or a name of a glTF object, likewise.
double gltf_number(const nlohmann::json& object, const char* key, double otherwise);
std::string gltf_text(const nlohmann::json& object, const char* key);
/// A list or an object within one; empty where it is not given.
const nlohmann::json& gltf_part(const nlohmann::json& object, const char* key);
/// The numbers of a list that must have `size` of them; empty where it is not given.
std::vector<double> gltf_numbers(const nlohmann::json& object, const char* key, std::size_t size);

/// The bytes that base64 text stands for. Throws InputError on anything else.
std::string from_base64(std::string_view text);
/// %20 and the like taken out of a URI.
std::string from_percent(std::string_view text);

}  // namespace billow::sim
