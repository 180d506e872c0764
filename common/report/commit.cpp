#include "common/report/commit.h"

#include "palpate_commit.h"

namespace palpate {

std::string commit() { return PALPATE_COMMIT; }
std::string version() { return PALPATE_VERSION; }

}  // namespace palpate
