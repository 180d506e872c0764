#include "common/record/hdf5_file.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <stdexcept>

#include "common/error/error.h"
#include "common/file/new_file.h"
#include "common/record/hdf5_handle.h"

namespace palpate {

using hdf5::Handle;

Hdf5File::Hdf5File(const std::string& path, Mode mode) : path_(path), mode_(mode) {
  hdf5::hush();
  if (mode == Mode::read) {
    std::error_code ignored;
    if (!std::filesystem::exists(path, ignored)) fail("there is no such file");
    file_ = checked(hdf5::open_to_read(path, cut_short_), "is not an HDF5 file, or is truncated");
    return;
  }
  const Handle access = hdf5::file_access();
  if (mode == Mode::record)
    checked(H5Pset_libver_bounds(access.get(), H5F_LIBVER_V110, H5F_LIBVER_V110), "HDF5 cannot be set up");
  // A new file, never what a link points to: HDF5 would follow it.
  if (!make_way(path)) fail(std::string("cannot be replaced (") + std::strerror(errno) + ")");
  file_ = checked(H5Fcreate(path.c_str(), H5F_ACC_EXCL, H5P_DEFAULT, access.get()), "cannot be created");
}

Hdf5File::~Hdf5File() {
  hdf5::hush();
  for (const auto& [name, id] : series_) H5Dclose(id);
  if (file_ >= 0) H5Fclose(file_);
}

void Hdf5File::make_group(const std::string& path) {
  hdf5::hush();
  if (has(path)) return;
  const Handle creation(H5Pcreate(H5P_LINK_CREATE), H5Pclose);
  H5Pset_create_intermediate_group(creation.get(), 1);
  const Handle group(H5Gcreate2(file_, path.c_str(), creation.get(), H5P_DEFAULT, H5P_DEFAULT), H5Gclose);
  checked(group.get(), "cannot make the group " + path);
}

bool Hdf5File::has(const std::string& path) const {
  hdf5::hush();
  // H5Lexists wants every parent to exist, so look along the path.
  for (std::size_t at = path.find_first_not_of('/'); at != std::string::npos;) {
    const std::size_t slash = path.find('/', at);
    if (H5Lexists(file_, path.substr(0, slash).c_str(), H5P_DEFAULT) <= 0) return false;
    at = path.find_first_not_of('/', slash);
  }
  return H5Oexists_by_name(file_, path.c_str(), H5P_DEFAULT) > 0;
}

void Hdf5File::start() {
  hdf5::hush();
  checked(H5Fstart_swmr_write(file_), "cannot be opened to readers");
}

void Hdf5File::flush() {
  hdf5::hush();
  checked(H5Fflush(file_, H5F_SCOPE_GLOBAL), "cannot be written to");
}

void Hdf5File::close() {
  hdf5::hush();
  herr_t status = 0;
  for (const auto& [name, id] : series_) status = std::min(status, H5Dclose(id));
  series_.clear();
  if (file_ >= 0) status = std::min({status, H5Fflush(file_, H5F_SCOPE_GLOBAL), H5Fclose(file_)});
  file_ = -1;
  checked(status, "cannot be written to; is the disk full?");
}

void Hdf5File::fail(const std::string& what) const { throw std::runtime_error(path_ + ": " + what); }

std::int64_t Hdf5File::checked(std::int64_t status, const std::string& what) const {
  if (status < 0) fail(what);
  return status;
}

void mend(const std::string& path) {
  hdf5::hush();
  const Handle access = hdf5::file_access();
  const bool yes = true;  // as the tool h5clear of HDF5 does
  H5Pset(access.get(), "clear_status_flags", &yes);
  const Handle file(H5Fopen(path.c_str(), H5F_ACC_RDWR, access.get()), H5Fclose);
  if (!file.valid())
    throw InputError(
        path + ": cannot be mended: it may not be written, is no record, or is damaged at its beginning");
}

}  // namespace palpate
