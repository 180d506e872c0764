#include "physics_node/record/mend_record.h"

#include <stdexcept>

#include "common/error/error.h"
#include "common/record/hdf5_file.h"

namespace palpate::physics {
namespace {

bool is_cut_short(const std::string& path) {
  try {
    return Hdf5File(path, Hdf5File::Mode::read).cut_short();
  } catch (const std::runtime_error& none) {
    throw InputError(none.what());
  }
}

}  // namespace

bool mend_record(const std::string& path) {
  if (!is_cut_short(path)) return false;
  mend(path);
  return true;
}

}  // namespace palpate::physics
