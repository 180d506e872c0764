#pragma once
// A linked shader program and its uniforms. Needs a current context from construction to destruction.

#include <Eigen/Core>
#include <string>

namespace palpate::render {

class Program {
 public:
  /// Sources without the #version line. @throws std::runtime_error with the compiler's words
  Program(const std::string& vertex_source, const std::string& fragment_source);
  ~Program();
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  void use() const;
  void set(const char* uniform, const Eigen::Matrix4f& value) const;
  void set(const char* uniform, const Eigen::Vector3f& value) const;
  void set(const char* uniform, const Eigen::Vector4f& value) const;
  void set(const char* uniform, const Eigen::Vector2f& value) const;
  void set(const char* uniform, float value) const;

 private:
  int place(const char* uniform) const;
  unsigned id_ = 0;
};

}  // namespace palpate::render
