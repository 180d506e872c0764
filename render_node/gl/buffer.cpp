#include "render_node/gl/buffer.h"

#include <epoxy/gl.h>

namespace palpate::render {
namespace {

GLenum target_of(Buffer::Kind kind) {
  return kind == Buffer::Kind::indices ? GL_ELEMENT_ARRAY_BUFFER : GL_ARRAY_BUFFER;
}

}  // namespace

VertexArray::VertexArray() { glGenVertexArrays(1, &id_); }
VertexArray::~VertexArray() { glDeleteVertexArrays(1, &id_); }
void VertexArray::bind() const { glBindVertexArray(id_); }

Buffer::Buffer(Kind kind) : kind_(kind) { glGenBuffers(1, &id_); }
Buffer::~Buffer() { glDeleteBuffers(1, &id_); }
void Buffer::bind() const { glBindBuffer(target_of(kind_), id_); }

void Buffer::upload_bytes(const void* data, std::size_t n_bytes) {
  bind();
  glBufferData(target_of(kind_), static_cast<GLsizeiptr>(n_bytes), data, GL_DYNAMIC_DRAW);
}

void Buffer::update_bytes(std::size_t offset, const void* data, std::size_t n_bytes) {
  bind();
  glBufferSubData(target_of(kind_), static_cast<GLintptr>(offset), static_cast<GLsizeiptr>(n_bytes), data);
}

}  // namespace palpate::render
