// The methods of the page: those that follow the sliders, most of all. Stands in for methods/every_method.cpp.
#include <gracilis/methods/every_method.hpp>

#include <gracilis/methods/arap/arap_method.hpp>
#include <gracilis/methods/pbd/pbd_method.hpp>
#include <gracilis/methods/skinning/skinning_method.hpp>
#include <gracilis/methods/strings/strings_method.hpp>
#include <gracilis/methods/xpbd/xpbd_method.hpp>

namespace gracilis {

std::vector<MethodEntry> every_method() {
  return {xpbd_entry(), strings_entry(), pbd_entry(), arap_entry(), skinning_entry()};
}

}  // namespace gracilis
