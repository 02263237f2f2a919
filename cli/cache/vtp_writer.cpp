// VTK's PolyData as XML, one file a frame, its arrays appended raw and each led by its size as UInt64; and the
// collection (PVD) that gives every file its time, which ParaView opens.
#include <fmt/format.h>

#include "base/atomic_file.h"
#include "base/xml.h"
#include "cli/cache/bytes.h"
#include "cli/cache/cache_writer.h"

namespace billow::cli {
namespace {

constexpr ByteOrder vtp_order = ByteOrder::little;

/// The arrays of one file: their elements in the XML, their bytes behind it.
class Arrays {
 public:
  /// The element of an array with so many numbers a row.
  template <class Rows>
  std::string add(std::string_view type, std::string_view name, const Eigen::MatrixBase<Rows>& rows) {
    const std::string element = fmt::format(
        "<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"appended\" offset=\"{}\"/>\n", type,
        name, rows.cols(), bytes_.size());
    put<vtp_order>(bytes_, static_cast<std::uint64_t>(rows.size()) * sizeof(typename Rows::Scalar));
    put_rows<vtp_order>(bytes_, rows);
    return element;
  }
  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
};

class VtpWriter : public CacheWriter {
 public:
  VtpWriter(const std::filesystem::path& folder, const CacheMesh& mesh)
      : folder_(folder), mesh_(mesh), uv_(vertex_uv(mesh.layout)) {
    const std::vector<sim::Face>& faces = mesh.layout.face;
    std::vector<std::int32_t> corners;
    ends_.resize(static_cast<Eigen::Index>(faces.size()));
    for (std::size_t f = 0; f < faces.size(); ++f) {
      corners.insert(corners.end(), faces[f].begin(), faces[f].begin() + sim::corner_count(faces[f]));
      ends_(static_cast<Eigen::Index>(f)) = static_cast<std::int32_t>(corners.size());
    }
    corners_ = Eigen::VectorXi::Map(corners.data(), static_cast<Eigen::Index>(corners.size()));
  }

  void add(const CacheFrame& frame) override {
    const std::string name = frame_file(mesh_, frame.number, "vtp");
    Arrays arrays;
    const std::string piece = points(frame, arrays) + polygons(arrays);
    const std::string text = fmt::format(
        "<?xml version=\"1.0\"?>\n"
        "<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n<PolyData>\n"
        "<FieldData>\n<DataArray type=\"Float64\" Name=\"TimeValue\" NumberOfTuples=\"1\" format=\"ascii\">{}"
        "</DataArray>\n</FieldData>\n<Piece NumberOfPoints=\"{}\" NumberOfPolys=\"{}\">\n{}</Piece>\n</PolyData>\n"
        "<AppendedData encoding=\"raw\">\n_{}\n</AppendedData>\n</VTKFile>\n",
        frame.time, frame.position.rows(), ends_.size(), piece, arrays.bytes());
    write_file_atomically(folder_ / name, text);
    collection_ += fmt::format("<DataSet timestep=\"{}\" part=\"0\" file=\"{}\"/>\n", frame.time, xml_escape(name));
  }

  void finish() override {
    write_file_atomically(folder_ / file(),
                          "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\" "
                          "byte_order=\"LittleEndian\">\n<Collection>\n" +
                              collection_ + "</Collection>\n</VTKFile>\n");
  }

  std::string file() const override { return mesh_.name + ".pvd"; }

 private:
  std::string points(const CacheFrame& frame, Arrays& arrays) const {
    std::string text = "<Points>\n" + arrays.add("Float32", "Points", frame.position) + "</Points>\n";
    text += uv_ ? "<PointData Vectors=\"velocity\" TCoords=\"uv\">\n" : "<PointData Vectors=\"velocity\">\n";
    text += arrays.add("Float32", "velocity", frame.velocity);
    text += arrays.add("Float32", "speed", frame.velocity.rowwise().norm());
    text += arrays.add("Float32", "strain", frame.strain);
    text += arrays.add("Float32", "contact", frame.contact);
    if (uv_) text += arrays.add("Float32", "uv", *uv_);
    return text + "</PointData>\n";
  }

  std::string polygons(Arrays& arrays) const {
    return "<Polys>\n" + arrays.add("Int32", "connectivity", corners_) + arrays.add("Int32", "offsets", ends_) +
           "</Polys>\n";
  }

  const std::filesystem::path folder_;
  const CacheMesh& mesh_;
  const std::optional<Eigen::MatrixX2f> uv_;
  Eigen::VectorXi corners_, ends_;  // of all faces; where each face's end
  std::string collection_;          // of the frames so far
};

}  // namespace

std::unique_ptr<CacheWriter> make_vtp_writer(const std::filesystem::path& folder, const CacheMesh& mesh) {
  return std::make_unique<VtpWriter>(folder, mesh);
}

}  // namespace billow::cli
