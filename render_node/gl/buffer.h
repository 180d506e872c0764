#pragma once
// Vertex arrays and buffers that delete themselves. Need a current context from construction to destruction.

#include <cstddef>
#include <span>

namespace palpate::render {

class VertexArray {
 public:
  VertexArray();
  ~VertexArray();
  VertexArray(const VertexArray&) = delete;
  VertexArray& operator=(const VertexArray&) = delete;
  void bind() const;

 private:
  unsigned id_ = 0;
};

class Buffer {
 public:
  enum class Kind { vertices, indices };
  explicit Buffer(Kind kind);
  ~Buffer();
  Buffer(const Buffer&) = delete;
  Buffer& operator=(const Buffer&) = delete;

  /// Index buffers are remembered by the vertex array bound at that time.
  void bind() const;
  /// Replaces all of it.
  template <class T>
  void upload(std::span<const T> data) {
    upload_bytes(data.data(), data.size_bytes());
  }
  /// Overwrites elements first .. first + data.size() of what upload() put there.
  template <class T>
  void update(std::size_t first, std::span<const T> data) {
    update_bytes(first * sizeof(T), data.data(), data.size_bytes());
  }

 private:
  void upload_bytes(const void* data, std::size_t n_bytes);
  void update_bytes(std::size_t offset, const void* data, std::size_t n_bytes);
  Kind kind_;
  unsigned id_ = 0;
};

}  // namespace palpate::render
