#pragma once
// A DDS domain that other tests on this machine hardly use at the same time.

#include <unistd.h>

namespace palpate::test {

inline int own_domain() { return 1 + static_cast<int>(getpid() % 99); }

}  // namespace palpate::test
