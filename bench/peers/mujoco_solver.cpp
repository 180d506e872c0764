// MuJoCo: a mass is a body on three sliders, a spring is a tendon between two sites.

#include <fmt/format.h>
#include <mujoco/mujoco.h>

#include <array>
#include <fstream>
#include <stdexcept>

#include "bench/peers/solver.h"
#include "bench/problems/stopwatch.h"
#include "common/file/scratch_folder.h"

namespace palpate::bench {
namespace {

std::string model_of(const SpringBody& body, double dt) {
  const Vec3& g = body.gravity;
  std::string xml = fmt::format(
      "<mujoco><option timestep=\"{:.17g}\" gravity=\"{:.17g} {:.17g} {:.17g}\" integrator=\"Euler\">"
      "<flag contact=\"disable\" constraint=\"disable\"/></option><worldbody>\n",
      dt, g.x(), g.y(), g.z());
  for (std::size_t i = 0; i < body.rest.size(); ++i) {
    const Vec3& x = body.rest[i];
    const std::string place = fmt::format("pos=\"{:.17g} {:.17g} {:.17g}\"", x.x(), x.y(), x.z());
    if (body.held[i] != 0) {
      xml += fmt::format("<site name=\"s{}\" {}/>\n", i, place);
      continue;
    }
    xml += fmt::format("<body {}>", place);
    for (const char* axis : {"1 0 0", "0 1 0", "0 0 1"})
      xml += fmt::format("<joint type=\"slide\" axis=\"{}\"/>", axis);
    xml += fmt::format(
        "<inertial pos=\"0 0 0\" mass=\"{:.17g}\" diaginertia=\"1e-8 1e-8 1e-8\"/><site "
        "name=\"s{}\"/></body>\n",
        body.mass, i);
  }
  xml += "</worldbody><tendon>\n";
  for (const Spring& spring : body.springs)
    xml += fmt::format(
        "<spatial stiffness=\"{:.17g}\" springlength=\"{:.17g}\"><site site=\"s{}\"/><site "
        "site=\"s{}\"/></spatial>\n",
        spring.k, spring.length, spring.i, spring.j);
  return xml + "</tendon></mujoco>\n";
}

struct Free {
  void operator()(mjModel* model) const { mj_deleteModel(model); }
  void operator()(mjData* data) const { mj_deleteData(data); }
};

class MujocoSolver final : public Solver {
 public:
  MujocoSolver() {
    method_ = {"MuJoCo", "sliders and tendons", "double", 1, Scheme::symplectic_euler, 1e5, {}, 1500};
  }
  const Method& method() const override { return method_; }

  Run run(const Task& task) override {
    const SpringBody& body = task.drop->body;
    const std::unique_ptr<mjModel, Free> model = load(body, task.dt());
    const std::unique_ptr<mjData, Free> data(mj_makeData(model.get()));
    if (!data) throw std::runtime_error("MuJoCo: no memory for its state");
    const Stopwatch watch;
    for (int n = 0; n < task.steps(); ++n) mj_step(model.get(), data.get());
    Run run{true, {}, watch.cpu_s(), watch.wall_s()};
    int q = 0;
    for (std::size_t i = 0; i < body.rest.size(); ++i) {
      run.displacement.push_back(Vec3::Zero());
      if (body.held[i] != 0) continue;
      for (Eigen::Index a = 0; a < 3; ++a) run.displacement.back()[a] = data->qpos[q++];
    }
    return run;
  }

 private:
  static std::unique_ptr<mjModel, Free> load(const SpringBody& body, double dt) {
    const ScratchFolder scratch;
    const auto file = scratch.path() / "body.xml";
    std::ofstream(file) << model_of(body, dt);
    std::array<char, 1000> complaint{};
    std::unique_ptr<mjModel, Free> model(
        mj_loadXML(file.c_str(), nullptr, complaint.data(), static_cast<int>(complaint.size())));
    if (!model) throw std::runtime_error(fmt::format("MuJoCo: {}", complaint.data()));
    return model;
  }
  Method method_;
};

}  // namespace

Peer mujoco_peer() {
  Peer peer{"MuJoCo",
            mj_versionString(),
            "libmujoco-dev",
            "A general mechanism solver: three joints a mass and a tendon with a dense row of derivatives a "
            "spring, "
            "so that its cost per mass grows with the body; time of a step of a small cube only.",
            {}};
  peer.solvers.push_back(std::make_unique<MujocoSolver>());
  return peer;
}

}  // namespace palpate::bench
