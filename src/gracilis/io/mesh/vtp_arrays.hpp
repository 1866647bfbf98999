#pragma once

#include <gracilis/io/value_reader.hpp>

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace gracilis {

/// What a reader may still take from its file. Each number costs it up to 64 bytes until a surface is made, so with as
/// many numbers as the file has bytes, and a million more, it needs no more than 64 times the file and 64 MiB. Honest
/// compression stays below: coordinates take two bytes or more each.
struct NumberBudget {
  std::size_t left = 0;

  /// Of a file of this size.
  explicit NumberBudget(std::size_t file_bytes) : left(file_bytes + (std::size_t{1} << 20)) {}
};

/// How all binary arrays of one of VTK's XML files are stored; the attributes of its first element say so.
struct VtpStorage {
  std::filesystem::path path;
  Encoding byte_order = Encoding::little_endian;
  ScalarType header_type = ScalarType::uint32;  ///< of the sizes before the data
  std::string compressor;  ///< vtkZLibDataCompressor, vtkLZ4DataCompressor, vtkLZMADataCompressor; or empty
};

/// The numbers of an array from its stored bytes, which begin at the start of `stored` and may be followed by others: a
/// header with sizes, then the data, in one piece or in compressed blocks; all of it raw or as base64. What the sizes
/// announce is compared with `expected` (how many numbers there must be, if that is known) and with the budget before
/// anything is inflated. Throws InputError naming `array` when the bytes do not hold what their header says.
std::vector<double> decode_array(std::string_view stored, bool base64, ScalarType type, const VtpStorage& storage,
                                 const std::string& array, std::optional<std::size_t> expected, NumberBudget& budget);

}  // namespace gracilis
