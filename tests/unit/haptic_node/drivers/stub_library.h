#pragma once
// The stand-in for a vendor's library, which the driver under test loads by the same name.

#include <dlfcn.h>
#include <gtest/gtest.h>

namespace palpate::haptic::test {

/// @param function  exported by the library, hands out its controls
template <class Controls>
Controls& stub_library(const char* file, const char* function) {
  void* handle = dlopen(file, RTLD_NOW | RTLD_LOCAL);
  if (handle == nullptr) {
    ADD_FAILURE() << dlerror();
    std::abort();
  }
  return *reinterpret_cast<Controls* (*)()>(dlsym(handle, function))();
}

}  // namespace palpate::haptic::test
