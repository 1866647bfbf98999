#pragma once

#include <gracilis/transfer/transfer.hpp>
#include <gracilis/view/pictures/picture.hpp>

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace gracilis {

/// From four sides: above the subject's bones, colored by how far the template's, laid on them, lie from them; below
/// the muscles on them. `scene` is the subject's.
Picture transfer_picture(const Transferred& transferred, const Scene& scene);

/// What the page tells beside what `transferred` holds.
struct TransferPage {
  std::string origin;  ///< the template's name
  std::vector<std::string> left_out, warnings;
  std::string picture;  ///< a .png's bytes; empty: none
};

/// Writes one HTML file that needs nothing but itself. Throws InputError.
void write_transfer_page(const std::filesystem::path& path, const Transferred& transferred, const TransferPage& page);

}  // namespace gracilis
