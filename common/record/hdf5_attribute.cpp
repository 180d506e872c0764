// Attributes of the root group.
#include <algorithm>
#include <cstring>

#include "common/record/hdf5_file.h"
#include "common/record/hdf5_handle.h"

namespace palpate {
namespace {

using hdf5::Handle;

constexpr std::size_t text_limit = 60'000;  // an attribute must fit into an object header of 64 kB
constexpr hssize_t numbers_limit = 4096;

Handle open_attribute(hid_t file, const std::string& name) {
  return {H5Aopen_by_name(file, "/", name.c_str(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose};
}

/// Makes or replaces an attribute and writes it.
herr_t put(hid_t file, const std::string& name, hid_t type, hid_t space, const void* data) {
  if (H5Aexists_by_name(file, "/", name.c_str(), H5P_DEFAULT) > 0)
    H5Adelete_by_name(file, "/", name.c_str(), H5P_DEFAULT);
  const Handle attribute(
      H5Acreate_by_name(file, "/", name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
      H5Aclose);
  return attribute.valid() ? H5Awrite(attribute.get(), type, data) : -1;
}

/// How many values the attribute has; -1 if it cannot be said.
hssize_t count_of(hid_t attribute) {
  const Handle space(H5Aget_space(attribute), H5Sclose);
  return H5Sget_simple_extent_npoints(space.get());
}

std::string variable_text(hid_t attribute, hid_t type, herr_t& status) {
  char* raw = nullptr;
  const Handle memory(H5Tcopy(type), H5Tclose);
  status = H5Aread(attribute, memory.get(), static_cast<void*>(&raw));
  std::string text =
      status >= 0 && raw != nullptr ? std::string(raw, strnlen(raw, text_limit)) : std::string();
  if (raw != nullptr) H5free_memory(raw);
  return text;
}

}  // namespace

bool Hdf5File::has_attribute(const std::string& name) const {
  hdf5::hush();
  return H5Aexists_by_name(file_, "/", name.c_str(), H5P_DEFAULT) > 0;
}

void Hdf5File::set_text(const std::string& name, const std::string& value) {
  hdf5::hush();
  if (value.size() >= text_limit) fail("attribute " + name + ": the text is longer than 60 kB");
  const Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_size(type.get(), value.size() + 1);
  H5Tset_cset(type.get(), H5T_CSET_UTF8);
  const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
  checked(put(file_, name, type.get(), space.get(), value.c_str()), "cannot write the attribute " + name);
}

void Hdf5File::set_numbers(const std::string& name, const std::vector<double>& values) {
  hdf5::hush();
  const hsize_t n = values.size();
  const Handle space(H5Screate_simple(1, &n, nullptr), H5Sclose);
  checked(put(file_, name, H5T_NATIVE_DOUBLE, space.get(), values.data()),
          "cannot write the attribute " + name);
}

std::string Hdf5File::text(const std::string& name) const {
  hdf5::hush();
  const Handle attribute = open_attribute(file_, name);
  checked(attribute.get(), "there is no attribute " + name);
  const Handle type(H5Aget_type(attribute.get()), H5Tclose);
  if (H5Tget_class(type.get()) != H5T_STRING || count_of(attribute.get()) != 1)
    fail("attribute " + name + " is not one text");
  herr_t status = 0;
  std::string text;
  if (H5Tis_variable_str(type.get()) > 0) {
    text = variable_text(attribute.get(), type.get(), status);
  } else {
    const std::size_t size = H5Tget_size(type.get());
    if (size > text_limit) fail("attribute " + name + " is longer than 60 kB");
    text.resize(size);
    status = H5Aread(attribute.get(), type.get(), text.data());
    text.resize(strnlen(text.data(), size));
  }
  checked(status, "cannot read the attribute " + name);
  return text;
}

std::vector<double> Hdf5File::numbers(const std::string& name) const {
  hdf5::hush();
  const Handle attribute = open_attribute(file_, name);
  checked(attribute.get(), "there is no attribute " + name);
  const Handle type(H5Aget_type(attribute.get()), H5Tclose);
  const H5T_class_t kind = H5Tget_class(type.get());
  if (kind != H5T_FLOAT && kind != H5T_INTEGER) fail("attribute " + name + " is not made of numbers");
  const hssize_t n = count_of(attribute.get());
  if (n < 0 || n > numbers_limit) fail("attribute " + name + " has too many numbers");
  std::vector<double> values(static_cast<std::size_t>(n));
  if (n > 0)
    checked(H5Aread(attribute.get(), H5T_NATIVE_DOUBLE, values.data()), "cannot read the attribute " + name);
  return values;
}

}  // namespace palpate
