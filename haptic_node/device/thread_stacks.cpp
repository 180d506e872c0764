// Gives every thread of palpate-haptic an alternate stack, also those that DDS, drivers and vendors' libraries start: takes
// the place of pthread_create. Why: sigaltstack() holds for one thread only, and a thread that has run over its stack without
// one dies before any handler is called. Linked into palpate-haptic itself and into nothing else.

#include <dlfcn.h>
#include <pthread.h>

#include <new>

#include "haptic_node/loop/alternate_stack.h"

namespace {

using Create = int(pthread_t*, const pthread_attr_t*, void* (*)(void*), void*);

struct Beginning {
  void* (*start)(void*);
  void* argument;
};

void* begin_with_stack(void* given) {
  const Beginning beginning = *static_cast<Beginning*>(given);
  delete static_cast<Beginning*>(given);
  static thread_local palpate::haptic::AlternateStack stack;  // gone with the thread, however that ends
  static_cast<void>(&stack);
  return beginning.start(beginning.argument);
}

}  // namespace

extern "C" __attribute__((visibility("default"))) int pthread_create(pthread_t* thread,
                                                                     const pthread_attr_t* attributes,
                                                                     void* (*start)(void*), void* argument) {
  static Create* const create = reinterpret_cast<Create*>(dlsym(RTLD_NEXT, "pthread_create"));
  auto* beginning = new (std::nothrow) Beginning{start, argument};
  if (beginning == nullptr) return create(thread, attributes, start, argument);
  const int error = create(thread, attributes, begin_with_stack, beginning);
  if (error != 0) delete beginning;
  return error;
}
