// Vertex buffers of a body.
#include "render/frame/body_mesh.h"

#include <algorithm>
#include <stdexcept>

#include "render/frame/normals.h"

namespace billow::render {
namespace {

using RowMajorTriangles = Eigen::Matrix<GLuint, Eigen::Dynamic, 3, Eigen::RowMajor>;
using RowMajorUv = Eigen::Matrix<float, Eigen::Dynamic, 2, Eigen::RowMajor>;

void copy_row(const Eigen::MatrixX3f& rows, int row, float* out) {
  for (int axis = 0; axis < 3; ++axis) out[axis] = rows(row, axis);
}

const void* at(std::size_t offset) { return reinterpret_cast<const void*>(offset); }

}  // namespace

BodyMesh::BodyMesh(const Gl& gl, const sim::Surface& surface)
    : gl_(&gl),
      surface_(surface),
      corner_(static_cast<std::size_t>(surface.point.size())),
      array_(make_vertex_array(gl)),
      moving_(make_buffer(gl)),
      fixed_(make_buffer(gl)),
      index_(make_buffer(gl)) {
  gl.BindVertexArray(array_.name());
  gl.BindBuffer(GL_ARRAY_BUFFER, moving_.name());
  gl.BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(corner_.size() * sizeof(Corner)), nullptr, GL_STREAM_DRAW);
  describe_moving();
  const RowMajorUv uv = surface.uv;
  gl.BindBuffer(GL_ARRAY_BUFFER, fixed_.name());
  gl.BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(uv.size() * sizeof(float)), uv.data(), GL_STATIC_DRAW);
  gl.VertexAttribPointer(3, 2, GL_FLOAT, GL_FALSE, 0, nullptr);
  gl.EnableVertexAttribArray(3);
  const RowMajorTriangles triangle = surface.triangle.cast<GLuint>();
  gl.BindBuffer(GL_ELEMENT_ARRAY_BUFFER, index_.name());
  gl.BufferData(GL_ELEMENT_ARRAY_BUFFER, static_cast<GLsizeiptr>(triangle.size() * sizeof(GLuint)), triangle.data(),
                GL_STATIC_DRAW);
}

void BodyMesh::describe_moving() const {
  const std::size_t offsets[] = {offsetof(Corner, position), offsetof(Corner, normal), offsetof(Corner, velocity)};
  for (GLuint attribute = 0; attribute < 3; ++attribute) {
    gl_->VertexAttribPointer(attribute, 3, GL_FLOAT, GL_FALSE, sizeof(Corner), at(offsets[attribute]));
    gl_->EnableVertexAttribArray(attribute);
  }
}

void BodyMesh::update(const sim::SurfaceState& state) {
  if (state.position.rows() < surface_.points() || state.velocity.rows() != state.position.rows() ||
      (state.strain.size() != 0 && state.strain.rows() != state.position.rows()))
    throw std::invalid_argument("a body's state has fewer points than its surface");
  const Eigen::MatrixX3f normal = point_normals(surface_, state.position);
  for (std::size_t c = 0; c < corner_.size(); ++c) {
    const int point = surface_.point(static_cast<Eigen::Index>(c));
    copy_row(state.position, point, corner_[c].position);
    copy_row(normal, point, corner_[c].normal);
    copy_row(state.velocity, point, corner_[c].velocity);
    corner_[c].strain = state.strain.size() == 0 ? 0.0f : state.strain(point);
  }
  gl_->BindBuffer(GL_ARRAY_BUFFER, moving_.name());
  gl_->BufferSubData(GL_ARRAY_BUFFER, 0, static_cast<GLsizeiptr>(corner_.size() * sizeof(Corner)), corner_.data());
}

void BodyMesh::draw() const {
  gl_->BindVertexArray(array_.name());
  gl_->DrawElements(GL_TRIANGLES, static_cast<GLsizei>(surface_.triangle.size()), GL_UNSIGNED_INT, nullptr);
}

}  // namespace billow::render
