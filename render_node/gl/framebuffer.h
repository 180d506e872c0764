#pragma once
// A picture to draw into where there is no window: several samples a pixel, resolved when read.

#include "render_node/image/image.h"

namespace palpate::render {

/// Reads the framebuffer bound for reading, from its lower left corner.
Image read_pixels(int width, int height);

class Framebuffer {
 public:
  /// @param width,height [px] @param samples  a pixel; 0: no smoothing of edges
  Framebuffer(int width, int height, int samples);
  ~Framebuffer();
  Framebuffer(const Framebuffer&) = delete;
  Framebuffer& operator=(const Framebuffer&) = delete;

  void bind() const;   // what is drawn from here on goes into it
  Image read() const;  // what was drawn

 private:
  struct Attached {
    unsigned frame = 0, colour = 0, depth = 0;
  };
  Attached attach(int samples) const;
  int width_, height_;
  Attached drawn_, resolved_;
};

}  // namespace palpate::render
