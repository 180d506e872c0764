#pragma once
// For the .cpp files of Hdf5File only: an HDF5 identifier that closes itself, the C++ types in HDF5's words.

#include <hdf5.h>

#include <cstdint>
#include <string>
#include <type_traits>

namespace palpate::hdf5 {

/// An identifier with the function that closes it. Negative: nothing to close.
class Handle {
 public:
  using Close = herr_t (*)(hid_t);
  Handle(hid_t id, Close close) noexcept : id_(id), close_(close) {}
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }
  Handle(Handle&& other) noexcept : id_(other.release()), close_(other.close_) {}
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  hid_t get() const noexcept { return id_; }
  bool valid() const noexcept { return id_ >= 0; }
  /// Hands the identifier out; the caller closes it.
  hid_t release() noexcept {
    const hid_t id = id_;
    id_ = -1;
    return id;
  }

 private:
  hid_t id_;
  Close close_;
};

/// HDF5 prints its own stack of errors unless told not to, and each thread has its own say.
inline void hush() noexcept {
  thread_local const bool done = H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr) >= 0;
  static_cast<void>(done);
}

/// How often HDF5 reads what has a wrong checksum, in a file that may still be written to, before it says
/// that it is damaged. Why: between two attempts it sleeps, 1 ns at first and twice as long each time. Its
/// default of 100 is for ever; 20 are 1 ms in all, and what a writer has half written is whole after some
/// microseconds.
inline constexpr unsigned read_attempts = 20;

/// How files are opened. No locks: a record may be looked at while it grows, and some file systems have none.
inline Handle file_access() {
  Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5Pset_metadata_read_attempts(access.get(), read_attempts);
  H5Pset_file_locking(access.get(), false, true);
  return access;
}

/// Opens a file to read, also one whose writer has not closed it. Negative: cannot be opened
inline hid_t open_to_read(const std::string& path, bool& cut_short) {
  const Handle access = file_access();
  const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDONLY, access.get());
  cut_short = file < 0;
  return cut_short ? H5Fopen(path.c_str(), H5F_ACC_RDONLY | H5F_ACC_SWMR_READ, access.get()) : file;
}

/// The memory type of T.
template <class T>
hid_t type_of() {
  if constexpr (std::is_same_v<T, float>) return H5T_NATIVE_FLOAT;
  if constexpr (std::is_same_v<T, double>) return H5T_NATIVE_DOUBLE;
  if constexpr (std::is_same_v<T, std::int16_t>) return H5T_NATIVE_INT16;
  if constexpr (std::is_same_v<T, std::uint8_t>) return H5T_NATIVE_UINT8;
  if constexpr (std::is_same_v<T, std::int32_t>) return H5T_NATIVE_INT32;
  if constexpr (std::is_same_v<T, std::uint32_t>) return H5T_NATIVE_UINT32;
  if constexpr (std::is_same_v<T, std::uint64_t>) return H5T_NATIVE_UINT64;
}

}  // namespace palpate::hdf5
