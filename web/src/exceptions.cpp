// What C++ calls to throw. There is no unwinding here: the page is told the message, throws it as an exception of its
// own through all that is running, and begins again with a new instance of the program.
#include "exceptions.hpp"

#include <gracilis/core/errors.hpp>

#include <cstdlib>
#include <cstring>
#include <stdexcept>
#include <string>
#include <typeinfo>

// By JavaScript: throws.
extern "C" __attribute__((import_module("page"), import_name("fail"))) void page_fail(const char* text,
                                                                                      std::size_t length);

namespace gracilis {

void fail(const char* text) {
  page_fail(text, std::strlen(text));
  __builtin_unreachable();
}

}  // namespace gracilis

extern "C" {

void* __cxa_allocate_exception(std::size_t size) { return std::malloc(size); }
void __cxa_free_exception(void* thrown) { std::free(thrown); }

[[noreturn]] void __cxa_throw(void* thrown, std::type_info* type, void (*)(void*)) {
  using namespace gracilis;
  // All that Gracilis throws has std::runtime_error first.
  for (const std::type_info* known : {&typeid(InputError), &typeid(ConfigurationError), &typeid(QualityError),
                                      &typeid(Error), &typeid(std::runtime_error)})
    if (*type == *known) gracilis::fail(static_cast<std::runtime_error*>(thrown)->what());
  gracilis::fail(type->name());
}

/// Of what a thread has for itself: there is one thread, and it never ends.
int __cxa_thread_atexit(void (*)(void*), void*, void*) { return 0; }

}  // extern "C"
