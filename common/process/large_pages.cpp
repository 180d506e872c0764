// Every program of palpate takes large memory in pages of 2 MB where the system has them. Why: a scan is tables of some 10 MB that are
// filled once and then read all over; in pages of 4 KB a head of 1.6 million cells loads in 1.5 times the time, most of which the
// system spends on handing out pages, and the processor on finding them.
//
// ZeroedArray stays with small pages: of what it holds most is never touched.

#include <sys/mman.h>

#include <cstdlib>
#include <new>

namespace {

constexpr std::size_t large = std::size_t{8} << 20, page = std::size_t{2} << 20;

void* take(std::size_t size) noexcept {
  if (size < large) return std::malloc(size == 0 ? 1 : size);
  const std::size_t whole = (size + page - 1) / page * page;
  void* const memory = whole < size ? nullptr : std::aligned_alloc(page, whole);
  if (memory != nullptr)
    madvise(memory, whole, MADV_HUGEPAGE);  // a wish: where it is refused all is as before
  return memory;
}

}  // namespace

// As the standard has it: whoever wants other memory has set a handler.
void* operator new(std::size_t size) {
  for (;;) {
    if (void* const memory = take(size)) return memory;
    const std::new_handler handler = std::get_new_handler();
    if (handler == nullptr) throw std::bad_alloc();
    handler();
  }
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
