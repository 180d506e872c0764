#pragma once
// What both soft bodies of Bullet share.

#include <BulletSoftBody/btSoftBody.h>

#include <memory>

#include "bench/peers/solver.h"

namespace palpate::bench {

inline btVector3 bullet_vector(const Vec3& v) {
  return {static_cast<btScalar>(v.x()), static_cast<btScalar>(v.y()), static_cast<btScalar>(v.z())};
}

/// Nodes without links; a held mass has infinite mass, which Bullet writes as 0.
std::unique_ptr<btSoftBody> bullet_nodes(const SpringBody& body, btSoftBodyWorldInfo& world);

/// Reads positions.
Run bullet_run(const btSoftBody& soft, const SpringBody& body, double cpu_s, double wall_s);

/// Deformable body with explicit mass-spring forces.
std::unique_ptr<Solver> bullet_deformable();

}  // namespace palpate::bench
