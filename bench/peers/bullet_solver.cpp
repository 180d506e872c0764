// Bullet's soft body as it is meant to be used: links solved by position, one or more sweeps a step.

#include <BulletSoftBody/btSoftBody.h>
#include <BulletSoftBody/btSoftBodyHelpers.h>

#include <map>

#include "bench/peers/bullet.h"
#include "bench/problems/stopwatch.h"

namespace palpate::bench {
namespace {

/// A sweep moves the end i of a link of stretch s by  kLST s w_i / (w_i + w_j),  w = 1 / m. Symplectic Euler moves it by
/// dt^2 k s w_i. So kLST = dt^2 k (w_i + w_j) / sweeps, at most 1, makes links of springs as far as that can be.
/// Bullet's s is  l (l^2 - L^2) / (l^2 + L^2), which is the stretch to first order only: the law itself is another.
void append_links(btSoftBody& soft, const SpringBody& body, double dt, int sweeps) {
  std::map<double, btSoftBody::Material*> materials;
  for (const Spring& spring : body.springs) {
    const int ends = 2 - body.held[spring.i] - body.held[spring.j];
    const double k_lst = std::min(1.0, dt * dt * spring.k * ends / body.mass / sweeps);
    btSoftBody::Material*& material = materials[k_lst];
    if (material == nullptr) {
      material = soft.appendMaterial();
      material->m_kLST = static_cast<btScalar>(k_lst);
    }
    soft.appendLink(static_cast<int>(spring.i), static_cast<int>(spring.j), material);
  }
}

class BulletSolver final : public Solver {
 public:
  explicit BulletSolver(int sweeps) : sweeps_(sweeps) {
    method_ = {"Bullet",
               sweeps == 1 ? "links, 1 sweep" : "links, " + std::to_string(sweeps) + " sweeps",
               "single",
               1,
               Scheme::symplectic_euler,
               sweeps == 1 ? 290.0 : 620.0,
               {1, 2, 4, 8},
               1 << 30};
  }
  const Method& method() const override { return method_; }

  Run run(const Task& task) override {
    const SpringBody& body = task.drop->body;
    btSoftBodyWorldInfo world;
    world.m_gravity = bullet_vector(body.gravity);
    world.air_density = 0;
    world.water_density = 0;
    world.m_sparsesdf.Initialize();
    const auto soft = bullet_nodes(body, world);
    append_links(*soft, body, task.dt(), sweeps_);
    soft->m_cfg.piterations = sweeps_;
    soft->m_cfg.collisions = 0;
    soft->m_cfg.m_psequence.resize(0);
    soft->m_cfg.m_psequence.push_back(btSoftBody::ePSolver::Linear);
    const auto dt = static_cast<btScalar>(task.dt());
    const Stopwatch watch;
    for (int n = 0; n < task.steps(); ++n) {
      soft->predictMotion(dt);
      soft->solveConstraints();
      soft->integrateMotion();
    }
    const double cpu_s = watch.cpu_s(), wall_s = watch.wall_s();
    return bullet_run(*soft, body, cpu_s, wall_s);
  }

 private:
  int sweeps_;
  Method method_;
};

}  // namespace

Peer bullet_peer() {
  Peer peer{"Bullet",
            std::to_string(btGetVersion() / 100) + "." + std::to_string(btGetVersion() % 100),
            "libbullet-dev",
            "Links are solved by position, sweep after sweep; their law is ours to first order in the "
            "stretch only, and velocities are differences of rounded positions, so that ever smaller "
            "steps do not help. Bullet keeps a tree of boxes for collisions that it cannot be told to "
            "leave out. Its explicit springs are our law, in a solver made for implicit steps and "
            "contact.",
            {}};
  peer.solvers.push_back(std::make_unique<BulletSolver>(1));
  peer.solvers.push_back(std::make_unique<BulletSolver>(4));
  peer.solvers.push_back(bullet_deformable());
  return peer;
}

}  // namespace palpate::bench
