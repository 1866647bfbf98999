#pragma once

#include <gracilis/io/value_reader.hpp>

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace gracilis {

/// How all binary arrays of one of VTK's XML files are stored; the attributes of its first element say so.
struct VtpStorage {
  std::filesystem::path path;
  Encoding byte_order = Encoding::little_endian;
  ScalarType header_type = ScalarType::uint32;  ///< of the sizes before the data
  std::string compressor;  ///< vtkZLibDataCompressor, vtkLZ4DataCompressor, vtkLZMADataCompressor; or empty
};

/// The numbers of an array from its stored bytes, which begin at the start of `stored` and may be followed by others: a
/// header with sizes, then the data, in one piece or in compressed blocks; all of it raw or as base64. Throws
/// InputError naming `array` when the bytes do not hold what their header says.
std::vector<double> decode_array(std::string_view stored, bool base64, ScalarType type, const VtpStorage& storage,
                                 const std::string& array);

}  // namespace gracilis
