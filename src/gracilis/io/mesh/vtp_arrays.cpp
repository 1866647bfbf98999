#include <gracilis/io/mesh/vtp_arrays.hpp>

#include <gracilis/core/errors.hpp>
#include <gracilis/io/mesh/vtk_messages.hpp>

#include <fmt/format.h>

#include <vtkBase64Utilities.h>
#include <vtkDataCompressor.h>
#include <vtkLZ4DataCompressor.h>
#include <vtkLZMADataCompressor.h>
#include <vtkSmartPointer.h>
#include <vtkZLibDataCompressor.h>

#include <algorithm>
#include <functional>

namespace gracilis {

namespace {

/// Takes bytes from the front of what is stored, raw or as base64, and never more than there are.
class StoredBytes {
 public:
  StoredBytes(std::string_view stored, bool base64, const VtpStorage& storage, const std::string& array)
      : rest_(stored), base64_(base64), storage_(storage), array_(array) {}

  [[noreturn]] void fail(const std::string& what) const {
    throw InputError({storage_.path.string(), "array " + array_, what, "export the surface again"});
  }

  /// The first `count` bytes without taking them away.
  std::string peek(std::size_t count) const {
    if (count > stored_size(rest_.size())) fail("ends before all announced bytes");
    if (!base64_) return std::string(rest_.substr(0, count));
    const std::string_view letters = rest_.substr(0, letters_for(count));
    std::string bytes(letters.size() / 4 * 3, '\0');
    const std::size_t decoded =
        vtkBase64Utilities::DecodeSafely(reinterpret_cast<const unsigned char*>(letters.data()), letters.size(),
                                         reinterpret_cast<unsigned char*>(bytes.data()), bytes.size());
    if (decoded < count) fail("is not base64");
    bytes.resize(count);
    return bytes;
  }

  /// Each piece of base64 is padded to whole groups of four letters.
  std::string take(std::size_t count) {
    std::string bytes = peek(count);
    rest_.remove_prefix(base64_ ? letters_for(count) : count);
    return bytes;
  }

 private:
  static std::size_t letters_for(std::size_t bytes) { return (bytes + 2) / 3 * 4; }
  std::size_t stored_size(std::size_t length) const { return base64_ ? length / 4 * 3 : length; }

  std::string_view rest_;
  bool base64_;
  const VtpStorage& storage_;
  const std::string& array_;
};

}  // namespace

static std::vector<double> numbers_in(const std::string& bytes, ScalarType type, Encoding encoding,
                                      const std::filesystem::path& path) {
  ValueReader reader(path, bytes);
  reader.encoding = encoding;
  std::vector<double> numbers;
  numbers.reserve(bytes.size() / size_of(type));
  while (!reader.at_end()) numbers.push_back(reader.number(type));
  return numbers;
}

static vtkSmartPointer<vtkDataCompressor> compressor_named(const std::string& name, const StoredBytes& bytes) {
  if (name == "vtkZLibDataCompressor") return vtkSmartPointer<vtkZLibDataCompressor>::New();
  if (name == "vtkLZ4DataCompressor") return vtkSmartPointer<vtkLZ4DataCompressor>::New();
  if (name == "vtkLZMADataCompressor") return vtkSmartPointer<vtkLZMADataCompressor>::New();
  bytes.fail("is compressed with '" + name + "', which is unknown");
}

/// Header: number of blocks, size of a block, size of the last block if it is smaller (else 0), compressed size of
/// each.
static std::string uncompressed(StoredBytes& bytes, std::size_t word, const VtpStorage& storage,
                                const std::function<void(double)>& require) {
  const auto words = [&](const std::string& text) {
    return numbers_in(text, storage.header_type, storage.byte_order, storage.path);
  };
  const std::vector<double> sizes = words(bytes.peek(3 * word));
  if (sizes[0] == 0) return "";
  if (sizes[0] > 1e8 || sizes[1] > 1e9 || sizes[2] > sizes[1]) bytes.fail("announces impossible blocks");
  const double total = sizes[2] > 0 ? (sizes[0] - 1) * sizes[1] + sizes[2] : sizes[0] * sizes[1];
  require(total);
  const std::vector<double> header = words(bytes.take((3 + static_cast<std::size_t>(sizes[0])) * word));
  double compressed_total = 0;
  for (std::size_t i = 3; i < header.size(); ++i) compressed_total += header[i];
  const std::string compressed = bytes.take(static_cast<std::size_t>(std::min(compressed_total, 1e15)));
  const auto compressor = compressor_named(storage.compressor, bytes);
  VtkMessages messages;
  std::string data(static_cast<std::size_t>(total), '\0');
  std::size_t position = 0, filled = 0;
  for (std::size_t block = 3; block < header.size(); ++block) {
    const bool last = block + 1 == header.size();
    const auto size = static_cast<std::size_t>(last && sizes[2] > 0 ? sizes[2] : sizes[1]);
    const auto compressed_size = static_cast<std::size_t>(header[block]);
    const std::size_t got =
        compressor->Uncompress(reinterpret_cast<const unsigned char*>(compressed.data()) + position, compressed_size,
                               reinterpret_cast<unsigned char*>(data.data()) + filled, size);
    if (got != size) bytes.fail("has a damaged block");
    filled += size;
    position += compressed_size;
  }
  return data;
}

std::vector<double> decode_array(std::string_view stored, bool base64, ScalarType type, const VtpStorage& storage,
                                 const std::string& array, std::optional<std::size_t> expected, NumberBudget& budget) {
  StoredBytes bytes(stored, base64, storage, array);
  const std::size_t word = storage.header_type == ScalarType::uint64 ? 8 : 4;
  const auto require = [&](double announced) {
    const double numbers = announced / static_cast<double>(size_of(type));
    if (expected && numbers != static_cast<double>(*expected))
      bytes.fail(fmt::format("announces {} numbers where there must be {}", numbers, *expected));
    if (!(numbers <= static_cast<double>(budget.left)))
      bytes.fail(fmt::format("announces {} numbers, more than a file of its size can honestly hold", numbers));
    budget.left -= static_cast<std::size_t>(numbers);
  };
  std::string data;
  if (!storage.compressor.empty()) {
    data = uncompressed(bytes, word, storage, require);
  } else {
    const double size = numbers_in(bytes.peek(word), storage.header_type, storage.byte_order, storage.path)[0];
    require(size);
    data = bytes.take(word + static_cast<std::size_t>(size)).substr(word);
  }
  return numbers_in(data, type, storage.byte_order, storage.path);
}

}  // namespace gracilis
