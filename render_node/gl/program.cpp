#include "render_node/gl/program.h"

#include <epoxy/gl.h>

#include <array>
#include <stdexcept>

namespace palpate::render {
namespace {

GLuint compile(GLenum kind, const std::string& source) {
  const std::array<const char*, 2> parts = {"#version 330 core\n", source.c_str()};
  const GLuint shader = glCreateShader(kind);
  glShaderSource(shader, 2, parts.data(), nullptr);
  glCompileShader(shader);
  GLint ok = GL_FALSE;
  glGetShaderiv(shader, GL_COMPILE_STATUS, &ok);
  if (ok == GL_TRUE) return shader;
  std::array<char, 1024> words{};
  glGetShaderInfoLog(shader, static_cast<GLsizei>(words.size()), nullptr, words.data());
  throw std::runtime_error(std::string("the graphics driver refuses a shader: ") + words.data());
}

}  // namespace

Program::Program(const std::string& vertex_source, const std::string& fragment_source)
    : id_(glCreateProgram()) {
  const GLuint vertex = compile(GL_VERTEX_SHADER, vertex_source);
  const GLuint fragment = compile(GL_FRAGMENT_SHADER, fragment_source);
  glAttachShader(id_, vertex);
  glAttachShader(id_, fragment);
  glLinkProgram(id_);
  glDeleteShader(vertex);
  glDeleteShader(fragment);
  GLint ok = GL_FALSE;
  glGetProgramiv(id_, GL_LINK_STATUS, &ok);
  if (ok != GL_TRUE) throw std::runtime_error("the graphics driver cannot link a shader program");
}

Program::~Program() { glDeleteProgram(id_); }

void Program::use() const { glUseProgram(id_); }
int Program::place(const char* uniform) const { return glGetUniformLocation(id_, uniform); }
void Program::set(const char* uniform, const Eigen::Matrix4f& value) const {
  glUniformMatrix4fv(place(uniform), 1, GL_FALSE, value.data());
}
void Program::set(const char* uniform, const Eigen::Vector3f& value) const {
  glUniform3fv(place(uniform), 1, value.data());
}
void Program::set(const char* uniform, const Eigen::Vector4f& value) const {
  glUniform4fv(place(uniform), 1, value.data());
}
void Program::set(const char* uniform, const Eigen::Vector2f& value) const {
  glUniform2fv(place(uniform), 1, value.data());
}
void Program::set(const char* uniform, float value) const { glUniform1f(place(uniform), value); }

}  // namespace palpate::render
