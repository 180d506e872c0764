// Bullet's deformable body: springs as forces, stepped explicitly.

#include <BulletCollision/BroadphaseCollision/btDbvtBroadphase.h>
#include <BulletSoftBody/btDeformableBodySolver.h>
#include <BulletSoftBody/btDeformableGravityForce.h>
#include <BulletSoftBody/btDeformableMassSpringForce.h>
#include <BulletSoftBody/btDeformableMultiBodyConstraintSolver.h>
#include <BulletSoftBody/btDeformableMultiBodyDynamicsWorld.h>
#include <BulletSoftBody/btSoftBodyRigidBodyCollisionConfiguration.h>

#include "bench/peers/bullet.h"
#include "bench/problems/stopwatch.h"

namespace palpate::bench {

std::unique_ptr<btSoftBody> bullet_nodes(const SpringBody& body, btSoftBodyWorldInfo& world) {
  btAlignedObjectArray<btVector3> x;
  btAlignedObjectArray<btScalar> mass;
  for (std::size_t i = 0; i < body.rest.size(); ++i) {
    x.push_back(bullet_vector(body.rest[i]));
    mass.push_back(body.held[i] != 0 ? btScalar(0) : static_cast<btScalar>(body.mass));
  }
  auto soft = std::make_unique<btSoftBody>(&world, x.size(), &x[0], &mass[0]);
  soft->setActivationState(DISABLE_DEACTIVATION);
  return soft;
}

Run bullet_run(const btSoftBody& soft, const SpringBody& body, double cpu_s, double wall_s) {
  Run run{true, {}, cpu_s, wall_s};
  for (std::size_t i = 0; i < body.rest.size(); ++i) {
    const btVector3& x = soft.m_nodes[static_cast<int>(i)].m_x;
    run.displacement.push_back(
        Vec3(static_cast<double>(x.x()), static_cast<double>(x.y()), static_cast<double>(x.z())) -
        body.rest[i]);
  }
  return run;
}

namespace {

class DeformableSolver final : public Solver {
 public:
  DeformableSolver() {
    method_ = {"Bullet", "springs, explicit", "single", 1, Scheme::symplectic_euler, 2000, {2, 4}, 1 << 30};
  }
  const Method& method() const override { return method_; }

  Run run(const Task& task) override {
    const SpringBody& body = task.drop->body;
    btSoftBodyRigidBodyCollisionConfiguration configuration;
    btCollisionDispatcher dispatcher(&configuration);
    btDbvtBroadphase broadphase;
    btDeformableBodySolver solver;
    btDeformableMultiBodyConstraintSolver constraints;
    constraints.setDeformableSolver(&solver);
    btDeformableMultiBodyDynamicsWorld world(&dispatcher, &broadphase, &constraints, &configuration, &solver);
    world.setImplicit(false);
    world.setGravity(bullet_vector(body.gravity));
    world.getWorldInfo().m_gravity = bullet_vector(body.gravity);
    world.getWorldInfo().m_sparsesdf.Initialize();
    const auto soft = bullet_nodes(body, world.getWorldInfo());
    for (const Spring& spring : body.springs)
      soft->appendLink(static_cast<int>(spring.i), static_cast<int>(spring.j));
    soft->m_cfg.collisions = 0;
    soft->setSelfCollision(false);
    btDeformableMassSpringForce springs(static_cast<btScalar>(body.springs.front().k), 0, false);
    btDeformableGravityForce weight(bullet_vector(body.gravity));
    world.addSoftBody(soft.get());
    world.addForce(soft.get(), &springs);
    world.addForce(soft.get(), &weight);
    const auto dt = static_cast<btScalar>(task.dt());
    const Stopwatch watch;
    for (int n = 0; n < task.steps(); ++n) world.stepSimulation(dt, 0);
    const double cpu_s = watch.cpu_s(), wall_s = watch.wall_s();
    world.removeSoftBody(soft.get());
    return bullet_run(*soft, body, cpu_s, wall_s);
  }

 private:
  Method method_;
};

}  // namespace

std::unique_ptr<Solver> bullet_deformable() { return std::make_unique<DeformableSolver>(); }

}  // namespace palpate::bench
