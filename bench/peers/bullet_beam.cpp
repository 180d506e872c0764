// Bullet's deformable body of tetrahedra with btDeformableNeoHookeanForce, stepped explicitly.

#include <BulletCollision/BroadphaseCollision/btDbvtBroadphase.h>
#include <BulletSoftBody/btDeformableBodySolver.h>
#include <BulletSoftBody/btDeformableGravityForce.h>
#include <BulletSoftBody/btDeformableMultiBodyConstraintSolver.h>
#include <BulletSoftBody/btDeformableMultiBodyDynamicsWorld.h>
#include <BulletSoftBody/btDeformableNeoHookeanForce.h>
#include <BulletSoftBody/btSoftBodyRigidBodyCollisionConfiguration.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <vector>

#include "bench/peers/beam_peers.h"
#include "bench/peers/bullet.h"
#include "bench/problems/hex_beam.h"
#include "bench/problems/stopwatch.h"
#include "physics_node/material/lame.h"

namespace palpate::bench {
namespace {

/// Nodes by x, y, z; Kuhn's six tetrahedra a cell, each along a way of three edges from its lowest to its highest corner.
struct Mesh {
  explicit Mesh(int n) : side(n + 1), length(8 * n + 1) {
    const double edge = HexBeam::height / n;
    x.resize(static_cast<std::size_t>(length * side * side));
    mass.assign(x.size(), 0);
    for (int k = 0; k < side; ++k)
      for (int j = 0; j < side; ++j)
        for (int i = 0; i < length; ++i) x[at(i, j, k)] = edge * Vec3(i, j, k);
    constexpr std::array<std::array<int, 3>, 6> ways{
        {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}}};
    for (int k = 0; k + 1 < side; ++k)
      for (int j = 0; j + 1 < side; ++j)
        for (int i = 0; i + 1 < length; ++i) {
          for (int a = 0; a < 8; ++a)
            mass[at(i + (a & 1), j + (a >> 1 & 1), k + (a >> 2))] += HexBeam::density * std::pow(edge, 3) / 8;
          for (std::size_t w = 0; w < 6; ++w) {
            std::array<int, 3> p{i, j, k};
            std::array<int, 4> tet{static_cast<int>(at(i, j, k))};
            for (std::size_t s = 0; s < 3; ++s) {
              ++p[static_cast<std::size_t>(ways[w][s])];
              tet[s + 1] = static_cast<int>(at(p[0], p[1], p[2]));
            }
            if (w >= 3) std::swap(tet[1], tet[2]);  // odd ways turn the other way round
            tets.push_back(tet);
          }
        }
  }
  std::size_t at(int i, int j, int k) const { return static_cast<std::size_t>(i + length * (j + side * k)); }

