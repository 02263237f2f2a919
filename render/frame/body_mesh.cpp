// Vertex buffers of a body.
#include "render/frame/body_mesh.h"

#include <algorithm>
#include <stdexcept>

#include "render/frame/normals.h"

namespace billow::render {
namespace {

using RowMajorTriangles = Eigen::Matrix<GLuint, Eigen::Dynamic, 3, Eigen::RowMajor>;
using RowMajorColour = Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor>;
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
      colour_(make_buffer(gl)),
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
  if (surface.colour.rows() > 0) {
    const RowMajorColour colour = surface.colour;
    gl.BindBuffer(GL_ARRAY_BUFFER, colour_.name());
    gl.BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(colour.size() * sizeof(float)), colour.data(),
                  GL_STATIC_DRAW);
    gl.VertexAttribPointer(4, 3, GL_FLOAT, GL_FALSE, 0, nullptr);
    gl.EnableVertexAttribArray(4);
  }
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

void BodyMesh::draw() const { draw({0, static_cast<int>(surface_.triangle.rows())}); }

void BodyMesh::draw(const TriangleRange& triangles) const {
  gl_->BindVertexArray(array_.name());
  if (surface_.colour.rows() == 0) gl_->VertexAttrib3f(4, 1.0f, 1.0f, 1.0f);
  gl_->DrawElements(GL_TRIANGLES, 3 * triangles.count, GL_UNSIGNED_INT,
                    at(3 * sizeof(GLuint) * static_cast<std::size_t>(triangles.first)));
}

void BodyMesh::draw_corners(const GlObject& buffer, const GLuint* corner, std::size_t count) const {
  gl_->BindVertexArray(array_.name());
  if (surface_.colour.rows() == 0) gl_->VertexAttrib3f(4, 1.0f, 1.0f, 1.0f);
  gl_->BindBuffer(GL_ELEMENT_ARRAY_BUFFER, buffer.name());
  gl_->BufferData(GL_ELEMENT_ARRAY_BUFFER, static_cast<GLsizeiptr>(count * sizeof(GLuint)), corner, GL_STREAM_DRAW);
  gl_->DrawElements(GL_TRIANGLES, static_cast<GLsizei>(count), GL_UNSIGNED_INT, nullptr);
  gl_->BindBuffer(GL_ELEMENT_ARRAY_BUFFER, index_.name());
}

TriangleRange triangles_of(const sim::Surface& surface, int material) {
  const auto all = static_cast<int>(surface.triangle.rows());
  if (surface.material.size() == 0) return material == 0 ? TriangleRange{0, all} : TriangleRange{};
  const int* begin = surface.material.data();
  const auto [first, end] = std::equal_range(begin, begin + all, material);
  return {static_cast<int>(first - begin), static_cast<int>(end - first)};
}

}  // namespace billow::render
