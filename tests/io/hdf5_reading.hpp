#pragma once

#include <hdf5.h>

#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

namespace gracilis {

/// Numbers of an HDF5 file, as the library itself reads them, with their shape.
struct Hdf5Numbers {
  std::vector<hsize_t> shape;
  std::vector<double> values;
};

inline Hdf5Numbers hdf5_numbers(const std::filesystem::path& file, const std::string& name) {
  const hid_t opened = H5Fopen(file.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  const hid_t numbers = opened < 0 ? -1 : H5Dopen2(opened, name.c_str(), H5P_DEFAULT);
  if (numbers < 0) throw std::runtime_error("no " + name);
  const hid_t space = H5Dget_space(numbers);
  Hdf5Numbers result;
  result.shape.resize(static_cast<std::size_t>(H5Sget_simple_extent_ndims(space)));
  H5Sget_simple_extent_dims(space, result.shape.data(), nullptr);
  result.values.resize(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)));
  H5Dread(numbers, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, result.values.data());
  H5Sclose(space), H5Dclose(numbers), H5Fclose(opened);
  return result;
}

inline std::vector<std::string> hdf5_texts(const std::filesystem::path& file, const std::string& object,
                                           const std::string& attribute) {
  const hid_t opened = H5Fopen(file.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  const hid_t found =
      opened < 0 ? -1 : H5Aopen_by_name(opened, object.c_str(), attribute.c_str(), H5P_DEFAULT, H5P_DEFAULT);
  if (found < 0) throw std::runtime_error("no " + attribute + " at " + object);
  const hid_t space = H5Aget_space(found), type = H5Aget_type(found);
  std::vector<char*> texts(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)));
  H5Aread(found, type, texts.data());
  const std::vector<std::string> result(texts.begin(), texts.end());
  H5Dvlen_reclaim(type, space, H5P_DEFAULT, texts.data());
  H5Tclose(type), H5Sclose(space), H5Aclose(found), H5Fclose(opened);
  return result;
}

inline bool hdf5_has(const std::filesystem::path& file, const std::string& name) {
  const hid_t opened = H5Fopen(file.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  const bool has = opened >= 0 && H5Lexists(opened, name.c_str(), H5P_DEFAULT) > 0;
  if (opened >= 0) H5Fclose(opened);
  return has;
}

}  // namespace gracilis
