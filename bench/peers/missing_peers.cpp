// What a peer is that was not there when this program was built.

#include "bench/peers/solver.h"

namespace palpate::bench {

#ifndef PALPATE_PEERS_BULLET
Peer bullet_peer() { return {"Bullet", "", "libbullet-dev", "", {}}; }
#endif
#ifndef PALPATE_PEERS_MUJOCO
Peer mujoco_peer() { return {"MuJoCo", "", "libmujoco-dev", "", {}}; }
#endif

}  // namespace palpate::bench
