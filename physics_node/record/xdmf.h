#pragma once
// Tells viewers (VTK, ParaView) how to read record.h5: one temporal collection, in it all bodies at each time.

#include <cstdint>
#include <string>
#include <vector>

namespace palpate::physics {

struct XdmfBody {
  std::string name;
  std::uint64_t n_masses = 0;
  std::uint64_t n_facets = 0;
  std::uint64_t n_rows = 0;  // of its series, at least as many as there are times
};

/// @param hdf5  name of the record, beside the file written
/// @throws std::runtime_error: cannot be written
void write_xdmf(const std::string& path, const std::string& hdf5, const std::vector<XdmfBody>& bodies,
                const std::vector<double>& times);

}  // namespace palpate::physics
