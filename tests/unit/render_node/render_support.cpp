#include "tests/unit/render_node/render_support.h"

#include <algorithm>
#include <unordered_map>

#include "common/scene/body_spec.h"
#include "common/scene/device_spec.h"
#include "common/scene/render_spec.h"
#include "common/scene/scene.h"
#include "common/scene/tool_spec.h"

namespace palpate::render::test {
namespace {

struct Face {
  std::array<int, 3> towards;
  std::array<std::array<int, 3>, 4> corner;
};

constexpr std::array<Face, 6> faces = {{
    {{-1, 0, 0}, {{{0, 0, 0}, {0, 0, 1}, {0, 1, 1}, {0, 1, 0}}}},
    {{1, 0, 0}, {{{1, 0, 0}, {1, 1, 0}, {1, 1, 1}, {1, 0, 1}}}},
    {{0, -1, 0}, {{{0, 0, 0}, {1, 0, 0}, {1, 0, 1}, {0, 0, 1}}}},
    {{0, 1, 0}, {{{0, 1, 0}, {0, 1, 1}, {1, 1, 1}, {1, 1, 0}}}},
    {{0, 0, -1}, {{{0, 0, 0}, {0, 1, 0}, {1, 1, 0}, {1, 0, 0}}}},
    {{0, 0, 1}, {{{0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}}}},
}};

class Corners {
 public:
  Corners(std::array<int, 3> size, std::array<double, 3> spacing, std::array<double, 3> origin,
          VoxelSurface& surface)
      : size_(size), spacing_(spacing), origin_(origin), surface_(surface) {}

  std::uint32_t at(int i, int j, int k) {
    const std::int64_t key = (std::int64_t{k} * (size_[1] + 1) + j) * (size_[0] + 1) + i;
    const auto [place, is_new] =
        known_.try_emplace(key, static_cast<std::uint32_t>(surface_.position.size()));
    if (is_new) {
      surface_.position.push_back({static_cast<float>(origin_[0] + i * spacing_[0]),
                                   static_cast<float>(origin_[1] + j * spacing_[1]),
                                   static_cast<float>(origin_[2] + k * spacing_[2])});
    }
    return place->second;
  }

