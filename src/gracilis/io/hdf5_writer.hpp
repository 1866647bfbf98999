#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace gracilis {

/// A new HDF5 file as it is filled. Objects are named by their path in it, as in "/runs/a/time"; groups on the way are
/// made. Throws InputError with the path that people see, from all functions.
class Hdf5Writer {
 public:
  /// Creates `file`, replacing what is there. `shown` is what messages call it.
  Hdf5Writer(const std::filesystem::path& file, std::filesystem::path shown);
  ~Hdf5Writer();
  Hdf5Writer(const Hdf5Writer&) = delete;
  Hdf5Writer& operator=(const Hdf5Writer&) = delete;

  /// Numbers of this shape, the last index fastest. With three indices compressed, a chunk for each of the first.
  /// Precondition: as many values as the shape says, at least one.
  void write(const std::string& name, const std::vector<std::uint64_t>& shape, std::span<const double> values);
  /// As above, in single precision.
  void write(const std::string& name, const std::vector<std::uint64_t>& shape, std::span<const float> values);
  /// As above, of integers.
  void write(const std::string& name, const std::vector<std::uint64_t>& shape, std::span<const std::int32_t> values);

  /// A group at this path, with those on the way to it.
  void make_group(const std::string& name);
  /// With all below it; nothing where there is none.
  void remove(const std::string& name);
  /// An attribute of a group or of numbers that are there: a text, or a list of them.
  void describe(const std::string& object, const std::string& attribute, const std::string& text);
  /// A list of texts; nothing where it is empty.
  void describe(const std::string& object, const std::string& attribute, const std::vector<std::string>& texts);

  /// Writes what is not on the disk yet. Without it the file is not complete.
  void close();

 private:
  [[noreturn]] void fail(const std::string& what) const;
  std::int64_t checked(std::int64_t result, const std::string& what) const;
  void write(const std::string& name, const std::vector<std::uint64_t>& shape, std::int64_t type, const void* values);

  std::int64_t file_ = -1;
  std::filesystem::path shown_;
};

}  // namespace gracilis
