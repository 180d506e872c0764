// palpate bench skin: how good the skin of an image is, smooth and of bricks, and what it costs.

#include <fmt/format.h>

#include <memory>

#include "bench/machine/result_folder.h"
#include "bench/problems/stopwatch.h"
#include "bench/skin/skin_quality.h"
#include "bench/subcommands.h"
#include "common/error/error.h"
#include "common/scene/body_spec.h"
#include "common/scene/material_spec.h"
#include "physics_node/body/body.h"
#include "physics_node/boundary/surface.h"

namespace palpate::bench {
namespace {

struct Options {
  std::string volume, out = "out/bench_skin";
  std::vector<double> keep;
  std::vector<int> partition;
};

/// All of it drawn, and as little as can be of it moving: its skin is the same.
BodySpec body_of(const Options& options, SkinKind skin) {
  BodySpec spec;
  spec.name = "image";
  spec.lattice = LatticeKind::voxel;
  spec.material = "tissue";
  spec.border.skin = skin;
  VolumeShape shape;
  shape.file = options.volume;
  shape.keep_min = options.keep[0];
  shape.keep_max = options.keep[1];
  if (!options.partition.empty())
    shape.partition = {options.partition[0], options.partition[1], options.partition[2]};
  shape.largest_component = true;
  shape.deformable.all = false;
  shape.deformable.gravity_center = true;
  shape.deformable.nearest = 8;
  spec.shape = shape;
  return spec;
}

int run_skin(const Options& options) {
  if (options.keep.size() != 2 || !(options.keep[0] < options.keep[1]))
    throw InputError("--keep takes two intensities, the lower first");
  const ResultFolder folder(options.out, "skin");
  MaterialSpec tissue;
  tissue.name = "tissue";
  tissue.density = 1000;
  tissue.modulus = 5e3;
  Table table{
      {"skin", "vertices", "triangles", "from_border_mean_cells", "p99_cells", "most_cells",
       "normal_mean_deg", "open_edges", "edges_of_four", "bad_vertices", "self_intersections", "made_cpu_s"},
      {}};
  nlohmann::json json;
  for (const SkinKind skin : {SkinKind::smooth, SkinKind::bricks}) {
    const std::string name = skin == SkinKind::smooth ? "smooth" : "bricks";
    const physics::Body body = physics::build_body(body_of(options, skin), tissue);
    physics::LiveElements all(body);
    all.copy(body, body.adjacency());
    const Stopwatch watch;
    const physics::Surface surface = make_surface(body, all, std::nullopt, 0);
    const double made = watch.cpu_s();
    const SkinQuality q = skin_quality(surface, *body.cells, options.keep[0], options.keep[1]);
    fmt::print(
        "{}: {} vertices, {} triangles, made in {:.2f} s of CPU\n"
        "  from the border of the tissue: mean {:.4f}, 99 % {:.3f}, at most {:.3f} cells; normals off by "
        "{:.1f} "
        "degrees in the mean\n"
        "  {} open edges, {} edges of four facets, {} vertices that are no fan, {} triangles through "
        "others\n",
        name, q.vertices, q.triangles, made, q.mean, q.p99, q.most, q.normal_mean, q.open_edges,
        q.edges_of_four, q.bad_vertices, q.intersections);
    table.add({name, std::to_string(q.vertices), std::to_string(q.triangles), text_of(q.mean), text_of(q.p99),
               text_of(q.most), text_of(q.normal_mean), std::to_string(q.open_edges),
               std::to_string(q.edges_of_four), std::to_string(q.bad_vertices),
               std::to_string(q.intersections), text_of(made)});
    json[name] = {{"vertices", q.vertices},
                  {"triangles", q.triangles},
                  {"from_border_cells", {{"mean", q.mean}, {"p99", q.p99}, {"most", q.most}}},
                  {"normal_mean_deg", q.normal_mean},
                  {"open_edges", q.open_edges},
                  {"edges_of_four", q.edges_of_four},
                  {"bad_vertices", q.bad_vertices},
                  {"self_intersections", q.intersections},
                  {"made_cpu_s", made}};
  }
  folder.write_csv(table);
  folder.write_json(json);
  fmt::print("results: {}\n", options.out);
  return exit_ok;
}

}  // namespace

void add_skin(CLI::App& app, int& exit_code) {
  auto* command =
      app.add_subcommand("skin", "how far the skin of a volume is from its tissue, smooth and of bricks");
  auto options = std::make_shared<Options>();
  command->add_option("volume", options->volume, "a volume file, from palpate import")->required();
  command->add_option("--keep", options->keep, "lowest and highest intensity that is tissue")
      ->required()
      ->delimiter(',')
      ->expected(2);
  command->add_option("--partition", options->partition, "resampled to so many cells along x, y and z")
      ->expected(3);
  command->add_option("--out", options->out, "folder of the results")->capture_default_str();
  command->callback([options, &exit_code] { exit_code = run_skin(*options); });
}

}  // namespace palpate::bench
