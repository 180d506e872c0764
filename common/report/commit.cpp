#include "common/report/commit.h"

#include "palpate_commit.h"

namespace palpate {

std::string commit() { return PALPATE_COMMIT; }

}  // namespace palpate
