#include "physics_node/record/earlier_record.h"

#include <fmt/format.h>

namespace palpate::physics {

std::optional<std::filesystem::path> set_earlier_record_aside(const std::filesystem::path& folder) {
  namespace fs = std::filesystem;
  const fs::path record = folder / "record.h5";
  if (!fs::exists(record)) return std::nullopt;
  fs::path aside;
  for (int n = 1; aside.empty() || fs::exists(aside); ++n) aside = folder / fmt::format("record_{}.h5", n);
  fs::rename(record, aside);
  return aside;
}

}  // namespace palpate::physics