 private:
  std::array<int, 3> size_;
  std::array<double, 3> spacing_, origin_;
  VoxelSurface& surface_;
  std::unordered_map<std::int64_t, std::uint32_t> known_;
};

}  // namespace

VoxelSurface voxel_surface(std::array<int, 3> size, std::array<double, 3> spacing,
                           std::array<double, 3> origin, const std::function<bool(int, int, int)>& filled,
                           const std::function<std::uint32_t(int, int, int)>& rgba) {
  VoxelSurface surface;
  Corners corners(size, spacing, origin, surface);
  const auto inside = [&](int i, int j, int k) {
    return i >= 0 && j >= 0 && k >= 0 && i < size[0] && j < size[1] && k < size[2] && filled(i, j, k);
  };
  for (int k = 0; k < size[2]; ++k) {
    for (int j = 0; j < size[1]; ++j) {
      for (int i = 0; i < size[0]; ++i) {
        if (!inside(i, j, k)) continue;
        for (const auto& face : faces) {
          if (inside(i + face.towards[0], j + face.towards[1], k + face.towards[2])) {
            ++surface.facets_hidden;
            continue;
          }
          std::array<std::uint32_t, 4> quad{};
          for (std::size_t c = 0; c < 4; ++c) {
            quad[c] = corners.at(i + face.corner[c][0], j + face.corner[c][1], k + face.corner[c][2]);
          }
          surface.corners.push_back(quad);
          surface.rgba.push_back(rgba(i, j, k));
        }
      }
    }
  }
  surface.facets_hidden /= 2;  // each was met from both sides
  return surface;
}

VoxelSurface cube_surface(int n, double side_m, std::uint32_t rgba) {
  const double spacing = side_m / n, corner = -side_m / 2;
  return voxel_surface(
      {n, n, n}, {spacing, spacing, spacing}, {corner, corner, corner}, [](int, int, int) { return true; },
      [rgba](int, int, int) { return rgba; });
}

std::vector<BodySurface> chunks_of(const VoxelSurface& surface, std::uint32_t body, std::uint32_t revision) {
  const auto total_vertices = static_cast<std::uint32_t>(surface.position.size());
  const auto total_facets = static_cast<std::uint32_t>(surface.corners.size());
  const std::uint32_t n_chunks =
      std::max({1U, (total_vertices + max_surface_vertices - 1) / max_surface_vertices,
                (total_facets + max_surface_facets - 1) / max_surface_facets});
  std::vector<BodySurface> chunks(n_chunks);
  for (std::uint32_t c = 0; c < n_chunks; ++c) {
    BodySurface& chunk = chunks[c];
    chunk.body = body;
    chunk.revision = revision;
    chunk.chunk = c;
    chunk.n_chunks = n_chunks;
    chunk.total_vertices = total_vertices;
    chunk.total_facets = total_facets;
    chunk.facets_hidden = surface.facets_hidden;
    chunk.first_vertex = std::min(c * max_surface_vertices, total_vertices);
    chunk.n_vertices = std::min(max_surface_vertices, total_vertices - chunk.first_vertex);
    chunk.first_facet = std::min(c * max_surface_facets, total_facets);
    chunk.n_facets = std::min(max_surface_facets, total_facets - chunk.first_facet);
    std::copy_n(surface.position.begin() + chunk.first_vertex, chunk.n_vertices, chunk.position.begin());
    std::copy_n(surface.corners.begin() + chunk.first_facet, chunk.n_facets, chunk.corners.begin());
    std::copy_n(surface.rgba.begin() + chunk.first_facet, chunk.n_facets, chunk.rgba.begin());
  }
  return chunks;
}

VertexBlock block_of(const VoxelSurface& surface, std::uint32_t body, std::uint32_t revision,
                     std::uint32_t block) {
  VertexBlock message;
  message.body = body;
  message.revision = revision;
  message.block = block;
  message.first_vertex = block * max_block_vertices;
  message.n_vertices = std::min(max_block_vertices,
                                static_cast<std::uint32_t>(surface.position.size()) - message.first_vertex);
  std::copy_n(surface.position.begin() + message.first_vertex, message.n_vertices, message.position.begin());
  return message;
}

void show(Picture& picture, const VoxelSurface& surface, std::uint32_t revision) {
  for (const auto& chunk : chunks_of(surface, 0, revision)) picture.take(chunk);
}

Camera camera_of_cube(const Scene& scene, double side_m) {
  Camera camera(scene.render->camera);
  camera.set_picture(scene.render->size_px[0], scene.render->size_px[1], 0);
  camera.fit({Vec3::Constant(-side_m / 2), Vec3::Constant(side_m / 2)});
  return camera;
}

Surface surface_of(const VoxelSurface& made) {
  Surface surface;
  surface.revision = 1;
  surface.position = made.position;
  surface.corners = made.corners;
  surface.rgba = made.rgba;
  return surface;
}

int pixels_that_differ(const Image& a, const Image& b) {
  int n = 0;
  for (std::size_t i = 0; i < a.rgb.size(); i += 3)
    n += std::equal(&a.rgb[i], &a.rgb[i] + 3, &b.rgb[i]) ? 0 : 1;
  return n;
}

Scene small_scene() {
  Scene scene;
  scene.title = "A small scene";
  BodySpec body;
  body.name = "cube";
  scene.bodies = {body};
  DeviceSpec device;
  device.name = "hand";
  device.driver = "simulated";
  scene.devices = {device};
  ToolSpec tool;
  tool.name = "finger";
  tool.device = "hand";
  scene.tools = {tool};
  scene.render->size_px = {320, 240};
  scene.render->camera.yaw = 0;
  scene.render->camera.pitch = 0;
  scene.render->show_panels = false;
  return scene;
}

HapticTrace trace_at(std::array<double, 3> tip, double t, double newton) {
  HapticTrace trace;
  trace.n_samples = 1;
  trace.samples[0].t = t;
  trace.samples[0].p = tip;
  trace.samples[0].proxy = tip;
  trace.samples[0].force = {0, 0, newton};
  return trace;
}

}  // namespace palpate::render::test
