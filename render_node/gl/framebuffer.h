#pragma once
// A picture to draw into beside the window, or where there is none: several samples a pixel, resolved when asked for.

#include <cstdint>
#include <vector>

#include "render_node/image/image.h"
#include "render_node/view/pixel_box.h"

namespace palpate::render {

/// Why an object: what it reads into is kept. Two megabytes taken and given back for each picture are five milliseconds of
/// page faults.
class PixelReader {
 public:
  /// Reads the framebuffer bound for reading, from its lower left corner.
  void read(int width, int height, Image& image);

 private:
  std::vector<std::uint8_t> rgba_;
};

class Framebuffer {
 public:
  /// @param width,height [px] @param samples  a pixel; 0: no smoothing of edges
  Framebuffer(int width, int height, int samples);
  ~Framebuffer();
  Framebuffer(const Framebuffer&) = delete;
  Framebuffer& operator=(const Framebuffer&) = delete;

  int width() const noexcept { return width_; }
  int height() const noexcept { return height_; }

  void bind() const;  // what is drawn from here on goes into it
  /// After drawing into this part of it: copy_to() and read() see that, and elsewhere what they saw before.
  void resolve(const PixelBox& part) const;
  /// Its colours, as resolved. @param frame  the name of a framebuffer as large, with one sample a pixel
  void copy_to(unsigned frame) const;
  void read(Image& image);  // what was resolved

 private:
  struct Attached {
    unsigned frame = 0, colour = 0, depth = 0;
  };
  Attached attach(int samples) const;
  int width_, height_;
  Attached drawn_, resolved_;
  PixelReader reader_;
};

}  // namespace palpate::render
