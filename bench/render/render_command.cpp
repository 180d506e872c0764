// palpate bench render: what a picture of a scene costs, by the processor's time: its messages, its drawing, its file.

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <functional>
#include <memory>

#include "bench/machine/result_folder.h"
#include "bench/problems/median.h"
#include "bench/problems/stopwatch.h"
#include "bench/render/message_tape.h"
#include "bench/subcommands.h"
#include "common/error/error.h"
#include "common/scene/load_scene.h"
#include "common/scene/render_spec.h"
#include "deploy/palpate/virtual_session.h"
#include "render_node/image/packed_rows.h"

namespace palpate::bench {
namespace {

struct Options {
  std::string scene, out = "out/bench_render";
  std::vector<std::string> settings;
  int pictures = 120;
};

struct Costs {
  std::vector<double> messages, drawing, file;  // CPU time of each picture [ms]
  std::vector<double> drawn;                    // share of the pixels of each
};

double ms_of(const std::function<void()>& work) {
  const Stopwatch watch;
  work();
  return 1e3 * watch.cpu_s();
}

enum class What { moving, whole, standing };

/// The first picture, for which all is uploaded and shaders are compiled, does not count.
Costs costs_of(const MessageTape& tape, const Scene& scene, render::Edges edges, What what) {
  render::Picture picture(scene, edges);
  tape.play(0, picture);
  picture.draw(tape.t(0));
  Costs costs;
  render::RowPacker packer;
  for (int n = 1; n < tape.pictures(); ++n) {
    if (what != What::standing) costs.messages.push_back(ms_of([&] { tape.play(n, picture); }));
    if (what == What::whole) picture.draw_whole();
    costs.drawing.push_back(ms_of([&] { picture.draw(what == What::standing ? tape.t(0) : tape.t(n)); }));
    costs.drawn.push_back(picture.drawn_share());
    costs.file.push_back(ms_of([&] { packer.pack(picture.image()); }));
  }
  return costs;
}

int run_render(const Options& options) {
  const ResultFolder folder(options.out, "render");
  const Scene scene = load_scene(options.scene, options.settings);
  MessageTape tape(scene, options.pictures);
  deploy::VirtualSession session(scene, {"", false, &tape});
  const double seconds = std::min(scene.natural_seconds(), options.pictures / scene.render->rate_Hz);
  session.run(seconds, [](double) {});
  if (tape.pictures() < 2)
    throw InputError("the scene is over before its second picture; raise render.rate_Hz");
  // Why one: so does a node that shares two cores with hand and tissue.
  setenv("LP_NUM_THREADS", "1", 1);
  const auto& size = scene.render->size_px;
  fmt::print("{} pictures of {} x {} pixels, {:.2f} to {:.2f} s; CPU time of one in the median, ms\n",
             tape.pictures(), size[0], size[1], tape.t(0), tape.t(tape.pictures() - 1));
  Table table{{"samples", "what", "messages_cpu_ms", "drawing_cpu_ms", "drawn_share", "file_cpu_ms"}, {}};
  nlohmann::json json;
  for (const auto& [edges, samples] : {std::pair{render::Edges::plain, "1"}, {render::Edges::smooth, "4"}})
    for (const auto& [what, name] :
         {std::pair{What::whole, "whole"}, {What::moving, "moving"}, {What::standing, "standing"}}) {
      const Costs costs = costs_of(tape, scene, edges, what);
      const double messages = median(costs.messages), drawing = median(costs.drawing);
      const double file = median(costs.file), drawn = median(costs.drawn);
      fmt::print(
          "{} sample(s), {:8}: messages {:6.2f}, drawing {:6.2f} of {:5.1f} % of the pixels, file {:6.2f}\n",
          samples, name, messages, drawing, 100 * drawn, file);
      table.add({samples, name, text_of(messages), text_of(drawing), text_of(drawn), text_of(file)});
      json[samples][name] = {{"messages_cpu_ms", messages},
                             {"drawing_cpu_ms", drawing},
                             {"drawn_share", drawn},
                             {"file_cpu_ms", file}};
    }
  folder.write_csv(table);
  folder.write_json(json);
  fmt::print("results: {}\n", options.out);
  return exit_ok;
}

}  // namespace

void add_render(CLI::App& app, int& exit_code) {
  auto* command = app.add_subcommand("render", "what a picture of a scene costs");
  auto options = std::make_shared<Options>();
  command->add_option("scene", options->scene, "a scene; its first pictures are drawn")->required();
  command->add_option("--set", options->settings, "TABLE.KEY=VALUE instead of the scene's");
  command->add_option("--pictures", options->pictures, "so many at most")
      ->check(CLI::Range(2, 2000))
      ->capture_default_str();
  command->add_option("--out", options->out, "folder of the results")->capture_default_str();
  command->callback([options, &exit_code] { exit_code = run_render(*options); });
}

}  // namespace palpate::bench
