#include <gracilis/methods/every_method.hpp>

#include <gracilis/methods/arap/arap_method.hpp>
#include <gracilis/methods/cylinder/cylinder_method.hpp>
#include <gracilis/methods/mass_spring/mass_spring_method.hpp>
#include <gracilis/methods/pbd/pbd_method.hpp>
#include <gracilis/methods/rbf/rbf_method.hpp>
#include <gracilis/methods/skinning/skinning_method.hpp>
#include <gracilis/methods/strings/strings_method.hpp>
#include <gracilis/methods/tissue/tissue_method.hpp>
#include <gracilis/methods/xpbd/xpbd_method.hpp>

namespace gracilis {

std::vector<MethodEntry> every_method() {
  return {xpbd_entry(), cylinder_entry(), skinning_entry(), tissue_entry(),     pbd_entry(),
          arap_entry(), rbf_entry(),      strings_entry(),  mass_spring_entry()};
}

}  // namespace gracilis
