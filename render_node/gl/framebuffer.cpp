#include "render_node/gl/framebuffer.h"

#include <epoxy/gl.h>

#include <stdexcept>

namespace palpate::render {

Framebuffer::Framebuffer(int width, int height, int samples) : width_(width), height_(height) {
  drawn_ = attach(samples);
  if (samples > 0) resolved_ = attach(0);
}

Framebuffer::Attached Framebuffer::attach(int samples) const {
  Attached a;
  glGenFramebuffers(1, &a.frame);
  glGenRenderbuffers(1, &a.colour);
  glGenRenderbuffers(1, &a.depth);
  glBindFramebuffer(GL_FRAMEBUFFER, a.frame);
  glBindRenderbuffer(GL_RENDERBUFFER, a.colour);
  glRenderbufferStorageMultisample(GL_RENDERBUFFER, samples, GL_RGBA8, width_, height_);
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, a.colour);
  glBindRenderbuffer(GL_RENDERBUFFER, a.depth);
  glRenderbufferStorageMultisample(GL_RENDERBUFFER, samples, GL_DEPTH_COMPONENT24, width_, height_);
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, a.depth);
  if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
    throw std::runtime_error("the graphics driver refuses a framebuffer of this size");
  }
  return a;
}

Framebuffer::~Framebuffer() {
  for (const auto& a : {drawn_, resolved_}) {
    glDeleteFramebuffers(1, &a.frame);
    glDeleteRenderbuffers(1, &a.colour);
    glDeleteRenderbuffers(1, &a.depth);
  }
}

void Framebuffer::bind() const { glBindFramebuffer(GL_FRAMEBUFFER, drawn_.frame); }

void Framebuffer::resolve(const PixelBox& part) const {
  if (resolved_.frame == 0 || part.empty()) return;
  glBindFramebuffer(GL_READ_FRAMEBUFFER, drawn_.frame);
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, resolved_.frame);
  glBlitFramebuffer(part.x0, part.y0, part.x1, part.y1, part.x0, part.y0, part.x1, part.y1,
                    GL_COLOR_BUFFER_BIT, GL_NEAREST);
}

void Framebuffer::copy_to(unsigned frame) const {
  glBindFramebuffer(GL_READ_FRAMEBUFFER, resolved_.frame != 0 ? resolved_.frame : drawn_.frame);
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, frame);
  glBlitFramebuffer(0, 0, width_, height_, 0, 0, width_, height_, GL_COLOR_BUFFER_BIT, GL_NEAREST);
}

void Framebuffer::read(Image& image) {
  glBindFramebuffer(GL_READ_FRAMEBUFFER, resolved_.frame != 0 ? resolved_.frame : drawn_.frame);
  reader_.read(width_, height_, image);
}

void PixelReader::read(int width, int height, Image& image) {
  const auto w = static_cast<std::size_t>(width), h = static_cast<std::size_t>(height);
  image.width = width;
  image.height = height;
  image.rgb.resize(3 * w * h);
  // Why all four channels: as it lies there it is copied; Mesa makes three of them pixel by pixel.
  rgba_.resize(4 * w * h);
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, rgba_.data());
  for (std::size_t y = 0; y < h; ++y) {  // OpenGL puts the bottom row first
    const std::uint8_t* from = rgba_.data() + 4 * w * (h - 1 - y);
    std::uint8_t* to = image.rgb.data() + 3 * w * y;
    for (std::size_t x = 0; x < w; ++x)
      for (std::size_t c = 0; c < 3; ++c) to[3 * x + c] = from[4 * x + c];
  }
}

}  // namespace palpate::render
