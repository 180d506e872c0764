#include "physics_node/collision/common_motion.h"

#include <algorithm>

#include "physics_node/collision/usual_motion.h"

namespace palpate::physics {
namespace {

constexpr double clearly_slower = 0.25;
constexpr double most_of_them = 0.75;

}  // namespace

Vec3 usual_velocity(const std::vector<ContactBody>& bodies, double least) noexcept {
  std::size_t all = 0;
  for (const auto& body : bodies) all += body.candidates().size();
  const Vec3 usual = usual_motion(all, [&](std::size_t n) {
    std::size_t b = 0;
    while (n >= bodies[b].candidates().size()) n -= bodies[b++].candidates().size();
    return bodies[b].candidates().v_move()[n];
  });
  return usual.squaredNorm() > least * least ? usual : Vec3::Zero();
}

Vec3 common_velocity(const ContactBody& body, const Vec3& against, double least) noexcept {
  const auto& v = body.candidates().v_move();
  const Vec3 usual = usual_motion(v.size(), [&](std::size_t n) { return v[n]; });
  if (!((usual - against).squaredNorm() > least * least)) return against;
  double most = 0;
  for (const Vec3& one : v) most = std::max(most, (one - against).squaredNorm());
  const double slow = clearly_slower * clearly_slower * most;
  const auto n_slow =
      std::count_if(v.begin(), v.end(), [&](const Vec3& one) { return (one - usual).squaredNorm() <= slow; });
  return static_cast<double>(n_slow) < most_of_them * static_cast<double>(v.size()) ? against : usual;
}

}  // namespace palpate::physics
