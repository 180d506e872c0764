// What a peer is that was not there when this program was built.

#include "bench/peers/beam_peers.h"
#include "bench/peers/solver.h"

namespace palpate::bench {

#ifndef PALPATE_PEERS_BULLET
Peer bullet_peer() { return {"Bullet", "", "libbullet-dev", "", {}}; }
std::optional<RestingBeam> bullet_beam(int, double) { return std::nullopt; }
#endif
#ifndef PALPATE_PEERS_MUJOCO
Peer mujoco_peer() { return {"MuJoCo", "", "libmujoco-dev", "", {}}; }
#endif

}  // namespace palpate::bench