  int side, length;  // nodes
  std::vector<Vec3> x;
  std::vector<double> mass;
  std::vector<std::array<int, 4>> tets;
};

class BulletBeam final : public BeamStepper {
 public:
  BulletBeam(const Mesh& mesh, double dt, double poisson_ratio)
      : mesh_(mesh),
        dt_(static_cast<btScalar>(dt)),
        weight_(btVector3(0, 0, static_cast<btScalar>(-RestingBeam::gravity))) {
    constraints_.setDeformableSolver(&solver_);
    world_ = std::make_unique<btDeformableMultiBodyDynamicsWorld>(&dispatcher_, &broadphase_, &constraints_,
                                                                  &configuration_, &solver_);
    world_->setImplicit(false);
    world_->setGravity(weight_.m_gravity);
    world_->getWorldInfo().m_gravity = weight_.m_gravity;
    world_->getWorldInfo().m_sparsesdf.Initialize();
    btAlignedObjectArray<btVector3> x;
    btAlignedObjectArray<btScalar> mass;
    for (std::size_t i = 0; i < mesh.x.size(); ++i) {
      x.push_back(bullet_vector(mesh.x[i]));
      mass.push_back(mesh.x[i].x() == 0 ? btScalar(0) : static_cast<btScalar>(mesh.mass[i]));  // 0: held
    }
    soft_ = std::make_unique<btSoftBody>(&world_->getWorldInfo(), x.size(), &x[0], &mass[0]);
    soft_->setActivationState(DISABLE_DEACTIVATION);
    for (const auto& tet : mesh.tets) soft_->appendTetra(tet[0], tet[1], tet[2], tet[3]);
    soft_->initializeDmInverse();
    soft_->m_tetraScratches.resize(soft_->m_tetras.size());
    soft_->m_tetraScratchesTn.resize(soft_->m_tetras.size());
    soft_->m_cfg.collisions = 0;
    soft_->setSelfCollision(false);
    // Its law has a logarithm, with which linear elasticity comes out of 4/3 mu and lambda + 5/6 mu (Smith and others 2018).
    const physics::Lame lame = physics::lame_of(HexBeam::modulus, poisson_ratio);
    law_ = std::make_unique<btDeformableNeoHookeanForce>(
        static_cast<btScalar>(4 * lame.mu / 3), static_cast<btScalar>(lame.lambda + 5 * lame.mu / 6), 0);
    world_->addSoftBody(soft_.get());
    world_->addForce(soft_.get(), law_.get());
    world_->addForce(soft_.get(), &weight_);
  }
  ~BulletBeam() override { world_->removeSoftBody(soft_.get()); }
  BulletBeam(const BulletBeam&) = delete;
  BulletBeam& operator=(const BulletBeam&) = delete;

  void step() override { world_->stepSimulation(dt_, 0); }
  double kinetic() const override {
    double sum = 0;
    for (std::size_t i = 0; i < mesh_.x.size(); ++i)
      sum += 0.5 * mesh_.mass[i] * static_cast<double>(soft_->m_nodes[static_cast<int>(i)].m_v.length2());
    return sum;
  }
  void stop() override {
    for (int i = 0; i < soft_->m_nodes.size(); ++i)
      soft_->m_nodes[i].m_v = soft_->m_nodes[i].m_vn = btVector3(0, 0, 0);
  }
  double sunk() const {
    double sum = 0;
    for (int k = 0; k < mesh_.side; ++k)
      for (int j = 0; j < mesh_.side; ++j) {
        const std::size_t n = mesh_.at(mesh_.length - 1, j, k);
        sum += mesh_.x[n].z() - static_cast<double>(soft_->m_nodes[static_cast<int>(n)].m_x.z());
      }
    return sum / (mesh_.side * mesh_.side);
  }

 private:
  const Mesh& mesh_;
  btScalar dt_;
  btSoftBodyRigidBodyCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_{&configuration_};
  btDbvtBroadphase broadphase_;
  btDeformableBodySolver solver_;
  btDeformableMultiBodyConstraintSolver constraints_;
  btDeformableGravityForce weight_;
  std::unique_ptr<btDeformableMultiBodyDynamicsWorld> world_;
  std::unique_ptr<btSoftBody> soft_;
  std::unique_ptr<btDeformableNeoHookeanForce> law_;
};

}  // namespace

std::optional<RestingBeam> bullet_beam(int cells, double poisson_ratio) {
  const Mesh mesh(cells);
  const physics::Lame lame = physics::lame_of(HexBeam::modulus, poisson_ratio);
  // Six tetrahedra a cell stay stable up to 0.69 of h / c_p; the same share of it as palpate's.
  const double wave = std::sqrt(physics::p_wave_modulus(lame) / HexBeam::density);
  BulletBeam beam(mesh, beam_step_share * 0.69 * HexBeam::height / cells / wave, poisson_ratio);
  RestingBeam result{.cells = cells};
  const Stopwatch watch;
  result.at_rest = settle(beam, 1e-5, result.steps);  // its places are rounded more
  result.cpu_s = watch.cpu_s();
  result.elements = static_cast<std::int64_t>(mesh.tets.size());
  result.sunk = beam.sunk() / RestingBeam::gravity;
  return result;
}

}  // namespace palpate::bench
